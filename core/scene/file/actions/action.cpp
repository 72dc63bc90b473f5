#include "core/scene/file/actions/action.h"

#include "core/scene/file/keys/scene_value.h"

namespace dartboard {

Action read_action(const SceneValue& event, bool has_springs) {
  return read_one_of<Action>(event, has_springs).value();
}

std::string_view key_of(const Action& action) {
  return std::visit([](const auto& kind) { return kind.key; }, action);
}

bool changes_topology(const Action& action) {
  return std::visit([](const auto& kind) { return kind.changes_topology; }, action);
}

bool dissociates(const Action& action) {
  return std::visit([](const auto& kind) { return kind.dissociates; }, action);
}

std::string SceneEvent::action_path() const { return path + "/" + std::string(key_of(action)); }

}  // namespace dartboard
