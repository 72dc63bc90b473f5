#pragma once
// Pictures of a body as it moves: the effect of a scene, seen from the side, drawn by gnuplot.

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/scene/body/frame.h"

namespace dartboard {

/// A body at a few times, side by side.
struct BodyStrip {
  std::vector<Frame> panels;
  std::string title;
};

/// A facet of the surface as it is drawn: corners in the plane of the picture, and its colour.
struct DrawnFacet {
  std::vector<Eigen::Vector2d> corners;  // [m]; two of them: a line
  double depth = 0.0;                    // of the middle of the facet, towards the viewer
  std::uint32_t colour = 0;              // 0xrrggbb
};

/// The bodies turned so that `up` is z, which pictures show upwards; unchanged if `up` is z already, or zero.
std::vector<Frame> upright(std::span<const Frame> panels, const Eigen::Vector3d& up);

/// The visible facets of a body, from the front, a little from the right and above, z upwards: its boundary, the
/// farthest facet first. Each component has its own colour; facets that were inside the body of `first` have another.
std::vector<DrawnFacet> drawn_facets(const Frame& panel, const Frame& first);

/// The extent of a body in the plane of the picture [m]; empty for an empty body.
Eigen::AlignedBox2d seen_box(const Frame& panel);

/// The properties that pictures of one body at several times have in common.
struct PictureArea {
  Eigen::AlignedBox2d all;     // [m] the extent of the body over all times
  Eigen::Vector2d size{0, 0};  // [m] of each picture
  bool follows = false;        // the body moves far beyond its size, and each picture has it in the middle

  Eigen::Vector2d centre_of(const Eigen::AlignedBox2d& box) const {
    return follows && !box.isEmpty() ? box.center() : all.center();
  }
};
/// A body that looks flat from this side still gets some room: `thinnest` of the larger extent.
PictureArea picture_area(std::span<const Eigen::AlignedBox2d> boxes, double thinnest);

/// Facets as gnuplot's polygons, each with a darker rim, moved by `shift` [m], for so many pixels per metre.
std::string polygons_of(std::span<const DrawnFacet> facets, const Eigen::Vector2d& shift, double pixels);

/// Draw bodies side by side at one scale, each with its time; `name`.png, `name`.svg, and the data and script they are
/// drawn from.
///
/// Where the body moves far beyond its size, each panel follows it.
/// returns a sentence on what went wrong, as `draw` does
/// throws  IoError when the files cannot be written
std::string draw_bodies(std::span<const Frame> panels, const std::string& title, const std::filesystem::path& folder,
                        const std::string& name, const std::string& gnuplot = "gnuplot");

inline std::string draw(const BodyStrip& strip, const std::filesystem::path& folder, const std::string& name) {
  return draw_bodies(strip.panels, strip.title, folder, name);
}

}  // namespace dartboard
