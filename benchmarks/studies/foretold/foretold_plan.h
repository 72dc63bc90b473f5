#pragma once
// What `dartboard recommend --audit --long` follows: long motions and errors, drawn from a seed.

#include <cstdint>
#include <vector>

#include "core/plain/random.h"
#include "validation/scenes/tradeoff_scenes.h"

namespace dartboard {

struct ForetoldCase {
  TradeoffScene scene;
  std::vector<double> errors;  // [edges]
};

/// Long motions of small bodies, of which pilots see a hundredth at most: some 1e5 / omega_max, thousands of the slow
/// periods. Strains and gravity are a fortieth of those of the other audit, and nothing is cut: chaotic motions have no
/// error to foretell, and what an event sets free shows in no pilot before it.
class ForetoldCases {
 public:
  ForetoldCases(std::uint64_t seed, bool quick);

  std::uint64_t size() const;
  /// [s] That pilots are granted for a recommendation.
  double budget_s() const;
  /// pre     fewer than size() were drawn
  ForetoldCase next();

 private:
  std::uint64_t seed_;
  bool quick_;
  SplitMix64 random_;
  std::uint64_t drawn_ = 0;
};

}  // namespace dartboard
