#pragma once
// Events: the one list of their actions, and what is asked of an action of any kind.

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "core/scene/file/actions/dissociate.h"
#include "core/scene/file/actions/refine.h"
#include "core/scene/file/actions/release.h"
#include "core/scene/file/actions/remove.h"
#include "core/scene/file/actions/tear.h"
#include "core/scene/file/actions/tear_where_stressed.h"

namespace dartboard {

using Action = std::variant<Dissociate, Remove, Tear, TearWhereStressed, Refine, Release>;

/// The action that the keys of an event name.
/// throws  InputError as the `read` of its kind does
Action read_action(const SceneValue& event, bool has_springs);
/// "dissociate": the key that names the action of an event.
std::string_view key_of(const Action& action);
bool changes_topology(const Action& action);
/// Does it take facets apart, and nothing else?
bool dissociates(const Action& action);

/// An action and the steps at which it happens: an event that is due at n happens after n steps.
struct SceneEvent {
  Action action;
  double from, until;           // [s]; equal for an event that happens once
  std::optional<double> every;  // [s]; no value: at every step
  std::string path;             // "/events/3"

  /// "/events/3/dissociate"
  std::string action_path() const;
};

/// f(path, choice) for each of the event's selections of cells (CellSelection) and of vertices at rest
/// (VertexSelection), for the number of a point (std::uint32_t), and for facets by their points (FacetPoints).
template <class Event, class F>
void for_each_choice(Event& event, F&& f) {
  std::visit([&](auto& action) { action.for_each_choice(action, event.action_path(), f); }, event.action);
}

/// Has one of the events an action of this kind?
template <class Kind>
bool has(std::span<const SceneEvent> events) {
  return std::ranges::any_of(events,
                             [](const SceneEvent& event) { return std::holds_alternative<Kind>(event.action); });
}

}  // namespace dartboard
