#pragma once
// The base class of the implicit integrators.

#include <vector>

#include "core/time/implicit/implicit_stage.h"
#include "core/time/method/integrator.h"
#include "core/time/method/trial_state.h"

namespace dartboard {

/// An integrator whose steps solve stages.
///
/// `restart` keeps the factor: the next step finds what has changed, and updates the factor where that is cheaper.
/// Where only the motion has changed, as by a contact, a kept factor goes on without a look at it.
class ImplicitIntegrator : public Integrator {
 public:
  explicit ImplicitIntegrator(const ImplicitOptions& options) : stage_(options) {}

  void restart() override {
    stage_.system_changed();
    motion_changed();
  }
  void motion_changed() override {}
  // what is driven turns and bends: a factor of the matrix as it is costs less than iterations with that of before
  void drives_changed() override { restart(); }
  void state(Archive& archive) override {
    Integrator::state(archive);
    archive(stage_);
  }
  bool undo_stopped_step() override { return stage_.solver().undo_step(work_); }
  std::size_t bytes() const override { return stage_.bytes() + end_.bytes(); }
  std::size_t solver_bytes() const override { return stage_.solver_bytes(); }
  std::optional<FactorForecast> factor_forecast(const SpringSystem& system) const override {
    return forecast_factor(system, options());
  }
  const ImplicitOptions& options() const { return stage_.options(); }

 protected:
  StepResult fail(const StepResult& result) {
    ++work_.failed_steps;
    return result;
  }

  ImplicitStage stage_;
  TrialState end_;
};

}  // namespace dartboard
