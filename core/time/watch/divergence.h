#pragma once
// A check in the step loop that ends a run whose energy exceeds what the system could supply, before anything
// overflows.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/base/bytes.h"
#include "core/time/method/integrator.h"

namespace dartboard {

/// Compares the energy of the motion with the energy that was available for it.
///
/// Forces do work from an elastic energy that is never negative, from gravity, and from vertices that are driven; the
/// rest dissipates. So kinetic energy stays below T_0 + V_0 plus the work of gravity and of driven vertices, and so
/// does the energy of any springs. The work of driven vertices is summed after every step, by the trapezoidal rule,
/// over the springs that end at them, and so is that of terms without an energy. An unstable motion raises that work in
/// proportion to its amplitude, and its own energy with the square of it, so the work cannot mask it. Compared are the
/// kinetic energy and the energy of a sample of springs that rotates: an overdamped instability grows without moving
/// fast. Exact sums are skipped where an upper bound suffices: the largest mass times the sum of the squared speeds,
/// compared with the supply without gravity. A stable method may exceed it: Verlet's and symplectic Euler's oscillate
/// by 1 / (1 - theta^2 / 4). More than `gain` times the energy available, that is a tenfold amplitude, is no
/// oscillation of a stable one below 0.99 of its limit.
///
/// An energy that stays above the bound is found within 16 steps where the velocities or the sampled springs show it,
/// and within 64 where they only suggest it (`suspicion`): then all springs are summed. An unstable step needs
/// ln(10 / share of the unstable oscillation) / ln(growth per step) steps to bring the energy above the bound.
///
/// Sums, never maxima: a sum with a NaN in it is NaN.
class DivergenceDetector {
 public:
  static constexpr double gain = 100;               // in energy
  static constexpr std::uint64_t check_steps = 16;  // between checks; after a start 1, 2, 4, 8
  static constexpr std::uint64_t keep_steps = 64;   // between states kept
  static constexpr double suspicion = 10;           // in energy; stable runs below 0.94 of their limit have less
  static constexpr std::uint64_t all_steps = 48;    // between two sums over all springs that are made on suspicion
  static constexpr std::size_t spring_share = 32;   // one spring of so many is sampled, but at least 8 if there are 8

  /// A run starts here, with steps of h [s]. The state is kept.
  /// returns  nonfinite if the state, a mass or a spring is not finite; then there is no state to go back to
  /// cost     a force evaluation
  StepResult start(const SpringSystem& system, Motion motion, double h);

  /// The system has changed between two steps. The available energy is reset to the present energy, capped by the old
  /// bound: a run with a change after every step is watched like any other.
  ///
  /// cost  a force evaluation
  StepResult system_changed(const SpringSystem& system, Motion motion);

  /// Adds work [J] done on the body since the last step by forces that the system does not have: by moving obstacles.
  void add_work(double work);

  /// After each step: ok, unstable_step, or nonfinite, with the vertex that has most of the energy, or is not finite.
  StepResult after_step(const SpringSystem& system, Motion motion);

  /// Checks with all springs: for the end of a run, which may lie between two checks.
  /// cost  a force evaluation
  StepResult check_all(const SpringSystem& system, Motion motion);

  /// Adds to a diagnosis nonfinite without a witness the vertex or the spring that is not finite, if there is one.
  StepResult with_witness(const StepResult& result, const SpringSystem& system, Motion motion) const;

  /// Put the motion back to the state kept last: the start, the state after the last change, or a later one whose
  /// kinetic energy was not above twice the energy available.
  /// returns  how many steps ago it was
  std::uint64_t restore(Motion motion) const;

  /// Writes or reads what later verdicts depend on, and the state kept.
  template <class Archive>
  void state(Archive& archive) {
    archive(step_, energy_, gravity_, small_, heaviest_, driven_, driven_springs_, driven_pieces_);
    archive(power_, work_, most_work_);
    archive(first_spring_, since_start_, next_check_, since_kept_, checks_, since_all_, kept_x_, kept_v_);
  }

  std::uint64_t checks() const { return checks_; }
  /// Is the state kept last the present one?
  bool has_just_kept() const { return since_kept_ == 0; }
  std::size_t bytes() const { return bytes_of(kept_x_, kept_v_); }
  /// Bytes of the lists of driven vertices and of the springs at them.
  std::size_t driven_bytes() const { return bytes_of(driven_, driven_springs_); }
  std::size_t driven_springs() const { return driven_springs_.size(); }

 private:
  struct Sums {
    double kinetic;
    double gravity;  // - sum of m (g + p).x, with what pulls at each vertex
    bool finite;
  };
  Sums sums(const SpringSystem& system, Motion motion) const;
  double available(const Sums& now) const;
  double supply() const { return energy_ + small_ + most_work_; }  // available energy without the work of gravity
  void find_driven(const SpringSystem& system, Motion motion);
  double power(const SpringSystem& system, Motion motion);
  double energy_of_some(const SpringSystem& system, Motion motion);
  StepResult begin(const SpringSystem& system, Motion motion, double ceiling);
  StepResult diagnose(const SpringSystem& system, Motion motion) const;
  void keep(Motion motion);

  double step_ = 0.0;
  double energy_ = 0.0;    // [J] kinetic and elastic, at the start
  double gravity_ = 0.0;   // [J] of gravity, at the start
  double small_ = 0.0;     // [J] what rounding, the first step of gravity, and driven vertices may supply
  double heaviest_ = 0.0;  // [kg] the largest mass
  std::vector<std::uint32_t> driven_, driven_springs_;  // vertices, and the springs at them that may change in length
  std::vector<std::vector<std::uint32_t>> driven_pieces_;  // by force term: those with a driven vertex
  std::vector<Eigen::Vector3d> driven_velocity_;           // of all vertices, zero where not driven
  double power_ = 0.0, work_ = 0.0, most_work_ = 0.0;  // [W] now, [J] of drives and loads since the run began, its peak
  std::size_t first_spring_ = 0;
  std::uint64_t since_start_ = 0, next_check_ = 1, since_kept_ = 0, checks_ = 0;
  std::uint64_t since_all_ = 0;  // steps since the last sum over all springs
  std::vector<Eigen::Vector3d> kept_x_, kept_v_;
};

}  // namespace dartboard
