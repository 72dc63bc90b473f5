// The verdict of `validate topology` on a mesh: every figure in its own place.

#include "benchmarks/studies/topology/topology_verdict.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/tables_for_tests.h"

namespace dartboard::topology_verdict_test {
namespace {

using Json = nlohmann::ordered_json;

TopologyVerdict verdict() {
  TopologyVerdict v;
  v.name = "box";
  v.darts = 11;
  v.at_rest.carriers = {"ours", "CGAL's"};
  v.at_rest.rows.resize(2);
  v.at_rest.rows[0].what = "darts";
  v.at_rest.rows[0].answers = {"11", ""};
  v.at_rest.rows[0].agrees = true;
  v.at_rest.rows[1].what = "edges";
  v.at_rest.rows[1].answers = {"5", "6"};
  v.at_rest.rows[1].agrees = true;
  v.sessions = {{ScriptStorage::tetrahedral, ScriptOracles::gmap, 21, {}, 2000.0},
                {ScriptStorage::general, ScriptOracles::both, 22, {}, 1000.0}};
  v.sessions[0].result.applied = 100;
  v.sessions[0].result.illegal = 200;
  v.sessions[0].result.not_carried = 300;
  v.sessions[1].result.applied = 1;
  v.sessions[1].result.illegal = 2;
  v.sessions[1].result.not_carried = 3;
  return v;
}

TopologyVerdict disagreeing() {
  TopologyVerdict v = verdict();
  v.at_rest.rows[1].agrees = false;
  v.at_rest.no_cmap = "a fold";
  v.sessions[1].result.disagreement = Disagreement{7, "sew 1 2", "alpha3(d17)", "ours 1", "CGAL 2"};
  v.sessions[1].result.script.mesh = "box";
  v.script_file = "a script.txt";
  return v;
}

TEST(TopologyVerdictTable, HasTheAnswersOfEachCarrierAtRest) {
  const Table table = rest_table(disagreeing().at_rest);
  EXPECT_EQ(alignment(table), "lrrl");
  ASSERT_EQ(table.rows().size(), 2u);
  EXPECT_EQ(labelled(table, 0), (Row{"question: darts", "ours: 11", "CGAL's: -", "agrees: yes"}));
  EXPECT_EQ(table.rows()[1], (Row{"edges", "5", "6", "NO"}));
}

TEST(TopologyVerdictTable, HasARowForEachMesh) {
  const Table table = summary_table({verdict(), disagreeing()});
  EXPECT_EQ(alignment(table), "lrllrrrrl");
  ASSERT_EQ(table.rows().size(), 2u);
  EXPECT_EQ(labelled(table, 0),
            (Row{"mesh: box", "darts: 11", "at rest: 2 of 2", "combinatorial map: yes", "operations: 101",
                 "refused by all: 202", "not carried: 303", "per second: 1000", "agrees: yes"}));
  EXPECT_EQ(table.rows()[1][2], "1 of 2");
  EXPECT_EQ(table.rows()[1][3], "not representable: a fold");
  EXPECT_EQ(table.rows()[1][8], "NO");
}

TEST(TopologyVerdict, AgreesWhereNothingDiffersAtRestOrDuringOperations) {
  EXPECT_TRUE(verdict().agrees());
  TopologyVerdict at_rest = verdict(), later = disagreeing();
  at_rest.at_rest.rows[0].agrees = false;
  later.at_rest = verdict().at_rest;
  EXPECT_FALSE(at_rest.agrees());
  EXPECT_FALSE(later.agrees());
}

TEST(TopologyVerdictText, TellsWhatDiffersAndHowToReplayIt) {
  EXPECT_EQ(disagreements_text(verdict()), "");
  const TopologyVerdict v = disagreeing();
  EXPECT_EQ(disagreements_text(v),
            "box: at rest, edges: 5 | 6\nbox: seed 22, after \"sew 1 2\": alpha3(d17): ours 1; CGAL 2\n" +
                to_string(v.sessions[1].result.script) +
                "Replay it with: dartboard validate topology --replay 'a script.txt'\n");
}

TEST(TopologyVerdictJson, HoldsEveryFigure) {
  EXPECT_EQ(to_json(verdict()), Json::parse(R"({"mesh": "box", "agrees": true, "darts": 11,
    "carriers": ["ours", "CGAL's"],
    "at_rest": [{"what": "darts", "answers": ["11", ""], "agrees": true},
      {"what": "edges", "answers": ["5", "6"], "agrees": true}],
    "sessions": [
      {"storage": "tetrahedral", "oracles": "gmap", "seed": 21, "applied": 100, "illegal": 200, "not_carried": 300,
       "per_second": 2000.0},
      {"storage": "general", "oracles": "both", "seed": 22, "applied": 1, "illegal": 2, "not_carried": 3,
       "per_second": 1000.0}]})"));
  const TopologyVerdict v = disagreeing();
  const Json json = to_json(v);
  EXPECT_EQ(json.at("agrees"), false);
  EXPECT_EQ(json.at("no_combinatorial_map"), "a fold");
  const Json& session = json.at("sessions").at(1);
  EXPECT_EQ(
      session.at("disagreement"),
      (Json{{"operation", 7}, {"line", "sew 1 2"}, {"what", "alpha3(d17)"}, {"ours", "ours 1"}, {"theirs", "CGAL 2"}}));
  EXPECT_EQ(session.at("script"), to_string(v.sessions[1].result.script));
  EXPECT_EQ(session.at("script_file"), "a script.txt");
}

}  // namespace
}  // namespace dartboard::topology_verdict_test
