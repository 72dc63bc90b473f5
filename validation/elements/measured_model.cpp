#include "validation/elements/measured_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/plain/error.h"

namespace dartboard {
namespace {

constexpr double part_of_error = 0.1;  // of a model's own error, which steps may add

}  // namespace

BarMeshes bar_meshes(const ClampedBar& bar, bool quick) {
  BarMeshes meshes;
  for (const int finer : quick ? std::vector{1, 2} : std::vector{1, 2, 3, 4, 6, 8})
    if (bar.nodes(finer) <= BarMeshes::most_nodes) meshes.models.push_back(finer);
  // quadratic elements have the nodes of a mesh twice as fine
  for (const int finer : quick ? std::vector{2, 4} : std::vector{2, 4, 6})
    if (bar.nodes(2 * finer) <= BarMeshes::most_true_nodes) meshes.truth = finer;
  if (bar.nodes(4) > BarMeshes::most_nodes)
    throw InputError(fmt::format(
        "/body/generate/box/cells: the largest cubes make a mesh of {} x {} x {}, of which a reference has {} nodes; "
        "expected {} at most: numbers of cells with a larger common divisor",
        bar.cubes[0], bar.cubes[1], bar.cubes[2], bar.nodes(4), BarMeshes::most_nodes));
  return meshes;
}

BarTruth bar_truth(const ClampedBar& bar, const BarMeshes& meshes, double poisson) {
  BarTruth truth{.poisson = poisson};
  truth.answers = true_answers(bar, meshes.truth, poisson, truth.beats);
  truth.unsure = errors_of(true_answers(bar, meshes.truth / 2, poisson, truth.beats), truth.answers);
  return truth;
}

MeasuredModel measure_model(const ClampedBar& bar, const BarModel& model, int finer, const BarTruth& truth,
                            const std::function<std::int64_t()>& clock) {
  auto body = bar_body(bar, model, finer, truth.poisson);
  const BarAnswers answers = model_answers(bar, model, finer, *body, truth.beats);
  const std::vector<std::uint32_t> watched = watched_vertices(bar, *body);
  BentBar bent(bar, std::move(body), answers.bent);
  MeasuredModel m{.model = model,
                  .finer = finer,
                  .nodes = answers.nodes,
                  .errors = errors_of(answers, truth.answers),
                  .method = {}};
  m.model_motion = m.errors.motion;
  m.allowed = part_of_error * std::max(m.model_motion, truth.unsure.motion);
  m.method = best_method(bent, truth.beats, watched, answers.motion, truth.answers.motion, m.allowed,
                         bar_methods(bent, truth.beats), clock);
  if (m.method.integrator.empty()) return m;
  m.errors.motion = m.method.total_error;
  m.h = truth.beats.period / static_cast<double>(m.method.steps);
  return m;
}

}  // namespace dartboard
