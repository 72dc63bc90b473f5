#pragma once
// Random draws for scenes, and numbers as a user writes them.

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "core/plain/random.h"

namespace dartboard {

/// Random draws, one after another; those of one number do not depend on the others.
class Draw {
 public:
  Draw(std::uint64_t seed, std::uint64_t number) : random_(seed * 1000003 + number) { random_.next(); }

  double uniform(double low, double high) { return low + (high - low) * 0.5 * (random_.next_signed() + 1.0); }
  double logarithmic(double low, double high) { return low * std::pow(high / low, uniform(0.0, 1.0)); }
  bool happens(double probability) { return uniform(0.0, 1.0) < probability; }
  std::uint32_t below(std::size_t n) { return random_.below(n); }
  /// One of low .. high.
  /// pre  0 <= low <= high
  int whole(int low, int high) {
    return low + static_cast<int>(below(static_cast<std::size_t>(high) + 1 - static_cast<std::size_t>(low)));
  }
  Eigen::Vector3d direction() {
    Eigen::Vector3d d(0, 0, 0);
    while (!(d.norm() > 0.1)) d = random_.next_in_ball();
    return d.normalized();
  }

 private:
  SplitMix64 random_;
};

/// As in a file: with six digits, which are all that anybody writes.
inline double written(double x) { return std::stod(fmt::format("{:.6g}", x)); }
inline nlohmann::ordered_json json_of(const Eigen::Vector3d& v) {
  return {written(v.x()), written(v.y()), written(v.z())};
}
inline nlohmann::ordered_json plane_of(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  return {{"point", json_of(point)}, {"normal", json_of(normal)}};
}

}  // namespace dartboard
