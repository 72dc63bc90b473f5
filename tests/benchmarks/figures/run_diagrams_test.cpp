#include "benchmarks/figures/run_diagrams.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/folder_for_tests.h"
#include "tests/support/moving_box.h"

namespace dartboard::run_diagrams_test {
namespace {

using moving::Json;
using moving::moving_box;

const RunDiagram* find(const std::vector<RunDiagram>& all, const std::string& title) {
  for (const RunDiagram& one : all)
    if (one.title == title) return &one;
  return nullptr;
}

const RunCurve* find(const RunDiagram& diagram, const std::string& name) {
  for (const RunCurve& one : diagram.curves)
    if (one.name == name) return &one;
  return nullptr;
}

/// The sum of the parts at a time.
double sum_of_parts(const RunDiagram& energy, std::size_t k) {
  double sum = 0.0;
  for (const RunCurve& one : energy.curves)
    if (one.is_part) sum += one.values[k];
  return sum;
}

std::vector<Diagnostics> rows_with_contact() {
  std::vector<Diagnostics> rows(3);
  for (std::size_t k = 0; k < 3; ++k) {
    const double t = static_cast<double>(k);
    Diagnostics& row = rows[k];
    row.time = t;
    row.kinetic = 1.0 + t;
    row.gravitational = 5.0 - 4.0 * t;
    row.applied = -2.0 * t;
    // the 4 t that are supplied, and the 6 t - t of the potentials that are not kinetic, have been rubbed off
    row.contact = ContactDiagnostics{.rubbed = 9.0 * t, .supplied = 4.0 * t, .contacts = k, .deepest = 0.1 * t};
  }
  return rows;
}

TEST(RunDiagrams, PartsOfEnergyAddUpToTheStartAndWhatWasSupplied) {
  const SceneFile scene = moving::parse(moving_box());
  const auto all = diagrams_of(rows_with_contact(), {}, scene, 3);
  ASSERT_EQ(all[0].title, "Energy");
  const RunCurve* account = find(all[0], "start and supplied");
  ASSERT_NE(account, nullptr);
  EXPECT_FALSE(account->is_part);
  // potentials count from their lowest value: gravity's 5 from -3 is 8, that of forces 0 from -4 is 4
  EXPECT_DOUBLE_EQ(account->values[0], 1.0 + 8.0 + 4.0);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_DOUBLE_EQ(sum_of_parts(all[0], k), account->values[k]) << k;
  EXPECT_EQ(find(all[0], "elastic"), nullptr) << "a part that is always 0 is left out";
}

TEST(RunDiagrams, WorkOfDrivenVerticesWithoutContactIsNotKnown) {
  Json scene = moving_box();
  std::vector<Diagnostics> rows(3);
  EXPECT_NE(find(diagrams_of(rows, {}, moving::parse(scene), 3)[0], "start and supplied"), nullptr);
  scene["driven"] = Json::array({{{"ids", {0}}, {"velocity", {0, 0, 1}}}});
  EXPECT_EQ(find(diagrams_of(rows, {}, moving::parse(scene), 3)[0], "start and supplied"), nullptr);
}

TEST(RunDiagrams, HaveContactAndCountsOnlyWhereThereAreSome) {
  const SceneFile scene = moving::parse(moving_box());
  std::vector<Diagnostics> rows = rows_with_contact();
  rows[2].counts.components = 2;
  const auto all = diagrams_of(rows, {}, scene, 3);
  EXPECT_EQ(find(all, "Contacts")->curves[0].values, (std::vector{0.0, 1.0, 2.0}));
  EXPECT_EQ(find(all, "Deepest contact")->unit, "m");
  EXPECT_EQ(find(all, "Components")->curves[0].values, (std::vector{0.0, 0.0, 2.0}));
  EXPECT_EQ(find(all, "Vertices"), nullptr);
  EXPECT_EQ(find(diagrams_of(std::vector<Diagnostics>(3), {}, scene, 3), "Contacts"), nullptr);
}

TEST(RunDiagrams, OfAProbeEndWhereItsVertexIsRemoved) {
  SceneFile scene = moving::parse(moving_box());
  scene.probes = {{.name = "tip", .vertex = 0u, .path = ""}};
  const auto row = [](double time, double z) { return ProbeRow{time, {VertexMotion{{1, 2, z}, {0, 0, 0}}}}; };
  const std::vector<ProbeRow> probes{row(0.0, 3.0), row(0.5, 2.5), {1.0, {std::nullopt}}};
  const auto all = diagrams_of(std::vector<Diagnostics>(3), probes, scene, 3);
  const RunDiagram* tip = find(all, "Displacement of 'tip'");
  ASSERT_NE(tip, nullptr);
  EXPECT_EQ(tip->times, (std::vector{0.0, 0.5, 1.0}));
  EXPECT_EQ(find(*tip, "z")->values[1], -0.5);
  EXPECT_TRUE(std::isnan(find(*tip, "z")->values[2]));
}

TEST(RunDiagrams, ThereIsNothingToDrawBetweenAStartAndAnEnd) {
  RowsOfRun rows;
  for (int k = 0; k < 2; ++k) rows.diagnostics({});
  EXPECT_FALSE(rows.are_curves());
  rows.diagnostics({});
  EXPECT_TRUE(rows.are_curves());
}

using RunDiagramsTest = FolderTest;

TEST_F(RunDiagramsTest, AreDrawnWithoutLeavingWhatTheyAreDrawnFrom) {
  const auto all = diagrams_of(rows_with_contact(), {}, moving::parse(moving_box()), 3);
  ASSERT_EQ(draw_diagrams(all, "a run", folder_, "curves"), "");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "curves.svg"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "curves.dat"));
  EXPECT_NE(draw_diagrams(all, "a run", folder_, "none", "no-such-gnuplot"), "");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "none.dat"));
}

}  // namespace
}  // namespace dartboard::run_diagrams_test
