#include "benchmarks/studies/models/models_results.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/plain/error.h"

namespace dartboard {

double error_of(const BarErrors& errors, Asked asked) {
  switch (asked) {
    case Asked::tip: return errors.tip;
    case Asked::frequencies: return errors.frequencies;
    case Asked::confined: return errors.confined;
    case Asked::motion: return errors.motion;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

const BarTruth& ModelsResults::truth(double poisson) const {
  const auto at = std::ranges::find(truths, poisson, &BarTruth::poisson);
  if (at == truths.end()) throw InputError("there is no reference of that Poisson's ratio");
  return *at;
}

double ModelsResults::known_error(const ModelPoint& point, Asked asked) const {
  return std::max({exact, error_of(point.measured.errors, asked), error_of(truth(point.timed.poisson).unsure, asked)});
}

Figure cost_of(const std::vector<Sample>& samples, const TimedBar& bar) {
  Figure cost = cpu_figure(samples, bar.name());
  const double per_second = 1e-9 / bar.simulated();
  cost.median *= per_second;
  cost.interval.low *= per_second;
  cost.interval.high *= per_second;
  return cost;
}

bool belongs(const ModelPoint& point, std::string_view family) {
  return point.timed.model.find(family) != std::string::npos;
}

const ModelPoint* ModelsResults::cheapest(Asked asked, double poisson, double error, std::string_view family) const {
  const ModelPoint* best = nullptr;
  for (const ModelPoint& p : points)
    if (p.timed.poisson == poisson && belongs(p, family) && known_error(p, asked) <= error &&
        (best == nullptr || p.cost.median < best->cost.median))
      best = &p;
  return best;
}

Figure ModelsResults::cost_ratio(const ModelPoint& point, const ModelPoint& baseline) const {
  Figure ratio = paired_ratio(samples, point.timed.name(), baseline.timed.name()).cpu;
  const double scale = baseline.timed.simulated() / point.timed.simulated();
  ratio.median *= scale;
  ratio.interval.low *= scale;
  ratio.interval.high *= scale;
  return ratio;
}

double cost_for(const ModelsResults& results, const std::string& model, Asked asked, double poisson, double error) {
  double least = std::numeric_limits<double>::infinity();
  const ModelPoint* coarser = nullptr;
  for (const ModelPoint& p : results.points) {
    if (p.timed.poisson != poisson || p.timed.model != model) continue;
    const double here = results.known_error(p, asked);
    if (here <= error) least = std::min(least, p.cost.median);
    if (coarser != nullptr && here <= error && error < results.known_error(*coarser, asked)) {
      const double before = results.known_error(*coarser, asked);
      const double part = std::log(before / error) / std::log(before / here);
      least = std::min(least, coarser->cost.median * std::pow(p.cost.median / coarser->cost.median, part));
    }
    coarser = &p;
  }
  return least;
}

std::vector<Reign> reigns(const ModelsResults& results, Asked asked, double poisson) {
  constexpr double in_a_decade = 100.0;
  std::vector<double> errors;
  std::vector<std::string> models;
  for (const ModelPoint& p : results.points) {
    if (p.timed.poisson != poisson) continue;
    errors.push_back(results.known_error(p, asked));
    if (std::ranges::find(models, p.timed.model) == models.end()) models.push_back(p.timed.model);
  }
  std::vector<Reign> found;
  if (models.empty()) return found;
  const auto [smallest, largest] = std::ranges::minmax(errors);
  const int steps = static_cast<int>(in_a_decade * std::log10(largest / smallest));
  for (int k = 1; k <= steps; ++k) errors.push_back(largest * std::pow(10.0, -k / in_a_decade));
  std::ranges::sort(errors, std::greater());
  for (const double error : errors) {
    const auto cost = [&](const std::string& model) { return cost_for(results, model, asked, poisson, error); };
    const std::string& best = *std::ranges::min_element(models, {}, cost);
    if (found.empty())
      found.push_back({best, error, std::numeric_limits<double>::infinity()});
    else if (found.back().model == best)
      found.back().least = error;
    else
      found.push_back({best, error, found.back().least});
  }
  return found;
}

}  // namespace dartboard
