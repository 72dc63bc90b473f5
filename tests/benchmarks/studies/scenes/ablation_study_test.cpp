// The pairs of the ablation: scenes that differ in one feature, and loops that leave the same bits.

#include "benchmarks/studies/scenes/ablation_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "benchmarks/studies/scenes/output_tasks.h"
#include "benchmarks/studies/scenes/plain_loop.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/scene/body/simulated_body.h"
#include "core/scene/plan/scene_plan.h"
#include "core/time/integrators.h"

namespace dartboard::ablation_study_test {
namespace {

TEST(PlainLoop, MovesWithTheBitsOfTheIntegrator) {
  Problem problem;
  problem.mesh = kuhn_box(3, 2, 2, 0.25, 0.2, 1);
  problem.material = {.density = 1000.0, .stiffness = 500.0, .damping = 0.0, .viscosity = 0.0};
  problem.surroundings.gravity = {0, 0, 0};
  for (const auto& p : problem.mesh.points) problem.initial_velocity.emplace_back(p.y(), -p.x(), 0.25 * p.z());
  const auto body = make_simulated_body(problem, false);
  const SpringSystem s = body->system();
  const std::vector<SpringEnds> ends(s.ends.begin(), s.ends.end());
  const std::vector<UndampedSpring> springs(s.springs.undamped().begin(), s.springs.undamped().end());
  const std::vector<double> inverse_mass(s.inverse_mass.begin(), s.inverse_mass.end());
  auto x = body->vertices().position, v = body->vertices().velocity;
  PlainLoop plain;
  const auto integrator = make_integrator("rk4");
  for (int k = 0; k < 20; ++k) {
    plain.step(ends, springs, inverse_mass, x, v, 1e-3);
    ASSERT_TRUE(integrator->step(body->system(), body->motion(), 1e-3).ok());
  }
  EXPECT_EQ(x, body->vertices().position);
  EXPECT_EQ(v, body->vertices().velocity);
}

TEST(Ablation, DoesNotJudgeBesideABaselineThatIsTheSlowerOne) {
  const auto verdict = [](double median, double low, double high) {
    return verdict_on_time({median, {low, high, 0.98, true}});
  };
  EXPECT_EQ(verdict(1.003, 0.999, 1.005), Verdict::holds);
  EXPECT_EQ(verdict(1.003, 0.999, 1.006), Verdict::undecided);
  EXPECT_EQ(verdict(0.998, 0.99, 1.001), Verdict::holds);
  EXPECT_EQ(verdict(1.006, 1.003, 1.01), Verdict::undecided);
  EXPECT_EQ(verdict(1.008, 1.0051, 1.01), Verdict::falls_short);
  EXPECT_EQ(verdict(0.924, 0.916, 0.942), Verdict::undecided);
}

TEST(Ablation, CountsTheBytesOfWhatABareSceneDoesNotAskFor) {
  MemoryReport report{{Part::vertices, 100}, {Part::springs, 480}, {Part::integrator, 30}};
  EXPECT_EQ(bytes_not_asked_for(report), 0u);
  EXPECT_EQ(bytes_of_damping(report, 20), 0u);  // 8 bytes each of rest length, stiffness and ends
  report.push_back({Part::map, 7});
  report.push_back({Part::viscosity, 5});
  report.push_back({Part::damping, 160});
  EXPECT_EQ(bytes_not_asked_for(report), 172u);
  EXPECT_EQ(bytes_of_damping(report, 20), 160u);
  report[1].bytes += 160;  // in addition to the others, in a row
  EXPECT_EQ(bytes_of_damping(report, 20), 320u);
}

TEST(Ablation, ASceneThatAsksForNothingHoldsNothingAndOneThatDoesHoldsIt) {
  for (const AblationVariant& variant : ablation_variants()) {
    const std::size_t bytes = bytes_not_asked_for(measured_memory(variant.scene));
    const bool asks_for_nothing = variant.name == "bare" || variant.name == "bare, verlet";
    const bool asks_for_bytes =
        variant.name == "bare + viscosity" || variant.name == "bare + fixed vertices" || variant.name == "bare + map";
    if (asks_for_nothing || asks_for_bytes) {
      EXPECT_EQ(bytes == 0, asks_for_nothing) << variant.name;
    }
  }
}

TEST(Ablation, ComparesScenesThatThereAre) {
  std::set<std::string> names;
  for (const AblationVariant& variant : ablation_variants())
    EXPECT_TRUE(names.insert(variant.name).second) << variant.name << " twice";
  for (const auto& pairs : {switched_on(), switched_off()}) {
    EXPECT_EQ(pairs.size(), 9u);  // eight features and the integrator
    for (const AblationPair& pair : pairs) {
      EXPECT_TRUE(names.contains(pair.task)) << pair.task;
      EXPECT_TRUE(names.contains(pair.baseline)) << pair.baseline;
    }
  }
}

TEST(Ablation, SwitchesOneFeatureAtATime) {
  std::map<std::string, AblationVariant> by_name;
  for (AblationVariant& variant : ablation_variants()) by_name.emplace(variant.name, variant);
  const auto features = [&by_name](const std::string& name) {
    const AblationVariant& v = by_name.at(name);
    return std::vector<bool>{
        v.scene.material.damping != 0.0,
        v.scene.material.viscosity != 0.0,
        !v.scene.gravity.isZero(0.0),
        !v.scene.fixed.empty(),
        !v.scene.events.empty(),
        std::ranges::any_of(v.scene.events,
                            [](const SceneEvent& e) { return std::holds_alternative<TearWhereStressed>(e.action); }),
        v.frames,
        v.diagnostics,
        v.scene.integrator == "rk4"};
  };
  for (const auto& pairs : {switched_on(), switched_off()})
    for (const AblationPair& pair : pairs) {
      const auto with = features(pair.task), without = features(pair.baseline);
      int differences = 0;
      for (std::size_t k = 0; k < with.size(); ++k) {
        EXPECT_GE(with[k], without[k]) << pair.feature;
        differences += with[k] != without[k];
      }
      EXPECT_EQ(differences, 1) << pair.feature;
    }
}

TEST(Ablation, HandsOutEachTaskOfEachRoundAndItsLoopsAgree) {
  std::map<std::string, int> count;
  std::map<std::string, std::set<std::uint64_t>> hashes;
  study_ablation({.rounds = 1, .steps = 2}, [&](const Sample& sample) {
    ++count[sample.task];
    hashes[sample.task].insert(sample.hash);
  });
  for (const AblationVariant& variant : ablation_variants()) EXPECT_EQ(count[variant.name], 1) << variant.name;
  for (const AblationPair& pair : staircase()) {
    EXPECT_EQ(count[pair.task], 3) << pair.task;
    EXPECT_EQ(hashes[pair.task], hashes["bare"]) << pair.task;
  }
  EXPECT_EQ(hashes["bare + map"], hashes["bare"]);
  EXPECT_EQ(hashes["bare + stress watch"], hashes["bare"]);
  EXPECT_EQ(hashes["bare + frames"], hashes["bare"]);
  EXPECT_EQ(hashes["bare + diagnostics"], hashes["bare"]);
  EXPECT_NE(hashes["bare + damping"], hashes["bare"]);
  for (const std::string& task : {output_run, output_integrator, output_bytes}) EXPECT_EQ(count[task], 1) << task;
  EXPECT_EQ(hashes[output_run], hashes[output_integrator]);
}

}  // namespace
}  // namespace dartboard::ablation_study_test
