#include "validation/elements/model_advice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/plain/error.h"
#include "core/time/integrators.h"

namespace dartboard::model_advice_test {
namespace {

ModelTrend trend(double coarse, double fine) {
  return {.model = {}, .coarse = 2, .fine = 4, .coarse_error = coarse, .fine_error = fine, .fine_cost = 0.5};
}

// A quarter on a mesh twice as fine is order 2: a ninth of 0.09 needs cubes three times as fine, at 3^4 times the cost.
TEST(ModelTrend, ForetellsTheMeshOfAnErrorByTheOrder) {
  const ModelTrend t = trend(0.36, 0.09);
  EXPECT_NEAR(t.order(), 2.0, 1e-12);
  EXPECT_EQ(t.finer_for(0.0101), 12);
  EXPECT_EQ(t.finer_for(0.5), 2);
  EXPECT_EQ(t.finer_for(0.1), 4);
  EXPECT_DOUBLE_EQ(t.cost_at(12), 0.5 * 81);
}

TEST(ModelTrend, DoesNotBelieveThatAFloorFalls) {
  EXPECT_EQ(trend(0.30, 0.28).finer_for(0.2), 0);
  EXPECT_EQ(trend(0.30, 0.31).finer_for(0.2), 0);
  EXPECT_EQ(trend(0.30, NAN).finer_for(0.2), 0);
  EXPECT_EQ(trend(0.30, 0.28).finer_for(0.29), 4);
}

// The advice, followed by hand and compared with a reference that it has not used.
TEST(LongModelAdvice, IsWhatMeetsTheErrorWhenItIsFollowed) {
  const ClampedBar bar{.cubes = {3, 1, 1}};
  std::int64_t now = 0;
  const auto clock = [&now] { return now += 1000; };
  const double error = 0.3;
  const ModelAdvice advice = advise_model(bar, {.models = {}, .truth = 2}, 0.25, error, clock);
  const MeasuredModel* pick = advice.pick();
  ASSERT_NE(pick, nullptr) << advice.why_not;
  EXPECT_LE(pick->errors.motion, error);

  const BarTruth truth = bar_truth(bar, {.models = {}, .truth = 3}, 0.25);
  auto body = bar_body(bar, pick->model, pick->finer, 0.25);
  const auto watched = watched_vertices(bar, *body);
  const BarAnswers answers = model_answers(bar, pick->model, pick->finer, *body, truth.beats);
  BentBar bent(bar, std::move(body), answers.bent);
  const auto integrator = make_integrator(pick->method.integrator);
  const auto run = bent.follow(*integrator, pick->method.steps, truth.beats, watched);
  ASSERT_TRUE(run.result.ok());
  EXPECT_LT(motion_error(run.motion, truth.answers.motion), error + truth.unsure.motion);
}

TEST(ModelAdvice, SaysWhyThereIsNone) {
  const ClampedBar bar{.cubes = {3, 1, 1}};
  std::int64_t now = 0;
  const auto clock = [&now] { return now += 1000; };
  const ModelAdvice none = advise_model(bar, {.models = {}, .truth = 2}, 0.25, 1e-5, clock);
  EXPECT_EQ(none.pick(), nullptr);
  EXPECT_NE(none.why_not.find("the reference cannot resolve errors below"), std::string::npos);
  EXPECT_TRUE(none.trials.empty());
  EXPECT_THROW(advise_model(bar, {.models = {}, .truth = 2}, 0.25, 0.0, clock), InputError);
}

}  // namespace
}  // namespace dartboard::model_advice_test
