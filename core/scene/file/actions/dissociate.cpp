#include "core/scene/file/actions/dissociate.h"

#include "core/scene/file/keys/scene_value.h"

namespace dartboard {

Dissociate Dissociate::read(const SceneValue& value) {
  if (const auto facets = value.find<FacetPoints>("points")) return {*facets};
  if (value.has(BladeSweep::key)) return {BladeSweep::read(value.at(BladeSweep::key))};
  const auto plane = PlaneSelection::read(value.at(PlaneSelection::key));
  Dissociate cut{plane};
  if (value.has("within")) cut.within = read_one_of<CutRegion>(value.at("within"), plane.normal);
  return cut;
}

}  // namespace dartboard
