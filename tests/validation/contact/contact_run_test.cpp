#include "validation/contact/contact_run.h"

#include <gtest/gtest.h>

#include "validation/contact/contact_scenes.h"

namespace dartboard::contact_run_test {
namespace {

constexpr std::size_t looks = 12;

/// Write access to the motion, which no run has.
Motion motion_of(Simulation& simulation) { return const_cast<SimulatedBody&>(simulation.body()).motion(); }

TEST(ContactRun, OfEverySceneIsAccountedFor) {
  for (const SceneFile& scene : contact_scenes()) {
    const ContactRun run = judge_run(scene, looks);
    EXPECT_TRUE(run.ended) << scene.name;
    EXPECT_EQ(run.looks, looks) << scene.name;
    EXPECT_GT(run.contacts, 3u) << scene.name;
    EXPECT_GT(run.by_depth.count(), 0u) << scene.name;
    EXPECT_LE(run.by_depth.deepest_missed, 1.0) << scene.name;
    EXPECT_LE(run.deepest, run.allowed) << scene.name;
    EXPECT_GT(run.deepest, 0.01 * run.allowed) << scene.name;
    EXPECT_LE(run.energy, 5e-3) << scene.name;
    EXPECT_LE(run.momentum, 1e-12) << scene.name;
    EXPECT_LE(run.angular, 1e-12) << scene.name;
  }
}

TEST(ContactRun, SeesBodiesThatPassThroughEachOther) {
  // put into each other unnoticed, before the last look
  std::size_t look = 0;
  const ContactRun run = judge_run(contact_scenes()[2], 2, [&look](Simulation& simulation) {
    if (++look != 2) return;
    const auto x = motion_of(simulation).x;
    for (std::size_t k = 0; k < x.size(); ++k)
      if (simulation.body().vertices().point[k] >= 27) x[k].z() -= 0.02;  // all but the lowest box
  });
  EXPECT_TRUE(run.ended);
  EXPECT_GT(run.deepest, run.allowed);
  EXPECT_GT(run.energy, 0.01);
}

TEST(ContactRun, SeesMomentumThatIsNotKept) {
  const ContactRun run = judge_run(contact_scenes()[0], 3, [](Simulation& simulation) {
    for (Eigen::Vector3d& v : motion_of(simulation).v) v.x() += 1e-6;
  });
  EXPECT_GT(run.momentum, 1e-7);
  EXPECT_GT(run.angular, 1e-8);
}

}  // namespace
}  // namespace dartboard::contact_run_test
