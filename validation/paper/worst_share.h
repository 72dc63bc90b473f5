#pragma once
// The largest deviation relative to its bound.

namespace dartboard {

/// For a quantity with an expected value: the largest deviation over its bound, NaN kept.
class WorstShare {
 public:
  void compare(double is, double should_be, double bound);
  bool within() const { return share_ <= 1.0; }
  double share() const { return share_; }

 private:
  double share_ = 0.0;
};

}  // namespace dartboard
