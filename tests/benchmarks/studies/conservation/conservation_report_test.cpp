// The report of `validate conservation` on a body: every figure in its own place.

#include "benchmarks/studies/conservation/conservation_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/tables_for_tests.h"

namespace dartboard::conservation_report_test {
namespace {

using Json = nlohmann::ordered_json;

ConservedRow row(const std::string& what, std::size_t checks, std::optional<double> bound, double deviation,
                 double largest, bool holds = true) {
  return {what, checks, bound, deviation, largest, holds};
}

TakenApart body() {
  TakenApart b{"box", "general", 31, 32, 0.015625, {}, 33.0};
  b.result.dissociations = 1;
  b.result.tears = 20;
  b.result.removals = 300;
  b.result.refinements = 4000;
  b.result.parts_split_off = 41;
  b.result.series = 42;
  b.result.steps = 43;
  b.result.refills = 44;
  b.result.whole_comparisons = 9;
  b.result.bodies_from_scratch = 45;
  b.result.rows = {row("mass", 51, 0.5, 0.25, 0.375)};
  return b;
}

TakenApart broken_body() {
  TakenApart b = body();
  b.result.bodies_without_bound = 46;
  b.result.violation = Violation{"momentum", 61, 62, "1", "2", "3"};
  return b;
}

TEST(ConservationTable, SaysOfEachQuantityHowCloseItCameToItsBound) {
  ConservationResult result;
  result.rows = {row("mass", 51, 0.5, 0.25, 0.375),
                 row("cells", 52, std::nullopt, 0.0, 0.0),
                 row("kept by rounding", 53, 0.0, 0.0, 0.0),
                 row("never asked", 0, 0.5, 0.0, 0.0),
                 row("bits", 54, std::nullopt, 0.0, 0.25, false),
                 row("momentum", 55, 0.5, 0.75, 0.75, false)};
  const Table table = table_of(result);
  EXPECT_EQ(alignment(table), "lrrrl");
  ASSERT_EQ(table.rows().size(), 6u);
  EXPECT_EQ(labelled(table, 0),
            (Row{"quantity: mass", "checks: 51", "largest deviation: 3.75e-01", "bound: 5.00e-01", "holds: yes"}));
  EXPECT_EQ(table.rows()[1], (Row{"cells", "52", "0", "exact", "yes"}));
  EXPECT_EQ(table.rows()[2], (Row{"kept by rounding", "53", "0", "exact", "yes"}));
  EXPECT_EQ(table.rows()[3], (Row{"never asked", "0", "0", "5.00e-01", "not met"}));
  EXPECT_EQ(table.rows()[4], (Row{"bits", "54", "-", "exact", "NO"}));  // bits that differ have no distance
  EXPECT_EQ(table.rows()[5], (Row{"momentum", "55", "7.50e-01", "5.00e-01", "NO"}));
}

TEST(ConservationText, TellsWhatWasDoneToTheBody) {
  EXPECT_EQ(
      to_text(body(), "again"),
      "box, general storage, 31 cells, seed 32, h = 0.0156 s\n"
      "4321 operations (1 dissociations, 20 torn fans, 300 removals, 4000 refinements) in 42 series, 43 steps "
      "between; 41 parts split off; the body was emptied and refilled 44 times\n"
      "compared after each series: sums, and all that it changed, the views' ends of springs included; everything, "
      "all views against rebuilt ones included: 9 times\n"
      "33 operations per second, checks and steps included; 45 bodies built from scratch\n\n" +
          to_text(table_of(body().result)) + "\n");
}

TEST(ConservationText, NamesTheViolationAndTheCommandThatRepeatsIt) {
  const std::string text = to_text(broken_body(), "dartboard again");
  EXPECT_NE(text.find("45 bodies built from scratch, for 46 of which the bound of motion says nothing\n\n"),
            std::string::npos);
  EXPECT_TRUE(
      text.ends_with("box, general storage: after operation 61 of seed 62: momentum: 1, expected 2 (bound: "
                     "3)\nRepeat it with: dartboard again\n\n"))
      << text;
}

TEST(ConservationVerdict, HoldsWhereEveryRowDoesAndNothingIsViolated) {
  EXPECT_TRUE(body().holds());
  EXPECT_FALSE(broken_body().holds());
  TakenApart one_row = body();
  one_row.result.rows.push_back(row("momentum", 1, 0.5, 0.75, 0.75, false));
  EXPECT_FALSE(one_row.holds());
}

Json expected() {
  return Json::parse(R"({"mesh": "box", "storage": "general", "cells": 31, "seed": 32, "h": 0.015625, "holds": true,
    "operations": 4321, "whole_comparisons": 9, "dissociations": 1, "tears": 20, "removals": 300, "refinements": 4000,
    "parts_split_off": 41, "series": 42, "steps": 43, "refills": 44, "bodies_from_scratch": 45, "bodies_without_bound": 0,
    "operations_per_s": 33.0,
    "quantities": [{"what": "mass", "checks": 51, "largest_deviation": 0.375, "holds": true, "exact": false,
      "deviation": 0.25, "bound": 0.5}]})");
}

TEST(ConservationJson, HoldsEveryFigureOfABody) { EXPECT_EQ(to_json(body()), expected()); }

TEST(ConservationJson, HoldsTheViolation) {
  Json json = expected();
  json["holds"] = false;
  json["bodies_without_bound"] = 46;
  json["violation"] =
      Json::parse(R"({"what": "momentum", "operation": 61, "seed": 62, "actual": "1", "expected": "2", "bound": "3"})");
  EXPECT_EQ(to_json(broken_body()), json);
}

TEST(ConservationJson, CallsExactWhatHasNoBoundOrNone) {
  TakenApart b = body();
  b.result.rows = {row("cells", 1, std::nullopt, 0.0, 0.0), row("sum", 2, 0.0, 0.0, 0.0)};
  EXPECT_EQ(to_json(b).at("quantities"), Json::parse(R"([
    {"what": "cells", "checks": 1, "largest_deviation": 0.0, "holds": true, "exact": true},
    {"what": "sum", "checks": 2, "largest_deviation": 0.0, "holds": true, "exact": true, "deviation": 0.0,
     "bound": 0.0}])"));
}

}  // namespace
}  // namespace dartboard::conservation_report_test
