#include "benchmarks/studies/step/changing_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "benchmarks/studies/step/step_bodies.h"

namespace dartboard {
namespace {

constexpr double most_changing_liver = 0.58, most_changing_large = 0.50;
constexpr const char* published_gain = "1.37 to 1.61";  // of STA-FEM (2026), for edits known beforehand

bool is_timed(const ChangingCosts& c, const std::string& body) {
  return std::ranges::count(c.bodies, body, &ChangingCounts::changing) > 0;
}

Claim claim_on_changing(const ChangingCosts& c, const char* id, const std::string& body, double most) {
  Claim made =
      target(id, fmt::format("{}: a dissociation and a step over a step of the naive graph without changes", body),
             fmt::format("<= {:g}", most));
  if (!is_timed(c, body)) {
    made.reason = too_quick;
    return made;
  }
  const Figure f = c.over(body, changing_task::followed, changing_task::naive);
  made.measured = fmt::format("{:.3f}", f.median);
  made.bound_or_interval = to_string(f.interval);
  judge(
      made, at_most(f, most),
      "map, embeddings and views follow each dissociation, and the integrator starts anew: the table has what that adds to "
      "a step alone");
  return made;
}

/// What it gains that views follow.
Claim claim_on_following(const ChangingCosts& c) {
  Claim made{
      .id = "step-changing-anew",
      .text = "a dissociation and a step with all columns computed anew from the map, over the same where they follow",
      .paper_value = fmt::format("none; published {}", published_gain),
      .reason = "it is reported only: the published gain is that of another program, for edits known beforehand"};
  for (const ChangingCounts& body : c.bodies) {
    const Figure f = c.over(body.changing, changing_task::all_anew, changing_task::followed);
    const char* between = made.measured.empty() ? "" : " / ";
    made.measured += fmt::format("{}{:.2f}", between, f.median);
    made.bound_or_interval += between + to_string(f.interval);
  }
  return made;
}

}  // namespace

Figure ChangingCosts::over(const std::string& body, const char* task, const char* baseline) const {
  return paired_ratio(samples, body + task, body + baseline).cpu;
}

std::size_t ChangingCosts::count_differing() const {
  std::map<std::pair<int, int>, std::map<std::string, std::uint64_t>> left;  // by process and round, then by task
  for (const Sample& s : samples) left[{s.process, s.round}][s.task] = s.hash;
  std::size_t differing = 0;
  for (const ChangingCounts& body : bodies) differing += body.differing;
  for (auto& [round, hash_of] : left)
    for (const ChangingCounts& body : bodies)
      for (const char* task : {changing_task::ends_anew, changing_task::all_anew})
        differing += hash_of[body.changing + changing_task::followed] != hash_of[body.changing + task];
  return differing;
}

std::vector<Claim> claims_of(const ChangingCosts& c) {
  const std::size_t differing = c.count_differing();
  const Claim agreement =
      target("step-changing-agreement",
             "bodies that change in every step end in the same bits where their views follow and where these are made "
             "anew, and have the forces of a fresh body within the bound of rounding",
             "0 differ", fmt::format("{} differ", differing), fmt::format("of {} bodies", c.bodies.size()),
             met(differing == 0 && !c.bodies.empty()));
  std::vector<Claim> claims{agreement};
  if (agreement.verdict == Verdict::holds) {
    claims.push_back(claim_on_changing(c, "step-changing-liver", paper_step_body(true), most_changing_liver));
    claims.push_back(claim_on_changing(c, "step-changing-large", step_box(1'000'000, false), most_changing_large));
    claims.push_back(claim_on_following(c));
  } else {
    for (const char* id : {"step-changing-liver", "step-changing-large", "step-changing-anew"})
      claims.push_back({.id = id,
                        .text = "a dissociation and a step",
                        .reason = "the motions do not agree, so their times mean nothing"});
  }
  return claims;
}

Table changing_table(const ChangingCosts& c) {
  using namespace changing_task;
  Table table({{"body"},
               {"tetrahedra", Align::right},
               {"a step alone, us", Align::right},
               {"with a dissociation, over alone", Align::right},
               {"interval", Align::right},
               {"over the graph's step", Align::right},
               {"interval ", Align::right},
               {"ends anew, over following", Align::right},
               {"all anew, over following", Align::right},
               {"interval  ", Align::right}});
  for (const ChangingCounts& body : c.bodies) {
    const Figure cost = c.over(body.changing, followed, alone), over_graph = c.over(body.changing, followed, naive),
                 ends = c.over(body.changing, ends_anew, followed), all = c.over(body.changing, all_anew, followed);
    table.add_row({body.changing, std::to_string(body.tetrahedra),
                   fmt::format("{:.1f}", times_of(c.samples, body.changing + alone).cpu_median / (1e3 * body.steps)),
                   fmt::format("{:.3f}", cost.median), to_string(cost.interval),
                   fmt::format("{:.3f}", over_graph.median), to_string(over_graph.interval),
                   fmt::format("{:.2f}", ends.median), fmt::format("{:.2f}", all.median), to_string(all.interval)});
  }
  return table;
}

std::string changing_note() {
  return "In every step an inner face drawn at random comes apart: the map, the embeddings and the views of a scene's body "
         "follow, the integrator starts anew, and a step of RK4 is taken. The graph steps the body without changes. Where "
         "ends are anew, the ends of all springs are read from the map after each change, and embeddings are adapted; where "
         "all is anew, all masses and springs are computed from the map, too. All end in the same bits. At most one face in "
         "a hundred comes apart before a body is made anew, and bodies of up to 20,000 tetrahedra are made anew for each "
         "sample.";
}

}  // namespace dartboard
