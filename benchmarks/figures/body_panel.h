#pragma once
// The facets of bodies and obstacles as pictures show them.

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "benchmarks/figures/frame_facets.h"
#include "benchmarks/figures/picture_view.h"
#include "core/contact/obstacle.h"

namespace dartboard {

/// How a scene is shown, the same at all times.
struct Look {
  PictureView view{};
  ColourBy colour = ColourBy::component;
  std::vector<Obstacle> obstacles{};
};

/// A colour, 0xrrggbb, as it is in more or less light.
std::uint32_t lit(std::uint32_t colour, double light);

/// A polygon, a line, or a dot.
struct DrawnFacet {
  static constexpr double no_value = FrameValues::none;

  std::vector<Eigen::Vector3d> corners{};  // [m] as seen; two of them: a line, one: a dot
  std::uint32_t base = 0;                  // its colour, 0xrrggbb, in full light
  double light = 1.0;
  double value = no_value;  // of the quantity by which it is coloured, in place of `base`
  enum class Of : std::uint8_t { body, side_of_obstacle, ball } of = Of::body;
  bool outline = false;  // drawn as its border alone

  std::uint32_t colour() const { return lit(base, light); }
};

/// Bodies at one time.
struct BodyPanel {
  double time = 0.0;  // [s]
  std::vector<DrawnFacet> facets{};
  Eigen::AlignedBox3d reach{};  // [m] of the bodies, along the axes of the scene
  Eigen::AlignedBox2d box{};    // [m] of the facets as seen
  std::string unit{};           // of values, if facets have any

  bool is_empty() const { return reach.isEmpty(); }
};

/// Colours that a legend explains.
namespace colours {
inline constexpr std::uint32_t inside = 0xc8503c, held = 0x303030, driven = 0xd0208f, held_in_part = 0x8a8a8a,
                               attached = 0x1f7a3a, obstacle = 0xd3d3d3;
/// Of components and materials, which begin again after the last.
inline constexpr std::array numbers{0x7ba7d9u, 0xe0b15au, 0x86bf7cu, 0xb18cc8u, 0x5fb8b3u, 0xd98ba5u, 0xa8a878u};
}  // namespace colours

}  // namespace dartboard
