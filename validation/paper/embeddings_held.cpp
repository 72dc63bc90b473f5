#include "validation/paper/embeddings_held.h"

#include <fmt/format.h>

#include "core/walks/dart_coverage.h"
#include "core/walks/embedding_lists.h"
#include "core/walks/runge_kutta_4.h"

namespace dartboard {
namespace {

template <class Body>
void move(Body& body, double h, int steps) {
  RungeKutta4 integrator;
  for (int k = 0; k < steps; ++k) integrator.step(DartCoverage{}, body, h);
  EmbeddingLists lists;
  lists.rebuild(body);
  for (int k = 0; k < steps; ++k) integrator.step(lists, body, h);
}

}  // namespace

ClaimAnswer same_results(MassSpringBody<Map3, Held::by_one_dart> one, MassSpringBody<Map3, Held::by_every_dart> every,
                         double h, int steps) {
  std::size_t darts = 0, alike = 0;
  every.map.for_each_dart([&](Dart d) {
    ++darts;
    const auto number = [&](const auto& body) {
      return std::array{body.vertex(body.map, d), body.edge(body.map, d), body.face(body.map, d),
                        body.cell(body.map, d)};
    };
    const auto found = number(one);
    alike += found == number(every) && std::ranges::find(found, no_embedding) == found.end() ? 1 : 0;
  });
  const auto start = every.state_hash();
  move(one, h, steps);
  move(every, h, steps);
  const bool same =
      one.vertices.position == every.vertices.position && one.vertices.velocity == every.vertices.velocity;
  return {alike == darts && darts > 0 && same && every.state_hash() != start,
          fmt::format("{} of {} darts find the same embeddings; states after {} steps {}", alike, darts, 2 * steps,
                      same ? "equal to the last bit" : "NOT equal")};
}

ClaimAnswer try_both_ways_to_hold(const Problem& problem, int steps) {
  return same_results(build_body<Map3, Held::by_one_dart>(problem), build_body<Map3, Held::by_every_dart>(problem),
                      problem.h, steps);
}

}  // namespace dartboard
