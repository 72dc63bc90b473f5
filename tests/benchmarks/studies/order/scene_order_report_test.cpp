// The report of `validate order SCENE`: verdicts, tables and the study itself on a small scene.

#include "benchmarks/studies/order/scene_order_report.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "benchmarks/studies/order/order_study.h"
#include "core/plain/error.h"
#include "tests/support/claims_for_tests.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/tables_for_tests.h"

namespace dartboard::scene_order_report_test {
namespace {

SceneOrder order(const char* integrator, OrderAnswer answer, const char* reason = "") {
  SceneOrder made{.study = {integrator, OrderCase::undamped, 2, {}, answer == OrderAnswer::shown, 2.0625, 3.0, reason},
                  .answer = answer};
  OrderPoint first, second;
  first.h_omega = 0.5;
  second.h_omega = 0.25;
  second.p_x = 2.25;
  second.p_v = 2.5;
  second.has_order = true;
  second.regime = Regime::asymptotic;
  made.study.points = {first, second};
  return made;
}

std::vector<SceneOrders> scenes() {
  SceneReference certified;
  certified.kind = ReferenceKind::certified;
  certified.floor = 3e-14;
  certified.cpu_s = 1.25;
  certified.what = "by two codes";
  return {{.name = "bar",
           .reference = certified,
           .orders = {order("verlet", OrderAnswer::shown), order("rk4", OrderAnswer::shown)}}};
}

TEST(SceneOrderClaims, HoldWhereAllOrdersAreShown) {
  const std::vector<Claim> claims = claims_of(scenes());
  ASSERT_EQ(claims.size(), 1u);
  EXPECT_EQ(claims[0].verdict, Verdict::holds);
  expect_words(claims, "order-on-bar", "three successive halvings within 0.1", "2 of 2 integrators, farthest 0.062",
               "reference: by two codes");
}

TEST(SceneOrderClaims, FallShortWhereOneIsMissed) {
  auto with = scenes();
  with[0].orders.push_back(order("ros2", OrderAnswer::open, "too slow"));
  with[0].orders.push_back(order("bdf2", OrderAnswer::missed, "order 1.00 in x"));
  const std::vector<Claim> claims = claims_of(with);
  EXPECT_EQ(claims[0].verdict, Verdict::falls_short);
  EXPECT_EQ(claims[0].reason, "ros2: too slow; bdf2: order 1.00 in x");
  EXPECT_TRUE(claims[0].measured.starts_with("2 of 4 integrators")) << claims[0].measured;
  EXPECT_EQ(exit_code(claims), 1);
}

TEST(SceneOrderClaims, AreUndecidedWhereTheMotionLeavesOneOpen) {
  auto with = scenes();
  with[0].orders[1] = order("rk4", OrderAnswer::open, "too slow");
  const std::vector<Claim> claims = claims_of(with);
  EXPECT_EQ(claims[0].verdict, Verdict::undecided);
  EXPECT_EQ(claims[0].reason, "rk4: too slow");
  EXPECT_EQ(exit_code(claims), 0);
}

TEST(SceneOrderClaims, SayWhatContactLeavesOfTheOrders) {
  auto with = scenes();
  with[0].limit = {1.5, "speed that is lost, with exponent 3"};
  const std::vector<Claim> claims = claims_of(with);
  EXPECT_EQ(claims[0].verdict, Verdict::holds);
  EXPECT_EQ(
      claims[0].text,
      "every integrator shows its order on bar, in x and in v; order 1.5 at most through speed that is lost, with "
      "exponent 3");
  expect_words(claims, "order-on-bar", "five errors or more fall with it, or faster, within 0.3", "2 of 2 integrators",
               "reference: by two codes");
  EXPECT_EQ(to_json(with, claims)["references"][0]["limit"]["most"], 1.5);
}

TEST(SceneOrderClaims, AreUndecidedWhereContactPromisesNone) {
  auto with = scenes();
  with[0].limit = {0.0, "bodies, whose nearest face changes"};
  for (SceneOrder& one : with[0].orders) one = order("verlet", OrderAnswer::open, "order 1.00 in x");
  const std::vector<Claim> claims = claims_of(with);
  EXPECT_EQ(claims[0].verdict, Verdict::undecided);
  EXPECT_EQ(
      claims[0].reason,
      "no order is promised through bodies, whose nearest face changes; verlet: order 1.00 in x; verlet: order 1.00 "
      "in x");
}

TEST(SceneOrderClaims, AreNotTestedWithoutAReference) {
  const std::vector<SceneOrders> without{{.name = "two bars", .reference = {}, .failure = "it diverges"}};
  const std::vector<Claim> claims = claims_of(without);
  EXPECT_EQ(claims[0].verdict, Verdict::not_tested);
  EXPECT_EQ(claims[0].id, "order-on-two-bars");
  EXPECT_EQ(claims[0].reason, "it diverges");
  EXPECT_EQ(scene_reference_table(without).rows()[0], (Row{"two bars", "-", "-", "it diverges"}));
}

TEST(SceneOrderTables, HaveTheReferenceAndEachOrderWithItsAnswer) {
  auto with = scenes();
  with[0].orders[1] = order("rk4", OrderAnswer::missed, "order 1.00 in x");
  const Table table = scene_order_table(with);
  EXPECT_EQ(alignment(table), "llrrlll");
  EXPECT_EQ(labelled(table, 0), (Row{"scene: bar", "integrator: verlet", "theory: 2", "h omega: 0.5 .. 0.25",
                                     "p in x, by halving: 2.25 ", "p in v: 2.50 ", "order: shown"}));
  EXPECT_EQ(table.rows()[1].back(), "MISSED: order 1.00 in x");
  const Table references = scene_reference_table(with);
  EXPECT_EQ(alignment(references), "lrrl");
  EXPECT_EQ(labelled(references, 0),
            (Row{"scene: bar", "floor / edges: 3.0e-14", "CPU s: 1.2", "reference: by two codes"}));
}

class SceneOrderStudy : public FolderTest {};

TEST_F(SceneOrderStudy, AnswersForTheIntegratorsAndScenesAskedFor) {
  StudyLog log;
  const Report report = order_study({.integrators = {"verlet"}, .quick = true, .scenes = {"chain"}}, log);
  ASSERT_EQ(report.claims.size(), 1u);
  EXPECT_EQ(report.claims[0].id, "order-on-chain");
  EXPECT_EQ(report.claims[0].verdict, Verdict::holds) << report.claims[0].reason;
  EXPECT_EQ(report.claims[0].bound_or_interval, "reference: closed form");
  EXPECT_EQ(report.numbers["orders"][0]["answer"], "shown");
}

// The speed of its ends overflows in the reference's own runs; membranes have no other.
TEST_F(SceneOrderStudy, LeavesASceneUntestedWhoseMotionCannotBeFollowed) {
  const std::string file = (folder_ / "fast.json").string();
  std::ofstream(file) << R"({"name": "sheet", "step": 0.001, "duration": 0.5,
    "body": {"generate": {"sheet": {"cells": [3, 2], "spacing": 0.125, "kind": "triangles"}}},
    "material": {"density": 2, "young": 300, "poisson": 0.3},
    "initial_velocity": {"linear": [[1e6, 0, 0], [0, 1e6, 0], [0, 0, 0]]}})";
  StudyLog log;
  const Report report = order_study({.integrators = {"verlet"}, .quick = true, .scenes = {file, "chain"}}, log);
  EXPECT_EQ(ids_of(report.claims, Verdict::not_tested), std::vector<std::string>{"order-on-fast"});
  EXPECT_EQ(ids_of(report.claims, Verdict::holds), std::vector<std::string>{"order-on-chain"});
  EXPECT_TRUE(report.claims[0].reason.starts_with("no reference: ")) << report.claims[0].reason;
}

TEST_F(SceneOrderStudy, RefusesAWrongIntegratorBeforeItMeasures) {
  StudyLog log;
  EXPECT_THROW(order_study({.integrators = {"verlte"}, .scenes = {"chain"}}, log), InputError);
}

}  // namespace
}  // namespace dartboard::scene_order_report_test
