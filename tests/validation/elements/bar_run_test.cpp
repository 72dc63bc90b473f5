#include "validation/elements/bar_run.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/time/integrators.h"

namespace dartboard::bar_run_test {
namespace {

struct Bent {
  ClampedBar bar;
  BarModel model;
  Beats beats;
  BarAnswers truth, answers;
  std::vector<std::uint32_t> watched;
  BentBar bent;

  static Bent of(const BarModel& model) {
    const ClampedBar bar;
    Beats beats;
    BarAnswers truth = true_answers(bar, 2, 0.25, beats);
    auto body = bar_body(bar, model, 1, 0.25);
    BarAnswers answers = model_answers(bar, model, 1, *body, beats);
    auto watched = watched_vertices(bar, *body);
    BentBar bent(bar, std::move(body), answers.bent);
    return {bar, model, beats, truth, answers, watched, std::move(bent)};
  }
};

// Bent by 1e-4 of its length a bar is 6e-5 shorter, as a share of how far it is bent: nonlinear terms of laws are of
// that size, times the periods of its faster modes.
TEST(BentBar, MovesAsTheLinearMotionOfItsModelSays) {
  for (const BarModel& model : {BarModel{}, BarModel{Model::neo_hookean, CellKind::hexahedron},
                                BarModel{Model::corotational, CellKind::tetrahedron}}) {
    Bent b = Bent::of(model);
    const auto verlet = make_integrator("verlet");
    const BentBar::Run run = b.bent.follow(*verlet, 4096, b.beats, b.watched);
    ASSERT_TRUE(run.result.ok()) << in_words(model);
    EXPECT_LT(motion_error(run.motion, b.answers.motion), 5e-4) << in_words(model);
    // again, from the same start
    EXPECT_EQ(b.bent.follow(*verlet, 4096, b.beats, b.watched).motion, run.motion);
  }
}

// A clock that ticks once per reading makes all steps cost the same: the method that needs the fewest steps wins, and
// with fewer of them its error would not be allowed.
TEST(BestMethod, HasTheFewestStepsWhoseErrorIsAllowed) {
  Bent b = Bent::of({Model::neo_hookean, CellKind::hexahedron});
  std::int64_t now = 0;
  const auto clock = [&now] { return now += 1'000'000; };
  const std::vector<BarMethod> methods{{"implicit-midpoint", 16}, {"verlet", 8192}};
  const BestMethod best =
      best_method(b.bent, b.beats, b.watched, b.answers.motion, b.truth.motion, 0.02, methods, clock);
  EXPECT_EQ(best.integrator, "implicit-midpoint");
  EXPECT_LE(best.error, 0.02);
  EXPECT_GT(best.followed, 1u);
  const auto midpoint = make_integrator("implicit-midpoint");
  const BentBar::Run fewer = b.bent.follow(*midpoint, best.steps / 16 * 3 / 4 * 16, b.beats, b.watched);
  EXPECT_GT(motion_error(fewer.motion, b.answers.motion), 0.02);
  // the remaining error is the model's own
  EXPECT_NEAR(best.total_error, motion_error(b.answers.motion, b.truth.motion), 0.021);

  const std::vector<BarMethod> other{{"implicit-midpoint", 16384}, {"verlet", 8192}};
  EXPECT_EQ(best_method(b.bent, b.beats, b.watched, b.answers.motion, b.truth.motion, 0.02, other, clock).integrator,
            "verlet");
}

TEST(BestMethod, IsNoneWhereNothingIsCloseEnough) {
  Bent b = Bent::of({});
  std::int64_t now = 0;
  const auto clock = [&now] { return now += 1'000'000; };
  const std::vector<BarMethod> unstable{{"explicit-euler", 700'000}};
  const BestMethod none =
      best_method(b.bent, b.beats, b.watched, b.truth.motion, b.truth.motion, 1e-9, unstable, clock);
  EXPECT_EQ(none.integrator, "");
}

// Explicit methods start where they are stable: all of them can be followed at once.
TEST(BarMethods, StartFromStepsThatAreStable) {
  Bent b = Bent::of({Model::neo_hookean, CellKind::hexahedron});
  const auto methods = bar_methods(b.bent, b.beats);
  for (const BarMethod& method : methods) {
    EXPECT_EQ(method.fewest_steps % Beats::count, 0u);
    const auto integrator = make_integrator(method.integrator);
    if (integrator->scheme().implicit) continue;
    const BentBar::Run run = b.bent.follow(*integrator, method.fewest_steps, b.beats, b.watched);
    EXPECT_TRUE(run.result.ok()) << method.integrator;
    EXPECT_LT(motion_error(run.motion, b.answers.motion), 0.1) << method.integrator;
    // and with steps twice as long they are not
    const std::uint64_t half = method.fewest_steps / (2 * Beats::count) * Beats::count;
    const auto longer = b.bent.follow(*integrator, half, b.beats, b.watched);
    EXPECT_TRUE(!longer.result.ok() || !(motion_error(longer.motion, b.answers.motion) < 0.1)) << method.integrator;
  }
}

}  // namespace
}  // namespace dartboard::bar_run_test
