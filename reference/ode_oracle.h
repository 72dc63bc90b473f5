#pragma once
// Certified trajectories: the motion of a spring network as two codes find it, independent ones if available, and how
// far they agree.

#include <cstdint>
#include <string>
#include <vector>

#include "reference/ode_codes.h"

namespace dartboard::reference {

/// One code compared with the reference.
struct CodeAgreement {
  std::string code;
  double distance = 0.0;  // from the reference: max over checkpoints of E_x (error_norms.h) [mean edge lengths]
  std::uint64_t evaluations = 0;
  double cpu_s = 0.0;
  std::string failure;  // the reason why it has no result; empty when it has one
};

struct CertifyOptions {
  double accepted = 2e-13;        // largest distance of the codes [mean edge lengths]
  double step_times_rate = 0.25;  // of the coarser of two runs of Odeint; the finer has 0.7 times that
  int refinements = 6;            // how often both may be refined, by 0.7, until they agree
  double relative = 1e-13;        // tolerance of the codes of SUNDIALS
  bool extrapolation = false;     // run Bulirsch-Stoer too, which is more accurate than codes in double
  bool all_codes = true;          // false: stop at the first code that suffices
  bool gain = true;               // run the twin
};

/// The reference of a scene.
struct CertifiedMotion {
  std::vector<PointState> states;     // at the checkpoints, by the points of their interval's network
  std::vector<std::size_t> interval;  // by checkpoint: the number of its network
  double edge = 1.0;                  // mean rest length at the start [m]
  // The two finest runs of Odeint agree, and so does a code of SUNDIALS (without SUNDIALS: the extrapolation).
  bool accepted = false;
  bool independent = false;      // one of the other codes that agree is from a library other than the reference's
  double self_difference = 0.0;  // of the two finest runs of Odeint [mean edge lengths]
  double agreement = 0.0;        // the smallest distance of any other code; infinite when all failed
  // Errors below this are not measured: 100 times the known error of the reference, which is the larger of the
  // agreement and the share of the self-difference for the finest run; at least 10 times the rounding of `states`.
  double floor = 0.0;
  std::vector<double> gain;          // at each checkpoint: growth of a disturbance of 1e-12 edges; empty without twin
  std::vector<CodeAgreement> codes;  // Odeint's runs from the coarsest to the reference, then the others

  double largest_gain() const;
};

/// Certify the motion: Odeint's finest run is the reference, and another code must find the same.
///
/// The others are ARKODE, CVODE and, if asked for or without SUNDIALS, Odeint's Bulirsch-Stoer extrapolation: a method
/// of another kind than Runge-Kutta, but from the same library.
/// throws  as check(motion)
CertifiedMotion certify(const NetworkMotion& motion, const CertifyOptions& options = {});

/// A state of a run in doubles.
PointState to_points(const std::vector<long double>& y);

/// The distance of two runs that have states: the largest over the checkpoints [mean edge lengths]; NaN
/// stays.
double distance(const NetworkMotion& motion, const CodeRun& a, const CodeRun& b, double edge);

/// E_x (error_norms.h) of two states of a network, in units of `edge`. NaN if a number is not finite.
double position_distance(const SpringNetwork& network, const std::vector<long double>& a,
                         const std::vector<long double>& b, double edge);

}  // namespace dartboard::reference
