#pragma once
// The kinds of force that a body has because a key of its scene asks for them: one source each, in core/scene/forces.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/file/keys/scene_keys.h"
#include "core/scene/file/selections/selection.h"

namespace dartboard {

struct ForceNeed;
struct Problem;
struct SceneFile;
class SceneValue;

/// A kind of force. Functions that are null have nothing to do.
struct ForceKind {
  using Selection = std::function<void(const std::string& path, VertexSelection&)>;
  using Number = std::function<void(const std::string& path, double)>;

  std::string_view name;  // "attachments": of its row in plans and of its bytes
  KeyRows rows{};

  bool changes_energy = false;  // also where nothing about it changes in time

  bool (*is_in)(const SceneFile&) = nullptr;
  /// From a scene that has been checked against the table of keys.
  void (*read)(const SceneValue&, SceneFile&) = nullptr;
  /// The selections of vertices that it makes: the numbers of points in a mesh file are replaced, and they are counted.
  void (*for_each_selection)(SceneFile&, const Selection&) = nullptr;
  /// The sizes of the numbers that it gives, one of which is named where the sum of all forces is not finite.
  void (*for_each_number)(const SceneFile&, const Number&) = nullptr;
  /// On the mesh of the scene; no value where it has no such force (core/scene/forces/body_force.h).
  std::optional<ForceNeed> (*need)(const SceneFile&, const Problem&) = nullptr;
};

/// All of them, in the order in which their forces are added (core/scene/forces/kinds.h).
std::span<const ForceKind> force_kinds();

inline void for_each_selection_of_forces(SceneFile& scene, const ForceKind::Selection& visit) {
  for (const ForceKind& kind : force_kinds())
    if (kind.for_each_selection != nullptr) kind.for_each_selection(scene, visit);
}
/// Visits the selections without changing any.
inline void for_each_selection_of_forces(
    const SceneFile& scene, const std::function<void(const std::string& path, const VertexSelection&)>& visit) {
  for_each_selection_of_forces(const_cast<SceneFile&>(scene), ForceKind::Selection(visit));
}

}  // namespace dartboard
