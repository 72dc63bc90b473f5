#pragma once
// What `dartboard recommend --audit` follows: scenes and errors drawn from a seed.

#include <cstdint>
#include <vector>

#include "core/plain/random.h"
#include "validation/scenes/tradeoff_scenes.h"

namespace dartboard {

/// What is done beside following the recommendations.
enum class AuditCheck { reference_and_sweep, reference, costs_only };

struct AuditCase {
  TradeoffScene scene;
  std::vector<double> errors;  // [edges]
  AuditCheck check = AuditCheck::reference_and_sweep;
};

/// [s] How long a run of the sweep may take beside picks of which the dearest is predicted to take that long. What
/// takes longer cannot be cheaper than it, but steps are powers of two.
double longest_sweep_run(double dearest_pick_s);

/// The cases of an audit, one after the other: scenes that a reference and a sweep can follow; longer ones without a
/// sweep, and without a reference by other codes; at last one whose costs alone can be told. With `quick` a few small
/// ones of the first kind.
class AuditCases {
 public:
  AuditCases(std::uint64_t seed, bool quick);

  std::uint64_t size() const;
  /// pre     fewer than size() were drawn
  AuditCase next();

 private:
  std::uint64_t seed_;
  bool quick_;
  SplitMix64 random_;
  std::uint64_t drawn_ = 0;
};

}  // namespace dartboard
