#pragma once
// Pictures of bodies as they move: the effect of a scene, seen from the side, drawn by gnuplot.

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/figures/body_panel.h"

namespace dartboard {

/// Bodies at a few times, side by side.
struct BodyStrip {
  std::vector<BodyPanel> panels;
  Look look;
  std::string title;
};

/// The properties that pictures of the same bodies at several times have in common.
struct PictureArea {
  Eigen::AlignedBox2d all;     // [m] the extent of bodies and obstacles over all times
  Eigen::Vector2d size{0, 0};  // [m] of each picture
  bool follows = false;        // the bodies move far beyond their size, and each picture has them in the middle

  Eigen::Vector2d centre_of(const Eigen::AlignedBox2d& box) const {
    return follows && !box.isEmpty() ? box.center() : all.center();
  }
};
/// Panels with the obstacles, in one scale of colours, each in the order of depth.
struct Drawing {
  std::vector<BodyPanel> panels;
  PictureArea area;
  double largest = 0.0;  // of the values by which facets are coloured, from 0
};
/// Bodies that look flat from this side still get some room: `thinnest` of the larger extent.
Drawing drawing_of(std::span<const BodyPanel> panels, const Look& look, double thinnest);

/// Facets as gnuplot's polygons, each with a darker rim, moved by `shift` [m], for so many pixels per metre.
std::string polygons_of(std::span<const DrawnFacet> facets, const Eigen::Vector2d& shift, double pixels);

/// The area of a picture in metres, as large as its pixels are.
struct Canvas {
  double pixels = 1.0;  // per metre
  int width = 0, height = 0;
  Eigen::Vector2d low{0, 0};  // [m] the lower left corner

  /// The place [m] so many pixels to the right of the lower left corner and above it.
  Eigen::Vector2d at(double right, double up) const { return low + Eigen::Vector2d(right, up) / pixels; }
};
/// A canvas with a title above, and below the times of its pictures, a scale bar and the meanings of colours.
struct Sheet {
  static constexpr double head = 42, times = 25;  // [pixels]

  Canvas canvas;
  double font;           // [points] of the title
  double up_to_times{};  // [pixels] from the lower border
  std::string commands{};

  /// The command that writes a panel's time under the middle [m] of its picture.
  std::string time_of(const BodyPanel& panel, int tag, double middle) const;
};
/// For pictures of the drawing's size around `middle` [m], at so many pixels per metre.
Sheet sheet_of(const Drawing& drawing, const Look& look, const std::string& title, double pixels, int width,
               double middle, double font);

/// Draw bodies side by side at one scale, each with its time; `name`.png, `name`.svg, and the data and script they are
/// drawn from.
///
/// Where the bodies move far beyond their size, each panel follows them.
/// returns a sentence on what went wrong, as `draw` does
/// throws  IoError when the files cannot be written
std::string draw_bodies(std::span<const BodyPanel> panels, const Look& look, const std::string& title,
                        const std::filesystem::path& folder, const std::string& name,
                        const std::string& gnuplot = "gnuplot");

inline std::string draw(const BodyStrip& strip, const std::filesystem::path& folder, const std::string& name) {
  return draw_bodies(strip.panels, strip.look, strip.title, folder, name);
}

}  // namespace dartboard
