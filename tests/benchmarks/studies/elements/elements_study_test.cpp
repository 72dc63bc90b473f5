#include "benchmarks/studies/elements/elements_study.h"

#include <gtest/gtest.h>

namespace dartboard::elements_study_test {
namespace {

/// The results of a sound study, in round numbers.
ElementsResults sound() {
  ElementsResults r;
  const PublishedCantilever published{0.25, 4.0, 2.0, 9.0, 10.0, 15.0};
  r.references = {{published, {.nodes = 100, .work = 4.02, .frequency = {2.0, 2.0, 9.0, 10.0, 10.0, 15.0}}}};
  constexpr CellKind t = CellKind::tetrahedron, h = CellKind::hexahedron;
  r.across = 2;
  r.errors = {{Model::springs, t, 2, 0.25, 99, -0.3, 0.1, 0.2, 0.1},
              {Model::neo_hookean, t, 1, 0.25, 24, -0.7, 0.9, 0.8, 0.1},
              {Model::neo_hookean, t, 2, 0.25, 99, -0.4, 0.3, 0.2, 0.1},
              {Model::neo_hookean, h, 2, 0.25, 99, -0.1, 0.1, 0.1, 0.1},
              {Model::neo_hookean, t, 1, 0.45, 24, -0.8, 0.9, 0.8, 0.1},
              {Model::neo_hookean, t, 2, 0.45, 99, -0.5, 0.4, 0.3, 0.1}};
  r.costs = {{Model::springs, t, 500, 4000.0, 100.0},
             {Model::neo_hookean, t, 400, 16000.0, 200.0, {8.0, {7.5, 8.25, 0.97, true}}},
             {Model::corotational, t, 400, 48000.0, 200.0, {24.0, {23.0, 25.0, 0.97, true}}},
             {Model::neo_hookean, h, 60, 80000.0, 50.0, {10.0, {9.5, 11.0, 0.97, true}}}};
  return r;
}
Verdict verdict(const ElementsResults& results, std::string_view id) {
  for (const Claim& claim : claims_of(results))
    if (claim.id == id) return claim.verdict;
  return Verdict::not_tested;
}

TEST(ElementsStudy, HoldsWhereOurReferenceIsThatOfAnotherCode) {
  ElementsResults r = sound();
  EXPECT_EQ(verdict(r, "elements-reference"), Verdict::holds);
  r.references[0].second.work = 4.05;
  EXPECT_EQ(verdict(r, "elements-reference"), Verdict::falls_short);
  r = sound();
  r.references[0].second.frequency[2] = 8.9;
  EXPECT_EQ(verdict(r, "elements-reference"), Verdict::falls_short);
  r.references.clear();
  EXPECT_EQ(verdict(r, "elements-reference"), Verdict::falls_short);
}

TEST(ElementsStudy, FallsShortWhereAFinerMeshIsNoBetter) {
  EXPECT_EQ(verdict(sound(), "elements-from-below"), Verdict::holds);
  for (const std::size_t k : {2u, 5u}) {
    ElementsResults r = sound();
    r.errors[k].tip = -0.9;
    EXPECT_EQ(verdict(r, "elements-from-below"), Verdict::falls_short) << k;
    r.errors[k].tip = 0.1;
    EXPECT_EQ(verdict(r, "elements-from-below"), Verdict::falls_short) << k;
  }
}

// A second of a body takes 100 / 2 evaluations of 4 us by springs, 200 / 2 of 16 and 48 by tetrahedra.
TEST(ElementsStudy, SaysWhatAModelMissesAndWhatItCosts) {
  EXPECT_DOUBLE_EQ(sound().costs[0].per_second(), 50 * 4e-6);
  EXPECT_EQ(
      in_words(sound()),
      "On 99 nodes springs miss the tip by -30.0 % and torsion by +20.0 %, tetrahedra by -40.0 % and +20.0 %, "
      "hexahedra by -10.0 % and +10.0 %. For the same simulated time neo-hookean tetrahedra take 8.0 (7.5 to 8.2) times "
      "as long as springs, corotational ones 24.0 (23.0 to 25.0) times, neo-hookean hexahedra 10.0 (9.5 to 11.0) times.");
  const Table table = costs_table(sound());
  EXPECT_EQ(table.rows()[0], (std::vector<std::string>{"springs", "500", "8.0", "100", "0.2", "1"}));
  EXPECT_EQ(table.rows()[1], (std::vector<std::string>{"neo-hookean tetrahedra", "400", "40.0", "200", "1.6",
                                                       "8 [7.5, 8.25] at 97.0 %"}));
  EXPECT_EQ(errors_table(sound()).rows()[0],
            (std::vector<std::string>{"springs", "0.25", "2", "99", "-30.0 %", "+10.0 %", "+20.0 %", "+10.0 %"}));
}

}  // namespace
}  // namespace dartboard::elements_study_test
