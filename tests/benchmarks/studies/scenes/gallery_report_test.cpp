// The report of `gallery` on a scene: every figure in its own place.

#include "benchmarks/studies/scenes/gallery_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/escape.h"
#include "tests/support/tables_for_tests.h"

namespace dartboard::gallery_report_test {
namespace {

using Json = nlohmann::ordered_json;

ShownScene shown_scene() {
  ShownScene s;
  s.scene.name = "a beam";
  s.scene.about = "it *bends*";
  s.scene.integrator = "rk4";
  s.file = "beam.json";
  s.map = "tetrahedral 3-g-map";
  s.hash = "00000000deadbeef";
  s.steps = 21;
  s.operations = 22;
  s.expected = s.held = 23;
  s.cpu_s = 0.25;
  return s;
}

ShownScene failed_scene() {
  ShownScene s = shown_scene();
  s.held = 20;
  s.divergence = "diverged";
  return s;
}

TEST(GalleryTable, HasARowForEachScene) {
  const Table table = gallery_table({shown_scene(), failed_scene()});
  EXPECT_EQ(alignment(table), "lllrrrll");
  ASSERT_EQ(table.rows().size(), 2u);
  EXPECT_EQ(labelled(table, 0), (Row{"scene: a beam", "map: tetrahedral 3-g-map", "integrator: rk4", "steps: 21",
                                     "operations: 22", "expected: 23 of 23", "hash: 00000000deadbeef", "holds: yes"}));
  EXPECT_EQ(table.rows()[1][5], "20 of 23");
  EXPECT_EQ(table.rows()[1][7], "NO");
}

TEST(GalleryTable, SaysNoWhereAnExpectationFailsOrTheMotionDiverges) {
  ShownScene missed = shown_scene(), diverged = shown_scene();
  missed.held = 22;
  diverged.divergence = "diverged";
  EXPECT_TRUE(shown_scene().holds());
  EXPECT_FALSE(missed.holds());
  EXPECT_FALSE(diverged.holds());
}

TEST(ShownTable, SaysWhatASceneShowsAndWhereExpectedNumbersComeFrom) {
  ShownScene s = shown_scene();
  s.scene.probes = {{"foot", 0u, ""}, {"tip", 1u, ""}};
  s.scene.expect.why = "It weighs what it weighs.";
  s.scene.expect.places = {
      {1, {0, 0, 0}, 0.0, true, "it falls"}, {0, {0, 0, 0}, 0.0, false, ""}, {0, {0, 0, 0}, 0.0, false, "it stays"}};
  EXPECT_EQ(shown_table({s}).rows().at(0),
            (Row{"a beam", "beam.json", "it *bends*",
                 "It weighs what it weighs.\nthe part of tip: it falls\nfoot: it stays"}));
}

TEST(GalleryJson, HoldsEveryFigureOfAScene) {
  EXPECT_EQ(to_json(shown_scene()),
            Json::parse(R"({"scene": "a beam", "map": "tetrahedral 3-g-map", "integrator": "rk4", "steps": 21,
              "operations": 22, "hash": "00000000deadbeef", "expected": 23, "held": 23, "holds": true,
              "divergence": "", "cpu_s": 0.25})"));
  EXPECT_EQ(to_json(failed_scene()),
            Json::parse(R"({"scene": "a beam", "map": "tetrahedral 3-g-map", "integrator": "rk4", "steps": 21,
              "operations": 22, "hash": "00000000deadbeef", "expected": 23, "held": 20, "holds": false,
              "divergence": "diverged", "cpu_s": 0.25})"));
}

}  // namespace
}  // namespace dartboard::gallery_report_test
