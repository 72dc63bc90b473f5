#include "benchmarks/studies/judges/judges_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "core/plain/nan_maximum.h"

namespace dartboard {
namespace {

constexpr double least_share = 0.95;  // of wrong integrators that a judge has to see
constexpr double most_slack = 100.0;  // ratio of a bound to the largest value of sound integrators

struct Judge {
  std::string_view name, id, independent_of, bound;
};
constexpr Judge judges[]{
    {"extremes", "extremes-see-wrong-integrators", "all of core: again in long double, and Odeint",
     "30 roundings of a step, or twice the solver's tolerance"},
    {"order", "orders-see-wrong-integrators", "core's forces and methods: Odeint, SUNDIALS", "three orders within 0.1"},
    {"exact maps", "maps-see-wrong-integrators", "all code: powers of a closed form", "1e-10"},
    {"recommend --verify", "verify-sees-wrong-integrators", "core's methods: a closed form, Odeint, SUNDIALS",
     "the requested error"},
};

std::string_view word(Wrong kind) { return std::ranges::find(wrong_integrators(), kind, &WrongIntegrator::kind)->name; }

/// Over all parts of a judge.
JudgeTrial total(const JudgesResults& results, std::string_view judge) {
  JudgeTrial sum;
  for (const JudgeTrial& trial : results.trials) {
    if (trial.judge != judge) continue;
    sum.right += trial.right;
    sum.same += trial.same;
    sum.seen += trial.seen;
    sum.by_scheme += trial.by_scheme;
  }
  return sum;
}

std::string percent(double share) { return fmt::format("{:.1f} %", 100 * share); }

/// The part of a judge that sees the smallest share, over all ways of being wrong: "98.3 %, step".
std::string least_part(const JudgesResults& results, std::string_view judge) {
  std::map<std::string, JudgeTrial> parts;
  for (const JudgeTrial& trial : results.trials) {
    if (trial.judge != judge) continue;
    parts[trial.part].right += trial.right;
    parts[trial.part].same += trial.same;
    parts[trial.part].seen += trial.seen;
  }
  const auto least = std::ranges::min_element(parts, {}, [](const auto& part) { return part.second.share(); });
  return fmt::format("{}, {}", percent(least->second.share()), least->first);
}

double worst_of(const JudgesResults& results) {
  double worst = 0.0;
  for (const SchemeSlack& slack : results.slack) worst = max_or_nan(worst, slack.worst);
  return worst;
}

}  // namespace

Table judges_table(const JudgesResults& results) {
  Table table({{"judge", Align::left},
               {"wrong ones seen", Align::right},
               {"of", Align::right},
               {"no difference", Align::right},
               {"independent of", Align::left},
               {"bound", Align::left}});
  for (const Judge& judge : judges) {
    const JudgeTrial sum = total(results, judge.name);
    if (sum.right == 0) continue;
    table.add_row({std::string(judge.name), percent(sum.share()), fmt::format("{}", sum.asked()),
                   fmt::format("{}", sum.same), std::string(judge.independent_of), std::string(judge.bound)});
  }
  return table;
}

Table others_table() {
  Table table({{"study", Align::left}, {"what it says of integrators", Align::left}});
  table.add_row({"tradeoff",
                 "nothing: it shows their errors against a reference, and says no only where none of them "
                 "follows the motion"});
  table.add_row({"validate conservation",
                 "nothing: it judges what operations keep, and moves bodies by the Runge-Kutta "
                 "method of the walks, which is none of these"});
  table.add_row({"reproduce",
                 "the walks and their Runge-Kutta method are held against extended precision before they "
                 "are timed; integrators are judged by its part 'extremes', as above"});
  return table;
}

Table trials_table(const JudgesResults& results) {
  std::vector<Column> columns{{"judge", Align::left}, {"part", Align::left}, {"called right", Align::right}};
  for (const WrongIntegrator& wrong : wrong_integrators()) columns.push_back({std::string(wrong.name), Align::right});
  Table table(columns);
  for (std::size_t k = 0; k < results.trials.size(); k += wrong_integrators().size()) {
    const JudgeTrial& first = results.trials[k];
    std::vector<std::string> row{first.judge, first.part, fmt::format("{}", first.right)};
    for (std::size_t i = k; i < k + wrong_integrators().size(); ++i) {
      const JudgeTrial& trial = results.trials[i];
      row.push_back(trial.asked() == 0 ? "-" : fmt::format("{} of {}", trial.seen, trial.asked()));
    }
    table.add_row(std::move(row));
  }
  return table;
}

Table unseen_table(const JudgesResults& results) {
  Table table({{"judge", Align::left}, {"part", Align::left}, {"wrong how", Align::left}, {"where", Align::left}});
  for (const JudgeTrial& trial : results.trials)
    for (const std::string& where : trial.unseen)
      table.add_row({trial.judge, trial.part, std::string(word(trial.kind)), where});
  return table;
}

Table slack_table(const JudgesResults& results) {
  Table table({{"integrator", Align::left},
               {"sound runs", Align::right},
               {"largest share of the bound", Align::right},
               {"slack", Align::right}});
  for (const SchemeSlack& slack : results.slack)
    table.add_row({slack.integrator, fmt::format("{}", slack.runs), fmt::format("{:.2g}", slack.worst),
                   slack.worst > 0.0 ? fmt::format("{:.3g}", 1 / slack.worst) : ""});
  return table;
}

std::vector<Claim> claims_of(const JudgesResults& results) {
  std::vector<Claim> claims;
  for (const Judge& judge : judges) {
    const JudgeTrial sum = total(results, judge.name);
    if (sum.right == 0) continue;
    const bool sees = sum.share() >= least_share;
    Claim claim{.id = std::string(judge.id),
                .text = fmt::format("{}: wrong integrators are distinguished from right ones", judge.name),
                .paper_value = fmt::format(">= {:g} %", 100 * least_share),
                .measured = percent(sum.share())};
    claim.bound_or_interval = fmt::format("{} of {}; in {} more being wrong changes nothing; least: {}", sum.seen,
                                          sum.asked(), sum.same, least_part(results, judge.name));
    if (sum.asked() == 0)
      claim.reason = "being wrong changed nothing in any of the cases";
    else
      claim.verdict = verdict_of(met(sees));
    claims.push_back(std::move(claim));
  }
  if (results.slack.empty()) return claims;
  const double worst = worst_of(results);
  double most = 0.0;
  std::string loosest;
  for (const SchemeSlack& slack : results.slack)
    if (const double factor = 1 / slack.worst; !(factor <= most)) {
      most = factor;
      loosest = slack.integrator;
    }
  const bool tight = worst <= 1.0 && most <= most_slack;
  Claim claim{.id = "scheme-bounds-are-tight",
              .text = "steps of sound integrators are within their bounds, and the bounds within 100 times that",
              .paper_value = fmt::format("<= 1; <= {:g}", most_slack),
              .measured = fmt::format("{:.2g}; {:.3g}", worst, most),
              .bound_or_interval = fmt::format("loosest: {}", loosest)};
  judge(claim, met(tight));
  claims.push_back(std::move(claim));
  return claims;
}

nlohmann::ordered_json to_json(const JudgesResults& results) {
  nlohmann::ordered_json json{{"trials", nlohmann::ordered_json::array()}, {"slack", nlohmann::ordered_json::array()}};
  for (const JudgeTrial& trial : results.trials)
    json["trials"].push_back({{"judge", trial.judge},
                              {"part", trial.part},
                              {"wrong", word(trial.kind)},
                              {"called_right", trial.right},
                              {"no_difference", trial.same},
                              {"seen", trial.seen},
                              {"seen_by_scheme", trial.by_scheme},
                              {"unseen", trial.unseen}});
  for (const SchemeSlack& slack : results.slack)
    json["slack"].push_back({{"integrator", slack.integrator}, {"runs", slack.runs}, {"largest_share", slack.worst}});
  return json;
}

}  // namespace dartboard
