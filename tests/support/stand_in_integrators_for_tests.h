#pragma once
// Integrators with a known error, made from a real one and with its scheme.

#include <Eigen/Core>
#include <memory>
#include <string_view>
#include <vector>

#include "core/time/integrators.h"
#include "core/time/system/accelerations.h"

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

/// Verlet with all forces, damping too, at the velocity of the start of the step: of order 1 where there is damping.
class LaggedVerlet : public Integrator {
 public:
  const Scheme& scheme() const override {
    static const Scheme scheme = scheme_of("verlet");
    return scheme;
  }
  StepResult step(const SpringSystem& system, Motion motion, double h) override {
    std::vector<Eigen::Vector3d> a(motion.x.size());
    for (std::size_t i = 0; i < a.size(); ++i) motion.x[i] += 0.5 * h * motion.v[i];
    accelerations(system, terms_of(system), motion.x, motion.v, a);
    for (std::size_t i = 0; i < a.size(); ++i) {
      motion.v[i] += h * a[i];
      motion.x[i] += 0.5 * h * motion.v[i];
    }
    return {};
  }
};

template <class T>
IntegratorEntry stand_in(std::string_view name) {
  return {name, []() -> std::unique_ptr<Integrator> { return std::make_unique<T>(); }};
}

inline constexpr char verlet_name[] = "verlet", rk4_name[] = "rk4";

}  // namespace dartboard
