#include "core/scene/file/actions/tear_where_stressed.h"

#include "core/scene/file/keys/scene_value.h"

namespace dartboard {

TearWhereStressed TearWhereStressed::read(const SceneValue& value) {
  TearWhereStressed tear{value.get<double>("threshold"), {}, value.find<std::size_t>("most_per_step")};
  if (value.has(PlaneSelection::key)) tear.seam = PlaneSelection::read(value.at(PlaneSelection::key));
  return tear;
}

}  // namespace dartboard
