#pragma once
// The times at which an event is due, in steps.

#include <cstdint>
#include <limits>
#include <optional>

#include "core/scene/file/step_times.h"

namespace dartboard {

/// The step boundaries at which an event happens: those of the times from, from + every, from + 2 every .. until; or
/// without `every`, or if it is no longer than the step, all boundaries in between. Times between two boundaries belong
/// to the later one.
class EventClock {
 public:
  /// pre  0 <= from <= until; every > 0
  EventClock(double from, double until, std::optional<double> every, double step)
      : from_(from), until_(until), step_(step), time_(from), next_(step_of_time(from, step)) {
    if (every && *every > step) every_ = every;
  }

  /// The next step boundary; `never` after the last.
  std::uint64_t next() const { return next_; }
  /// [s] The time that `next` is the boundary for.
  double time() const { return time_; }
  /// [s] The same, if it lies between two boundaries; no value if it lies on one, and after the last.
  std::optional<double> time_between() const {
    if (next_ == never || step_at(time_, step_)) return {};
    return time_;
  }
  /// Advance from a time between two boundaries to the next time; without `every` that is the boundary itself.
  void advance_from_between() {
    if (every_) return advance();
    time_ = static_cast<double>(next_) * step_;
    if (next_ > step_until(until_, step_)) next_ = never;
  }
  /// Advance to the boundary after `next`.
  void advance() {
    if (!every_) {
      time_ = static_cast<double>(++next_) * step_;
      if (next_ > step_until(until_, step_)) next_ = never;
      return;
    }
    // a product, not a sum, so that rounding does not accumulate
    const double time = from_ + static_cast<double>(++count_) * *every_;
    next_ = time > until_ && !is_rounding_of_end(time) ? never : step_of_time(time, step_);
    time_ = time;
  }

  /// Go on where `until` has become later, as in a run that is continued for longer.
  void extend() {
    if (next_ == never && (time_ <= until_ || is_rounding_of_end(time_))) next_ = step_of_time(time_, step_);
  }

  /// Writes or reads the position of the clock; its times are those of the scene.
  template <class Archive>
  void state(Archive& archive) {
    archive(next_, count_, time_);
  }

  static constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();

 private:
  // 4 units of rounding: of `every`, `until`, the product and the sum
  bool is_rounding_of_end(double time) const { return time - until_ <= 0x1p-51 * until_; }

  double from_, until_;
  std::optional<double> every_;
  double step_, time_;
  std::uint64_t next_, count_ = 0;
};

}  // namespace dartboard
