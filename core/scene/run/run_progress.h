#pragma once
// The record of what a run has handed out: all of its summary that is not in its last state.

#include <cmath>

#include "core/plain/nan_maximum.h"
#include "core/scene/body/diagnostics.h"

namespace dartboard {

/// The largest change of the total energy, over the largest sum of kinetic and elastic energy.
class EnergyDrift {
 public:
  EnergyDrift() = default;
  explicit EnergyDrift(const Diagnostics& first) : start_(first.energy()) { add(first); }
  void add(const Diagnostics& d) {
    change_ = max_or_nan(change_, std::abs(d.energy() - start_));
    size_ = max_or_nan(size_, d.kinetic + d.elastic);
  }
  double value() const { return change_ == 0.0 ? 0.0 : change_ / size_; }
  template <class Archive>
  void state(Archive& archive) {
    archive(start_, change_, size_);
  }

 private:
  double start_ = 0.0, change_ = 0.0, size_ = 0.0;
};

/// The progress in rows and frames that were due; those handed out only because of an interruption do not count.
struct RunProgress {
  Diagnostics first, last;
  EnergyDrift drift;
  double frame_time = 0.0, diagnostics_time = 0.0;  // [s] when the last of each was
  template <class Archive>
  void state(Archive& archive) {
    archive(first, last, drift, frame_time, diagnostics_time);
  }
};

}  // namespace dartboard
