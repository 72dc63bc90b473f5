#include "core/time/system/node_pattern.h"

#include <algorithm>

namespace dartboard {

NodePattern node_pattern_of(const SpringSystem& system) {
  const std::size_t n = system.vertex_count();
  NodePattern pattern;
  const auto coupled = [&system](const SpringEnds& ends) {
    return ends[0] != ends[1] && !system.fixed[ends[0]] && !system.fixed[ends[1]];
  };

  std::vector<std::uint32_t> start(n + 1, 0);
  for (const SpringEnds& ends : system.ends)
    if (coupled(ends)) ++start[std::min(ends[0], ends[1]) + 1];
  for (std::size_t j = 0; j < n; ++j) start[j + 1] += start[j];

  struct Entry {
    std::uint32_t row, spring;
  };
  std::vector<Entry> entries(start[n]);
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (std::uint32_t e = 0; e < system.ends.size(); ++e) {
    const SpringEnds& ends = system.ends[e];
    if (coupled(ends)) entries[next[std::min(ends[0], ends[1])]++] = {std::max(ends[0], ends[1]), e};
  }

  pattern.column_start.assign(n + 1, 0);
  pattern.row.reserve(entries.size());
  pattern.place.assign(system.ends.size(), NodePattern::none);
  for (std::size_t j = 0; j < n; ++j) {
    const auto first = entries.begin() + start[j], last = entries.begin() + start[j + 1];
    std::sort(first, last, [](const Entry& a, const Entry& b) { return a.row < b.row; });
    for (auto entry = first; entry != last; ++entry) {
      if (entry == first || entry->row != std::prev(entry)->row) pattern.row.push_back(entry->row);
      pattern.place[entry->spring] = static_cast<std::uint32_t>(pattern.row.size() - 1);
    }
    pattern.column_start[j + 1] = static_cast<std::uint32_t>(pattern.row.size());
  }
  return pattern;
}

}  // namespace dartboard
