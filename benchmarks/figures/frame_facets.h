#pragma once
// The facets of a frame that can be seen from some side, and the properties that give them colours.

#include <cstdint>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/scene/body/frame.h"

namespace dartboard {

/// The quantity that gives the parts of bodies their colours.
enum class ColourBy { component, material, speed, stress, contact };

/// A polygon of a surface, or a face of a volume that belongs to one cell.
struct FrameFacet {
  std::vector<std::uint32_t> nodes;  // in order around it; of a volume, counterclockwise seen from outside
  std::size_t cell;
  bool was_inside = false;  // a body, at the start
};

/// The facets of one run.
class FrameFacets {
 public:
  using Key = std::vector<std::uint32_t>;

  explicit FrameFacets(const Frame& first);
  std::vector<FrameFacet> of(const Frame& frame) const;

 private:
  std::set<Key> skin_;  // the facets of the boundary at the start
};

/// A quantity by which the parts of a frame are coloured: stresses in one unit, of the cells of the highest dimension.
class FrameValues {
 public:
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  /// Of a frame that has the fields of the quantity; there are no values by component or material.
  FrameValues(ColourBy by, const Frame& frame);

  /// The mean of the corners of a facet of a cell of this dimension; none where it has none.
  double at(std::span<const std::uint32_t> nodes, int dimension) const;
  double at_link(std::size_t k) const;
  const std::string& unit() const { return unit_; }

 private:
  const Frame& frame_;
  std::vector<double> at_points_;
  int least_ = 0;  // the dimension of cells that have values, or more
  std::string unit_;
};

/// Gives each component of a body a number that stays with it: where it is divided, the largest part keeps the number,
/// and the others have new ones, larger parts first. In the first frame they are those of the frame.
class LastingComponents {
 public:
  /// By component of the frame.
  /// pre  frames come in the order of their times
  std::vector<std::uint32_t> of(const Frame& frame);

 private:
  std::unordered_map<std::uint64_t, std::uint32_t> before_;  // the number of the component of each cell
  std::uint32_t count_ = 0;
};

}  // namespace dartboard
