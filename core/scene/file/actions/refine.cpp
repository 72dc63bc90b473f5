#include "core/scene/file/actions/refine.h"

#include "core/scene/file/keys/scene_value.h"

namespace dartboard {

Refine Refine::read(const SceneValue& value, bool has_springs) {
  if (value.has("bracing") && !has_springs)
    value.fail_at("bracing", "is " + value.at("bracing").shown(), "no such key: a body of elements has no springs");
  return {read_cells(value.at("cells")), value.get<std::string>("at") == "centre",
          value.find<double>("bracing").value_or(0.5)};
}

}  // namespace dartboard
