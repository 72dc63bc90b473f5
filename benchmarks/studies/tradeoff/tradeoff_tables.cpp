#include "benchmarks/studies/tradeoff/tradeoff_tables.h"

#include <fmt/format.h>

#include <cmath>

namespace dartboard {
namespace {

std::string show(double x) { return std::isfinite(x) ? fmt::format("{:.3g}", x) : "-"; }

}  // namespace

std::string reading_of_costs() {
  return "Costs are processor time, in units of the time of one evaluation of the forces of the same system, timed in turn "
         "with the runs; a run includes all of its factorisations and what its scene does to the body. An error is the root "
         "mean square over the mass, the largest over time. Between two steps the cost and the step are interpolated on the "
         "log-log scale; the step of a method that chooses its steps is their mean. The regret of a fixed choice is its cost over that of the best; '-' "
         "where it does not reach the error. A point is dominated when another is no less accurate and its slowest "
         "repetition is faster than the fastest of the point.";
}

std::vector<double> decades(const WorkPrecision& study) {
  std::vector<double> errors;
  for (int k = 1; k <= 13; ++k) {
    const double error = std::pow(10.0, -k);
    if (error < study.reference.floor) break;
    errors.push_back(error);
  }
  return errors;
}

Table winners_table(const WorkPrecision& study) {
  Table table({{"error [edges]"},
               {"cheapest"},
               {"step [ms]", Align::right},
               {"cost [evaluations' time]", Align::right},
               {"force evaluations", Align::right},
               {"seconds", Align::right},
               {"runner-up"},
               {"costs", Align::right},
               {"cvode-adams costs", Align::right}});
  double force_s = 0.0;
  for (const WorkPoint& p : study.points)
    if (force_s == 0.0 || p.force_s < force_s) force_s = p.force_s;
  const auto ratio = [](double cost, double best) {
    return std::isfinite(cost) ? fmt::format("{:.2f} x", cost / best) : "-";
  };
  for (const Winner& w : winners(study.points, decades(study))) {
    const double peer = cost_at(study.points, "cvode-adams", w.error);
    if (w.contender.empty())
      table.add_row({fmt::format("{:.0e}", w.error), "none", "-", "-", "-", "-", "-", "-", "-"});
    else
      table.add_row({fmt::format("{:.0e}", w.error), w.contender, show(1e3 * w.h), fmt::format("{:.0f}", w.cost),
                     fmt::format("{:.0f}", w.evaluations), show(w.cost * force_s),
                     w.runner_up.empty() ? "-" : w.runner_up,
                     w.runner_up.empty() ? "-" : ratio(w.runner_up_cost, w.cost), ratio(peer, w.cost)});
  }
  return table;
}

Table regrets_table(const WorkPrecision& study) {
  const std::vector<double> errors = decades(study);
  std::vector<Column> columns{{"always"}};
  for (const double error : errors) columns.push_back({fmt::format("{:.0e}", error), Align::right});
  columns.push_back({"worst", Align::right});
  Table table(columns);
  for (const Regret& r : regrets(study.points, errors)) {
    std::vector<std::string> row{r.contender + (r.peer ? " (peer)" : "")};
    for (const double x : r.of_error) row.push_back(std::isfinite(x) ? fmt::format("{:.3g}", x) : "-");
    row.push_back(show(r.worst));
    table.add_row(row);
  }
  return table;
}

Table points_table(const WorkPrecision& study) {
  Table table({{"integrator"},
               {"h omega_max", Align::right},
               {"tolerance", Align::right},
               {"E_x", Align::right},
               {"E_v", Align::right},
               {"energy", Align::right},
               {"force evaluations", Align::right},
               {"factorisations", Align::right},
               {"solves", Align::right},
               {"cost [evaluations' time]", Align::right},
               {"range"},
               {"standing"}});
  for (const WorkPoint& p : study.points) {
    const bool bad = p.failed();
    table.add_row(
        {p.contender, show(p.h_omega), p.setting.steps > 0 ? "" : fmt::format("{:.0e}", p.setting.tolerance),
         bad ? "" : fmt::format("{:.2e}", p.errors.x), bad ? "" : fmt::format("{:.2e}", p.errors.v),
         bad ? "" : fmt::format("{:.2e}", p.errors.energy), std::to_string(p.work.force_evaluations),
         std::to_string(p.work.factorisations), std::to_string(p.work.solves), fmt::format("{:.0f}", p.cost),
         fmt::format("{:.0f} .. {:.0f}", p.cost_low(), p.cost_high()),
         bad ? p.diagnosis : fmt::format("{}{}", name(p.standing), p.under_floor ? ", under the floor" : "")});
  }
  return table;
}

}  // namespace dartboard
