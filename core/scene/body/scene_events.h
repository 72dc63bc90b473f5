#pragma once
// The events of a scene on a body: looked up once at the start, applied when they are due.

#include <memory>

#include "core/scene/body/simulated_body.h"
#include "core/scene/file/scene_file.h"
#include "core/topology/generalized_map.h"

namespace dartboard {

template <class Map>
class BodyOnMap;

/// `body` must outlive the event.
///
/// throws  InputError "/events/3/...: ..." for an id or face that the body does not have, or an action that does not
///         exist in its dimension
template <class Map>
std::unique_ptr<ReadyEvent> make_event_ready(BodyOnMap<Map>& body, const SceneEvent& event);

extern template std::unique_ptr<ReadyEvent> make_event_ready(BodyOnMap<Map2>&, const SceneEvent&);
extern template std::unique_ptr<ReadyEvent> make_event_ready(BodyOnMap<Map3>&, const SceneEvent&);
extern template std::unique_ptr<ReadyEvent> make_event_ready(BodyOnMap<TetMap>&, const SceneEvent&);

}  // namespace dartboard
