#include "benchmarks/studies/contact/bench_contact_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/plain/nan_maximum.h"

namespace dartboard {
namespace {

constexpr double most_idle = 1.02;      // of a step without contact
constexpr double most_after_cut = 1.0;  // of the forces of the elements
constexpr double most_asleep = 1.1;     // of a step of what is awake
constexpr double most_factored = 0.1;   // of the steps
/// The sum of some thousand forces by their roundings.
constexpr double most_unbalanced = 1e-13;

using Points = std::vector<std::pair<double, double>>;  // logarithms

double slope_of(const Points& points) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto n = static_cast<double>(points.size());
  for (const auto& [x, y] : points) {
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

Figure ratio_of(const ContactCosts& c, const std::string& situation, const char* task, const char* baseline) {
  return paired_ratio(c.samples, situation + task, situation + baseline).cpu;
}

/// Every situation must keep to the bound.
Claim claim_of_all(const ContactCosts& c, const std::string& id, const std::string& text,
                   const std::vector<std::string>& situations, const char* baseline, double most,
                   const char* cause = "") {
  std::string measured, intervals;
  Met met = Met::yes;
  for (const std::string& situation : situations) {
    const Figure f = ratio_of(c, situation, ": step", baseline);
    measured += fmt::format("{}{:.3f}", measured.empty() ? "" : " / ", f.median);
    intervals += (intervals.empty() ? "" : " / ") + to_string(f.interval);
    met = std::min(met, at_most(f, most));
  }
  return target(id, text, fmt::format("<= {:g}", most), measured, intervals, met, cause);
}

Claim idle_claim(const ContactCosts& c, const std::string& kind) {
  std::vector<std::string> of_kind;
  for (const std::string& situation : idle_situations())
    if (situation.starts_with(kind)) of_kind.push_back(situation);
  return claim_of_all(
      c, "contact-idle-" + kind,
      fmt::format("a liver of {} far from a plane / from itself: a step with contact over one without", kind), of_kind,
      ": step without", most_idle,
      "places and velocities are looked at twice in a step, while four springs or tetrahedra at a time cost little more");
}

Claim growth_claim(const ContactCosts& c, const std::string& task, const std::string& what) {
  const Figure f = c.exponent(task);
  const double bound = c.exponent_of_n_log_n();
  const auto plates = plate_situations(c.largest);
  return target("contact-growth-" + what,
                fmt::format("{} of contact grow like n log n or better, from {} to {} tetrahedra along the boundary",
                            what, c.counts.at(plates.front()).tetrahedra, c.counts.at(plates.back()).tetrahedra),
                fmt::format("exponent <= {:.3f}", bound), fmt::format("{:.3f}", f.median), to_string(f.interval),
                at_most(f, bound), "a pair takes longer where its places come from memory, not from a cache");
}

// Counts, which have no interval.
Claim factors_claim(const ContactCosts& c) {
  std::string measured, iterations;
  Met met = c.factors.empty() ? Met::no : Met::yes;
  for (const ContactFactors& f : c.factors) {
    const double share = static_cast<double>(f.factorisations) / static_cast<double>(f.steps);
    measured += fmt::format("{}{:.3f}", measured.empty() ? "" : " / ", share);
    iterations +=
        fmt::format("{}{:.1f} and {:.1f}", iterations.empty() ? "" : " / ", f.with_changes(), f.without_changes());
    if (!(f.changes > 0 && share <= most_factored)) met = Met::no;
  }
  return target(
      "contact-kept-factor",
      "backward Euler on boxes that lie on each other / a liver that is pressed / balls that roll: new factors "
      "per step, while contacts come and go",
      fmt::format("<= {:g}", most_factored), measured,
      fmt::format("{} iterations in steps with a change and without", iterations), met);
}

std::string limit_of(const std::string& situation) {
  return std::ranges::count(idle_situations(), situation) > 0 ? fmt::format("<= {:g}", most_idle) : "";
}

}  // namespace

Figure ContactCosts::exponent(const std::string& task) const {
  const auto plates = plate_situations(largest);
  const ContactCounts& first = counts.at(plates.front());
  std::vector<Points> by_process;
  for (const std::string& situation : plates) {
    const ContactCounts& at = counts.at(situation);
    const double each = static_cast<double>(first.evaluations) / at.evaluations;
    std::vector<double> ratios(by_process.size(), 1.0);
    if (situation != first.situation)
      ratios = paired_ratio(samples, situation + task, first.situation + task).cpu_of_process;
    by_process.resize(ratios.size(), {{std::log(first.tetrahedra), 0.0}});
    for (std::size_t p = 0; p < ratios.size(); ++p)
      by_process[p].emplace_back(std::log(at.tetrahedra), std::log(each * ratios[p]));
  }
  std::vector<double> slopes;
  for (const Points& points : by_process) slopes.push_back(slope_of(points));
  return figure_of(slopes);
}

double ContactCosts::exponent_of_n_log_n() const {
  Points points;
  for (const std::string& situation : plate_situations(largest)) {
    const double log_n = std::log(counts.at(situation).tetrahedra);
    points.emplace_back(log_n, log_n + std::log(log_n));
  }
  return slope_of(points);
}

double ContactCosts::evaluation_ns(const std::string& situation, const std::string& task) const {
  return times_of(samples, situation + task).cpu_median / counts.at(situation).evaluations;
}

Table contact_steps_table(const ContactCosts& c) {
  Table table({{"situation"},
               {"samples", Align::right},
               {"candidate pairs", Align::right},
               {"contacts", Align::right},
               {"us per step without", Align::right},
               {"with contact, over that", Align::right},
               {"interval", Align::right},
               {"limit"}});
  for (const std::string& situation : stepped_situations()) {
    const ContactCounts& n = c.counts.at(situation);
    const Figure f = ratio_of(c, situation, ": step", ": step without");
    table.add_row({situation, std::to_string(n.samples), std::to_string(n.candidates), std::to_string(n.contacts),
                   fmt::format("{:.1f}", times_of(c.samples, situation + ": step without").cpu_median / c.steps / 1e3),
                   fmt::format("{:.3f}", f.median), to_string(f.interval), limit_of(situation)});
  }
  return table;
}

Table sleep_table(const ContactCosts& c) {
  Table table({{"situation"},
               {"bodies asleep", Align::right},
               {"tetrahedra awake", Align::right},
               {"us per step, alone", Align::right},
               {"beside sleepers, over that", Align::right},
               {"interval", Align::right},
               {"limit"}});
  for (const std::string& situation : asleep_situations()) {
    const ContactCounts& n = c.counts.at(situation);
    const Figure f = ratio_of(c, situation, ": step", ": step alone");
    table.add_row({situation, std::to_string(n.samples), std::to_string(n.tetrahedra),
                   fmt::format("{:.1f}", times_of(c.samples, situation + ": step alone").cpu_median / c.steps / 1e3),
                   fmt::format("{:.3f}", f.median), to_string(f.interval), fmt::format("<= {:g}", most_asleep)});
  }
  return table;
}

Table factors_table(const ContactCosts& c) {
  Table table({{"scene"},
               {"steps", Align::right},
               {"contacts that come or go", Align::right},
               {"factors", Align::right},
               {"iterations in a step with a change", Align::right},
               {"in another", Align::right}});
  for (const ContactFactors& f : c.factors)
    table.add_row({f.scene, std::to_string(f.steps), std::to_string(f.changes), std::to_string(f.factorisations),
                   fmt::format("{:.1f}", f.with_changes()), fmt::format("{:.1f}", f.without_changes())});
  return table;
}

Table contact_forces_table(const ContactCosts& c) {
  Table table({{"situation"},
               {"tetrahedra", Align::right},
               {"samples", Align::right},
               {"candidate pairs", Align::right},
               {"contacts", Align::right},
               {"ns per tetrahedron", Align::right},
               {"ns per sample", Align::right},
               {"ns per pair", Align::right},
               {"contact over elements", Align::right},
               {"interval", Align::right},
               {"limit"},
               {"list: ns per sample", Align::right}});
  const auto show = [](double ns, std::size_t count) {
    return count == 0 ? "" : fmt::format("{:.3g}", ns / static_cast<double>(count));
  };
  std::vector<std::string> situations = pressed_situations();
  const auto plates = plate_situations(c.largest);
  situations.insert(situations.end(), plates.begin(), plates.end());
  for (const std::string& situation : situations) {
    const ContactCounts& n = c.counts.at(situation);
    const Figure f = ratio_of(c, situation, ": contact", ": elements");
    const double contact = c.evaluation_ns(situation, ": contact");
    const bool listed = std::ranges::count(plates, situation) > 0;
    table.add_row({situation, std::to_string(n.tetrahedra), std::to_string(n.samples), std::to_string(n.candidates),
                   std::to_string(n.contacts), show(c.evaluation_ns(situation, ": elements"), n.tetrahedra),
                   show(contact, n.samples), show(contact, n.candidates), fmt::format("{:.3g}", f.median),
                   to_string(f.interval), situation == cut_situation() ? fmt::format("<= {:g}", most_after_cut) : "",
                   listed ? show(c.evaluation_ns(situation, ": list"), n.samples) : ""});
  }
  return table;
}

std::string contact_costs_note() {
  return "Processor time; tasks take turns within rounds, ratios are paired, intervals are over processes. Contact has "
         "restitution and friction: its steps include these and the search for warnings. Forces are those of contact "
         "and of stable neo-Hookean tetrahedra at the same places. Plates of two cubes' height lie on each other: all "
         "of their tetrahedra are along the boundary, the most that contact has to look at. A list is made anew each "
         "time, and searched once; in a run, it holds until a vertex has moved by half of its margin.";
}

std::vector<Claim> claims_of(const ContactCosts& c) {
  std::size_t differing = 0;
  double unbalanced = 0.0;
  for (const auto& [situation, n] : c.counts) {
    differing += n.differing;
    unbalanced = max_or_nan(unbalanced, n.unbalanced);
  }
  const bool right = differing == 0 && unbalanced <= most_unbalanced;
  std::vector<Claim> claims{
      target("contact-cost-agreement",
             "lists find the contacts that other lists and brute force find, idle contact and sleepers change no bit, "
             "and forces between bodies balance",
             fmt::format("0 differ; <= {:g}", most_unbalanced), fmt::format("{} differ; {:.1e}", differing, unbalanced),
             fmt::format("in {} situations", c.counts.size()), met(right)),
      idle_claim(c, "elements"), idle_claim(c, "springs")};
  const Figure cut = ratio_of(c, cut_situation(), ": contact", ": elements");
  claims.push_back(
      target("contact-after-cut", "the liver, cut through: forces of contact over those of neo-Hookean elements",
             fmt::format("<= {:g}", most_after_cut), fmt::format("{:.3f}", cut.median), to_string(cut.interval),
             at_most(cut, most_after_cut),
             "a vertex between the pressed halves is compared with the nearest few ways out, while forces of "
             "four tetrahedra are computed at a time"));
  claims.push_back(
      claim_of_all(c, "contact-asleep",
                   "99 of 100 cubes asleep, of elements without contact / with contact, of springs without "
                   "/ with: a step over that of the awake one by itself",
                   asleep_situations(), ": step alone", most_asleep));
  claims.push_back(factors_claim(c));
  claims.push_back(growth_claim(c, ": list", "lists"));
  claims.push_back(growth_claim(c, ": contact", "forces"));
  if (!right)
    for (Claim& one : std::span(claims).subspan(1)) {
      one.verdict = Verdict::not_tested;
      one.reason = "the contacts found are wrong, so their times mean nothing";
    }
  return claims;
}

}  // namespace dartboard
