#include "validation/elements/model_advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/plain/error.h"

namespace dartboard {
namespace {

constexpr double least_order = 0.5;  // errors that fall more slowly have a floor, as those of springs: not trusted

constexpr CellKind tetrahedra = CellKind::tetrahedron, hexahedra = CellKind::hexahedron;
constexpr std::array<BarModel, 5> models{{{Model::springs, tetrahedra},
                                          {Model::neo_hookean, tetrahedra},
                                          {Model::corotational, tetrahedra},
                                          {Model::neo_hookean, hexahedra},
                                          {Model::corotational, hexahedra}}};

}  // namespace

double ModelTrend::order() const {
  return std::log(coarse_error / fine_error) / std::log(static_cast<double>(fine) / coarse);
}

int ModelTrend::finer_for(double error) const {
  if (coarse_error <= error) return coarse;
  if (fine_error <= error) return fine;
  if (!(order() >= least_order)) return 0;
  const double needed = fine * std::pow(fine_error / error, 1.0 / order());
  return needed < 1e3 ? std::max(fine + 1, static_cast<int>(std::ceil(needed))) : 0;
}

double ModelTrend::cost_at(int finer) const { return fine_cost * std::pow(static_cast<double>(finer) / fine, 4.0); }

const MeasuredModel* ModelAdvice::pick() const {
  return why_not.empty() && !trials.empty() ? &trials.back().measured : nullptr;
}

ModelAdvice advise_model(const ClampedBar& bar, const BarMeshes& meshes, double poisson, double error,
                         const std::function<std::int64_t()>& clock,
                         const std::function<void(const std::string&)>& tells) {
  if (!(error > 0.0)) throw InputError(fmt::format("an error of {} is requested; expected one above 0", error));
  ModelAdvice advice{.error = error, .trends = {}, .trials = {}};
  const auto tell = [&](const std::string& what) {
    if (tells) tells(what);
  };
  const BarTruth truth = bar_truth(bar, meshes, poisson);
  tell("the reference");
  if (error < 2.0 * truth.unsure.motion) {
    advice.why_not = fmt::format("the reference cannot resolve errors below {:.2g}", 2.0 * truth.unsure.motion);
    return advice;
  }
  std::vector<int> least;  // the fineness that each model needs, by the measurements
  for (const BarModel& model : models) {
    ModelTrend trend{.model = model};
    const MeasuredModel coarse = measure_model(bar, model, trend.coarse, truth, clock);
    const MeasuredModel fine = measure_model(bar, model, trend.fine, truth, clock);
    tell(in_words(model));
    if (coarse.method.integrator.empty() || fine.method.integrator.empty()) continue;
    trend.coarse_error = coarse.errors.motion;
    trend.fine_error = fine.errors.motion;
    trend.fine_cost = fine.rough_cost();
    advice.trends.push_back(trend);
    least.push_back(trend.finer_for(error));
  }
  for (;;) {
    std::size_t best = advice.trends.size();
    for (std::size_t k = 0; k < advice.trends.size(); ++k)
      if (least[k] > 0 && bar.nodes(least[k]) <= BarMeshes::most_nodes &&
          (best == advice.trends.size() ||
           advice.trends[k].cost_at(least[k]) < advice.trends[best].cost_at(least[best])))
        best = k;
    if (best == advice.trends.size()) {
      advice.why_not =
          fmt::format("no model has an error of {:g} on a mesh of up to {} nodes", error, BarMeshes::most_nodes);
      return advice;
    }
    const ModelTrend& trend = advice.trends[best];
    const int finer = least[best];
    const double predicted = trend.fine_error * std::pow(static_cast<double>(trend.fine) / finer, trend.order());
    advice.trials.push_back({predicted, trend.cost_at(finer), measure_model(bar, trend.model, finer, truth, clock)});
    const MeasuredModel& measured = advice.trials.back().measured;
    tell(fmt::format("{}, {} finer", in_words(trend.model), finer));
    if (!measured.method.integrator.empty() && measured.errors.motion <= error) return advice;
    least[best] = finer + 1;
  }
}

}  // namespace dartboard
