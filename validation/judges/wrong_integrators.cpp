#include "validation/judges/wrong_integrators.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/plain/error.h"
#include "core/time/system/accelerations.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

constexpr std::array kinds{
    WrongIntegrator{Wrong::does_nothing, "does nothing", "returns at once"},
    WrongIntegrator{Wrong::half_the_force, "half the force", "springs, dampers and gravity at half their strength"},
    WrongIntegrator{Wrong::wrong_sign, "wrong sign", "springs push where they should pull"},
    WrongIntegrator{Wrong::one_order_less, "an order less", "the error of a step is larger by 1 / (h omega)"},
    WrongIntegrator{Wrong::loses_damping, "loses damping", "no dampers and no viscosity"},
    WrongIntegrator{Wrong::as_if_unstretched, "as if unstretched", "right for springs near their rest length only"},
    WrongIntegrator{Wrong::drifts, "drifts by 1e-6", "positions grow by a millionth in each step"},
};

// A system of its own, with other springs and gravity.
struct ChangedSystem {
  std::vector<Spring> springs;
  std::vector<double> viscosity;
  SpringSystem system;

  template <class F>
  ChangedSystem(const SpringSystem& of, double gravity, double of_viscosity, F&& change) : system(of) {
    for (const Spring s : of.springs) springs.push_back(change(s));
    for (std::size_t i = 0; i < of.vertex_count(); ++i) viscosity.push_back(of_viscosity * of.viscosity[i]);
    system.springs = SpringSpan(springs);
    system.viscosity = viscosity;
    system.gravity = gravity * of.gravity;
  }
};

class Faulty : public Integrator {
 public:
  Faulty(Wrong kind, std::string_view name)
      : kind_(kind), right_(make_integrator(name)), half_(make_integrator(name)) {}

  const Scheme& scheme() const override { return right_->scheme(); }
  void restart() override {
    right_->restart();
    half_->restart();
  }

  StepResult step(const SpringSystem& system, Motion motion, double h) override {
    switch (kind_) {
      case Wrong::does_nothing: return {};
      case Wrong::half_the_force: {
        const ChangedSystem changed(system, 0.5, 0.5, [](const Spring& s) {
          return Spring{s.rest_length, 0.5 * s.stiffness, 0.5 * s.damping};
        });
        return right_->step(changed.system, motion, h);
      }
      case Wrong::wrong_sign: {
        const ChangedSystem changed(system, 1.0, 1.0, [](const Spring& s) {
          return Spring{s.rest_length, -s.stiffness, s.damping};
        });
        return right_->step(changed.system, motion, h);
      }
      case Wrong::loses_damping: {
        const ChangedSystem changed(system, 1.0, 0.0, [](const Spring& s) {
          return Spring{s.rest_length, s.stiffness, 0.0};
        });
        return right_->step(changed.system, motion, h);
      }
      case Wrong::one_order_less: return enlarge_error(system, motion, h);
      case Wrong::as_if_unstretched: return linearise(system, motion, h);
      case Wrong::drifts: {
        const StepResult result = right_->step(system, motion, h);
        for (std::size_t i = 0; result.ok() && i < motion.x.size(); ++i) motion.x[i] *= 1 + 1e-6;
        return result;
      }
    }
    return {};
  }

 private:
  // A step and two of half the size differ by the error of the step, C h^(p+1); that over h omega is added to it.
  StepResult enlarge_error(const SpringSystem& system, Motion motion, double h) {
    std::vector<Vector3d> x(motion.x.begin(), motion.x.end()), v(motion.v.begin(), motion.v.end());
    StepResult result = right_->step(system, motion, h);
    half_->restart();
    for (int k = 0; k < 2 && result.ok(); ++k) result = half_->step(system, {x, v}, h / 2);
    if (!result.ok()) return result;
    const double theta = std::min(1.0, h * frequency_bound(system)), factor = theta > 0.0 ? 1.0 / theta : 1.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      motion.x[i] += factor * (motion.x[i] - x[i]);
      motion.v[i] += factor * (motion.v[i] - v[i]);
    }
    return result;
  }

  // The velocities are changed by the difference of linearised springs from the true ones: k d.(dx - L d) along d, the
  // direction at the start of the run.
  StepResult linearise(const SpringSystem& system, Motion motion, double h) {
    if (along_.size() != system.springs.size()) {
      along_.clear();
      for (const SpringEnds& ends : system.ends) {
        const Vector3d line = motion.x[ends[1]] - motion.x[ends[0]];
        along_.push_back(line.isZero(0.0) ? line : Vector3d(line / line.norm()));
      }
    }
    std::vector<Vector3d> extra(motion.x.size(), Vector3d::Zero());
    for (std::size_t e = 0; e < along_.size(); ++e) {
      const auto [a, b] = system.ends[e];
      const Spring s = system.springs[e];
      const Vector3d line = motion.x[b] - motion.x[a];
      const double length = line.norm();
      if (length == 0.0) continue;
      const Vector3d pull =
          s.stiffness * ((line.dot(along_[e]) - s.rest_length) * along_[e] - (length - s.rest_length) / length * line);
      extra[a] += pull;
      extra[b] -= pull;
    }
    const StepResult result = right_->step(system, motion, h);
    for (std::size_t i = 0; result.ok() && i < extra.size(); ++i)
      if (!system.fixed[i]) motion.v[i] += h * system.inverse_mass[i] * extra[i];
    return result;
  }

  Wrong kind_;
  std::unique_ptr<Integrator> right_, half_;
  std::vector<Vector3d> along_;
};

// An entry makes its integrator by a plain function: one for each way of being wrong and each place in the table.
using MakeFunction = std::unique_ptr<Integrator> (*)();
constexpr std::size_t most_integrators = 32;

template <std::size_t kind, std::size_t place>
std::unique_ptr<Integrator> make_at() {
  return make_wrong(kinds[kind].kind, integrators()[place].name);
}
template <std::size_t kind, std::size_t... places>
constexpr std::array<MakeFunction, sizeof...(places)> functions_of(std::index_sequence<places...>) {
  return {make_at<kind, places>...};
}
template <std::size_t... wrongs>
constexpr auto all_functions(std::index_sequence<wrongs...>) {
  return std::array{functions_of<wrongs>(std::make_index_sequence<most_integrators>())...};
}

}  // namespace

std::span<const WrongIntegrator> wrong_integrators() { return kinds; }

IntegratorEntry wrong_entry(Wrong kind, std::string_view integrator) {
  static constexpr auto functions = all_functions(std::make_index_sequence<kinds.size()>());
  const auto wrong = std::ranges::find(kinds, kind, &WrongIntegrator::kind);
  const auto place = std::ranges::find(integrators(), integrator, &IntegratorEntry::name);
  if (place == integrators().end()) throw InputError("there is no integrator of this name to be wrong");
  return {place->name, functions[static_cast<std::size_t>(wrong - kinds.begin())]
                                [static_cast<std::size_t>(place - integrators().begin())]};
}

std::unique_ptr<Integrator> make_wrong(Wrong kind, std::string_view integrator) {
  return std::make_unique<Faulty>(kind, integrator);
}

}  // namespace dartboard
