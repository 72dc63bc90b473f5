#include "reference/dart_table.h"

#include <algorithm>
#include <numeric>

namespace dartboard::reference {

std::vector<std::uint32_t> orbits(const DartTable& table, std::initializer_list<int> involutions) {
  std::vector<std::uint32_t> above(table.size());
  std::iota(above.begin(), above.end(), std::uint32_t{0});
  const auto top = [&](std::uint32_t d) {
    while (above[d] != d) d = above[d] = above[above[d]];
    return d;
  };
  for (const int i : involutions)
    for (std::uint32_t d = 0; d < table.size(); ++d) {
      if (!table.is_live(d)) continue;
      const std::uint32_t a = top(d), b = top(table(i, d));
      above[std::max(a, b)] = std::min(a, b);
    }
  for (std::uint32_t d = 0; d < table.size(); ++d) above[d] = top(d);
  return above;
}

PaperFan paper_fan(const DartTable& table, std::uint32_t d0) {
  PaperFan fan{{d0}, false};
  for (const std::uint32_t start : {d0, table(1, d0)}) {
    for (std::uint32_t d = start;;) {
      const std::uint32_t across = table(2, d);
      if (table(3, across) == across) break;  // the surface of the object
      d = table(1, table(2, table(3, across)));
      fan.closed = d == d0;
      if (fan.closed || d == start) return fan;
      fan.darts.push_back(d);
    }
  }
  return fan;
}

}  // namespace dartboard::reference
