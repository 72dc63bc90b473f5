#include "validation/paper/indexed_structure.h"

#include <fmt/format.h>

#include "core/operations/dissociate_face.h"
#include "core/operations/remove_volume.h"

namespace dartboard {
namespace {

/// What is not as the cells say; empty where all is.
std::string compare(const CutSubject& s, const SpringEndsView& view) {
  std::size_t edges = 0, vertices = 0;
  std::string differs;
  std::vector<char> edge_met(s.body.springs.size(), 0), vertex_met(s.body.vertices.size(), 0);
  s.cells.for_each_vertex([&](std::uint32_t, std::span<const std::uint32_t> corners) {
    ++vertices;
    const std::uint32_t number = s.vertex_at(corners.front());
    for (const std::uint32_t k : corners)
      if (s.vertex_at(k) != number) differs = "a vertex has two numbers";
    if (number >= vertex_met.size() || vertex_met[number]++) differs = "two vertices have one number";
  });
  s.cells.for_each_edge([&](std::uint32_t, std::span<const std::uint32_t> of_cells) {
    ++edges;
    const std::uint32_t number = s.edge_at(of_cells.front());
    if (number >= view.ends.size() || edge_met[number]++) {
      differs = "two edges have one number";
      return;
    }
    const auto [a, b] = s.cells.ends(of_cells.front());
    if (std::minmax(view.ends[number][0], view.ends[number][1]) != std::minmax(s.vertex_at(a), s.vertex_at(b)))
      differs = fmt::format("spring {} ends elsewhere", number);
    if (s.body.springs[number].stiffness != static_cast<double>(of_cells.size()) * s.problem.material.stiffness)
      differs = fmt::format("spring {} has another stiffness", number);
  });
  if (view.ends.size() != edges) differs = fmt::format("{} springs for {} edges", view.ends.size(), edges);
  if (s.body.vertices.size() != vertices) differs = fmt::format("{} nodes for {}", s.body.vertices.size(), vertices);
  return differs;
}

}  // namespace

ClaimAnswer translate_operations(const Problem& problem, int operations, std::uint64_t seed,
                                 const Follow<Map3>& translate) {
  CutSubject s(problem);
  Views views;
  views.rebuild(s.body);
  SplitMix64 random(seed);
  int done = 0, removed = 0;
  for (; done < operations; ++done) {
    const auto side = s.joined_side(random);
    if (!side) break;
    const std::uint32_t c = s.cell_of_side(*side);
    if (done % 8 == 7) {
      translate(s.body, views, remove_volume(s.body.map, s.places.side[*side]));
      s.cells.remove(c);
      ++removed;
    } else {
      translate(s.body, views, dissociate_face(s.body.map, s.places.side[*side]));
      s.cells.dissociate(*side);
    }
    if (const std::string differs = compare(s, views.ends); !differs.empty())
      return {false, fmt::format("operation {}: {}", done, differs)};
  }
  return {removed > 0, fmt::format("{} dissociations and {} removals translated, the arrays right after each",
                                   done - removed, removed)};
}

}  // namespace dartboard
