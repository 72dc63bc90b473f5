#pragma once
// The 24 darts of a tetrahedron: a constant table, because they are the 24 permutations of its nodes.

#include <array>
#include <bit>
#include <cstdint>

namespace dartboard {

/// Local dart p = 6 f + r lies on the face f opposite node f; around the face, r = 2k and 2k + 1 are the two darts of
/// its k-th edge. So alpha_0 pairs (0,1)(2,3)(4,5), alpha_1 pairs (1,2)(3,4)(5,0), and alpha_2 swaps the two faces of
/// the edge. `add_cell` makes the darts of any cell in this order, so both storages number darts alike.
struct TetDarts {
  std::array<std::array<std::uint8_t, 24>, 3> alpha{};
  std::array<std::uint8_t, 24> node{};  // 0..3
  std::array<std::uint8_t, 24> edge{};  // 0..5: 01 02 03 12 13 23

  // Each set of involutions within the tetrahedron (bits 0..2) parts its darts into orbits, called blocks here. All the
  // blocks of a set are alike, because a permutation of the nodes takes any dart to any other.
  std::array<std::uint8_t, 8> block_size{}, exit_count{};
  std::array<std::array<std::array<std::uint8_t, 24>, 24>, 8> block{};  // block[set][p]: the darts of p's, ascending

  // One dart of the block, dart 6 face + r, for each way out by alpha_3; the other darts leave to the same blocks,
  // because alpha_0 and alpha_1 commute with alpha_3.
  struct Exit {
    std::uint8_t face, r;
  };
  std::array<std::array<std::array<Exit, 4>, 24>, 8> exits{};
  // The entry into the next block: turned[r][turn] is the dart of a face opposite dart r of a face sewn to it with that
  // turn (named by the image of dart 0); entry[set][r][8 f + turn] is the lowest dart of the block entered when that
  // face is f.
  std::array<std::array<std::uint8_t, 8>, 6> turned{};
  std::array<std::array<std::array<std::uint8_t, 32>, 6>, 8> entry{};

  constexpr std::uint8_t lowest(unsigned set, unsigned p) const { return block[set][p][0]; }
};

namespace detail {

constexpr std::uint32_t orbit_bits(const TetDarts& t, unsigned set, unsigned p) {
  std::uint32_t reached = 1u << p, frontier = reached;
  while (frontier != 0) {
    const auto q = static_cast<unsigned>(std::countr_zero(frontier));
    frontier &= frontier - 1;
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t next = 1u << t.alpha[i][q];
      if ((set >> i & 1u) != 0 && (reached & next) == 0) {
        reached |= next;
        frontier |= next;
      }
    }
  }
  return reached;
}

constexpr TetDarts make_tet_darts() {
  TetDarts t;
  constexpr int cycle[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};  // faces_of(tetrahedron)
  constexpr int edge_of[4][4] = {{-1, 0, 1, 2}, {0, -1, 3, 4}, {1, 3, -1, 5}, {2, 4, 5, -1}};
  int other_end[24] = {};
  for (int f = 0; f < 4; ++f)
    for (int r = 0; r < 6; ++r) {
      const std::size_t p = 6 * static_cast<std::size_t>(f) + static_cast<std::size_t>(r);
      const int here = cycle[f][(r / 2 + r % 2) % 3];
      const int there = cycle[f][(r / 2 + 1 - r % 2) % 3];
      t.node[p] = static_cast<std::uint8_t>(here);
      t.edge[p] = static_cast<std::uint8_t>(edge_of[here][there]);
      other_end[p] = there;
      t.alpha[0][p] = static_cast<std::uint8_t>(6 * f + (r ^ 1));
      t.alpha[1][p] = static_cast<std::uint8_t>(6 * f + (r % 2 == 1 ? (r + 1) % 6 : (r + 5) % 6));
    }
  for (std::size_t p = 0; p < 24; ++p)
    for (std::size_t q = 0; q < 24; ++q)
      if (p / 6 != q / 6 && t.node[p] == t.node[q] && other_end[p] == other_end[q])
        t.alpha[2][p] = static_cast<std::uint8_t>(q);

  for (unsigned set = 0; set < 8; ++set)
    for (unsigned p = 0; p < 24; ++p) {
      const std::uint32_t block = orbit_bits(t, set, p);
      std::uint8_t darts = 0, ways = 0;
      for (std::uint32_t rest = block; rest != 0; rest &= rest - 1)
        t.block[set][p][darts++] = static_cast<std::uint8_t>(std::countr_zero(rest));
      for (std::uint32_t open = block; open != 0;) {
        const auto q = static_cast<unsigned>(std::countr_zero(open));
        t.exits[set][p][ways++] = {static_cast<std::uint8_t>(q / 6), static_cast<std::uint8_t>(q % 6)};
        open &= ~orbit_bits(t, set & 3u, q);
      }
      t.block_size[set] = darts;
      t.exit_count[set] = ways;
    }

  // around the two faces the numbers run the same way (even turns) or against each other (odd ones)
  for (unsigned r = 0; r < 6; ++r)
    for (unsigned turn = 0; turn < 6; ++turn)
      t.turned[r][turn] = static_cast<std::uint8_t>((turn + (turn % 2 == 0 ? r : 6 - r)) % 6);
  for (unsigned set = 0; set < 8; ++set)
    for (unsigned r = 0; r < 6; ++r)
      for (unsigned in = 0; in < 32; ++in) t.entry[set][r][in] = t.lowest(set, 6 * (in / 8) + t.turned[r][in % 8]);
  return t;
}

}  // namespace detail

inline constexpr TetDarts tet_darts = detail::make_tet_darts();

}  // namespace dartboard
