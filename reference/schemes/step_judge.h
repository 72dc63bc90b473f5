#pragma once
// Checks one step of an integrator against an independent implementation of its scheme in extended precision.

#include <memory>
#include <string>
#include <string_view>

#include "reference/schemes/explicit_schemes.h"
#include "reference/schemes/taken_step.h"

namespace dartboard::reference {

/// Judges single steps of one method on one network, from the state that each of them started from: so neither chaos
/// nor instability gets between the step and its judgement, and a run of any length can be sampled.
///
/// Explicit methods are taken again, in `long double` and, for the effect of rounding, in double and from disturbed
/// states (`compare_step`). The result of an implicit method is put into its equations; methods that stop before these
/// are solved, or whose stages cannot be found from the result, are taken again by dense factors.
/// cost  some six steps in extended precision; dense methods the cube of the number of points
class StepJudge {
 public:
  /// throws  InputError for a name that no scheme has, and as check(network)
  StepJudge(std::string_view scheme, const SpringNetwork& network);
  StepJudge(const StepJudge&) = delete;
  StepJudge& operator=(const StepJudge&) = delete;

  StepJudgement judge(const TakenStep& step) const;

 private:
  std::string scheme_;
  SpringNetwork network_;
  std::unique_ptr<const ExplicitScheme<double>> in_double_;  // null for an implicit method
  std::unique_ptr<const ExplicitScheme<long double>> witness_;
};

/// Does a judgement of this scheme cost a dense factor?
bool is_costly_to_judge(std::string_view scheme);

}  // namespace dartboard::reference
