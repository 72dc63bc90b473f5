#pragma once
// The columns of a frame that follow from vertices and springs, for bodies of every kind.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/contact/contacts.h"
#include "core/forces/springs.h"
#include "core/mechanics/fracture/stress.h"
#include "core/mechanics/mass_spring_body.h"
#include "core/scene/body/frame.h"
#include "core/time/system/spring_system.h"

namespace dartboard {

/// Number the points by the file of the mesh, where `number` has one for each of its points, and put them into the
/// order of these numbers: parts of a vertex one after another, vertices that refinement made last.
void put_in_order(Frame& frame, std::span<const std::uint32_t> number);

/// Fill the columns of a frame from the vertices and springs of a system: places, velocities and masses always, stress,
/// displacement and strain where `fields` asks for them; only the run knows how vertices are held.
///
/// Stresses are those of `vertex_stresses`, strains (l - L) / L. A number that is not finite, as the strain of a spring
/// without length at rest, is infinity.
/// pre   the frame has its cells and links; vertices have their rest positions if displacement is asked for, and there are
///       volumes if stress is
/// cost  O(vertices + springs)
void fill_columns(Frame& frame, const FrameFields& fields, const VertexColumns& vertices, const SpringSystem& system,
                  const VertexVolumes& volumes);

/// The column `held` of a frame: 0 for a free vertex, 1 for a fixed one, 2 for a fixed one that `is_driven`, which
/// takes the number of its mesh point, 3 for one that is held along some axes.
std::vector<std::uint8_t> constraints_of(
    const VertexColumns& vertices,
    const std::function<bool(std::uint32_t)>& is_driven = [](std::uint32_t) { return false; });

/// Fill the columns of contact for the vertices of a body that has contact with obstacles or bodies; one may be null.
/// pre  the frame has its points
void fill_contact(Frame& frame, const Contacts& contacts);

}  // namespace dartboard
