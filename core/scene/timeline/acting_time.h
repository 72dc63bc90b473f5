#pragma once
// When a load acts, and with which sign; and the mean of that over a step.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace dartboard {

/// The time from one moment until another [s], in which the sign may change again and again. Times that differ by their
/// rounding alone are equal: a load that begins at a step boundary acts in the whole step.
struct ActingTime {
  struct Part {
    double begin, end;
  };

  double from = 0.0, until = std::numeric_limits<double>::infinity();
  std::optional<double> reverse_every{};  // [s] from `from` on

  /// Is a before b, by more than the rounding of times of steps (step_at)?
  static bool is_before(double a, double b) { return a < (1.0 - 0x1p-51) * b; }

  bool overlaps(const ActingTime& other) const { return is_before(from, other.until) && is_before(other.from, until); }
  /// What is within it of the time between two moments; no value for nothing.
  std::optional<Part> part_of(double begin, double end) const {
    const Part part{is_before(begin, from) ? from : begin, is_before(until, end) ? until : end};
    return is_before(part.begin, part.end) ? std::optional(part) : std::nullopt;
  }
  /// The mean of the sign between two moments, 0 where it does not act: exactly 1 or -1 where nothing changes.
  double mean_sign(double begin, double end) const {
    const auto part = part_of(begin, end);
    if (!part) return 0.0;
    const double share = (part->end - part->begin) / (end - begin);
    if (!reverse_every) return share;
    const double turns = turns_until(part->begin);
    if (turns == turns_before(part->end)) return is_odd(turns) ? -share : share;
    return (way(part->end) - way(part->begin)) / (end - begin);
  }
  /// The first moment between two others at which it begins, turns back or ends.
  std::optional<double> next_between(double begin, double end) const {
    if (is_before(begin, from)) return is_before(from, end) ? std::optional(from) : std::nullopt;
    double next = until;
    if (reverse_every && is_before(begin, until))
      next = std::min(next, from + (turns_until(begin) + 1.0) * *reverse_every);
    return is_before(begin, next) && is_before(next, end) ? std::optional(next) : std::nullopt;
  }

 private:
  static bool is_odd(double turns) { return std::fmod(turns, 2.0) != 0.0; }
  /// How often the sign has changed at this time, that change included.
  double turns_until(double time) const {
    const double nearest = std::round((time - from) / *reverse_every), turn = from + nearest * *reverse_every;
    return is_before(time, turn) ? nearest - 1.0 : nearest;
  }
  /// How often the sign has changed before this time.
  double turns_before(double time) const {
    const double turns = turns_until(time);
    return turns > 0.0 && !is_before(from + turns * *reverse_every, time) ? turns - 1.0 : turns;
  }
  /// [s] The integral of the sign from `from` on: there and back again.
  double way(double time) const {
    const double turns = turns_until(time), since = time - (from + turns * *reverse_every);
    return is_odd(turns) ? *reverse_every - since : since;
  }
};

/// The first moment between two others at which a load of a list begins, turns back or ends.
template <class Loads>
std::optional<double> first_between(const Loads& loads, double begin, double end) {
  std::optional<double> first;
  for (const auto& load : loads)
    if (const auto next = load.time.next_between(begin, first.value_or(end))) first = next;
  return first;
}

}  // namespace dartboard
