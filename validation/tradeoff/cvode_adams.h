#pragma once
// SUNDIALS' CVODE as a contender: Adams methods of orders 1 to 12 on the core's forces.

#include <memory>

#include "core/time/method/integrator.h"

namespace dartboard {

/// The best general-purpose code for smooth motions, with fixed-point iteration, in the state-of-the-art setting; it is
/// here to be compared with, and is not one of `integrators()`. Its absolute tolerances are those of `Tolerance`; its
/// relative one is 0, as for our own adaptive method.
class CvodeAdams : public AdaptiveIntegrator {
 public:
  CvodeAdams();
  ~CvodeAdams() override;

  const Scheme& scheme() const override;
  /// Always fails: it has no fixed steps.
  StepResult step(const SpringSystem& system, Motion motion, double h) override;
  StepResult advance(const SpringSystem& system, Motion motion, double duration, const Tolerance& tolerance) override;
  void restart() override;

  static bool available();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace dartboard
