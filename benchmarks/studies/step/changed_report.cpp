#include "benchmarks/studies/step/changed_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "benchmarks/studies/step/step_bodies.h"

namespace dartboard {
namespace {

constexpr double most_after_changes = 1.15;

/// The worst change of one body.
Claim claim_after_changes(const ChangedCosts& c, const char* id, const std::string& body) {
  Claim made = target(id, fmt::format("{}, after up to half of it has changed: a step over one of a fresh body", body),
                      fmt::format("<= {:g} for each", most_after_changes));
  Met met = Met::yes;
  double worst = -std::numeric_limits<double>::infinity();
  std::size_t changes = 0;
  for (const ChangedCase& one : c.cases) {
    if (one.body != body) continue;
    const Figure f = c.over_fresh(one);
    met = std::min(met, at_most(f, most_after_changes));
    ++changes;
    if (!(f.median <= worst)) {
      worst = f.median;
      made.bound_or_interval = fmt::format("{} for {:g} % {}", to_string(f.interval), 100.0 * one.asked, one.kind);
    }
  }
  if (changes == 0) {
    made.reason = too_quick;
    return made;
  }
  made.measured = fmt::format("{:.3f}, the largest of {}", worst, changes);
  judge(
      made, met,
      "until a sixteenth is scattered, what changes add lies at the end of the columns, and what was last in the gaps "
      "of what they remove");
  return made;
}

}  // namespace

Figure ChangedCosts::over_fresh(const ChangedCase& one) const {
  return paired_ratio(samples, one.changed + changed_task::changed, one.changed + changed_task::fresh).cpu;
}

double ChangedCosts::spring_ns(const ChangedCase& one, const char* task) const {
  return times_of(samples, one.changed + task).cpu_median / (4.0 * one.steps * static_cast<double>(one.springs));
}

std::size_t ChangedCosts::count_differing() const {
  std::size_t differing = 0;
  for (const ChangedCase& one : cases) differing += one.differing;
  return differing;
}

std::vector<Claim> claims_of(const ChangedCosts& c) {
  const std::size_t differing = c.count_differing();
  const Claim agreement = target(
      "step-changed-agreement",
      "changed bodies and fresh bodies of the same cells and vertices have equal counts of springs, and the same "
      "forces within the bound of rounding",
      "0 differ", fmt::format("{} differ", differing), fmt::format("of {} changed bodies", c.cases.size()),
      met(differing == 0 && !c.cases.empty()));
  std::vector<Claim> claims{agreement};
  for (const auto& [id, tetrahedra] : {std::pair{"step-changed-medium", 100'000}, {"step-changed-large", 1'000'000}}) {
    const std::string body = step_box(static_cast<std::size_t>(tetrahedra), false);
    if (agreement.verdict == Verdict::holds)
      claims.push_back(claim_after_changes(c, id, body));
    else
      claims.push_back({.id = id,
                        .text = fmt::format("{}, after changes", body),
                        .reason = "bodies do not agree, so their times mean nothing"});
  }
  return claims;
}

Table changed_table(const ChangedCosts& c) {
  Table table({{"body"},
               {"change"},
               {"amount, %", Align::right},
               {"tetrahedra", Align::right},
               {"springs", Align::right},
               {"changed, ns per spring and evaluation", Align::right},
               {"fresh, ns", Align::right},
               {"over fresh", Align::right},
               {"interval", Align::right}});
  for (const ChangedCase& one : c.cases) {
    const Figure f = c.over_fresh(one);
    table.add_row({one.body, one.kind, fmt::format("{:.1f}", 100.0 * one.reached), std::to_string(one.tetrahedra),
                   std::to_string(one.springs), fmt::format("{:.2f}", c.spring_ns(one, changed_task::changed)),
                   fmt::format("{:.2f}", c.spring_ns(one, changed_task::fresh)), fmt::format("{:.3f}", f.median),
                   to_string(f.interval)});
  }
  return table;
}

std::string changed_note() {
  return "Amounts are the new springs over those at the start, and for removals the cells removed over all cells. The "
         "changed body is stepped through its own columns, four springs at a time on one thread; as in a scene they are "
         "numbered anew each time that a sixteenth of the springs is scattered. The fresh body has the same cells, "
         "vertices and springs, ordered and numbered as a scene makes a body of them. Where an edge comes apart between "
         "vertices that do not, a scene's body would have one spring in place of parallel ones; the fresh body here keeps "
         "these next to each other. Both take turns from the same state.";
}

}  // namespace dartboard
