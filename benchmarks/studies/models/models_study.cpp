#include "benchmarks/studies/models/models_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/models/model_times.h"
#include "benchmarks/studies/models/models_report.h"
#include "core/plain/error.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {
namespace {

constexpr double sample_ns = 1e7;  // target for the time of a sample
constexpr double fewest_steps = 16.0, most_steps = 1e5;

constexpr CellKind tetrahedra = CellKind::tetrahedron, hexahedra = CellKind::hexahedron;

std::vector<BarModel> models_of(bool quick) {
  if (quick) return {{Model::springs, tetrahedra}, {Model::neo_hookean, tetrahedra}, {Model::neo_hookean, hexahedra}};
  return {{Model::springs, tetrahedra},      {Model::springs, tetrahedra, 0.2}, {Model::neo_hookean, tetrahedra},
          {Model::corotational, tetrahedra}, {Model::stvk, tetrahedra},         {Model::neo_hookean, hexahedra},
          {Model::corotational, hexahedra}};
}

/// Corotational elements take three times as long as others: minutes on the finest meshes.
int finest(const BarModel& model) { return model.model == Model::corotational ? 6 : 8; }

/// Measured as `measure_model` does; a study that goes on, or is derived again, has it already.
MeasuredModel measure_once(const ClampedBar& bar, const BarModel& model, int finer, const BarTruth& truth,
                           StudyLog& log) {
  const nlohmann::json found = log.once(fmt::format("{}, {} finer, {}", in_words(model), finer, truth.poisson), [&] {
    const MeasuredModel m = measure_model(bar, model, finer, truth, thread_cpu_ns);
    const BarErrors& e = m.errors;
    const BestMethod& best = m.method;
    return nlohmann::json{
        {"nodes", m.nodes},
        {"errors", {e.tip, e.frequencies, e.confined, e.motion, e.worst_frequency}},
        {"model_motion", m.model_motion},
        {"allowed", m.allowed},
        {"method", {best.integrator, best.steps, best.error, best.total_error, best.step_ns, best.followed}},
        {"h", m.h}};
  });
  const nlohmann::json &e = found.at("errors"), &best = found.at("method");
  return {.model = model,
          .finer = finer,
          .nodes = found.at("nodes"),
          .errors = {e.at(0), e.at(1), e.at(2), e.at(3), e.at(4)},
          .model_motion = found.at("model_motion"),
          .allowed = found.at("allowed"),
          .method = {best.at(0), best.at(1), best.at(2), best.at(3), best.at(4), best.at(5)},
          .h = found.at("h")};
}

ModelPoint point_of(const MeasuredModel& m, double poisson) {
  ModelPoint point{.timed = {.model = in_words(m.model),
                             .finer = m.finer,
                             .poisson = poisson,
                             .integrator = m.method.integrator,
                             .h = m.h,
                             .steps = static_cast<std::uint64_t>(
                                 std::clamp(sample_ns / std::max(m.method.step_ns, 1.0), fewest_steps, most_steps))},
                   .measured = m,
                   .cost = {}};
  return point;
}

void measure_costs(ModelsResults& results, const ModelsPlan& plan, StudyLog& log) {
  ModelTimesPlan times{.bar = plan.of.bar, .bars = {}, .rounds = 2, .seed = plan.seed};
  for (const ModelPoint& p : results.points) times.bars.push_back(p.timed);
  const int processes = plan.quick ? 6 : 7;
  log.begin(fmt::format("timing {} bars", times.bars.size()), static_cast<std::size_t>(processes));
  for (times.process = 0; times.process < processes; ++times.process) {
    log.measure({"measure-models", to_argument(times)},
                [&](const nlohmann::json& json) { results.samples.push_back(json.get<Sample>()); });
    log.advance();
  }
  check_repeats(results.samples);
  for (ModelPoint& p : results.points) p.cost = cost_of(results.samples, p.timed);
}

}  // namespace

ModelsPlan models_plan(const std::string& name_or_file) {
  if (name_or_file == "cantilever") return {};
  const std::filesystem::path file(name_or_file);
  ModelsPlan plan{.name = file.stem().string(), .of = bar_of_scene(read_scene(file))};
  try {
    bar_meshes(plan.of.bar, false);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", name_or_file, error.what()));
  }
  return plan;
}

std::pair<double, double> ratios_for(double poisson) {
  return poisson < 0.4 ? std::pair(poisson, 0.45) : std::pair(0.25, poisson);
}

Report models_study(const ModelsPlan& plan, StudyLog& log) {
  const ClampedBar& bar = plan.of.bar;
  const BarMeshes meshes = bar_meshes(bar, plan.quick);
  const std::vector<BarModel> models = models_of(plan.quick);
  const auto [first, second] = ratios_for(plan.of.poisson);
  ModelsResults results;
  results.sure = plan.quick ? 0.1 : 0.02;
  results.what =
      fmt::format("{}, {:g} x {:g} x {:g} m, {:g} Pa, {:g} kg/m^3, held at one end", one_line(plan.name), bar.length(),
                  bar.cubes[1] * bar.spacing, bar.cubes[2] * bar.spacing, bar.young, bar.density);
  log.say(results.what);
  for (const std::string& omission : plan.of.omissions) log.say(omission);
  std::size_t bodies = 0;
  for (const BarModel& model : models)
    bodies += static_cast<std::size_t>(std::ranges::count_if(meshes.models, [&](int k) { return k <= finest(model); }));
  log.begin("models on their meshes", 2 * (1 + bodies));
  for (const double poisson : {first, second}) {
    results.truths.push_back(bar_truth(bar, meshes, poisson));
    log.advance(fmt::format("the reference at {}", poisson));
    for (const BarModel& model : models)
      for (const int finer : meshes.models) {
        if (finer > finest(model)) continue;
        const MeasuredModel m = measure_once(bar, model, finer, results.truths.back(), log);
        log.advance(fmt::format("{}, {} finer, {}", in_words(model), finer, poisson));
        if (m.method.integrator.empty())
          log.say(fmt::format("{}, {} finer: no integrator follows it closely enough", in_words(model), finer));
        else
          results.points.push_back(point_of(m, poisson));
        if (!m.method.integrator.empty()) log.sample(json_of(results.points.back()), "points.jsonl");
      }
  }
  measure_costs(results, plan, log);

  Report report;
  report.opening = results.what;
  report.tables = {
      {"references", "The bar by quadratic tetrahedra, and how far a mesh half as fine is off", truths_table(results)},
      {"models", "Errors, and the cheapest integrator and step that adds no more than a tenth to them",
       points_table(results),
       "Errors are shares: of the work of a shear traction at the tip; the largest of the six lowest frequencies; of the "
       "modulus of a slab that cannot expand sideways; of the positions of the coarsest mesh's corners over one period "
       "after the load is let go of. They have no sign: where springs pass the truth from too stiff to too soft their error is small on one mesh and not on the next."},
      {"cheapest", "Which model is the cheapest for which error", reigns_table(results)}};
  report.claims = claims_of(results);
  report.limits = {
      "On jittered meshes springs pass from too stiff to too soft, and near the crossing any error is small. What they miss "
      "on every mesh is the stiffness of a slab that cannot expand sideways."};
  report.pictures = {{"models", models_panels(results)}};
  report.numbers = json_of(results);
  report.data_files = {{"models.json", report.numbers}};
  report.sentence = in_words(results);
  return report;
}

}  // namespace dartboard
