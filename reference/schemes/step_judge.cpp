#include "reference/schemes/step_judge.h"

#include <fmt/format.h>

#include "core/plain/error.h"
#include "reference/schemes/implicit_schemes.h"
#include "reference/schemes/local_global_witness.h"
#include "reference/schemes/network_state.h"
#include "reference/schemes/rosenbrock_witness.h"
#include "reference/schemes/step_comparison.h"

namespace dartboard::reference {

StepJudge::StepJudge(std::string_view scheme, const SpringNetwork& network) : scheme_(scheme), network_(network) {
  check(network_);
  if (is_explicit_scheme(scheme)) {
    in_double_ = std::make_unique<ExplicitScheme<double>>(scheme_, network_);
    witness_ = std::make_unique<ExplicitScheme<long double>>(scheme_, network_);
  } else if (!is_implicit_scheme(scheme) && scheme != "ros2" && scheme != "local-global") {
    throw InputError(fmt::format("there is no witness for a scheme '{}'", scheme));
  }
}

StepJudgement StepJudge::judge(const TakenStep& step) const {
  if (is_implicit_scheme(scheme_)) return judge_implicit_step(scheme_, network_, step);
  if (scheme_ == "ros2") return judge_rosenbrock(network_, step);
  if (scheme_ == "local-global") return judge_local_global(network_, step);
  std::vector<double> rounded = vector_of<double>(step.before);
  in_double_->step(rounded, step.h);
  return compare_step(network_, step, [&](std::vector<Extended>& y) { witness_->step(y, step.h); },
                      {std::vector<Extended>(rounded.begin(), rounded.end())});
}

bool is_costly_to_judge(std::string_view scheme) {
  return scheme == "ros2" || scheme == "local-global" || scheme == "baraff-witkin";
}

}  // namespace dartboard::reference
