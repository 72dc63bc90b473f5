#include "core/time/system/node_pattern.h"

#include <algorithm>

namespace dartboard {

namespace {

/// visit(ends) for every spring, then for every pair of each piece of each force term.
template <class Visit>
void for_each_pair(const SpringSystem& system, const Visit& visit) {
  for (const SpringEnds& ends : system.ends) visit(ends);
  for (const ForceTerm* term : system.terms)
    for (std::size_t piece = 0; piece < term->size(); ++piece) {
      const ForceTerm::Nodes nodes = term->nodes(piece);
      for (std::size_t a = 1; a < nodes.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) visit(SpringEnds{nodes[a], nodes[b]});
    }
}

}  // namespace

NodePattern node_pattern_of(const SpringSystem& system) {
  const std::size_t n = system.vertex_count();
  NodePattern pattern;
  const auto coupled = [&system](const SpringEnds& ends) {
    return ends[0] != ends[1] && !system.fixed[ends[0]] && !system.fixed[ends[1]];
  };

  std::vector<std::uint32_t> start(n + 1, 0);
  std::uint32_t pairs = 0;
  for_each_pair(system, [&](const SpringEnds& ends) {
    if (coupled(ends)) ++start[std::min(ends[0], ends[1]) + 1];
    ++pairs;
  });
  for (std::size_t j = 0; j < n; ++j) start[j + 1] += start[j];

  struct Entry {
    std::uint32_t row, pair;
  };
  std::vector<Entry> entries(start[n]);
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  std::uint32_t pair = 0;
  for_each_pair(system, [&](const SpringEnds& ends) {
    if (coupled(ends)) entries[next[std::min(ends[0], ends[1])]++] = {std::max(ends[0], ends[1]), pair};
    ++pair;
  });

  pattern.column_start.assign(n + 1, 0);
  pattern.row.reserve(entries.size());
  pattern.place.assign(pairs, NodePattern::none);
  for (std::size_t j = 0; j < n; ++j) {
    const auto first = entries.begin() + start[j], last = entries.begin() + start[j + 1];
    std::sort(first, last, [](const Entry& a, const Entry& b) { return a.row < b.row; });
    for (auto entry = first; entry != last; ++entry) {
      if (entry == first || entry->row != std::prev(entry)->row) pattern.row.push_back(entry->row);
      pattern.place[entry->pair] = static_cast<std::uint32_t>(pattern.row.size() - 1);
    }
    pattern.column_start[j + 1] = static_cast<std::uint32_t>(pattern.row.size());
  }
  return pattern;
}

}  // namespace dartboard
