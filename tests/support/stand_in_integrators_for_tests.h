#pragma once
// Integrators with a known error, made from a real one and with its scheme.

#include <memory>
#include <string_view>

#include "core/time/integrators.h"

namespace dartboard {

/// A step of `of` with h times 1 + `permille` / 1000 / `divisor`.
template <const char* of, int permille, long divisor = 1>
class LongerSteps : public Integrator {
 public:
  const Scheme& scheme() const override { return real_->scheme(); }
  StepResult step(const SpringSystem& system, Motion motion, double h) override {
    return real_->step(system, motion, h * (1.0 + 1e-3 * permille / static_cast<double>(divisor)));
  }
  void restart() override { real_->restart(); }

 private:
  std::unique_ptr<Integrator> real_ = make_integrator(of);
};

template <class T>
IntegratorEntry stand_in(std::string_view name) {
  return {name, []() -> std::unique_ptr<Integrator> { return std::make_unique<T>(); }};
}

inline constexpr char verlet_name[] = "verlet", rk4_name[] = "rk4";

}  // namespace dartboard
