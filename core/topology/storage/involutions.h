#pragma once
// Sets of involutions, and the orbits that section 2.1 names by them.

#include <bit>
#include <cstdint>
#include <initializer_list>

namespace dartboard {

/// A set {alpha_i}, one bit each; it names a kind of orbit, such as <alpha_0, alpha_1>.
struct Involutions {
  std::uint8_t bits = 0;

  constexpr Involutions() = default;
  constexpr Involutions(std::initializer_list<int> members) {
    for (int i : members) bits = static_cast<std::uint8_t>(bits | 1u << i);
  }
  static constexpr Involutions from_bits(unsigned b) {
    Involutions set;
    set.bits = static_cast<std::uint8_t>(b);
    return set;
  }
  constexpr bool contains(int i) const { return (bits >> i & 1u) != 0; }
  constexpr int size() const { return std::popcount(bits); }
  friend constexpr bool operator==(Involutions, Involutions) = default;
};

/// All of alpha_0 .. alpha_n: the orbit is a connected component.
constexpr Involutions all_involutions(int n) { return Involutions::from_bits((1u << (n + 1)) - 1u); }

/// All but alpha_i: the orbit is an i-cell of an n-g-map.
constexpr Involutions cell_involutions(int n, int i) {
  return Involutions::from_bits(all_involutions(n).bits & ~(1u << i));
}

/// The involutions that commute with alpha_i, {alpha_j, |i-j| >= 2}: the darts that an i-sew must treat alike.
constexpr Involutions sew_involutions(int n, int i) {
  unsigned bits = 0;
  for (int j = 0; j <= n; ++j)
    if (j + 2 <= i || i + 2 <= j) bits |= 1u << j;
  return Involutions::from_bits(bits);
}

}  // namespace dartboard
