#include "core/scene/file/force_kind.h"
#include "core/scene/forces/kinds.h"

namespace dartboard {

std::span<const ForceKind> force_kinds() {
  static const std::vector<ForceKind> kinds = [] {
    std::vector<ForceKind> all;
    for (const auto make : kinds_in_order) all.push_back(make());
    return all;
  }();
  return kinds;
}

KeyRows keys_of_forces() {
  KeyRows all;
  const auto append = [](auto& to, const auto& rows) { to.insert(to.end(), rows.begin(), rows.end()); };
  for (const ForceKind& kind : force_kinds()) {
    append(all.keys, kind.rows.keys);
    append(all.shapes, kind.rows.shapes);
    append(all.rules, kind.rows.rules);
  }
  return all;
}

}  // namespace dartboard
