#include "core/plain/random.h"

namespace dartboard {

std::uint64_t SplitMix64::next() {
  state_ += 0x9e3779b97f4a7c15u;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double SplitMix64::next_signed() { return static_cast<double>(next() >> 11) * 0x1p-52 - 1.0; }

Eigen::Vector3d SplitMix64::next_in_ball() {
  for (;;) {
    const double x = next_signed(), y = next_signed(), z = next_signed();  // named: arguments have no order
    if (x * x + y * y + z * z < 1.0) return {x, y, z};
  }
}

}  // namespace dartboard
