#pragma once
// Events made ready for a body: an overload for each kind of action.

#include <memory>
#include <string>

#include "core/mechanics/vertex_columns.h"
#include "core/scene/body/events/changing_body.h"
#include "core/scene/body/events/ready_event.h"
#include "core/scene/file/actions/action.h"

namespace dartboard {

// `path` is that of the action, "/events/3/remove"; the body must outlive the event.
//
// throws  InputError "PATH/...: ..." for an id or face that the body does not have, or an action that does not exist in
//         its dimension
template <class Map>
std::unique_ptr<ReadyEvent> ready(ChangingBody<Map>& on, const Dissociate& dissociate, const std::string& path);
template <class Map>
std::unique_ptr<ReadyEvent> ready(ChangingBody<Map>& on, const Remove& remove, const std::string& path);
template <class Map>
std::unique_ptr<ReadyEvent> ready(ChangingBody<Map>& on, const Tear& tear, const std::string& path);
template <class Map>
std::unique_ptr<ReadyEvent> ready(ChangingBody<Map>& on, const TearWhereStressed& tear, const std::string& path);
template <class Map>
std::unique_ptr<ReadyEvent> ready(ChangingBody<Map>& on, const Refine& refine, const std::string& path);

// Actions that leave the topology as it is need no map.

/// Vertices are known by the mesh point they came from, as driven ones are: all parts of one that came apart are
/// released. Their points are chosen now, and none is added to the targets; `apply` returns the number of vertices.
///
/// pre     the vertices are at rest, and outlive the event
/// throws  InputError "PATH: ..." if no selected vertex is fixed
std::unique_ptr<ReadyEvent> ready(VertexColumns& vertices, const Release& release, const std::string& path);

template <class Map, class Kind>
std::unique_ptr<ReadyEvent> ready(ChangingBody<Map>& on, const Kind& action,
                                  const std::string& path) requires(!Kind::changes_topology) {
  return ready(on.body().vertices, action, path);
}

}  // namespace dartboard
