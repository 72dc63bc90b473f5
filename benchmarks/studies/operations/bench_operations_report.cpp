#include "benchmarks/studies/operations/bench_operations_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "benchmarks/harness/paired.h"
#include "benchmarks/harness/statistics.h"
#include "benchmarks/paper/paper_claims.h"

namespace dartboard {
namespace {

using Values = std::vector<double>;  // one of each process

double milliseconds(const std::vector<std::int64_t>& ns) { return median(Values(ns.begin(), ns.end())) / 1e6; }

Values ratios(const Values& a, const Values& b) {
  Values ratio;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) ratio.push_back(a[k] / b[k]);
  return ratio;
}

std::string show(const Values& values) { return values.empty() ? "-" : fmt::format("{:.3g}", median(values)); }

/// An operation must keep to a bound on every body; the 99th percentiles are reported.
Claim bounded(const OperationFigures& r, const std::vector<std::string>& bodies, const std::string& id,
              const std::vector<std::string>& names, double bound_us, const char* cause) {
  std::string measured, tails;
  Met met = Met::yes;
  for (const std::string& operation : names)
    for (const std::string& body : bodies) {
      const Values middle = r.quantiles(body, operation, 0.5);
      if (middle.empty()) continue;
      measured += (measured.empty() ? "" : " / ") + show(middle);
      tails += (tails.empty() ? "99th percentile " : " / ") + show(r.quantiles(body, operation, 0.99));
      met = std::min(met, at_most(figure_of(middle), bound_us));
    }
  Claim c = target("operation-" + id, fmt::format("{}, with embeddings and four views", fmt::join(names, " / ")),
                   fmt::format("<= {:g} us", bound_us), measured + " us", tails, met, cause);
  if (measured.empty()) {
    c.verdict = Verdict::not_tested;
    c.measured.clear();
    c.reason = "it was not timed on any body";
  }
  return c;
}

}  // namespace

std::vector<double> OperationFigures::quantiles(const std::string& body, const std::string& operation, double p,
                                                std::size_t first_phase, std::size_t phases) const {
  Values values;
  const auto found = operations.find(body + ":" + operation);
  if (found == operations.end()) return values;
  for (const OperationSample& s : found->second) {
    Values totals(s.ns[0].size(), 0.0);
    for (std::size_t phase = first_phase; phase < std::min(first_phase + phases, s.ns.size()); ++phase)
      for (std::size_t k = 0; k < totals.size(); ++k) totals[k] += static_cast<double>(s.ns[phase][k]) / 1e3;
    values.push_back(quantile(totals, p));
  }
  return values;
}

Table operations_table(const OperationFigures& r, const std::vector<std::string>& bodies) {
  Table table({{"operation"},
               {"body"},
               {"map [us]", Align::right},
               {"embeddings [us]", Align::right},
               {"four views [us]", Align::right},
               {"all: median [us]", Align::right},
               {"99th percentile [us]", Align::right},
               {"median over a step", Align::right}});
  for (const std::string& operation : operations())
    for (const std::string& body : bodies) {
      const Values all = r.quantiles(body, operation, 0.5);
      if (all.empty()) continue;
      const double step_us = 1e3 * milliseconds(r.bodies.at(body).front().step_ns);
      table.add_row({operation, body, show(r.quantiles(body, operation, 0.5, 0, 1)),
                     show(r.quantiles(body, operation, 0.5, 1, 1)), show(r.quantiles(body, operation, 0.5, 2)),
                     show(all), show(r.quantiles(body, operation, 0.99)),
                     fmt::format("{:.2g}", median(all) / step_us)});
    }
  return table;
}

Table views_table(const OperationFigures& r, const std::vector<std::string>& bodies) {
  Table table({{"view"},
               {"body"},
               {"follow a dissociation [us]", Align::right},
               {"follow a removal [us]", Align::right},
               {"rebuild [ms]", Align::right},
               {"a step [ms]", Align::right}});
  for (std::size_t view = 2; view < operation_phases().size(); ++view)
    for (const std::string& body : bodies) {
      Values rebuild, step;
      for (const BodySample& s : r.bodies.at(body)) {
        rebuild.push_back(milliseconds(s.rebuild_ns[view - 2]));
        step.push_back(milliseconds(s.step_ns));
      }
      table.add_row({operation_phases()[view], body, show(r.quantiles(body, "dissociate, random", 0.5, view, 1)),
                     show(r.quantiles(body, "remove", 0.5, view, 1)), show(rebuild), show(step)});
    }
  return table;
}

std::string operations_note() {
  return "Wall time of each operation by itself, on the tetrahedral storage: the median and the 99th percentile are "
         "taken within each process, and the median over processes is shown. Each phase includes one reading of the "
         "clock, some 0.03 us. 'split off' copies some hundred tetrahedra out, map and embeddings in one; 'undo' is of "
         "a dissociation, by the journal, the map alone. A step is one of the classical Runge-Kutta method over the "
         "cell arrays.";
}

std::vector<Claim> claims_of(const OperationFigures& r, const std::vector<std::string>& bodies) {
  std::vector<Claim> claims;
  const char* far_away = "in large bodies every cell that is touched lies outside the caches";
  const char* shares_anew =
      "in large bodies every cell that is touched lies outside the caches; a removal walks around its four vertices and "
      "sums the shares of all cells there anew, so that no bit depends on the order of operations";
  claims.push_back(bounded(r, bodies, "dissociate", {"dissociate, cut", "dissociate, random"}, 5.0, far_away));
  claims.push_back(bounded(r, bodies, "remove", {"remove"}, 10.0, shares_anew));
  claims.push_back(bounded(r, bodies, "tear-fan", {"tear fan"}, 20.0, far_away));
  for (const auto& [operation, bound] : {std::pair("dissociate, cut", 1.5), std::pair("dissociate, random", 2.5)}) {
    const Values ratio = ratios(r.quantiles("kuhn-998250", operation, 0.5), r.quantiles("kuhn-2058", operation, 0.5));
    if (ratio.empty()) continue;
    const Figure f = figure_of(ratio);
    claims.push_back(
        target(fmt::format("operation-{}-scaling", operation == std::string("dissociate, cut") ? "cut" : "random"),
               fmt::format("{}: 998,250 tetrahedra over 2,058", operation), fmt::format("<= {:g}", bound),
               fmt::format("{:.3g}", f.median), to_string(f.interval), at_most(f, bound), far_away));
  }
  for (const std::string body : {"liver564", "kuhn-105456"}) {
    Values ratio;
    if (const auto found = r.bodies.find(body); found != r.bodies.end())
      for (const BodySample& s : found->second)
        ratio.push_back(milliseconds(s.eventful_step_ns) / milliseconds(s.step_ns));
    if (ratio.empty()) continue;
    const Figure f = figure_of(ratio);
    claims.push_back(target("operation-step-" + body,
                            "a step with a dissociation and all views over one without, " + body, "<= 2",
                            fmt::format("{:.3g}", f.median), to_string(f.interval), at_most(f, 2.0)));
  }
  // the paper's claim, by the cost of one operation
  Values rebuild;
  for (const BodySample& s : r.bodies.at("liver564")) rebuild.push_back(1e3 * milliseconds(s.rebuild_ns[0]));
  Values removal;
  for (const auto phase : {0, 1}) {
    const Values part = r.quantiles("liver564", "remove", 0.5, static_cast<std::size_t>(phase), 1);
    removal.resize(part.size(), 0.0);
    for (std::size_t k = 0; k < part.size(); ++k) removal[k] += part[k];
  }
  const Figure f = figure_of(ratios(rebuild, removal));
  claims.push_back(answered("rebuild-negligible", at_most(f, 0.1),
                            fmt::format("rebuilding takes {:.3g} removals", f.median), to_string(f.interval)));
  return claims;
}

}  // namespace dartboard
