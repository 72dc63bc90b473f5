#pragma once
// A generalized map as plain numbers, with orbits and fans exactly as the paper defines them.

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <vector>

namespace dartboard::reference {

/// alpha[i][d] of every dart d; `no_dart` for a number that no dart has.
struct DartTable {
  static constexpr std::uint32_t no_dart = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::vector<std::uint32_t>> alpha;

  std::size_t size() const { return alpha.front().size(); }
  bool is_live(std::uint32_t d) const { return alpha.front()[d] != no_dart; }
  std::uint32_t operator()(int i, std::uint32_t d) const { return alpha[static_cast<std::size_t>(i)][d]; }
};

/// The orbits of these involutions (section 2.1) by union-find: for every dart the lowest one of its orbit.
std::vector<std::uint32_t> orbits(const DartTable& table, std::initializer_list<int> involutions);

/// The fan of section 5.1 around the vertex of d0, exactly as described: d0, then dart by dart by alpha_2, alpha_3,
/// alpha_2 and alpha_1 until d0 is met again, or the surface before alpha_3; then the same from alpha_1(d0), which is
/// not listed itself.
/// pre  the table is of a 3-g-map
struct PaperFan {
  std::vector<std::uint32_t> darts;
  bool closed;
};
PaperFan paper_fan(const DartTable& table, std::uint32_t d0);

}  // namespace dartboard::reference
