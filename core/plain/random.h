#pragma once
// Random numbers that are the same on every platform, for meshes, tests and fuzzers.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

namespace dartboard {

/// Pseudo-random numbers, equal everywhere: the generator splitmix64 of Steele, Lea and Flood (OOPSLA 2014).
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  /// One of 0 .. n - 1; for n far below 2^64, equally likely to the accuracy of a test.
  /// pre  n > 0
  std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>(next() % n); }
  /// A multiple of 2^-52 in [-1, 1), all equally likely.
  double next_signed();
  /// A point of the open unit ball, uniform by volume: points of the cube are drawn until one is inside.
  Eigen::Vector3d next_in_ball();
  template <class Archive>
  void state(Archive& archive) {
    archive(state_);
  }

 private:
  std::uint64_t state_;
};

}  // namespace dartboard
