// An integrator that is stored between two steps and read into a new one continues with the same bits.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/archive.h"
#include "core/time/implicit/one_stage.h"
#include "core/time/integrators.h"
#include "core/time/solve/stop_request.h"
#include "tests/support/spring_bodies_for_tests.h"

namespace dartboard::integrator_state_test {
namespace {

std::string stored(Integrator& integrator) {
  Archive archive;
  integrator.state(archive);
  return archive.written();
}

void read(Integrator& integrator, const std::string& state) {
  Archive archive(state, "state");
  integrator.state(archive);
  archive.require_end();
}

SpringArrays moving_grid() {
  SpringArrays body = spring_grid(2, 2, 2, 50.0, 0.02);
  body.gravity = {0, 0, -9.81};
  disturb(body, 0.01, 0.4);
  return body;
}

constexpr double h = 0.002;
constexpr int step_count = 24;

/// A step, and after some of them a cut or another spring: factors are updated then.
void advance(Integrator& integrator, SpringArrays& body, int n) {
  const StepResult result = integrator.step(body.system(), body.motion(), h);
  ASSERT_TRUE(result.ok()) << to_string(result);
  if (n % 7 == 5) {
    body.springs[static_cast<std::size_t>(n)].stiffness *= 0.5;
    integrator.restart();
  }
  if (n == 9 || n == 17) {
    dissociate(body, 13);
    integrator.restart();
  }
}

void expect_same(const SpringArrays& a, const SpringArrays& b, int step) {
  ASSERT_EQ(a.x.size(), b.x.size());
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    ASSERT_EQ(a.x[i], b.x[i]) << "vertex " << i << " after step " << step;
    ASSERT_EQ(a.v[i], b.v[i]) << "vertex " << i << " after step " << step;
  }
}

template <class Make>
void expect_to_go_on(Make&& make) {
  for (int cut = 0; cut < step_count; ++cut) {
    SCOPED_TRACE("stored after " + std::to_string(cut));
    SpringArrays body = moving_grid();
    const auto first = make();
    for (int n = 0; n < cut; ++n) advance(*first, body, n);
    SpringArrays copy = body;
    const auto second = make();
    read(*second, stored(*first));
    EXPECT_EQ(stored(*second), stored(*first));
    for (int n = cut; n < step_count; ++n) {
      advance(*first, body, n);
      advance(*second, copy, n);
      expect_same(body, copy, n);
      if (testing::Test::HasFailure()) return;
    }
    EXPECT_EQ(first->work().steps, second->work().steps);
    EXPECT_EQ(first->work().force_evaluations, second->work().force_evaluations);
    EXPECT_EQ(first->work().factorisations, second->work().factorisations);
    EXPECT_EQ(first->work().rank_one_updates, second->work().rank_one_updates);
  }
}

struct IntegratorState : testing::TestWithParam<std::string_view> {};

TEST_P(IntegratorState, IsAllThatLaterStepsDependOn) {
  expect_to_go_on([] { return make_integrator(GetParam()); });
}

std::vector<std::string_view> all_names() {
  std::vector<std::string_view> names;
  for (const IntegratorEntry& entry : integrators()) names.push_back(entry.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(Every, IntegratorState, testing::ValuesIn(all_names()));

TEST(IntegratorStateOf, BackwardEulerIsAllWhateverSolvesItsEquations) {
  for (const LinearSolver solver : {LinearSolver::fresh_factor, LinearSolver::kept_factor,
                                    LinearSolver::conjugate_gradients, LinearSolver::laplacian})
    for (const FactorKind kind : {FactorKind::simplicial, FactorKind::supernodal}) {
      ImplicitOptions options;
      options.solver = solver;
      options.cholesky.kind = kind;
      SCOPED_TRACE(std::to_string(static_cast<int>(solver)) + " " + std::to_string(static_cast<int>(kind)));
      expect_to_go_on([&options] { return std::make_unique<BackwardEuler>(options); });
    }
}

// Adaptive steps: the size of the next one, and the error of the last.
TEST(IntegratorStateOf, DormandPrinceHasWhatChoosesTheNextStep) {
  const auto make = [] {
    std::unique_ptr<Integrator> integrator = make_integrator("dormand-prince-54");
    return std::unique_ptr<AdaptiveIntegrator>(dynamic_cast<AdaptiveIntegrator*>(integrator.release()));
  };
  const Tolerance tolerance{1e-7, 1e-6};
  SpringArrays body = moving_grid();
  const auto first = make(), second = make();
  ASSERT_TRUE(first->advance(body.system(), body.motion(), 0.013, tolerance).ok());
  SpringArrays copy = body;
  read(*second, stored(*first));
  ASSERT_TRUE(first->advance(body.system(), body.motion(), 0.017, tolerance).ok());
  ASSERT_TRUE(second->advance(copy.system(), copy.motion(), 0.017, tolerance).ok());
  expect_same(body, copy, 1);
  EXPECT_EQ(first->work().rejected_steps, second->work().rejected_steps);
  EXPECT_EQ(first->work().force_evaluations, second->work().force_evaluations);
}

// ---- a step that was given up

int looks_left = 0;
bool after_some_looks() { return --looks_left < 0; }

// A solution that takes more than one iteration asks for a fresh factor, in the middle of a step.
std::unique_ptr<Integrator> impatient() {
  ImplicitOptions options;
  options.patience = 1;
  return std::make_unique<BackwardEuler>(options);
}

TEST(IntegratorStateOf, AStepGivenUpIsThatOfBeforeUnlessTheFactorWasReplaced) {
  const auto make = [](std::string_view name) { return name == "impatient" ? impatient() : make_integrator(name); };
  for (const std::string_view name :
       {"impatient", "backward-euler", "bdf2", "sdirk2", "local-global", "energy-momentum"}) {
    int undone = 0;
    for (int before = 0; before < step_count; ++before)
      for (int looks = 0; looks < 6; ++looks) {
        SpringArrays body = moving_grid();
        const auto integrator = make(name);
        for (int n = 0; n < before; ++n) advance(*integrator, body, n);
        const std::string state = stored(*integrator);
        const SpringArrays start = body;
        bool stopped = false;
        {
          looks_left = looks;
          const StopRequest request(after_some_looks);
          try {
            integrator->step(body.system(), body.motion(), h);
          } catch (const Stopped&) {
            stopped = true;
          }
        }
        if (!stopped) break;
        expect_same(start, body, before);
        if (!integrator->undo_stopped_step()) continue;
        ++undone;
        SpringArrays copy = start;
        const auto other = make(name);
        read(*other, state);
        for (int n = before; n < step_count; ++n) {
          advance(*integrator, body, n);
          advance(*other, copy, n);
          expect_same(body, copy, n);
          if (HasFailure()) return;
        }
        EXPECT_EQ(integrator->work().newton_iterations, other->work().newton_iterations);
      }
    EXPECT_GT(undone, step_count / 2) << name;
  }
}

}  // namespace
}  // namespace dartboard::integrator_state_test
