#include "benchmarks/studies/extremes/extremes_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/plain/nan_maximum.h"
#include "core/time/integrators.h"

namespace dartboard {
namespace {

using Json = nlohmann::ordered_json;

Claim claim(std::string id, std::string text, std::string asked, std::string measured, bool holds,
            std::string rests_on) {
  return target(std::move(id), std::move(text), std::move(asked), std::move(measured), std::move(rests_on), met(holds));
}

/// The worst case of the axis of offsets, for methods that solve equations and for those that do not: the former stop
/// where rounding leaves the residual of an equation, in each step.
void add_offset_claims(const ExtremesResults& results, std::vector<Claim>& claims) {
  constexpr double target = 30.0;
  for (const bool implicit : {false, true}) {
    double worst = 0.0;
    std::size_t count = 0;
    std::string worst_run;
    for (const Json& cell : results.cells) {
      const auto name = cell.at("integrator").get<std::string>();
      // explicit Euler is stable nowhere and amplifies rounding as everything else
      if (!cell.contains("offset_error") || name == "explicit-euler") continue;
      if (scheme_of(name).implicit != implicit) continue;
      ++count;
      const Json& found = cell.at("offset_error");
      const double error = found.is_number() ? found.get<double>() : std::numeric_limits<double>::infinity();
      if (error < worst) continue;  // NaN is not less
      worst = max_or_nan(worst, error);
      worst_run = fmt::format("{}, {} at D = {}", name, cell.at("scene").get<std::string>(),
                              cell.at("value").get<std::string>());
    }
    if (count == 0) continue;
    claims.push_back(claim(implicit ? "offset-implicit" : "offset-explicit",
                           fmt::format("{} methods at D edge lengths from the origin against the same run there",
                                       implicit ? "implicit" : "explicit"),
                           fmt::format("<= {:g} eps D", target), fmt::format("{:.3g} eps D", worst), worst <= target,
                           fmt::format("{} runs of 100 steps{}; worst: {}", count,
                                       implicit ? "" : ", explicit Euler left out", worst_run)));
  }
}

/// Every run that was not diagnosed has a witness: another code's motion, or the scheme in more digits. There are
/// exceptions: in steps of 10^6 s the residual of local-global's equations is larger than a step.
Claim judged_claim(const ExtremesResults& results) {
  constexpr double target = 0.98;
  std::size_t ended = 0, by_motion = 0, by_scheme = 0;
  for (const Json& cell : results.cells) {
    const auto by = cell.at("judged_by").get<std::string>();
    ended += by != to_string(JudgedBy::diagnosis);
    by_motion += by == to_string(JudgedBy::motion);
    by_scheme += by == to_string(JudgedBy::scheme);
  }
  const std::string text = "runs that end without a diagnosis are judged by more than that they survived";
  if (ended == 0)
    return {.id = "runs-are-judged",
            .text = text,
            .paper_value = fmt::format(">= {:g} %", 100 * target),
            .reason = "no run ended without a diagnosis"};
  const double share = static_cast<double>(by_motion + by_scheme) / static_cast<double>(ended);
  return claim("runs-are-judged", text, fmt::format(">= {:g} %", 100 * target), fmt::format("{:.2f} %", 100 * share),
               share >= target,
               fmt::format("{} runs: {} by the motion, {} by the steps of the scheme", ended, by_motion, by_scheme));
}

void add_limit_claims(const ExtremesResults& results, std::vector<Claim>& claims) {
  if (results.limits.empty()) return;
  for (const double tolerance : {1e-3, 5e-3}) {
    double worst = 0.0;
    std::size_t count = 0, held = 0;
    for (const StabilityLimit& l : results.limits) {
      if (l.tolerance != tolerance) continue;
      ++count;
      held += l.holds();
      worst = max_or_nan(worst, std::abs(l.measured / l.theory - 1));
    }
    const bool meshes = tolerance > 4e-3;
    claims.push_back(claim(meshes ? "limits-meshes" : "limits-closed-forms",
                           meshes ? "longest stable steps on meshes, with omega_max by Lanczos, before and after cuts"
                                  : "longest stable steps on the oscillator and the chain, five damping ratios",
                           fmt::format("<= {:g} %", 100 * tolerance), fmt::format("{:.3f} %", 100 * worst),
                           held == count && worst <= tolerance, fmt::format("{} of {} limits", held, count)));
  }
  double above = 0.0, below = 0.0;
  bool proven = true;
  for (const MeshBody& m : results.meshes) {
    above = max_or_nan(above, m.omega / m.upper - 1);
    below = max_or_nan(below, m.upper / m.omega - 1);
    proven &= m.proven;
  }
  if (!results.meshes.empty())
    claims.push_back(claim("estimate-meshes", "the stable-step estimate is never above the limit, at most 10 % below",
                           "<= 10 %", fmt::format("{:.2f} %", 100 * below), above <= 0.0 && below <= 0.1 && proven,
                           proven ? "omega_max proven by a Cholesky factor" : "omega_max not proven"));
}

}  // namespace

// JSON has no infinity: numbers that may be infinite are text.
Json to_json(const ExtremeCell& cell) {
  Json json{{"axis", cell.axis},
            {"scene", cell.scene},
            {"integrator", cell.integrator},
            {"value", cell.value},
            {"outcome", to_string(cell.outcome)},
            {"judged_by", to_string(cell.judged_by)},
            {"step", cell.step}};
  if (!cell.diagnosis.ok()) {
    json["code"] = to_string(cell.diagnosis.code);
    if (cell.diagnosis.witness != Witness::none)
      json[cell.diagnosis.witness == Witness::vertex ? "vertex" : "edge"] = cell.diagnosis.number;
    json["quantity"] = cell.diagnosis.quantity;
    const double value = cell.diagnosis.value;
    json["found"] = std::isnan(value) ? "not a number" : std::isinf(value) ? "infinite" : fmt::format("{:.6g}", value);
    if (!names_a_quantity(cell.diagnosis)) json["nameless"] = true;
  }
  if (!cell.warnings.empty()) json["warnings"] = cell.warnings;
  if (!cell.note.empty()) json["note"] = cell.note;
  if (cell.refused) json["refused"] = true;
  const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json("not finite"); };
  if (cell.scheme_excess > 0.0 || std::isnan(cell.scheme_excess)) json["scheme_excess"] = number(cell.scheme_excess);
  if (cell.motion_error) json["motion_error"] = number(*cell.motion_error);
  if (cell.offset_error) json["offset_error"] = number(*cell.offset_error);
  return json;
}

std::vector<Json> forbidden_cells(const ExtremesResults& results) {
  std::vector<Json> forbidden;
  for (const Json& cell : results.cells)
    if (cell.at("outcome") == "SILENT" || cell.at("outcome") == "CRASH") forbidden.push_back(cell);
  return forbidden;
}

std::vector<Json> nameless_cells(const ExtremesResults& results) {
  std::vector<Json> nameless;
  for (const Json& cell : results.cells)
    if (cell.at("outcome") == "DIAGNOSED" && cell.contains("nameless")) nameless.push_back(cell);
  return nameless;
}

Json to_json(const ExtremesResults& results) {
  Json json{{"cells", results.cells.size()}, {"forbidden", forbidden_cells(results).size()}, {"matrix", results.cells}};
  json["limits"] = Json::array();
  for (const StabilityLimit& l : results.limits)
    json["limits"].push_back({{"body", l.body},
                              {"integrator", l.integrator},
                              {"zeta", l.zeta},
                              {"theory", l.theory},
                              {"measured", l.measured},
                              {"holds", l.holds()}});
  for (const StabilityMap& m : results.maps)
    for (const auto& c : m.boundary)
      json["boundary"].push_back(
          {{"integrator", m.integrator}, {"zeta", c.zeta}, {"theory", c.theory}, {"measured", c.measured}});
  for (const AmplificationPoint& p : results.amplification)
    json["amplification"].push_back({{"integrator", p.integrator},
                                     {"h_omega", p.theta},
                                     {"amplitude", p.amplitude()},
                                     {"phase", p.phase()},
                                     {"damping_ratio", p.damping_ratio()},
                                     {"deviation", p.deviation()},
                                     {"tolerance", p.tolerance}});
  for (const RoundingGrowth& g : results.rounding)
    for (const auto& p : g.points)
      json["rounding"].push_back({{"integrator", g.integrator}, {"steps", p.steps}, {"energy_error", p.error}});
  for (const RoundingGrowth& g : results.rounding)
    json["rounding_exponents"].push_back(
        {{"integrator", g.integrator}, {"exponent", g.exponent}, {"standard_error", g.standard_error}});
  for (const TinySteps& t : results.tiny)
    json["tiny"].push_back({{"integrator", t.integrator},
                            {"h", t.h},
                            {"steps", t.steps},
                            {"lost", t.lost},
                            {"cannot_be_read", t.readable},
                            {"lost_with_digits", t.lost_with_digits}});
  for (const Detection& d : results.detections) {
    Json one{{"body", d.body}, {"integrator", d.integrator}, {"factor", d.factor}, {"predicted", d.predicted}};
    if (d.passed) one["passed"] = *d.passed;
    if (d.detected) one["detected"] = *d.detected;
    json["detection"].push_back(one);
  }
  json["claims"] = Json(nlohmann::json(claims_of(results)));
  return json;
}

std::vector<Claim> claims_of(const ExtremesResults& results) {
  std::vector<Claim> claims;
  if (!results.cells.empty()) {
    const std::size_t forbidden = forbidden_cells(results).size();
    claims.push_back(claim("no-silent-run", "no run of the matrix is wrong without a word, or ends the process", "0",
                           fmt::format("{}", forbidden), forbidden == 0, fmt::format("{} runs", results.cells.size())));
    claims.push_back(judged_claim(results));
    const std::vector<Json> nameless = nameless_cells(results);
    std::string first;
    if (!nameless.empty())
      first = fmt::format("; {} {} {} with {}: {} {}", nameless[0].at("axis").get<std::string>(),
                          nameless[0].at("scene").get<std::string>(), nameless[0].at("value").get<std::string>(),
                          nameless[0].at("integrator").get<std::string>(),
                          nameless[0].at("quantity").get<std::string>(), nameless[0].at("found").get<std::string>());
    const auto diagnosed =
        std::ranges::count_if(results.cells, [](const Json& c) { return c.at("outcome") == "DIAGNOSED"; });
    claims.push_back(claim("diagnoses-name-a-quantity", "no diagnosis names a quantity that is no number", "0",
                           fmt::format("{}", nameless.size()), nameless.empty(),
                           fmt::format("{} diagnoses{}", diagnosed, first)));
    add_offset_claims(results, claims);
  }
  add_limit_claims(results, claims);
  if (!results.maps.empty()) {
    double worst = 0.0;
    std::size_t crossings = 0;
    for (const StabilityMap& m : results.maps) {
      worst = max_or_nan(worst, m.worst());
      crossings += m.boundary.size();
    }
    claims.push_back(claim("map-boundaries", "boundaries of stability over step and damping ratio", "<= 0.1 %",
                           fmt::format("{:.3f} %", 100 * worst), worst <= 1e-3, fmt::format("{} places", crossings)));
  }
  if (!results.amplification.empty()) {
    double worst = 0.0;
    std::size_t held = 0;
    for (const AmplificationPoint& p : results.amplification) {
      worst = max_or_nan(worst, p.deviation());
      held += p.holds();
    }
    claims.push_back(claim("amplification", "amplitude and phase of a step against closed forms", "<= 1e-10",
                           fmt::format("{:.1e}", worst), worst <= 1e-10 && held == results.amplification.size(),
                           fmt::format("{} of {} within rounding", held, results.amplification.size())));
  }
  if (!results.detections.empty()) {
    std::size_t predicted = 0, held = 0;
    std::uint64_t above = 0;
    for (const Detection& d : results.detections) {
      predicted += d.predicted;
      held += d.holds();
      above = std::max(above, d.above);
    }
    claims.push_back(claim("unstable-steps",
                           "unstable steps are predicted, and detected within 64 steps above the bound of the energy",
                           "all; <= 64", fmt::format("{} of {}; {}", predicted, results.detections.size(), above),
                           held == results.detections.size(), fmt::format("{} runs", results.detections.size())));
  }
  for (const RoundingGrowth& g : results.rounding) {
    // starts are drawn at random: two standard errors, some 95 %
    const double low = g.exponent - 2.0 * g.standard_error, high = g.exponent + 2.0 * g.standard_error;
    const Figure figure{g.exponent, {low, high, 0.954, true}};
    Claim made = claim("rounding-" + g.integrator,
                       fmt::format("rounding of the energy of {} grows like a random walk", g.integrator), "0.5 +- 0.1",
                       fmt::format("{:.3f}", g.exponent), false,
                       fmt::format("[{:.3f}, {:.3f}], two standard errors; {} starts, {:.0e} steps", low, high,
                                   g.starts, static_cast<double>(g.points.back().steps)));
    judge(made, std::min(at_least(figure, 0.4), at_most(figure, 0.6)));
    claims.push_back(std::move(made));
  }
  if (!results.tiny.empty()) {
    bool keeps = true;
    for (const TinySteps& t : results.tiny) keeps &= t.keeps_all() || !t.integrator.ends_with("compensated");
    claims.push_back(claim("tiny-steps", "a compensated state keeps what 10^6 steps down to 1e-18 s add up to",
                           "what can be read", keeps ? "kept" : "lost", keeps, "table of tiny steps"));
  }
  return claims;
}

}  // namespace dartboard
