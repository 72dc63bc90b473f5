#include "validation/paper/maps/cost_of_coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/topology/build.h"
#include "core/topology/cells.h"

namespace dartboard {
namespace {

CountingMap counting_copy(const Map3& map) {
  CountingMap copy;
  for (std::size_t k = 0; k < map.capacity(); ++k) copy.add_dart();
  map.for_each_dart([&](Dart d) {
    const auto link = [&]<int i>(std::integral_constant<int, i>) {
      if (d < map.alpha<i>(d)) copy.link<i>(d, map.alpha<i>(d));
    };
    link(std::integral_constant<int, 0>{});
    link(std::integral_constant<int, 1>{});
    link(std::integral_constant<int, 2>{});
    link(std::integral_constant<int, 3>{});
  });
  return copy;
}

}  // namespace

Coverage core_coverage() {
  return [](const CountingMap& map, int i) -> std::size_t {
    std::size_t cells = 0;
    const auto count = [&](auto) { ++cells; };
    switch (i) {
      case 0: for_each_cell<0>(map, count); break;
      case 1: for_each_cell<1>(map, count); break;
      case 2: for_each_cell<2>(map, count); break;
      default: for_each_cell<3>(map, count); break;
    }
    return cells;
  };
}

ClaimAnswer try_coverages(std::span<const Mesh> bodies, const Coverage& cover) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  std::size_t smallest = std::numeric_limits<std::size_t>::max(), largest = 0;
  for (const Mesh& mesh : bodies) {
    const CountingMap map = counting_copy(build_map<Map3>(mesh).map);
    smallest = std::min(smallest, map.dart_count());
    largest = std::max(largest, map.dart_count());
    for (int i = 0; i <= 3; ++i) {
      const std::size_t before = map.storage().looks();
      cover(map, i);
      const double each = static_cast<double>(map.storage().looks() - before) / static_cast<double>(map.dart_count());
      least = std::min(least, each);
      most = std::max(most, each);
    }
  }
  return {largest >= 8 * smallest && least >= 1.0 && most <= 1.01 * least,
          fmt::format("{:.3g} to {:.3g} look-ups per dart in bodies of {} to {} darts, for cells of any dimension",
                      least, most, smallest, largest)};
}

}  // namespace dartboard
