#include "benchmarks/studies/order/order_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "benchmarks/harness/json_number.h"
#include "core/plain/nan_maximum.h"

namespace dartboard {
namespace {

constexpr double accepted_agreement = 2e-13;  // mean edge lengths
// A code in doubles may be off by some times its tolerance, 1e-13: CVODE was off by 0.2 to 2.4 times that, depending on
// the last bits of masses.
constexpr double accepted_of_each = 1e-12;
constexpr double discrete_gate = 1e-10;
constexpr double jump_gate = 1e-14;
constexpr double drift_gate = 1e-11;
constexpr std::uint64_t savings_gate = 10;
constexpr double kept_difference = 1e-3;  // of the error of the step

double largest_jump(const OrderResults& results) {
  double largest = 0.0;
  for (const CutJump& jump : results.jumps)
    for (const double value : {jump.energy, jump.momentum, jump.angular}) largest = max_or_nan(largest, value);
  return largest;
}

Claim order_claim(const OrderResults& results, OrderCase which) {
  Claim claim{.id = fmt::format("order-{}", name(which))};
  std::replace(claim.id.begin(), claim.id.end(), ' ', '-');
  claim.text = which == OrderCase::unaligned_cut
                   ? "every integrator falls to order 1 across a cut within a step"
                   : fmt::format("every integrator shows its order, {}, in x and in v", name(which));
  claim.paper_value = "three successive halvings within 0.1";
  double farthest = 0.0;
  std::size_t holding = 0, all = 0;
  for (const OrderStudy& study : results.studies) {
    if (study.which != which) continue;
    ++all;
    if (study.holds) {
      ++holding;
      farthest =
          max_or_nan(farthest, max_or_nan(std::abs(study.p_x - study.theory), std::abs(study.p_v - study.theory)));
    } else {
      claim.reason += fmt::format("{}{}: {}", claim.reason.empty() ? "" : "; ", study.integrator, study.reason);
    }
  }
  claim.measured = fmt::format("{} of {} integrators, farthest {:.3f}", holding, all, farthest);
  claim.verdict = all == 0 ? Verdict::not_tested : verdict_of(met(holding == all));
  return claim;
}

bool by_independent_codes(const OrderResults& results) {
  return std::ranges::all_of(results.references,
                             [](const OrderReference& stage) { return stage.certified.independent; });
}

char mark(Regime regime) {
  switch (regime) {
    case Regime::failed: return '!';
    case Regime::large: return '^';
    case Regime::pre_asymptotic: return '~';
    case Regime::asymptotic: return ' ';
    case Regime::floor: return '_';
  }
  return '?';
}

}  // namespace

std::string orders_text(const OrderStudy& study, double OrderPoint::*order) {
  std::string text;
  for (const OrderPoint& p : study.points) {
    if (!p.has_order && p.diagnosis.empty()) continue;
    if (!text.empty()) text += ' ';
    text += p.has_order ? fmt::format("{:.2f}{}", p.*order, mark(p.regime)) : std::string("!");
  }
  return text;
}

std::string steps_text(const OrderStudy& study) {
  if (study.points.empty()) return "-";
  return fmt::format("{:.2g} .. {:.2g}", study.points.front().h_omega, study.points.back().h_omega);
}

std::string references_heading(const OrderResults& results) {
  return by_independent_codes(results) ? "by independent codes" : "by two methods of one library";
}

std::vector<Claim> claims_of(const OrderResults& results) {
  std::vector<Claim> claims;
  for (const OrderCase which : order_cases) claims.push_back(order_claim(results, which));

  double closest = 0.0, farthest = 0.0;
  bool accepted = true;
  for (const OrderReference& stage : results.references) {
    const reference::CertifiedMotion& certified = stage.certified;
    accepted = accepted && certified.accepted;
    closest = max_or_nan(closest, max_or_nan(certified.agreement, certified.self_difference));
    for (const reference::CodeAgreement& code : certified.codes) farthest = max_or_nan(farthest, code.distance);
  }
  claims.push_back(
      {.id = "oracle-agreement",
       .text = fmt::format("{} agree on the references, in mean edge lengths",
                           by_independent_codes(results) ? "independent codes" : "two methods of one library"),
       .paper_value = fmt::format("<= {:.0e}; each code <= {:.0e}", accepted_agreement, accepted_of_each),
       .measured = fmt::format("{:.1e} in extended precision, {:.1e} the farthest of all", closest, farthest),
       .verdict = results.references.empty() ? Verdict::not_tested
                                             : verdict_of(met(accepted && farthest <= accepted_of_each))});

  double deviation = 0.0;
  std::string farthest_method;
  for (const DiscreteExact& d : results.discrete)
    if (!(d.deviation <= deviation) && !std::isnan(deviation)) {
      deviation = d.deviation;
      farthest_method = d.integrator;
    }
  Claim discrete{.id = "discrete-exact",
                 .text = "integrators are the powers of their amplification on an oscillator",
                 .paper_value = fmt::format("<= {:.0e}", discrete_gate),
                 .measured = fmt::format("{:.1e}", deviation)};
  if (!results.discrete.empty())
    discrete.bound_or_interval =
        fmt::format("after {} steps, the farthest: {}", results.discrete[0].steps, farthest_method);
  for (const std::string& none : results.no_discrete)
    discrete.reason += fmt::format("{}{} states no amplification", discrete.reason.empty() ? "" : "; ", none);
  for (const DiscreteExact& d : results.discrete)
    if (!d.diagnosis.empty())
      discrete.reason += fmt::format("{}{}: {}", discrete.reason.empty() ? "" : "; ", d.integrator, d.diagnosis);
  discrete.verdict = results.discrete.empty() ? Verdict::not_tested : verdict_of(met(deviation <= discrete_gate));
  claims.push_back(discrete);

  claims.push_back(
      {.id = "force-is-gradient",
       .text = "forces are minus the derivative of the energy",
       .paper_value = "within the rounding bound",
       .measured = fmt::format("{:.1e} N of {:.2g} N", results.force.deviation, results.force.largest_force),
       .bound_or_interval = fmt::format("bound {:.1e} N", results.force.bound),
       .verdict = verdict_of(met(results.force.ratio <= 1.0))});
  const double jump = largest_jump(results);
  claims.push_back({.id = "cut-jump",
                    .text = "energy, momentum and angular momentum stay at a cut",
                    .paper_value = fmt::format("<= {:.0e} relative", jump_gate),
                    .measured = fmt::format("{:.1e}", jump),
                    .verdict = verdict_of(met(jump <= jump_gate))});
  const ConservedDrift& drift = results.drift;
  claims.push_back({.id = "energy-momentum-drift",
                    .text = fmt::format("the energy-momentum scheme keeps the energy at h omega = {:g}, across a cut",
                                        drift.h_omega),
                    .paper_value = fmt::format("<= {:.0e} relative", drift_gate),
                    .measured = fmt::format("{:.1e} in {} steps", drift.drift, drift.steps),
                    .verdict = verdict_of(met(drift.diagnosis.empty() && drift.drift <= drift_gate)),
                    .reason = drift.diagnosis});
  const KeptFactor& factor = results.factor;
  claims.push_back(
      {.id = "kept-factor",
       .text = "a factor that is kept saves factorisations at the same error (backward Euler, stiff inclusions)",
       .paper_value = fmt::format(">= {} times fewer", savings_gate),
       .measured = fmt::format("{} instead of {} in {} steps", factor.kept, factor.fresh, factor.steps),
       .bound_or_interval =
           fmt::format("{:.1e} edges apart; the error of the step is {:.1e}", factor.difference, factor.step_error),
       .verdict = verdict_of(met(factor.diagnosis.empty() && factor.fresh >= savings_gate * factor.kept &&
                                 factor.difference <= kept_difference * factor.step_error)),
       .reason = factor.diagnosis});
  return claims;
}

Table order_table(const OrderResults& results) {
  Table table({{"integrator"},
               {"scene"},
               {"theory", Align::right},
               {"h omega", Align::right},
               {"p in x, by halving"},
               {"p in v"},
               {"holds"}});
  for (const OrderStudy& s : results.studies) {
    table.add_row({s.integrator, std::string(name(s.which)), fmt::format("{}", s.theory), steps_text(s),
                   orders_text(s, &OrderPoint::p_x), orders_text(s, &OrderPoint::p_v),
                   s.holds ? "yes" : "NO: " + s.reason});
  }
  return table;
}

Table oracle_table(const OrderResults& results) {
  Table table({{"scene"},
               {"code"},
               {"distance / edges", Align::right},
               {"evaluations", Align::right},
               {"CPU s", Align::right}});
  for (const OrderReference& stage : results.references)
    for (const reference::CodeAgreement& code : stage.certified.codes)
      table.add_row({std::string(name(stage.which)), code.code,
                     code.failure.empty() ? fmt::format("{:.1e}", code.distance) : code.failure,
                     fmt::format("{}", code.evaluations), fmt::format("{:.3f}", code.cpu_s)});
  return table;
}

Table discrete_table(const OrderResults& results) {
  Table table({{"integrator"},
               {"zeta", Align::right},
               {"h omega", Align::right},
               {"steps", Align::right},
               {"deviation", Align::right}});
  for (const DiscreteExact& d : results.discrete)
    table.add_row({d.integrator, fmt::format("{:g}", d.zeta), fmt::format("{:.3g}", d.h_omega),
                   fmt::format("{}", d.steps), d.diagnosis.empty() ? fmt::format("{:.1e}", d.deviation) : d.diagnosis});
  return table;
}

nlohmann::ordered_json to_json(const OrderStudy& study, std::string_view scene) {
  nlohmann::ordered_json json{{"integrator", study.integrator}, {"scene", scene},           {"theory", study.theory},
                              {"holds", study.holds},           {"p_x", number(study.p_x)}, {"p_v", number(study.p_v)}};
  if (!study.reason.empty()) json["reason"] = study.reason;
  for (const OrderPoint& p : study.points) {
    nlohmann::ordered_json point{{"steps", p.steps}, {"h_omega", p.h_omega}, {"regime", name(p.regime)}};
    if (p.diagnosis.empty()) {
      point["error_x"] = number(p.errors.x);
      point["error_v"] = number(p.errors.v);
      point["error_energy"] = number(p.errors.energy);
      point["error_momentum"] = number(p.errors.momentum);
      point["error_angular"] = number(p.errors.angular);
    } else {
      point["diagnosis"] = p.diagnosis;
    }
    if (p.has_order) {
      point["p_x"] = number(p.p_x);
      point["p_v"] = number(p.p_v);
    }
    json["points"].push_back(point);
  }
  return json;
}

nlohmann::ordered_json to_json(const OrderResults& results, const std::vector<Claim>& claims) {
  nlohmann::ordered_json json{{"holds", exit_code(claims) == 0}, {"claims", nlohmann::json(claims)}};
  for (const OrderStudy& s : results.studies) json["orders"].push_back(to_json(s, name(s.which)));
  for (const OrderReference& stage : results.references) {
    const reference::CertifiedMotion& c = stage.certified;
    nlohmann::ordered_json oracle{{"scene", name(stage.which)},       {"accepted", c.accepted},
                                  {"independent", c.independent},     {"self_difference", number(c.self_difference)},
                                  {"agreement", number(c.agreement)}, {"floor", number(c.floor)},
                                  {"gain", number(c.largest_gain())}};
    for (const reference::CodeAgreement& code : c.codes)
      oracle["codes"].push_back({{"code", code.code},
                                 {"distance", number(code.distance)},
                                 {"evaluations", code.evaluations},
                                 {"cpu_s", code.cpu_s},
                                 {"failure", code.failure}});
    json["references"].push_back(oracle);
  }
  for (const DiscreteExact& d : results.discrete)
    json["discrete"].push_back({{"integrator", d.integrator},
                                {"zeta", d.zeta},
                                {"h_omega", d.h_omega},
                                {"steps", d.steps},
                                {"deviation", number(d.deviation)},
                                {"diagnosis", d.diagnosis}});
  json["force"] = {{"deviation", results.force.deviation},
                   {"bound", results.force.bound},
                   {"ratio", number(results.force.ratio)},
                   {"largest_force", results.force.largest_force}};
  json["energy_drift"] = {{"steps", results.drift.steps},
                          {"h_omega", results.drift.h_omega},
                          {"drift", number(results.drift.drift)},
                          {"diagnosis", results.drift.diagnosis}};
  json["kept_factor"] = {{"steps", results.factor.steps},
                         {"fresh", results.factor.fresh},
                         {"kept", results.factor.kept},
                         {"difference", number(results.factor.difference)},
                         {"step_error", number(results.factor.step_error)},
                         {"diagnosis", results.factor.diagnosis}};
  for (const CutJump& jump : results.jumps)
    json["jumps"].push_back({{"time", jump.time},
                             {"vertices_before", jump.vertices_before},
                             {"vertices_after", jump.vertices_after},
                             {"energy", number(jump.energy)},
                             {"momentum", number(jump.momentum)},
                             {"angular", number(jump.angular)}});
  return json;
}

}  // namespace dartboard
