#include "core/operations/tear_fan.h"

#include "core/operations/dissociate_face.h"
#include "core/topology/cells.h"

namespace dartboard {
namespace {

// Follow the fan from d and add the faces met; true if it came back to d.
template <class Map>
bool follow(const Map& map, Dart d, Mark& on_fan, std::vector<Dart>& faces) {
  Dart at = d;
  for (;;) {
    const Dart across = map.template alpha<2>(at);
    if (map.template is_free<3>(across)) return false;  // the surface
    at = map.template alpha<3, 2, 1>(across);
    if (at == d) return true;
    // all darts of the face, so that its other side is recognised too
    if (on_fan(at)) continue;
    for_each_dart_of(map, Face{at}, [&](Dart e) { on_fan.set(e); });
    faces.push_back(at);
  }
}

}  // namespace

template <class Map>
std::vector<Dart> fan(const Map& map, Dart d) {
  std::vector<Dart> faces{d};
  Mark on_fan(map);
  for_each_dart_of(map, Face{d}, [&](Dart e) { on_fan.set(e); });
  if (!follow(map, d, on_fan, faces)) follow(map, map.template alpha<1>(d), on_fan, faces);
  return faces;
}

template <class Map>
TopologyChange tear_fan(Map& map, Dart d) {
  map.require_live(d);
  TopologyChange change;
  for (const Dart face : fan(map, d)) change.append(dissociate_face(map, face));
  return change;
}

template std::vector<Dart> fan(const Map3&, Dart);
template std::vector<Dart> fan(const TetMap&, Dart);
template TopologyChange tear_fan(Map3&, Dart);
template TopologyChange tear_fan(TetMap&, Dart);

}  // namespace dartboard
