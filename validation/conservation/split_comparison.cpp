#include "validation/conservation/split_comparison.h"

#include <algorithm>
#include <cmath>

#include "core/mechanics/split_off.h"
#include "core/topology/check.h"
#include "core/walks/runge_kutta_4.h"
#include "validation/conservation/conserved_sums.h"

namespace dartboard {
namespace {

constexpr int steps = 3;

template <class Map>
void move(LiveBody<Map>& body, const CellArrays& arrays, double h) {
  RungeKutta4 rk;
  for (int k = 0; k < steps; ++k) rk.step(arrays, body, h);
}

/// The numbers of the body's vertices (edges) at the given darts, ascending, each once.
template <class Number>
std::vector<std::uint32_t> numbers_at(const std::vector<Dart>& darts, Number&& number) {
  std::vector<std::uint32_t> numbers;
  for (const Dart d : darts) numbers.push_back(number(d));
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

}  // namespace

template <class Map>
void split_off_and_compare(Subject<Map>& at, std::span<const std::uint32_t> leaving, ConservationLedger& ledger) {
  LiveBody<Map>& body = at.body;
  LiveBody<Map> whole = body;
  const CellArrays whole_arrays = at.views.cells;
  std::vector<Dart> darts;
  for (const std::uint32_t c : leaving) darts.insert(darts.end(), at.darts_of(c).begin(), at.darts_of(c).end());
  const auto vertices = numbers_at(darts, [&whole](Dart d) { return whole.vertex(whole.map, d); });
  const auto edges = numbers_at(darts, [&whole](Dart d) { return whole.edge(whole.map, d); });

  auto split = split_off(body, at.darts_of(leaving[0]).front());
  at.views.apply(body, split.change, split.changed);
  LiveBody<Map>& part = split.part;
  CellArrays part_arrays;
  part_arrays.rebuild(part);

  const std::size_t which = part.cell_dart.size();
  ledger.equal(Check::split_cells, check(part.map), std::string(), "violation in a part, cells", which);
  ledger.equal(Check::split_cells, part.cell_dart.size(), leaving.size(), "cells of a part, cells", which);
  ledger.equal(Check::split_cells, part.vertices.size(), vertices.size(), "vertices of a part, cells", which);
  ledger.equal(Check::split_cells, part.springs.size(), edges.size(), "springs of a part, cells", which);
  ledger.equal(Check::split_cells, body.cell_dart.size(), at.cells.count() - leaving.size(), "cells left, of a part of",
               which);
  ledger.equal(Check::split_cells, body.vertices.size(), whole.vertices.size() - vertices.size(),
               "vertices left, of a part of", which);
  ledger.equal(Check::split_cells, body.springs.size(), whole.springs.size() - edges.size(),
               "springs left, of a part of", which);
  ledger.equal(Check::split_cells, body.face_dart.size() + part.face_dart.size(), whole.face_dart.size(),
               "faces of both, of a part of", which);
  if (ledger.broken()) return;

  const ConservedSums before = sums_of(whole, whole_arrays), of_part = sums_of(part, part_arrays),
                      of_rest = sums_of(body, at.views.cells);
  for (std::size_t i = 0; i < conserved_count; ++i) {
    const TwofoldSum &w = before.sums[i], &p = of_part.sums[i], &r = of_rest.sums[i];
    const double bound = 1.001 * gamma(4) * (w.magnitude + p.magnitude + r.magnitude);
    ledger.within(Check::split_sums, std::abs((w.value() - p.value()) - r.value()), bound, w.magnitude,
                  p.value() + r.value(), w.value());
  }

  // its numbers are in the same order as in the whole
  move(whole, whole_arrays, at.start->h);
  move(part, part_arrays, at.start->h);
  for (std::uint32_t k = 0; k < vertices.size(); ++k) {
    const bool same = part.vertices.position[k] == whole.vertices.position[vertices[k]] &&
                      part.vertices.velocity[k] == whole.vertices.velocity[vertices[k]];
    ledger.require(Check::split_bits, same, "vertex of a part", k);
  }
}

template void split_off_and_compare(Subject<Map2>&, std::span<const std::uint32_t>, ConservationLedger&);
template void split_off_and_compare(Subject<Map3>&, std::span<const std::uint32_t>, ConservationLedger&);
template void split_off_and_compare(Subject<TetMap>&, std::span<const std::uint32_t>, ConservationLedger&);

}  // namespace dartboard
