#include "benchmarks/studies/reproduce/reproduce_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "benchmarks/harness/paired.h"
#include "benchmarks/paper/paper_claims.h"
#include "benchmarks/studies/reproduce/paper_answers.h"
#include "benchmarks/studies/reproduce/real_time.h"
#include "core/topology/check.h"
#include "validation/paper/uncut_body.h"
#include "validation/topology/topology_claims.h"

namespace dartboard {
namespace {

constexpr double paper_baseline_ms = 2.0;

std::string or_dash(bool present, const std::string& text) { return present ? text : "-"; }

// Whether each dart is met exactly once when the darts of all i-cells are listed.
template <int i>
bool partitions(const Map3& map) {
  std::vector<int> met(map.capacity(), 0);
  for_each_cell<i>(map, [&](Cell<i> cell) { for_each_dart_of(map, cell, [&](Dart d) { ++met[d.index]; }); });
  bool once = true;
  map.for_each_dart([&](Dart d) { once = once && met[d.index] == 1; });
  return once;
}

}  // namespace

ReproduceGates gates_of(const std::vector<CountAgreement>& counts, const std::vector<MotionAgreement>& motion,
                        const std::vector<SecondOfMotion>& second) {
  ReproduceGates gates;
  // a contender is as good as all contenders with the same carrier
  const auto moves_right = [&](const std::string& id) {
    return std::ranges::none_of(
        second, [&](const SecondOfMotion& s) { return !s.agrees && contender(s.id).carrier == contender(id).carrier; });
  };
  const bool topology = !counts.empty() && std::ranges::all_of(counts, [](const auto& c) { return c.agrees(); });
  for (const MotionAgreement& m : motion)
    if (topology && m.agrees && moves_right(m.id)) gates.agreed.push_back(m.id);
  gates.passed = !gates.agreed.empty() && gates.agreed.size() == motion.size();
  return gates;
}

std::vector<Claim> answer_body(const MassSpringBody<Map3, Held::by_every_dart>& body, const Problem& problem) {
  std::vector<Claim> claims;
  const Map3& map = body.map;
  const std::string violation = check(map);
  claims.push_back(answered("map-valid", met(violation.empty()), violation.empty() ? "valid" : violation, "exact"));
  const bool once = partitions<0>(map) && partitions<1>(map) && partitions<2>(map) && partitions<3>(map);
  claims.push_back(
      answered("cells-partition", met(once), once ? "each dart in 1 cell per i" : "a dart is in 0 or 2", "exact"));

  claims.push_back(tried_out("mass-sum", masses_are_of_cells(body, problem), "volumes of the mesh in exact rationals"));
  claims.push_back(tried_out("stiffness-sum", stiffnesses_are_of_cells(body, problem),
                             "exact; cells of the mesh by pairs of points"));
  return claims;
}

std::vector<Claim> answer_topology(const std::vector<CountAgreement>& counts, const Problem& problem) {
  std::vector<Claim> claims;
  const auto answer = [&](PaperClaimId id, const ClaimAnswer& a) {
    claims.push_back(answered(id, met(a.holds), a.measured, "exact"));
  };
  answer("graphs-ambiguous", try_same_graph_twice(problem.mesh));
  answer("non-manifold-refused", try_non_manifold_inputs());
  answer("class-closed", try_to_leave_the_class(problem.mesh, 500, 1));
  answer("combinatorial-export", try_combinatorial_round_trip(problem.mesh));
  for (Claim& claim : answer_body(build_body<Map3, Held::by_every_dart>(problem), problem))
    claims.push_back(std::move(claim));
  const auto count = [&](const char* what) { return std::ranges::find(counts, what, &CountAgreement::what)->ours; };
  claims.push_back(answered("body-size",
                            met(count("vertices") == 564 && count("edges") == 2850 && count("volumes") == 1856),
                            fmt::format("{} / {} / {}", count("vertices"), count("edges"), count("volumes")), "exact"));
  claims.push_back(answered("dart-count", met(count("darts") == 44544 && count("darts") == 24 * count("volumes")),
                            std::to_string(count("darts")), "exact"));
  return claims;
}

namespace {
// The largest ratio of arrays to graph that is no new finding where the paper's 1.10 is missed.
constexpr double close_to_arrays = 1.2;
}  // namespace

std::vector<Claim> answer_time(const ReproduceResults& r) {
  std::vector<Claim> claims;
  const std::vector<std::string> walks{"coverage-every", "coverage", "lists", "lists-every", "arrays", "graph"};
  if (!std::ranges::all_of(walks, [&](const std::string& id) { return r.timed(id); })) {
    for (const PaperClaim& row : paper_claims) {
      if (row.about != About::times || row.id == "rebuild-negligible" || row.id == "real-time") continue;
      claims.push_back(claim_of(row));
      claims.back().reason = "a contender failed a gate and was not timed";
    }
    return claims;
  }
  const Figure slower = r.ratio("coverage-every", "graph").cpu;  // the cheaper of the two coverages
  claims.push_back(answered("coverage-slower", at_least(slower, 1.0), fmt::format("{:.3g}", slower.median),
                            to_string(slower.interval)));
  const Figure one = r.ratio("lists", "coverage").cpu, every = r.ratio("lists-every", "coverage-every").cpu;
  claims.push_back(answered("lists-faster", std::min(at_most(one, 1.0), at_most(every, 1.0)),
                            fmt::format("{:.2f}, {:.3f} if every dart holds", one.median, every.median),
                            fmt::format("{}; {}", to_string(one.interval), to_string(every.interval))));
  const Figure arrays = r.ratio("arrays", "graph").cpu;
  claims.push_back(answered("arrays-overhead", at_most(arrays, 1.10), fmt::format("{:.3f}", arrays.median),
                            to_string(arrays.interval)));
  if (claims.back().verdict == Verdict::does_not_carry_over && arrays.interval.high <= close_to_arrays)
    claims.back().reason =
        "it is on the border: one machine had 1.07 on one day and 1.12 on another, when all its memory was slower";
  // a ladder of whole numbers: each is met by a ratio that rounds to it
  const Figure coverage = r.ratio("coverage", "graph").cpu, lists = r.ratio("lists", "graph").cpu;
  const auto is_step = [](const Figure& f, double of) { return std::min(at_least(f, of - 0.5), at_most(f, of + 0.5)); };
  claims.push_back(answered(
      "paper-ladder", std::min({is_step(coverage, 6.0), is_step(lists, 4.0), is_step(arrays, 1.0)}),
      fmt::format("{:.3g} : {:.3g} : {:.2f} : 1", coverage.median, lists.median, arrays.median),
      fmt::format("{}; {}; {}", to_string(coverage.interval), to_string(lists.interval), to_string(arrays.interval))));
  for (Claim& claim : claims)
    if (r.quick && claim.surprises()) {
      claim.verdict = Verdict::undecided;
      claim.reason = "a quick run is too short to contradict what is known: leave out --quick";
    }
  return claims;
}

Claim answer_rebuild(const std::vector<SeriesTime>& series, int removals) {
  std::vector<double> ratio;
  for (const SeriesTime& time : series)
    ratio.push_back(static_cast<double>(time.rebuild_ns) / static_cast<double>(time.changes_ns));
  const Figure figure = figure_of(ratio);
  return answered("rebuild-negligible", at_most(figure, 0.1),
                  fmt::format("{:.2g} of the time of {} removals", figure.median, removals),
                  to_string(figure.interval));
}

Claim measure_rebuild_claim(const Problem& problem, StudyLog& log) {
  constexpr int removals = 20;
  const std::vector<SeriesTime> series = log.once("series of removals", [&problem] {
    std::vector<SeriesTime> timed;
    for (std::uint64_t seed = 1; seed <= 7; ++seed) timed.push_back(time_series_of_removals(problem, removals, seed));
    return timed;
  });
  return answer_rebuild(series, removals);
}

int reproduce_exit_code(const std::vector<Claim>& claims, bool gates_passed) {
  return gates_passed ? exit_code(claims) : 1;
}

std::string closing_words(const std::vector<Claim>& claims, bool gates_passed, bool quick) {
  std::string text = quick ? "This was a quick run. " : "";
  text += gates_passed ? "Every gate is passed: " : "A gate has failed, and contenders that failed it were not timed: ";
  text += in_words(claims) + "\n";
  if (reproduce_exit_code(claims, gates_passed) != 0)
    text +=
        "What failed or fell short is listed above and in report.html; "
        "run again with another --seed to see whether it persists.";
  else
    text +=
        "Next: './dartboard gallery' runs and draws the scenes, './dartboard simulate FILE.json' one of your own, "
        "'./dartboard recommend FILE.json --error 1e-3' chooses its integrator and step.";
  return text;
}

bool ReproduceResults::timed(const std::string& id) const {
  return std::any_of(per_step.begin(), per_step.end(), [&](const Sample& s) { return s.task == id; });
}

Table counts_table(const ReproduceResults& results) {
  const std::map<std::string, std::string> paper{
      {"darts", "44544"}, {"vertices", "564"}, {"edges", "2850"}, {"volumes", "1856"}};
  Table table({{"count"}, {"paper", Align::right}, {"this map", Align::right}, {"CGAL", Align::right}, {"agree"}});
  for (const auto& c : results.counts)
    table.add_row({c.what, paper.contains(c.what) ? paper.at(c.what) : "-", std::to_string(c.ours),
                   std::to_string(c.cgal), c.agrees() ? "yes" : "NO"});
  return table;
}

Table agreement_table(const ReproduceResults& results) {
  Table table({{"contender"},
               {"state hash"},
               {"force difference / bound", Align::right},
               {"position difference [m]", Align::right},
               {"bound [m]", Align::right},
               {"agrees"}});
  for (const auto& m : results.motion) {
    const bool bits = m.position_bound == 0.0;
    table.add_row({m.id, fmt::format("{:016x}", m.hash),
                   bits ? (m.force_difference == 0.0 ? "0" : "not 0") : fmt::format("{:.2g}", m.force_difference),
                   m.position_difference == 0.0 ? "0" : fmt::format("{:.1e}", m.position_difference),
                   bits ? "0, same bits" : fmt::format("{:.1e}", m.position_bound), m.agrees ? "yes" : "NO"});
  }
  return table;
}

Table second_table(const ReproduceResults& results) {
  Table table({{"contender"},
               {"steps", Align::right},
               {"travelled [m]", Align::right},
               {"position difference [m]", Align::right},
               {"bound [m]", Align::right},
               {"velocity difference [m/s]", Align::right},
               {"bound [m/s]", Align::right},
               {"agrees"}});
  for (const SecondOfMotion& s : results.second)
    table.add_row({s.id, std::to_string(s.steps), fmt::format("{:.2g}", s.travelled), fmt::format("{:.1e}", s.position),
                   fmt::format("{:.1e}", s.position_bound), fmt::format("{:.1e}", s.velocity),
                   fmt::format("{:.1e}", s.velocity_bound), s.agrees ? "yes" : "NO"});
  return table;
}

std::string bounds_note() {
  return "The bounds above hold in the worst case: every rounding as large as it can be and in the same direction, so "
         "what is measured is a thousandth of them. The sharp gate is this one: ten times what rounding the result of "
         "each step, at random, does to the same run in extended precision.";
}

Table timing_table(const ReproduceResults& results) {
  Table table({{"walk"},
               {"section"},
               {"paper [ms]", Align::right},
               {"paper ratio", Align::right},
               {"here [ms]", Align::right},
               {"wall [ms]", Align::right},
               {"ratio here [interval]", Align::right}});
  for (const Contender& c : contenders()) {
    const bool timed = results.timed(c.id) && results.timed("graph");
    const Times times = timed ? times_of(results.per_step, c.id) : Times{};
    table.add_row({c.id, or_dash(!c.section.empty(), c.section),
                   or_dash(c.paper_ms > 0.0, fmt::format("{:.0f}", c.paper_ms)),
                   or_dash(c.paper_ms > 0.0,
                           c.id == "arrays" ? "<= 1.10" : fmt::format("{:.0f}", c.paper_ms / paper_baseline_ms)),
                   or_dash(timed, fmt::format("{:.4f}", times.cpu_median * 1e-6)),
                   or_dash(timed, fmt::format("{:.4f}", times.wall_median * 1e-6)),
                   !timed            ? "not timed: failed a gate"
                   : c.id == "graph" ? "1"
                                     : to_string(results.ratio(c.id, "graph").cpu)});
  }
  return table;
}

std::string timing_note(const ReproduceResults& r, const Problem& problem) {
  const auto& walks_compared = {"coverage", "coverage-every", "lists", "lists-every", "arrays", "graph"};
  if (!std::ranges::all_of(walks_compared, [&](const char* id) { return r.timed(id); }))
    return "Some contenders failed a gate and were not timed.";
  const auto springs = static_cast<double>(
      std::find_if(r.counts.begin(), r.counts.end(), [](const auto& c) { return c.what == "edges"; })->ours);
  std::string walks;
  for (const Contender& c : contenders()) walks += fmt::format("- {}: {}\n", c.id, c.what);
  return fmt::format(
      "{}\n"
      "Times are processor time per RK4 step (four force evaluations, h = {:g} s), medians over processes. Ratios are "
      "paired within rounds; their intervals are distribution-free, over processes.\n"
      "\n"
      "Against the paper's times (2010, 2.8 GHz, its map library MOKA) full coverage is {:.1f} times as fast when one "
      "dart holds the embedding and {:.1f} times when every dart does, lists {:.1f} and {:.0f} times, cell arrays "
      "{:.0f} and the adjacency graph {:.0f} times: contiguous arrays and lists profit from wider and deeper "
      "processors, a walk waits for one link to know the next. So the ratios to the graph are not the paper's, while "
      "the order of the walks is the same.\n"
      "\n"
      "Cell arrays take {:.1f} ns per spring and force evaluation, everything included.\n"
      "\n"
      "When one dart of an orbit holds the embedding (the paper's choice, section 2.2), a look-up walks the orbit; when "
      "every dart holds it, coverage costs {:.3g} ms and lists {:.3g} ms.",
      walks, problem.h, 12.0 / r.ms("coverage"), 12.0 / r.ms("coverage-every"), 8.0 / r.ms("lists"),
      8.0 / r.ms("lists-every"), 2.0 / r.ms("arrays"), 2.0 / r.ms("graph"), r.ms("arrays") * 1e6 / (4.0 * springs),
      r.ms("coverage-every"), r.ms("lists-every"));
}

std::vector<Claim> in_order_of_paper(std::vector<Claim> claims) {
  const auto place = [](const Claim& claim) {
    return std::ranges::find(paper_claims, claim.id, &PaperClaim::id) - paper_claims.begin();
  };
  std::ranges::stable_sort(claims, {}, place);
  return claims;
}

std::vector<Claim> answer_claims(const ReproduceResults& results, const Problem& problem, StudyLog& log) {
  std::vector<Claim> claims = answer_topology(results.counts, problem);
  for (Claim& claim : answer_by_trials(problem)) claims.push_back(std::move(claim));
  for (Claim& claim : answer_time(results)) claims.push_back(std::move(claim));
  claims.push_back(measure_rebuild_claim(problem, log));
  claims.push_back(measure_real_time(problem.h, results.quick, log));
  return in_order_of_paper(std::move(claims));
}

}  // namespace dartboard
