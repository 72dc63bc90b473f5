#pragma once
// Trials of the judges of integrators: their verdicts on wrong ones.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "validation/extremes/extremes.h"
#include "validation/judges/wrong_integrators.h"
#include "validation/order/convergence_order.h"

namespace dartboard {

/// Cases in which a judge called the sound integrator right, and its verdicts on one that is wrong in one way.
struct JudgeTrial {
  std::string judge, part;  // "extremes", and the axis; "order", and its scene
  Wrong kind = Wrong::does_nothing;
  std::size_t right = 0;              // cases
  std::size_t same = 0;               // of these, cases in which being wrong changes no more than a rounding a step
  std::size_t seen = 0;               // of the others: called wrong, or diagnosed
  std::size_t by_scheme = 0;          // of those seen: a step is not its scheme's
  std::vector<std::string> unseen{};  // the rest, each with the share of its bound that it takes up

  std::size_t asked() const { return right - same; }
  double share() const { return asked() == 0 ? 1.0 : static_cast<double>(seen) / static_cast<double>(asked()); }
};

/// The distance of sound runs from the bound of their scheme's steps.
struct SchemeSlack {
  std::string integrator;
  std::uint64_t runs = 0;
  double worst = 0.0;  // largest distance over bound
};

/// Tries cases of `extremes` one by one.
class ExtremesTrial {
 public:
  /// Runs the case with the sound integrator and, if that is called right, with each wrong one.
  void take(const ExtremeCase& which);

  std::vector<JudgeTrial> trials() const { return trials_; }
  std::vector<SchemeSlack> slack() const { return slack_; }

 private:
  std::vector<JudgeTrial> trials_;  // by axis, then by kind
  std::vector<SchemeSlack> slack_;
};

/// Are the ends of two runs of so many steps the same, but for a rounding of the largest number in each step?
bool same_but_for_rounding(const ExtremeCell& a, const ExtremeCell& b);

/// `validate order` on one of its scenes, for each of these methods that it judges right with the sound code.
std::vector<JudgeTrial> try_order(const OrderStage& stage, std::span<const IntegratorEntry> methods,
                                  const OrderOptions& options);

/// The comparison with the exact maps of methods that state one, on an oscillator; damped where `zeta` is above 0.
std::vector<JudgeTrial> try_exact_maps(double zeta, std::uint64_t steps);

}  // namespace dartboard
