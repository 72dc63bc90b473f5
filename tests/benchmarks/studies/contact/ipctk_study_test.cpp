// The conclusions on contact from answers of ipctk: with one wrong answer, the claim about it falls short.

#include "benchmarks/studies/contact/ipctk_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "tests/support/claims_for_tests.h"

namespace dartboard::ipctk_study_test {
namespace {

using Ids = std::vector<std::string>;

IpctkResults good_results() {
  IpctkResults r;
  r.placements = {
      {.bodies = "boxes",
       .placements = 90,
       .crossing = 60,
       .quiet = 3,
       .deepest_quiet = 0.2,
       .contacts = 200,
       .shallow = 150,
       .longer = 2,
       .apart = 1e-16,
       .longest = 1.5},
      {.bodies = "balls", .placements = 90, .crossing = 50, .contacts = 100, .shallow = 100, .apart = 2e-16}};
  r.shots = {.shots = 30, .slow = 10, .fast = 20, .hits = 10, .at_once = 9, .passes = 5};
  return r;
}
/// The claims that fall short when one thing differs from `good_results`.
Ids short_with(const std::function<void(IpctkResults&)>& spoil) {
  IpctkResults r = good_results();
  spoil(r);
  return ids_of(claims_of(r), Verdict::falls_short);
}
const Ids depths{"contact-ipctk-depths"}, crossings{"contact-ipctk-crossings"}, steps{"contact-ipctk-steps"};

TEST(IpctkClaims, HoldWhenEverythingIsAsPromised) {
  const std::vector<Claim> claims = claims_of(good_results());
  EXPECT_EQ(ids_of(claims, Verdict::holds), (Ids{depths[0], crossings[0], steps[0]}));
  expect_words(claims, depths[0], "<= 8.9e-15 of the size", "2.0e-16",
               "250 contacts nearer to it than the width of a cell");
  expect_words(claims, crossings[0], "<= 0.75 altitudes", "0.2 altitudes", "in 110 of 180 placements they cross");
  expect_words(claims, steps[0], "0 otherwise", "0 otherwise", "of 30 shots, 10 of them slow; 5 fast ones pass unfelt");
}

TEST(IpctkClaims, FallShortOfDepthsWhereOneIsWrongOrNoNumber) {
  EXPECT_EQ(short_with([](auto& r) { r.placements[1].apart = 4e-15; }), Ids{});
  EXPECT_EQ(short_with([](auto& r) { r.placements[1].apart = 3e-14; }), depths);
  EXPECT_EQ(short_with([](auto& r) { r.placements[0].apart = NAN; }), depths);
}

TEST(IpctkClaims, FallShortOfDepthsWhereNoneIsCompared) {
  EXPECT_EQ(short_with([](auto& r) { r.placements[0].shallow = 0; }), Ids{});
  EXPECT_EQ(short_with([](auto& r) { r.placements[0].shallow = r.placements[1].shallow = 0; }), depths);
  EXPECT_EQ(short_with([](auto& r) { r.placements.clear(); }), (Ids{depths[0], crossings[0]}));
}

TEST(IpctkClaims, FallShortOfCrossingsWhereADeepOneIsNotFelt) {
  EXPECT_EQ(short_with([](auto& r) { r.placements[0].deepest_quiet = 0.7; }), Ids{});
  EXPECT_EQ(short_with([](auto& r) { r.placements[0].deepest_quiet = 0.8; }), crossings);
  EXPECT_EQ(short_with([](auto& r) { r.placements[0].deepest_quiet = NAN; }), crossings);
}

TEST(IpctkClaims, FallShortOfCrossingsWhereNoneIsFelt) {
  EXPECT_EQ(short_with([](auto& r) { r.placements[1].false_felt = 1; }), crossings);
  EXPECT_EQ(short_with([](auto& r) { r.placements[1].disputed = 1; }), crossings);
}

TEST(IpctkClaims, FallShortOfCrossingsWhereOneAnswerNeverOccurs) {
  EXPECT_EQ(short_with([](auto& r) { r.placements[0].crossing = r.placements[1].crossing = 0; }), crossings);
  EXPECT_EQ(short_with([](auto& r) { r.placements[0].crossing = r.placements[1].crossing = 90; }), crossings);
}

TEST(IpctkClaims, FallShortOfStepsWhereOneShotIsOtherwise) {
  EXPECT_EQ(short_with([](auto& r) { r.shots.early = 1; }), steps);
  EXPECT_EQ(short_with([](auto& r) { r.shots.late = 1; }), steps);
  EXPECT_EQ(short_with([](auto& r) { r.shots.false_warnings = 1; }), steps);
  EXPECT_EQ(short_with([](auto& r) { r.shots.silent = 1; }), steps);
}

TEST(IpctkClaims, FallShortOfStepsWhereSlowShotsMissOrNothingPasses) {
  EXPECT_EQ(short_with([](auto& r) { r.shots.hits = 9; }), steps);
  EXPECT_EQ(short_with([](auto& r) { r.shots.hits = r.shots.slow = 0; }), steps);
  EXPECT_EQ(short_with([](auto& r) { r.shots.passes = 0; }), steps);
}

TEST(IpctkTables, HaveARowForEachPairOfBodiesAndEachFigureOfTheShots) {
  const IpctkResults r = good_results();
  ASSERT_EQ(ipctk_table(r).rows().size(), 2u);
  EXPECT_EQ(ipctk_table(r).rows()[0], (Ids{"boxes", "90", "60", "3", "0.2", "200", "1.0e-16", "150", "2", "1.5"}));
  const Table shots = ipctk_shots_table(r.shots);
  ASSERT_EQ(shots.rows().size(), 10u);
  EXPECT_EQ(shots.rows()[1], (Ids{"slow, and a step collides", "10", "10"}));
  EXPECT_EQ(shots.rows()[3], (Ids{"of these, felt after the next", "1", ""}));
  EXPECT_EQ(shots.rows()[7], (Ids{"fast, and unfelt after two steps", "5", "> 0"}));
}

/// Answers of one that agrees, but for squares of distances, which are this times those of the depths.
AskIpctk agreeing_with(const IpctkPlacements& placed, double factor = 1.0) {
  return [&placed, factor](const std::string&) {
    std::vector<bool> crossing;
    std::vector<std::vector<double>> squares;
    for (const double depth : placed.overlap) crossing.push_back(depth > 0.0);
    for (const IpctkPlace& place : placed.question.places) {
      squares.emplace_back();
      for (const IpctkSample& s : place.samples) squares.back().push_back(factor * s.depth * s.depth);
    }
    nlohmann::json answer = nlohmann::json::object(), all = nlohmann::json::object();
    answer["crossing"] = crossing;
    answer["squares"] = squares;
    answer["free"] = nlohmann::json::array();
    all["answers"].push_back(answer);
    return all.dump();
  };
}
IpctkPlacements placed_boxes(const std::function<bool(std::size_t)>& loses = {}) {
  const Mesh box = kuhn_box(1, 1, 1, 0.5);
  return ipctk_placements("boxes", box, box, {.placements = 400, .seed = 1, .loses = loses});
}

TEST(IpctkStudy, FallsShortWhereADepthIsWrong) {
  const IpctkPlacements placed = placed_boxes();
  const auto with = [&placed](double factor) {
    return short_with([&](IpctkResults& r) { r.placements = {certified(placed, agreeing_with(placed, factor))}; });
  };
  EXPECT_EQ(with(1.0), Ids{});
  EXPECT_EQ(with(1.0 + 1e-12), depths);
  EXPECT_EQ(with(1.0 - 1e-12), depths);
}

TEST(IpctkStudy, FallsShortWhereDeepContactsAreLost) {
  const IpctkPlacements placed = placed_boxes();
  const auto deepest = static_cast<std::size_t>(std::ranges::max_element(placed.overlap) - placed.overlap.begin());
  ASSERT_GT(placed.overlap[deepest], 0.75);
  const IpctkPlacements lost = placed_boxes([deepest](std::size_t k) { return k == deepest; });
  EXPECT_EQ(short_with([&](IpctkResults& r) { r.placements = {certified(lost, agreeing_with(lost))}; }), crossings);
}

TEST(IpctkStudy, RefusesAnswersThatAreMissing) {
  const Mesh box = kuhn_box(1, 1, 1, 0.5);
  const IpctkPlacements placed = ipctk_placements("boxes", box, box, {.placements = 2, .seed = 1});
  EXPECT_THROW(certified(placed, [](const std::string&) { return "{}"; }), IoError);
  EXPECT_THROW(certified(ipctk_shots(1, 1), [](const std::string&) { return ""; }), IoError);
}

}  // namespace
}  // namespace dartboard::ipctk_study_test
