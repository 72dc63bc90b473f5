#pragma once
// The contact of a body with the obstacles of a scene.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/contact/obstacle_contact.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// pre  the samples live as long as the contact
std::unique_ptr<ObstacleContact> make_contact(const std::vector<SceneObstacle>& obstacles,
                                              const std::vector<SkinSample>& samples);

/// The body of the scene that a cell of its mesh belongs to; `first_cell` has the first cell of each body.
/// pre  not empty, ascending, from 0 on
std::uint32_t body_of_cell(std::span<const std::size_t> first_cell, std::size_t cell);

}  // namespace dartboard
