// Bodies that have changed, and fresh bodies of the same cells and vertices.

#include "benchmarks/studies/step/changed_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <utility>

#include "benchmarks/harness/scratch_folder.h"
#include "benchmarks/studies/step/scene_columns.h"
#include "benchmarks/studies/step/step_bodies.h"
#include "core/plain/error.h"
#include "validation/contenders/motion_agreement.h"

namespace dartboard::changed_bodies_test {
namespace {

Problem box() { return find_step_body(step_box(1'000, false), 1).make(); }

ChangedBody changed_box(const std::string& kind, double amount) {
  ChangedBody changed;
  change_body(box(), kind, std::vector{amount}, 1, [&](ChangedBody&& one) { changed = std::move(one); });
  return changed;
}

/// How many of these columns have other forces than the changed ones.
std::size_t differ(const ChangedBody& changed, const std::vector<KeptColumns>& all) {
  std::size_t differing = 0;
  for (const KeptColumns& each : all) {
    SceneColumns other(std::make_shared<KeptColumns>(each), each.h, {"other"});
    differing += count_differing(changed.columns, std::vector<ContenderBody*>{&other});
  }
  return differing;
}

TEST(ChangedBodies, HaveTheSpringsAndForcesOfTheirFreshBodies) {
  for (const std::string& kind : kinds_of_change()) {
    const ChangedBody changed = changed_box(kind, 0.1);
    const FreshBody fresh(changed.present, changed.columns);
    EXPECT_EQ(fresh.columns.springs.size(), changed.columns.springs.size()) << kind;
    EXPECT_EQ(count_differing(changed, fresh), 0u) << kind;
  }
}

TEST(ChangedBodies, DifferFromEachFreshBodyWithAnotherVertex) {
  const ChangedBody changed = changed_box("planar cuts", 0.1);
  FreshBody fresh(changed.present, changed.columns);
  fresh.columns.at.viscosity[70] *= 1.0 + 1e-9;
  EXPECT_EQ(count_differing(changed, fresh), 1u);
  fresh.scene->vertices().viscosity[70] *= 1.0 + 1e-9;
  EXPECT_EQ(count_differing(changed, fresh), 2u);
}

TEST(ChangedBodies, LoseFacesAndCellsDrawnAtRandom) {
  for (const std::string& kind : kinds_of_change()) {
    std::vector<std::vector<SpringEnds>> ends;
    for (const std::uint64_t seed : {1, 2})
      change_body(box(), kind, std::vector{0.1}, seed,
                  [&](const ChangedBody& one) { ends.push_back(one.columns.ends); });
    EXPECT_NE(ends[0], ends[1]) << kind;
  }
}

TEST(ChangedBodies, HaveTheForcesAndMotionOfTheGraphOfTheirCells) {
  for (const std::string& kind : kinds_of_change()) {
    const ChangedBody changed = changed_box(kind, 0.1);
    const auto columns = [&](const Problem&) {
      return std::make_unique<SceneColumns>(std::make_shared<KeptColumns>(changed.columns), changed.columns.h,
                                            Manner{"changed"});
    };
    const Contender all[]{{"changed", "", "", 0.0, Carrier::core_map, columns}, contender(baseline_id)};
    for (const MotionAgreement& one : compare_motion(changed.present, 4, all))
      EXPECT_TRUE(one.agrees) << kind << one.id;
  }
}

TEST(ChangedBodies, DifferFromBodiesOfWhichOneSpringVertexOrNumberIsAnother) {
  const ChangedBody changed = changed_box("planar cuts", 0.1);
  const KeptColumns fresh = FreshBody(changed.present, changed.columns).columns;
  KeptColumns stiffer = fresh, damped = fresh, elsewhere = fresh, heavier = fresh, renumbered = fresh,
              no_number = fresh;
  stiffer.springs.change(7, [](Spring& spring) { spring.stiffness *= 1.0 + 1e-9; });
  damped.springs.change(7, [](Spring& spring) { spring.damping *= 1.0 + 1e-9; });
  std::swap(elsewhere.ends[7], elsewhere.ends[70]);
  heavier.at.viscosity[70] *= 1.0 + 1e-9;
  std::swap(renumbered.at.point[70], renumbered.at.point[71]);
  no_number.springs.change(7, [](Spring& spring) { spring.stiffness = std::nan(""); });
  EXPECT_EQ(differ(changed, {stiffer, damped, elsewhere, heavier, renumbered, no_number}), 6u);
}

TEST(ChangedBodies, AreChangedByTheAmountsAskedFor) {
  const auto springs = static_cast<double>(changed_box("planar cuts", 0.0).columns.springs.size());
  for (const std::string& kind : kinds_of_change()) {
    std::vector<double> reached;
    change_body(box(), kind, std::vector{0.01, 0.1, 0.5}, 1, [&](const ChangedBody& one) {
      const double added = static_cast<double>(one.columns.springs.size()) / springs - 1.0,
                   left = static_cast<double>(one.present.mesh.cell_count()) / 1080.0;
      // a quotient and a difference of numbers of about 1 round by some 2^-53 each
      EXPECT_NEAR(one.reached, kind == "random tetrahedra removed" ? 1.0 - left : added, 4e-16) << kind;
      // a change adds at most three edges to 1565 springs, or takes one of 1080 cells
      EXPECT_GE(one.reached, one.asked) << kind;
      EXPECT_LT(one.reached, one.asked + 0.002) << kind;
      reached.push_back(one.reached);
    });
    EXPECT_EQ(reached.size(), 3u) << kind;
  }
}

TEST(ChangedBodies, ReachLessWhereNoFaceIsLeft) {
  double reached = 0.0;
  change_body(box(), "random faces dissociated", std::vector{1e3}, 1,
              [&](const ChangedBody& one) { reached = one.reached; });
  EXPECT_DOUBLE_EQ(reached, 6.0 * 1080 / 1565 - 1.0);  // each tetrahedron has its six edges
}

TEST(ChangedBodies, AreOfAKnownKind) { EXPECT_THROW(changed_box("wishes", 0.1), InputError); }

TEST(FreshBodies, AreNumberedAsASceneNumbersTheSameCells) {
  for (const std::string& kind : kinds_of_change()) {
    const ChangedBody changed = changed_box(kind, 0.1);
    const KeptColumns fresh = FreshBody(changed.present, changed.columns).columns;
    const auto scene = make_simulated_body(changed.present, false);
    EXPECT_EQ(fresh.at.point, scene->vertices().point) << kind;
    EXPECT_EQ(fresh.at.position, scene->vertices().position) << kind;
    // each pair of ends at its first place
    const auto without_parallel = [](const auto& ends) {
      std::vector<SpringEnds> first;
      std::map<SpringEnds, int> met;
      for (SpringEnds pair : ends) {
        std::ranges::sort(pair);
        if (++met[pair] == 1) first.push_back(pair);
      }
      return first;
    };
    EXPECT_EQ(without_parallel(fresh.ends), without_parallel(scene->system().ends)) << kind;
    EXPECT_NE(without_parallel(fresh.ends), without_parallel(changed.columns.ends)) << kind;
  }
}

TEST(FreshBodies, HaveASpringForEachOfTheChangedBody) {
  ChangedBody changed = changed_box("planar cuts", 0.1);
  changed.columns.ends.pop_back();
  EXPECT_THROW(FreshBody(changed.present, changed.columns), SolverError);
}

TEST(KeptColumns, AreReadAsTheyWereWritten) {
  const ScratchFolder folder("test");
  ChangedBody changed = changed_box("random faces dissociated", 0.1);
  write_columns(folder.path() / "columns", changed.columns);
  const KeptColumns read = read_columns(folder.path() / "columns");
  EXPECT_EQ(read.ends, changed.columns.ends);
  EXPECT_EQ(read.at.position, changed.columns.at.position);
  EXPECT_EQ(read.gravity, changed.columns.gravity);
  EXPECT_EQ(read.h, changed.columns.h);
  EXPECT_EQ(differ(changed, {read}), 0u);
}

TEST(KeptColumns, AreNotReadFromFilesThatAreMissingOrDamaged) {
  const ScratchFolder folder("test");
  EXPECT_THROW(read_columns(folder.path() / "columns"), IoError);
  std::ofstream(folder.path() / "columns") << "short";
  EXPECT_THROW(read_columns(folder.path() / "columns"), IoError);
}

TEST(ChangedSteps, AreTimedOfEachAmountFromOneState) {
  const ScratchFolder folder("test");
  const ChangedPlan plan{
      .body = step_box(1'000, false), .kind = "planar cuts", .folder = folder.path(), .process = 3, .rounds = 2};
  std::vector<ChangedCase> cases;
  std::vector<Sample> samples;
  compare_changed(plan, [&](const ChangedCase& one) { cases.push_back(one); });
  measure_changed(plan, [&](const Sample& sample) { samples.push_back(sample); });
  check_repeats(samples);
  ASSERT_EQ(cases.size(), 3u);
  EXPECT_EQ(samples.size(), 2u * 2 * 3);
  for (const ChangedCase& one : cases) {
    EXPECT_EQ(one.differing, 0u);
    EXPECT_EQ(one.steps, static_cast<int>(150'000 / one.springs));
    for (const char* task : {changed_task::changed, changed_task::fresh})
      EXPECT_EQ(std::ranges::count(samples, one.changed + task, &Sample::task), 2) << one.changed << task;
  }
}

}  // namespace
}  // namespace dartboard::changed_bodies_test
