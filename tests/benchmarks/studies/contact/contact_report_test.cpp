// The conclusions of `validate contact` from its results: with one wrong figure, the claim about it falls short.

#include "benchmarks/studies/contact/contact_report.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "benchmarks/studies/contact/contact_study.h"
#include "core/plain/error.h"
#include "tests/support/claims_for_tests.h"

namespace dartboard::contact_report_test {
namespace {

ContactResults good_results() {
  ContactResults r;
  r.placements = {{"boxes", {.placements = 100, .overlapping = 90, .quiet = 2, .deepest_quiet = 0.2}},
                  {"balls", {.placements = 100, .overlapping = 80, .quiet = 1, .deepest_quiet = 0.1}}};
  for (ContactResults::Placed& placed : r.placements) {
    placed.found.by_depth.add(0.1, false);
    for (int k = 0; k < 200; ++k) placed.found.by_depth.add(0.7, true);
  }
  for (const char* scene : {"one", "other"}) {
    ContactRun run{.scene = scene, .looks = 100, .contacts = 20, .allowed = 0.01};
    run.by_depth.add(0.3, true);
    run.deepest = 0.008;
    run.energy = 1e-4;
    run.momentum = run.angular = 1e-15;
    run.ended = true;
    r.runs.push_back(run);
  }
  r.balls = {{{.across = 6}, {.force = 10.5, .closed_form = 10.0, .moved = 1e-9, .ended = true}},
             {{.across = 8}, {.force = 9.8, .closed_form = 10.0, .moved = 1e-9, .ended = true}}};
  r.stack = StackAtRest{.boxes = 5, .steps = 100, .drop = 0.5, .kinetic = 1e-12, .moved = 1e-8, .ended = true};
  r.bounces = {{.body = "box, 10 MPa", .integrator = "verlet", .order = 2, .asked = 0.5, .found = 0.501, .ended = true},
               {.body = "box, 10 MPa", .integrator = "explicit-euler", .order = 1, .asked = 0.5},
               {.body = "box, 20 kPa", .integrator = "verlet", .order = 2, .asked = 0.5, .found = 0.8, .ended = true}};
  const auto drawn = [&r](DrawnKind kind, bool with_bodies, const DrawnContactFound& found) {
    r.drawn.push_back({{.kind = kind, .with_bodies = with_bodies}, found});
  };
  drawn(DrawnKind::leaves, false, {.ended = true, .touched = true, .pulled = 1e-13});
  drawn(DrawnKind::leaves, true, {.ended = true, .touched = true, .pulled = 1e-4});
  drawn(DrawnKind::slides, false, {.ended = true, .touched = true, .caught = 1e-14});
  drawn(DrawnKind::slides, true, {.ended = true, .touched = true, .caught = 1e-9});
  drawn(DrawnKind::drops, false, {.ended = true, .touched = true, .lost = true, .warned = true});
  drawn(DrawnKind::drops, true, {.ended = true, .touched = true});
  PressedOperations& p =
      r.operations.emplace(PressedOperations{.stacks = 2, .dissociated = 60, .torn = 20, .removed = 20});
  p.ended = true;
  p.elastic = p.sums = p.contact = p.momentum = p.angular = 1e-16;
  p.energy = 0.01;
  p.contacts = 50;
  p.by_depth.add(0.3, true);
  p.by_depth.add(0.1, false);
  p.of_neighbours.add(0.2, true);
  return r;
}

using Ids = std::vector<std::string>;
/// The claims that fall short when one thing differs from `good_results`.
Ids short_with(const std::function<void(ContactResults&)>& spoil) {
  ContactResults r = good_results();
  spoil(r);
  return ids_of(claims_of(r), Verdict::falls_short);
}
const Ids moving{"contact-moving-pairs", "contact-depth", "contact-energy", "contact-momentum",
                 "contact-angular-momentum"};

TEST(ContactClaims, HoldWhenEverythingIsAsPromised) {
  const auto claims = claims_of(good_results());
  EXPECT_EQ(ids_of(claims, Verdict::holds).size(), 17u);
  expect_words(claims, "contact-placed", "<= 0.75 altitudes", "0.2 altitudes", "of 170 placements that overlap");
  const Claim& pairs = find_claim(claims, "contact-placed-pairs");
  EXPECT_EQ(pairs.paper_value, ">= 95 %");
  EXPECT_EQ(pairs.measured, "400 of 400, 100.0 %");
  expect_words(claims, "contact-moving-pairs", "<= 1 depths", "0 depths", "in 200 looks");
  expect_words(claims, "contact-depth", "<= 1 depths", "0.8 depths", "in 200 looks");
  expect_words(claims, "contact-energy", "<= 0.005", "0.0001", "in 200 looks");
  expect_words(claims, "contact-momentum", "<= 1e-12", "1e-15", "in 200 looks");
  expect_words(claims, "contact-hertz", "<= 0.1", "0.05", "the worst of 2 cases");
  expect_words(claims, "contact-restitution", "<= 0.02", "0.001", "in 3 runs");
  expect_words(claims, "contact-pushes", "<= 1e-09", "0", "in 3 runs");
  expect_words(claims, "contact-stack-rests", "<= 1e-10", "2e-12", "in 100 steps");
  expect_words(claims, "contact-stack-still", "<= 1e-06 cell edges", "1e-08 cell edges", "in 100 steps");
  expect_words(claims, "contact-drawn-pulls", "<= 1e-09", "1e-13", "in 6 drawn scenes");
  expect_words(claims, "contact-drawn-silence", "<= 0", "0", "in 6 drawn scenes");
  expect_words(claims, "contact-pressed-operations", "<= 1 of each limit", "0.4 of each limit",
               "in 100 operations, 20 of them removals");
}

TEST(ContactClaims, FallShortOfTheOneThingThatIsWrong) {
  EXPECT_EQ(short_with([](auto& r) { r.bounces[0].found = 0.521; }), Ids{"contact-restitution"});
  EXPECT_EQ(short_with([](auto& r) { r.bounces[0].ended = false; }), Ids{"contact-restitution"});
  EXPECT_EQ(short_with([](auto& r) { r.bounces[2].pulled = 2e-9; }), Ids{"contact-pushes"});
  EXPECT_EQ(short_with([](auto& r) { r.bounces.clear(); }), (Ids{"contact-restitution", "contact-pushes"}));
  EXPECT_EQ(short_with([](auto& r) { r.placements[0].found.deepest_quiet = 0.76; }), Ids{"contact-placed"});
  EXPECT_EQ(short_with([](auto& r) {
              for (int k = 0; k < 60; ++k) r.placements[1].found.by_depth.add(0.61, false);
            }),
            Ids{"contact-placed-pairs"});
  EXPECT_EQ(short_with([](auto& r) {
              for (int k = 0; k < 60; ++k) r.placements[1].found.by_depth.add(0.59, false);
            }),
            Ids{});
  EXPECT_EQ(short_with([](auto& r) { r.runs[0].by_depth.add(1.1, false); }), Ids{"contact-moving-pairs"});
  EXPECT_EQ(short_with([](auto& r) { r.runs[1].deepest = 0.011; }), Ids{"contact-depth"});
  EXPECT_EQ(short_with([](auto& r) { r.runs[0].energy = 6e-3; }), Ids{"contact-energy"});
  EXPECT_EQ(short_with([](auto& r) { r.runs[0].momentum = 2e-12; }), Ids{"contact-momentum"});
  EXPECT_EQ(short_with([](auto& r) { r.runs[1].angular = 2e-12; }), Ids{"contact-angular-momentum"});
  for (const double force : {8.9, 11.1})
    EXPECT_EQ(short_with([force](auto& r) { r.balls[1].found.force = force; }), Ids{"contact-hertz"});
  EXPECT_EQ(short_with([](auto& r) { r.drawn[0].found.pulled = 2e-9; }), Ids{"contact-drawn-pulls"});
  EXPECT_EQ(short_with([](auto& r) { r.drawn[1].found.pulled = 3e-3; }), Ids{"contact-drawn-pulls-bodies"});
  for (const std::size_t k : {2u, 3u})
    EXPECT_EQ(short_with([k](auto& r) { r.drawn[k].found.caught = 2e-6; }), Ids{"contact-drawn-seams"});
  EXPECT_EQ(short_with([](auto& r) { r.drawn[4].found.warned = false; }), Ids{"contact-drawn-silence"});
  EXPECT_EQ(short_with([](auto& r) { r.stack->kinetic = 6e-11; }), Ids{"contact-stack-rests"});
  EXPECT_EQ(short_with([](auto& r) { r.stack->moved = 1.1e-6; }), Ids{"contact-stack-still"});
  const std::function<void(PressedOperations&)> wrong[]{[](auto& p) { p.strangers = 1; },
                                                        [](auto& p) { p.invalid = 1; },
                                                        [](auto& p) { p.elastic = 1.1e-14; },
                                                        [](auto& p) { p.sums = 1.1e-14; },
                                                        [](auto& p) { p.contact = 1.1e-14; },
                                                        [](auto& p) { p.across = 1e-30; },
                                                        [](auto& p) { p.energy = 0.051; },
                                                        [](auto& p) { p.momentum = 1.1e-14; },
                                                        [](auto& p) { p.angular = 1.1e-14; },
                                                        [](auto& p) { p.by_depth.add(0.76, true); },
                                                        [](auto& p) { p.by_depth.add(0.76, false); }};
  for (const auto& spoil : wrong)
    EXPECT_EQ(short_with([&spoil](auto& r) { spoil(*r.operations); }), Ids{"contact-pressed-operations"});
  EXPECT_EQ(short_with([](auto& r) { r.operations->of_neighbours.add(2.0, true); }), Ids{});
}

TEST(ContactClaims, FallShortOfWhatWasNotLookedAtOrIsNoNumber) {
  EXPECT_EQ(short_with([](auto& r) { r.drawn.clear(); }),
            (Ids{"contact-drawn-pulls", "contact-drawn-pulls-bodies", "contact-drawn-seams", "contact-drawn-silence"}));
  EXPECT_EQ(short_with([](auto& r) { r.drawn[1].found.touched = false; }), Ids{"contact-drawn-pulls-bodies"});
  EXPECT_EQ(short_with([](auto& r) { r.placements.clear(); }), Ids{"contact-placed"});
  EXPECT_EQ(short_with([](auto& r) { r.placements[0].found.overlapping = 0; }), Ids{"contact-placed"});
  EXPECT_EQ(short_with([](auto& r) { r.runs.clear(); }), moving);
  EXPECT_EQ(short_with([](auto& r) { r.runs[0].ended = false; }), moving);
  EXPECT_EQ(short_with([](auto& r) { r.runs[0].contacts = 0; }), moving);
  const std::function<void(ContactResults&)> without_ball[]{
      [](auto& r) { r.balls.clear(); }, [](auto& r) { r.balls[0].found.ended = false; },
      [](auto& r) { r.balls[0].found.moved = 2e-3; }, [](auto& r) { r.balls[0].ball.across = 5; }};
  for (const auto& spoil : without_ball) EXPECT_EQ(short_with(spoil), Ids{"contact-hertz"});
  const Ids stack{"contact-stack-rests", "contact-stack-still"};
  EXPECT_EQ(short_with([](auto& r) { r.stack.reset(); }), stack);
  EXPECT_EQ(short_with([](auto& r) { r.stack->ended = false; }), stack);
  EXPECT_EQ(short_with([](auto& r) { r.stack->drop = 0.0; }), stack);
  const std::function<void(ContactResults&)> without_operations[]{
      [](auto& r) { r.operations.reset(); }, [](auto& r) { r.operations->ended = false; },
      [](auto& r) { r.operations->contacts = 0; }, [](auto& r) { r.operations->by_depth = {}; },
      [](auto& r) { r.operations->sums = std::numeric_limits<double>::quiet_NaN(); }};
  for (const auto& spoil : without_operations) EXPECT_EQ(short_with(spoil), Ids{"contact-pressed-operations"});
  EXPECT_EQ(short_with([](auto& r) { r.runs[0].energy = std::numeric_limits<double>::quiet_NaN(); }),
            Ids{"contact-energy"});
}

TEST(ContactClaims, FallShortOfMomentaWhereSomethingActsOnEveryBody) {
  EXPECT_EQ(short_with([](auto& r) { r.runs[0].alone = false; }), Ids{});
  EXPECT_EQ(short_with([](auto& r) { r.runs[0].alone = r.runs[1].alone = false; }),
            (Ids{"contact-momentum", "contact-angular-momentum"}));
}

TEST(ContactTables, SayNothingOfMomentaWhereSomethingActs) {
  ContactResults r = good_results();
  r.runs[1].alone = false;
  EXPECT_EQ(runs_table(r.runs).rows()[1],
            (std::vector<std::string>{"other", "100", "20", "1", "0", "0.008", "0.01", "1.0e-04", "", ""}));
}

TEST(ContactTables, HaveARowForEachPairOfBodiesClassOfDepthAndScene) {
  const ContactResults r = good_results();
  EXPECT_EQ(placements_table(r).rows().size(), 2u);
  EXPECT_EQ(placements_table(r).rows()[0],
            (std::vector<std::string>{"boxes", "100", "90", "2", "0.2", "201", "1", "0.1"}));
  const Table depths = depths_table(r);
  ASSERT_EQ(depths.rows().size(), 10u);
  EXPECT_EQ(depths.rows()[0], (std::vector<std::string>{"0.0 to 0.2", "2", "2", "100 %"}));
  EXPECT_EQ(depths.rows()[3], (std::vector<std::string>{"0.6 to 0.8", "400", "0", "0 %"}));
  EXPECT_EQ(depths.rows()[9], (std::vector<std::string>{"1.8 and more", "0", "0", ""}));
  EXPECT_EQ(runs_table(r.runs).rows()[1], (std::vector<std::string>{"other", "100", "20", "1", "0", "0.008", "0.01",
                                                                    "1.0e-04", "1.0e-15", "1.0e-15"}));
}

TEST(ContactTables, HaveARowForEachBallAndTwoForTheStack) {
  const Table table = carried_table(good_results());
  ASSERT_EQ(table.rows().size(), 4u);
  EXPECT_EQ(table.rows()[0], (std::vector<std::string>{"ball in hexahedra, 6 faces to the edge of the contact, p = 3",
                                                       "force [N]", "10.5", "10", "+5.0 %", "10 %"}));
  EXPECT_EQ(table.rows()[2],
            (std::vector<std::string>{"stack of 5 boxes, 100 steps", "kinetic energy over that of the drop", "2.0e-12",
                                      "0", "", "1e-10"}));
}

TEST(ContactTables, HaveTheFiguresOfOperationsAndWhatIsNearTips) {
  const Table table = operations_table(*good_results().operations);
  ASSERT_EQ(table.rows().size(), 16u);
  EXPECT_EQ(table.rows()[6], (std::vector<std::string>{"energy over steps, of the largest", "0.01", "0.05"}));
  EXPECT_EQ(table.rows()[12], (std::vector<std::string>{"unfelt", "50 %", ""}));
  EXPECT_EQ(table.rows()[14],
            (std::vector<std::string>{"pairs within two rings of a crack's tip, of all that overlap", "33.3 %", ""}));
  EXPECT_EQ(table.rows()[15], (std::vector<std::string>{"deepest of these", "0.2", ""}));
}

TEST(ContactTables, HaveARowForEachKindOfDrawnScenes) {
  const Table table = drawn_table(good_results().drawn);
  ASSERT_EQ(table.rows().size(), 6u);
  using Row = std::vector<std::string>;
  EXPECT_EQ(table.rows()[0], (Row{"leaves, obstacles", "1", "1", "1", "1.0e-13", "", "", ""}));
  EXPECT_EQ(table.rows()[3], (Row{"slides, bodies", "1", "1", "1", "", "1.0e-09", "", ""}));
  EXPECT_EQ(table.rows()[4], (Row{"drops, obstacles", "1", "1", "1", "", "", "1", "0"}));
}

/// Answers in the name of ipctk that are of the right form, and wrong: surfaces cross everywhere.
std::string wrong_answers_to(const std::string& questions) {
  nlohmann::json all = nlohmann::json::object();
  const nlohmann::json asked = nlohmann::json::parse(questions);
  for (const auto& question : asked.at("questions")) {
    const auto& places = question.at("places");
    nlohmann::json squares = nlohmann::json::array(), answer = nlohmann::json::object();
    for (const auto& place : places) squares.push_back(std::vector<double>(place.at("samples").size(), 1.0));
    answer["crossing"] = std::vector<bool>(places.size(), true);
    answer["squares"] = squares;
    answer["free"] = std::vector<bool>(question.at("in_motion").get<bool>() ? places.size() - 1 : 0, false);
    all["answers"].push_back(answer);
  }
  return all.dump();
}

TEST(ContactStudy, HoldsButWhereIpctkSaysOtherwise) {
  StudyLog log;
  const Report report = contact_study({.placements = 80,
                                       .looks = 6,
                                       .seed = 2,
                                       .operations = 60,
                                       .drawn = 12,
                                       .every_integrator = false,
                                       .one_ball = true,
                                       .ipctk = wrong_answers_to,
                                       .ipctk_version = "0.1",
                                       .certified = 20,
                                       .shots = 3},
                                      log);
  EXPECT_EQ(ids_of(report.claims, Verdict::holds).size(), 17u);
  EXPECT_EQ(ids_of(report.claims, Verdict::falls_short),
            (Ids{"contact-ipctk-depths", "contact-ipctk-crossings", "contact-ipctk-steps"}));
  EXPECT_EQ(exit_code(report), 1);
  ASSERT_EQ(report.tables.size(), 9u);
  EXPECT_EQ(report.tables[7].name, "ipctk");
  ASSERT_EQ(report.tables[7].table.rows().size(), 4u);
  EXPECT_EQ(report.tables[7].table.rows()[0][1], "5");
  EXPECT_EQ(report.tables[8].table.rows()[0][1], "1");
  EXPECT_EQ(report.facts.at("ipctk"), "0.1");
}

TEST(ContactStudy, EndsAtOnceWhereIpctkAnswersNothing) {
  StudyLog log;
  const ContactStudyPlan plan{.ipctk = [](const std::string&) { return "{}"; }, .certified = 4, .shots = 1};
  EXPECT_THROW(contact_study(plan, log), IoError);
}

}  // namespace
}  // namespace dartboard::contact_report_test
