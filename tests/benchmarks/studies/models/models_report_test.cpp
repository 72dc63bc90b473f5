#include "benchmarks/studies/models/models_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "benchmarks/studies/models/models_study.h"
#include "core/plain/error.h"

namespace dartboard::models_report_test {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

ModelPoint point(const std::string& model, int finer, double poisson, double tip, double cost) {
  ModelPoint p{.timed = {model, finer, poisson, "verlet", 1e-3, 1000}, .measured = {}, .cost = {}};
  MeasuredModel& m = p.measured;
  m.nodes = 24;
  m.errors = {.tip = tip, .frequencies = tip / 2, .confined = 1e-9, .motion = 2 * tip, .worst_frequency = 2};
  m.model_motion = 2 * tip;
  m.allowed = 0.2 * tip;
  m.method = {.integrator = "verlet", .steps = 512, .error = 0.1 * tip, .total_error = 2 * tip};
  if (model.starts_with("springs")) m.errors.confined = poisson < 0.4 ? 0.2 : 0.62;
  p.cost.median = cost;  // [s]: a sample is of one simulated second
  return p;
}

/// Samples of six processes of four rounds, of times that differ by a percent.
void add_samples(ModelsResults& r) {
  r.samples.clear();
  for (int process = 0; process < 6; ++process)
    for (int round = 0; round < 4; ++round)
      for (const ModelPoint& p : r.points)
        r.samples.push_back(
            {.task = p.timed.name(),
             .process = process,
             .round = round,
             .cpu_ns = static_cast<std::int64_t>(1e9 * p.cost.median * (0.99 + 0.02 * (process % 2)) + 0.5),
             .wall_ns = 1,
             .hash = 1});
  for (ModelPoint& p : r.points) p.cost = cost_of(r.samples, p.timed);
}

/// Springs are cheap and coarse, hexahedra win below 12 %, tetrahedra never do.
ModelsResults sound() {
  ModelsResults r{.what = "a bar", .truths = {}, .points = {}, .samples = {}};
  for (const double poisson : {0.25, 0.45}) {
    BarTruth truth{.poisson = poisson, .unsure = {0.01, 0.004, 0.0, 0.01}};
    truth.answers.nodes = 999;
    truth.answers.work = 4e-5;
    truth.answers.frequency = {2, 2, 9, 10, 10, 15};
    r.truths.push_back(truth);
    r.points.push_back(point("springs", 1, poisson, 0.30, 0.001));
    r.points.push_back(point("springs", 2, poisson, 0.09, 0.010));
    r.points.push_back(point("neo-hookean tetrahedra", 1, poisson, 0.40, 0.020));
    r.points.push_back(point("neo-hookean tetrahedra", 2, poisson, 0.20, 0.200));
    r.points.push_back(point("neo-hookean hexahedra", 1, poisson, 0.08, 0.020));
    r.points.push_back(point("neo-hookean hexahedra", 2, poisson, 0.004, 0.100));
  }
  add_samples(r);
  return r;
}
Claim claim(const ModelsResults& results, std::string_view id) {
  for (const Claim& c : claims_of(results))
    if (c.id == id) return c;
  return {};
}

TEST(ModelsReport, HoldsWhereACoarserReferenceSaysTheSame) {
  ModelsResults r = sound();
  EXPECT_EQ(claim(r, "models-reference").verdict, Verdict::holds);
  r.truths[1].unsure.frequencies = 0.03;
  EXPECT_EQ(claim(r, "models-reference").verdict, Verdict::falls_short);
  r.truths[1].unsure.frequencies = NAN;
  EXPECT_EQ(claim(r, "models-reference").verdict, Verdict::falls_short);
  r.truths.clear();
  r.points.clear();
  EXPECT_EQ(claim(r, "models-reference").verdict, Verdict::falls_short);
}

TEST(ModelsReport, FallsShortWhereStepsAddMoreThanATenth) {
  ModelsResults r = sound();
  EXPECT_EQ(claim(r, "models-steps").verdict, Verdict::holds);
  r.points[3].measured.method.error = 1.01 * r.points[3].measured.allowed;
  EXPECT_EQ(claim(r, "models-steps").verdict, Verdict::falls_short);
  r.points[3].measured.method.error = NAN;
  EXPECT_EQ(claim(r, "models-steps").verdict, Verdict::falls_short);
  r.points.clear();
  EXPECT_EQ(claim(r, "models-steps").verdict, Verdict::falls_short);
}

// 10 ms against 20 for a tip within a tenth.
TEST(ModelsReport, WhoIsCheaperIsAFindingAndNoFailure) {
  ModelsResults r = sound();
  EXPECT_EQ(claim(r, "models-springs-coarse").verdict, Verdict::holds);
  EXPECT_EQ(claim(r, "models-springs-coarse").measured, "0.5");
  r.points[1].cost.median = 0.030;
  add_samples(r);
  const Claim slow = claim(r, "models-springs-coarse");
  EXPECT_EQ(slow.verdict, Verdict::does_not_carry_over);
  EXPECT_EQ(slow.measured, "1.5");
  EXPECT_FALSE(slow.surprises());
  EXPECT_EQ(slow.reason, "a finding: neo-hookean hexahedra have that error for 0.667 of the time");
}

// 10 ms for a thousand steps of 1 ms, and 10 ms for two thousand: half the cost.
TEST(ModelsReport, ARatioIsOfSimulatedSeconds) {
  ModelsResults r = sound();
  r.points[0].timed.steps = 2000;
  r.points[0].cost.median = r.points[1].cost.median = 0.010;
  add_samples(r);
  EXPECT_NEAR(r.cost_ratio(r.points[0], r.points[1]).median, 0.5, 1e-9);
  EXPECT_NEAR(r.points[0].cost.median / r.points[1].cost.median, 0.5, 1e-9);
  EXPECT_NEAR(r.cost_ratio(r.points[0], r.points[1]).interval.high, 0.5, 1e-9);
}

TEST(ModelsReport, AModelWithoutAMeshThatIsGoodEnoughLoses) {
  ModelsResults r = sound();
  EXPECT_EQ(claim(r, "models-hexahedra-fine").verdict, Verdict::holds);
  EXPECT_EQ(claim(r, "models-hexahedra-fine").measured, "no springs are that near");
  r.points[1].measured.errors.tip = 0.12;
  EXPECT_EQ(claim(r, "models-springs-coarse").verdict, Verdict::does_not_carry_over);
  for (const std::size_t k : {4u, 5u}) r.points[k].measured.errors.tip = 0.5;
  EXPECT_EQ(claim(r, "models-hexahedra-fine").verdict, Verdict::not_tested);
  EXPECT_EQ(claim(r, "models-springs-coarse").verdict, Verdict::not_tested);
}

// An interval over few processes decides nothing.
TEST(ModelsReport, TimesOfFewProcessesCannotTell) {
  ModelsResults r = sound();
  std::erase_if(r.samples, [](const Sample& s) { return s.process > 2; });
  EXPECT_EQ(claim(r, "models-springs-coarse").verdict, Verdict::undecided);
}

TEST(ModelsReport, SpringsKnowOneRatioAlone) {
  ModelsResults r = sound();
  EXPECT_EQ(claim(r, "models-springs-confined").verdict, Verdict::holds);
  EXPECT_EQ(claim(r, "models-springs-confined").measured, "62.0 %");
  r.points[7].measured.errors.confined = 0.1;
  EXPECT_EQ(claim(r, "models-springs-confined").verdict, Verdict::falls_short);
  std::erase_if(r.points, [](const ModelPoint& p) { return belongs(p, "springs"); });
  EXPECT_EQ(claim(r, "models-springs-confined").verdict, Verdict::falls_short);
}

TEST(ModelsReport, AModelReignsOverTheErrorsThatItIsTheCheapestFor) {
  const auto found = reigns(sound(), Asked::tip, 0.25);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].model, "springs");
  EXPECT_EQ(found[0].below, never);
  EXPECT_EQ(found[0].least, 0.09);
  EXPECT_EQ(found[1].model, "neo-hookean hexahedra");
  EXPECT_EQ(found[1].below, found[0].least);
  EXPECT_EQ(found[1].least, 0.01);  // the resolution of the reference
  EXPECT_EQ(reigns_table(sound()).rows()[0], (std::vector<std::string>{"tip", "0.25", "9.0 % and more", "springs"}));
  EXPECT_EQ(reigns_table(sound()).rows()[1],
            (std::vector<std::string>{"tip", "0.25", "1.0 % to 9.0 %", "neo-hookean hexahedra"}));
}

// Springs of 30 % cost 1 ms, of 9 % 10 ms: the geometric mean of the errors has that of the costs.
TEST(ModelsReport, BetweenTwoMeshesCostIsAPowerOfError) {
  const ModelsResults r = sound();
  const double one = r.points[0].cost.median, ten = r.points[1].cost.median;
  EXPECT_NEAR(cost_for(r, "springs", Asked::tip, 0.25, std::sqrt(0.30 * 0.09)), std::sqrt(one * ten), 1e-9);
  EXPECT_EQ(cost_for(r, "springs", Asked::tip, 0.25, 0.5), one);
  EXPECT_EQ(cost_for(r, "springs", Asked::tip, 0.25, 0.0899), never);
  EXPECT_EQ(r.known_error(r.points[0], Asked::confined), 0.2);
  EXPECT_EQ(r.known_error(r.points[5], Asked::confined), 1e-6);
}

TEST(ModelsReport, NamesTheCrossing) {
  EXPECT_EQ(
      in_words(sound()).substr(0, 128),
      "For the tip at a Poisson's ratio of 0.25 the cheapest are springs down to 9.0 %, neo-hookean hexahedra down to "
      "1.0 %. For the fr");
}

TEST(ModelsReport, HasARowAndALineForEachModelOnEachMesh) {
  const ModelsResults r = sound();
  EXPECT_EQ(points_table(r).rows().size(), r.points.size());
  EXPECT_EQ(points_table(r).rows()[0],
            (std::vector<std::string>{"springs", "0.25", "1", "24", "30.0 %", "15.0 %", "3.", "20.0 %", "60.0 %",
                                      "3.0 %", "verlet, 512 steps", "0.001"}));
  EXPECT_EQ(truths_table(r).rows()[0],
            (std::vector<std::string>{"0.25", "999", "4.0000e-05", "2, 2, 9, 10, 10, 15", "1.0 %", "0.40 %", "1.0 %"}));
  const Panels panels = models_panels(r);
  ASSERT_EQ(panels.panels.size(), 8u);
  EXPECT_EQ(panels.panels[0].title, "tip, Poisson's ratio 0.25");
  ASSERT_EQ(panels.panels[0].series.size(), 4u);  // three models, and the reference's own
  EXPECT_EQ(panels.panels[0].series[0].points.size(), 2u);
  EXPECT_EQ(panels.panels[0].series[0].points[1].y, 0.09);
  EXPECT_EQ(panels.panels[0].series[0].points[1].x, r.points[1].cost.median);
  EXPECT_GT(panels.panels[2].series[1].points[0].y, panels.panels[2].y_low);  // exact, and within the picture
  const auto json = json_of(r);
  EXPECT_EQ(json["points"].size(), 12u);
  EXPECT_TRUE(json["cheapest"][0]["below"].is_null());
}

TEST(ModelsStudy, LooksAtARatioOfItsOwnAndAtOneFarFromIt) {
  EXPECT_EQ(ratios_for(0.25), std::pair(0.25, 0.45));
  EXPECT_EQ(ratios_for(0.0), std::pair(0.0, 0.45));
  EXPECT_EQ(ratios_for(0.48), std::pair(0.25, 0.48));
}

TEST(ModelTimes, APlanIsOneArgument) {
  const ModelTimesPlan plan{.bar = {{6, 2, 1}, 0.1, 3e4, 900.0},
                            .bars = {{"springs", 2, 0.25, "verlet", 1e-3, 40}, {"springs", 3, 0.25, "rk4", 2e-3, 7}},
                            .process = 4,
                            .rounds = 3,
                            .seed = 9};
  const ModelTimesPlan read = from_argument(to_argument(plan));
  EXPECT_EQ(to_argument(read), to_argument(plan));
  EXPECT_EQ(read.bar.cubes, plan.bar.cubes);
  EXPECT_EQ(read.bars[1].integrator, "rk4");
  EXPECT_DOUBLE_EQ(read.bars[1].simulated(), 0.014);
  EXPECT_THROW(from_argument("{}"), InputError);
}

// Each sample starts from the same state: the hashes of all rounds are one.
TEST(ModelTimes, AreOfTheSameStepsInEachRound) {
  ModelTimesPlan plan{.bar = {},
                      .bars = {{"springs", 1, 0.25, "verlet", 1e-3, 20},
                               {"neo-hookean hexahedra", 1, 0.25, "implicit-midpoint", 0.01, 3}},
                      .rounds = 3};
  std::vector<Sample> samples;
  measure_models(plan, [&](const Sample& s) { samples.push_back(s); });
  ASSERT_EQ(samples.size(), 6u);
  EXPECT_NO_THROW(check_repeats(samples));
  EXPECT_NE(hashes_of(samples, plan.bars[0].name()), hashes_of(samples, plan.bars[1].name()));
  plan.bars[0].steps = 21;
  std::vector<Sample> other;
  measure_models(plan, [&](const Sample& s) { other.push_back(s); });
  EXPECT_NE(hashes_of(samples, plan.bars[0].name()), hashes_of(other, plan.bars[0].name()));
}

}  // namespace
}  // namespace dartboard::models_report_test
