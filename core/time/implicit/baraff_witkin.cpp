#include "core/time/implicit/baraff_witkin.h"

#include "core/time/implicit/implicit_amplification.h"

namespace dartboard {
namespace {

const Scheme scheme_of_baraff_witkin{
    .name = "baraff-witkin",
    .what = "linearly implicit Euler (one Newton iteration)",
    .order = 1,
    .stages = 1,
    .implicit = true,
    .linearized = true,
    .imaginary_limit = Scheme::unlimited,
    .amplification = backward_euler_amplification,
    .source = "Baraff, Witkin: Large steps in cloth simulation, 1998",
};

}  // namespace

const Scheme& BaraffWitkin::scheme() const { return scheme_of_baraff_witkin; }

StepResult BaraffWitkin::step(const SpringSystem& system, Motion motion, double h) {
  const std::size_t n = motion.x.size();
  end_.resize(n);
  right_.resize(n);
  solution_.resize(n);
  StepSolver& solver = stage_.solver();
  solver.begin_step(work_);
  // Fixed vertices may move: the springs are taken where those will be.
  for (std::size_t i = 0; i < n; ++i) {
    end_.v[i] = system.fixed[i] ? motion.v[i] : Eigen::Vector3d(0, 0, 0);
    end_.x[i] = motion.x[i] + h * end_.v[i];
  }
  const TangentsAt tangents{[this, &system](Compression compression, std::vector<SpringTangent>& result) {
                              evaluate_tangents(system, end_.x, compression, result);
                            },
                            {end_.x}};
  accelerations(system, terms_.of(system), end_.x, end_.v, right_);
  ++work_.force_evaluations;
  for (std::size_t i = 0; i < n; ++i)
    right_[i] =
        system.fixed[i] ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(system.mass[i] * (motion.v[i] + h * right_[i]));
  ++work_.newton_iterations;
  SolveStatus status = SolveStatus::not_factored;
  for (bool again = true; again;) {
    again = false;
    status = solver.prepare(system, tangents, h, work_);
    if (status == SolveStatus::ok) status = solver.solve(right_, solution_, Accuracy::full, work_);
    if (status == SolveStatus::not_positive_definite && !solver.is_projecting()) {
      solver.project(work_);
      again = true;
    }
  }
  if (status != SolveStatus::ok) return fail(diagnosis_of(status, solver));
  for (std::size_t i = 0; i < n; ++i) {
    if (!system.fixed[i]) end_.v[i] = solution_[i];
    end_.x[i] = motion.x[i] + h * end_.v[i];
  }
  return end_.commit(motion, work_);
}

}  // namespace dartboard
