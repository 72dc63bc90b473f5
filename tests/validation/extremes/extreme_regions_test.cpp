// Bodies of two materials, and the axis of them: what they are made of, and that a wrong step of them is seen.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "validation/extremes/extreme_matrix.h"
#include "validation/judges/judge_trials.h"
#include "validation/scenes/elastic_solid.h"

namespace dartboard::extreme_regions_test {
namespace {

const Material springs = elastic_material(Model::springs);

std::vector<ExtremeMatrix::Row> regions() {
  ExtremeMatrix matrix("regions", false);
  add_regions(matrix);
  return matrix.rows();
}

// A cube has twelve edges and eight Gauss points; four edges belong to both.
TEST(ElasticBody, HasSpringsAndElementsWhereTheirMaterialIs) {
  const SpringColumns both = elastic_body("hexahedra", springs, springs);
  EXPECT_EQ(both.springs.size(), 20u);
  EXPECT_EQ(both.solid, nullptr);
  EXPECT_TRUE(both.terms.empty());
  for (const Model law : {Model::neo_hookean, Model::corotational, Model::stvk}) {
    const SpringColumns mixed = elastic_body("hexahedra", springs, elastic_material(law));
    EXPECT_EQ(mixed.springs.size(), 12u);
    EXPECT_EQ(mixed.solid->points().size(), 8u);
    EXPECT_EQ(mixed.terms.size(), 1u);
    EXPECT_EQ(elastic_body("tetrahedra", springs, elastic_material(law)).solid->points().size(), 6u);
  }
}

TEST(ElasticBody, AddsUpSpringsWhereRegionsMeet) {
  const Material none = elastic_material(Model::stvk), stiff = elastic_material(Model::springs, 0.3, 1e12);
  const SpringColumns one = elastic_body("tetrahedra", springs, none), other = elastic_body("tetrahedra", none, stiff),
                      both = elastic_body("tetrahedra", springs, stiff);
  std::map<SpringEnds, double> sum;
  for (const SpringColumns* body : {&one, &other})
    for (std::size_t s = 0; s < body->springs.size(); ++s) sum[body->ends[s]] += body->springs[s].stiffness;
  EXPECT_LT(sum.size(), one.springs.size() + other.springs.size());
  ASSERT_EQ(sum.size(), both.springs.size());
  for (std::size_t s = 0; s < both.springs.size(); ++s)
    EXPECT_DOUBLE_EQ(both.springs[s].stiffness, sum.at(both.ends[s])) << s;
}

// The volume of each tetrahedron of the layer is in proportion to its thickness.
TEST(ElasticBody, HasALayerThatIsAsThinAsAskedFor) {
  const double thickness = 1e-6;
  const SpringColumns whole = elastic_body("tetrahedra", springs, elastic_material(Model::stvk)),
                      thin = elastic_body("tetrahedra", springs, elastic_material(Model::stvk), thickness);
  const auto volume = [](const SpringColumns& body, std::size_t k) {
    return static_cast<double>(body.solid->points()[k].volume);
  };
  double greatest = 0.0;
  for (std::size_t k = 0; k < 6; ++k) greatest = std::max(greatest, volume(thin, k));
  EXPECT_LT(greatest, thickness);
  EXPECT_GT(greatest, 0.01 * thickness);
  EXPECT_EQ(whole.springs.size(), thin.springs.size());
  EXPECT_DOUBLE_EQ(whole.springs[0].stiffness, thin.springs[0].stiffness);
}

TEST(ExtremeRegions, PairSpringsWithEachLawAndLawsWithEachOther) {
  std::set<std::string> pairs;
  for (const ExtremeMatrix::Row& row : regions()) {
    const SpringColumns body = row.make("tetrahedra").body;
    EXPECT_EQ(body.springs.empty(), !row.value.starts_with("springs")) << row.value;
    EXPECT_EQ(body.solid == nullptr, row.value.starts_with("springs and springs")) << row.value;
    const auto first = row.value.find(' '), second = row.value.find(' ', first + 1);
    pairs.insert(row.value.substr(0, row.value.find_first_of(" ,", second + 1)));
  }
  EXPECT_EQ(pairs, (std::set<std::string>{"springs and springs", "springs and neo-hookean", "springs and corotational",
                                          "springs and stvk", "neo-hookean and corotational", "corotational and stvk",
                                          "stvk and neo-hookean"}));
}

TEST(ExtremeRegions, SquashACellBetweenThemAsTheirValuesName) {
  std::size_t squashed = 0;
  for (const ExtremeMatrix::Row& row : regions()) {
    const auto at = row.value.find("a cell between them ");
    if (at == std::string::npos) continue;
    const SpringColumns body = row.make("tetrahedra").body;
    const Mesh& rest = body.solid->rest();
    const auto corners = rest.cell(6);
    const auto place = [&](std::size_t k) { return body.x[corners[k]]; };
    const double now = (place(1) - place(0)).cross(place(2) - place(0)).dot(place(3) - place(0)) / 6;
    const double share = now / signed_measure(rest, 6);
    if (row.value.find("inverted", at) != std::string::npos)
      EXPECT_NEAR(share, -1.0, 0.1) << row.value;  // besides displacements of a thousandth
    else if (row.value.find("flat", at) != std::string::npos)
      EXPECT_EQ(share, 0.0) << row.value;
    else
      EXPECT_NEAR(share / 1e-12, 1.0, 0.1) << row.value;
    ++squashed;
  }
  EXPECT_EQ(squashed, 6u * 3u);
}

// The term has the materials of the two regions the other way round.
TEST(ExtremeRegions, SeeATermThatConfusesTheRegions) {
  const Material soft = elastic_material(Model::neo_hookean), stiff = elastic_material(Model::stvk, 0.3, 1e4);
  for (const char* scene : {"tetrahedra", "hexahedra"}) {
    ExtremeSetup setup = with_theta(in_motion(elastic_body(scene, soft, stiff), 1e-3), 0.3);
    const auto run = [&] { return run_extreme({"regions", scene, "verlet", "confused", {}}, setup); };
    EXPECT_EQ(run().outcome, ExtremeOutcome::ok) << run().note;
    const SpringColumns confused = elastic_body(scene, stiff, soft);
    setup.body.terms = confused.terms;
    EXPECT_EQ(run().outcome, ExtremeOutcome::silent);
    EXPECT_NE(run().note.find("scheme"), std::string::npos) << run().note;
  }
}

// Of each pair one value, by methods that solve nothing and that do.
TEST(ExtremeRegions, SeeWrongIntegratorsAndNoFaultInSoundOnes) {
  ExtremesTrial trial;
  std::size_t taken = 0;
  for (const ExtremeCase& which : extreme_cases("regions", false)) {
    if (which.scene != "tetrahedra" || !which.value.ends_with(" 100000 times as stiff, h omega 0.3")) continue;
    if (which.integrator != "verlet" && which.integrator != "backward-euler") continue;
    trial.take(which);
    ++taken;
  }
  EXPECT_EQ(taken, 7u * 2u);
  for (const JudgeTrial& one : trial.trials()) {
    EXPECT_EQ(one.right, taken) << static_cast<int>(one.kind);
    EXPECT_EQ(one.seen, one.asked()) << static_cast<int>(one.kind);
    EXPECT_EQ(one.asked() > 0, one.kind != Wrong::loses_damping) << static_cast<int>(one.kind);
  }
}

}  // namespace
}  // namespace dartboard::extreme_regions_test
