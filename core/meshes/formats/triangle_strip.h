#pragma once
// Strips of triangles, as PLY and VTK have them.

#include <array>
#include <cstddef>
#include <span>

namespace dartboard {

/// Calls add(corners) for each triangle of a strip: every point after the second makes one with the two before it, and
/// every other one is turned. One with a point twice, which only joins two strips, is left out.
template <class Number, class F>
void for_each_triangle(std::span<const Number> strip, const F& add) {
  for (std::size_t k = 2; k < strip.size(); ++k) {
    const bool is_turned = k % 2 == 1;
    const std::array corners{strip[is_turned ? k - 1 : k - 2], strip[is_turned ? k - 2 : k - 1], strip[k]};
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) add(corners);
  }
}

}  // namespace dartboard
