#include "validation/paper/removals_share.h"

#include <fmt/format.h>

#include <set>

#include "core/operations/remove_volume.h"
#include "validation/conservation/conserved_sums.h"
#include "validation/paper/worst_share.h"

namespace dartboard {
namespace {

struct Totals {
  TwofoldSum mass, stiffness;
};
Totals totals_of(const LiveBody<Map3>& body) {
  Totals totals;
  for (const double m : body.vertices.mass) totals.mass.add(m);
  for (const Spring spring : body.springs) totals.stiffness.add(spring.stiffness);
  return totals;
}

/// Their difference, without the rounding of either.
double lost(const TwofoldSum& before, const TwofoldSum& after) {
  return (before.high - after.high) + (before.low - after.low);
}

}  // namespace

RemovalAnswers try_removals(const Problem& problem, int removals, std::uint64_t seed, const Adapt& follow) {
  CutSubject s(problem);
  s.deform();
  SplitMix64 random(seed);
  const auto cells = static_cast<std::uint32_t>(problem.mesh.cell_count());
  const double k = problem.material.stiffness;

  WorstShare masses, lost_mass, lost_stiffness;
  bool stiffness_counted = true, freed = true, only_these = true, gone = true;
  std::size_t faces_freed = 0, neighbours = 0;
  int done = 0;
  for (; done < removals && s.cells.count() > 0; ++done) {
    std::uint32_t c = random.below(cells);
    while (!s.cells.is_there(c)) c = (c + 1) % cells;
    std::set<std::uint32_t> corners, edges, sides;  // of the cells around it
    // bounds on the errors of the sums: masses and stiffnesses are summed anew where the volume was, before and after
    double mass_rounding = s.rounding[c] * static_cast<double>(problem.mesh.cell(c).size()), stiffness_rounding = 0.0;
    for (std::uint32_t side = s.cells.first_side(c); side < s.cells.first_side(c + 1); ++side)
      if (s.cells.is_joined(side)) sides.insert(s.cells.opposite(side));
    for (std::uint32_t n = problem.mesh.first[c]; n < problem.mesh.first[c + 1]; ++n) {
      const auto around = s.cells.vertex(n);
      mass_rounding += 2.0 * gamma(around.size() + 1) * s.body.vertices.mass[s.vertex(n)];
      for (const std::uint32_t m : around)
        if (s.cells.cell_of_corner(m) != c) corners.insert(m);
    }
    const auto is_own = [&](std::uint32_t e) { return s.cells.first_edge(c) <= e && e < s.cells.first_edge(c + 1); };
    for (std::uint32_t e = s.cells.first_edge(c); e < s.cells.first_edge(c + 1); ++e) {
      stiffness_rounding += gamma(2) * s.body.springs[s.edge(e)].stiffness;
      for (const std::uint32_t f : s.cells.edge(e))
        if (!is_own(f)) edges.insert(f);
    }

    const Totals before = totals_of(s.body);
    follow(s.body, remove_volume(s.body.map, s.darts_of(c).front()));
    s.cells.remove(c);
    for (const Dart d : s.darts_of(c)) gone = gone && !s.body.map.is_live(d);
    for (const std::uint32_t m : corners) {
      const auto [exact, bound] = s.mass_of(s.cells.vertex(m));
      masses.compare(s.body.vertices.mass[s.vertex(m)], exact, bound);
    }
    for (const std::uint32_t e : edges)
      stiffness_counted =
          stiffness_counted && s.body.springs[s.edge(e)].stiffness == static_cast<double>(s.cells.edge(e).size()) * k;
    neighbours += corners.size();
    const Totals after = totals_of(s.body);
    lost_mass.compare(lost(before.mass, after.mass), reference::rounded(s.share[c] * problem.mesh.cell(c).size()),
                      mass_rounding);
    lost_stiffness.compare(lost(before.stiffness, after.stiffness),
                           static_cast<double>(s.cells.first_edge(c + 1) - s.cells.first_edge(c)) * k,
                           stiffness_rounding);

    for (const std::uint32_t side : sides) freed = freed && s.body.map.is_free<3>(s.places.side[side]);
    faces_freed += sides.size();
    for (std::uint32_t side = 0; side < s.places.side.size(); ++side)
      if (s.cells.is_there(s.cell_of_side(side)))
        only_these = only_these && s.body.map.is_free<3>(s.places.side[side]) == !s.cells.is_joined(side);
  }

  RemovalAnswers answers;
  const bool counted = stiffness_counted && lost_stiffness.within();
  answers.shares = {done > 0 && neighbours > 0 && masses.within() && lost_mass.within() && counted,
                    fmt::format("{} removals; masses off by {:.2g} of the rounding bound, losses by {:.2g}, "
                                "stiffnesses {}",
                                done, masses.share(), lost_mass.share(),
                                counted ? "those of the cells left" : "NOT those of the cells left")};
  answers.free_faces = {done > 0 && faces_freed > 0 && freed && only_these && gone,
                        fmt::format("{} faces of {} removals {} and no other", faces_freed, done,
                                    freed && only_these && gone ? "became 3-free," : "did NOT all become 3-free,")};
  return answers;
}

}  // namespace dartboard
