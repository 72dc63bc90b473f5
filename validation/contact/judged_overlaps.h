#pragma once
// Overlaps found by other code, and whether a body feels them.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/contact/body_contact.h"
#include "reference/cgal/overlaps.h"

namespace dartboard {

using CellCorners = std::array<std::uint32_t, 4>;

/// Two cells that overlap, and whether contact is felt there.
struct JudgedOverlap {
  reference::Overlap overlap;  // of cells by number
  bool felt = false;
};

/// All overlaps of tetrahedra that may touch and are no neighbours: no corner of one is in a cell with a corner of the
/// other, as within a body that is bent, or around the tip of a cut. An overlap is felt if a sample at a corner of one
/// of the two is in contact with a tetrahedron at a corner of the other, or out of reach there.
///
/// pre     the contact is of a body of these tetrahedra at x; `may_touch` answers for two cells
/// cost    that of reference::overlaps, and O(overlaps, contacts, cells)
std::vector<JudgedOverlap> judged_overlaps(const BodyContact& contact, std::span<const Eigen::Vector3d> x,
                                           std::span<const CellCorners> tetrahedra,
                                           const std::function<bool(std::uint32_t, std::uint32_t)>& may_touch);

/// Numbers of overlaps by depth, and how many of these no body feels.
struct OverlapTally {
  static constexpr std::size_t classes = 10;
  std::array<std::size_t, classes> overlaps{}, missed{};  // the last: of that depth and above
  double deepest = 0.0;                                   // share of the unit
  double deepest_missed = 0.0;

  /// Add one that is that deep, as a share of a unit that has `classes` / 2 classes.
  void add(double share, bool felt);
  void add(const OverlapTally& other);
  std::size_t count() const;
  std::size_t count_missed() const;
};

}  // namespace dartboard
