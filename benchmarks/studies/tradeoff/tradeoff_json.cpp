#include "benchmarks/studies/tradeoff/tradeoff_json.h"

#include <nlohmann/json.hpp>

#include "benchmarks/harness/json_number.h"
#include "benchmarks/studies/tradeoff/tradeoff_tables.h"

namespace dartboard {
namespace {

nlohmann::json json_of(const WorkCounters& w) {
  return {{"steps", w.steps},
          {"failed_steps", w.failed_steps},
          {"rejected_steps", w.rejected_steps},
          {"force_evaluations", w.force_evaluations},
          {"damping_sweeps", w.damping_sweeps},
          {"assemblies", w.assemblies},
          {"analyses", w.analyses},
          {"factorisations", w.factorisations},
          {"solves", w.solves},
          {"rank_one_updates", w.rank_one_updates},
          {"newton_iterations", w.newton_iterations},
          {"linear_iterations", w.linear_iterations},
          {"line_search_trials", w.line_search_trials},
          {"projections", w.projections},
          {"factor_nonzeros", w.factor_nonzeros}};
}

}  // namespace

nlohmann::json json_of(const std::string& scene, const WorkPoint& p) {
  nlohmann::json json{{"scene", scene},
                      {"integrator", p.contender},
                      {"peer", p.peer},
                      {"h", number(p.h)},
                      {"h_omega", number(p.h_omega)},
                      {"work", json_of(p.work)},
                      {"costs", p.costs},
                      {"cost", number(p.cost)},
                      {"cpu_s", number(p.cpu_s)},
                      {"force_s", number(p.force_s)},
                      {"under_floor", p.under_floor}};
  if (p.setting.steps > 0)
    json["steps"] = p.setting.steps;
  else
    json["tolerance"] = p.setting.tolerance;
  if (p.failed()) {
    json["code"] = p.code;
    json["diagnosis"] = p.diagnosis;
  } else {
    json["errors"] = {{"x", number(p.errors.x)},
                      {"x_p95", number(p.errors.x_p95)},
                      {"x_largest", number(p.errors.x_largest)},
                      {"v", number(p.errors.v)},
                      {"energy", number(p.errors.energy)},
                      {"momentum", number(p.errors.momentum)},
                      {"angular", number(p.errors.angular)}};
  }
  return json;
}

nlohmann::json summary_of(const WorkPrecision& study) {
  nlohmann::json best = nlohmann::json::array();
  for (const Winner& w : winners(study.points, decades(study)))
    best.push_back({{"error", w.error},
                    {"integrator", w.contender},
                    {"cost", number(w.cost)},
                    {"force_evaluations", number(w.evaluations)},
                    {"h", number(w.h)},
                    {"runner_up", w.runner_up},
                    {"runner_up_cost", number(w.runner_up_cost)},
                    {"cvode_adams_cost", number(cost_at(study.points, "cvode-adams", w.error))}});
  return {{"scene", study.scene},
          {"reference", study.reference.what},
          {"floor", study.reference.floor},
          {"winners", best},
          {"omissions", study.omissions}};
}

}  // namespace dartboard
