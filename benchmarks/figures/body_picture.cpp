#include "benchmarks/figures/body_picture.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "benchmarks/figures/body_facets.h"
#include "benchmarks/figures/gnuplot.h"
#include "core/base/escape.h"

namespace dartboard {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Box = Eigen::AlignedBox2d;
using Corners = std::vector<Vector2d>;

// A polygon with its corners moved away from its middle; towards it where `by` is negative.
std::string moved_corners(const Corners& corners, const Vector2d& shift, double by, std::uint32_t colour) {
  Vector2d middle(0, 0);
  for (const Vector2d& x : corners) middle += x / static_cast<double>(corners.size());
  std::string text;
  for (const Vector2d& x : corners) {
    const double far = (x - middle).norm();
    const Vector2d at = middle + (x - middle) * (far > -by && far > 0.0 ? 1.0 + by / far : 0.0) + shift;
    text += fmt::format("{:.6g} {:.6g} {}\n", at.x(), at.y(), colour);
  }
  return text + '\n';
}

// A line as a rectangle.
Corners widened(const Vector2d& from, const Vector2d& to, double half_width) {
  const Vector2d along = to - from;
  const double length = along.norm();
  const Vector2d aside =
      length > 0.0 ? Vector2d(-along.y(), along.x()) * (half_width / length) : Vector2d(0, half_width);
  return {from + aside, to + aside, to - aside, from - aside};
}

// A dot as a square.
Corners square(const Vector2d& at, double half) {
  return {at + Vector2d(-half, -half), at + Vector2d(half, -half), at + Vector2d(half, half),
          at + Vector2d(-half, half)};
}

/// The largest extent of any of some boxes.
Vector2d largest_of(std::span<const BodyPanel> panels) {
  Vector2d largest(0, 0);
  for (const BodyPanel& panel : panels)
    if (!panel.box.isEmpty()) largest = largest.cwiseMax(panel.box.sizes());
  return largest;
}

Box all_of(std::span<const BodyPanel> panels) {
  Box all;
  for (const BodyPanel& panel : panels) all.extend(panel.box);
  return all.isEmpty() ? Box(Vector2d(0, 0), Vector2d(1, 1)) : all;
}

void give_shades(Drawing& drawing) {
  for (const BodyPanel& panel : drawing.panels)
    for (const DrawnFacet& facet : panel.facets)
      if (std::isfinite(facet.value)) drawing.largest = std::max(drawing.largest, facet.value);
  for (BodyPanel& panel : drawing.panels)
    for (DrawnFacet& facet : panel.facets)
      if (!std::isnan(facet.value)) facet.base = shade_of(facet.value / drawing.largest);
}

}  // namespace

Drawing drawing_of(std::span<const BodyPanel> panels, const Look& look, double thinnest) {
  Drawing drawing{.panels = {panels.begin(), panels.end()}, .area = {}};
  PictureArea& area = drawing.area;
  area.follows = (all_of(panels).sizes().array() > 2.5 * largest_of(panels).maxCoeff()).any();
  Eigen::AlignedBox3d of_all;
  for (const BodyPanel& panel : panels) of_all.extend(panel.reach);
  for (BodyPanel& panel : drawing.panels) {
    Eigen::AlignedBox3d reach = area.follows ? panel.reach : of_all;
    if (!reach.isEmpty()) {
      const Vector3d more = Vector3d::Constant(0.1 * reach.sizes().maxCoeff());
      reach.extend(Vector3d(reach.min() - more)).extend(Vector3d(reach.max() + more));
    }
    for (DrawnFacet& facet : facets_of_obstacles(look, panel.time, reach)) {
      for (const Vector3d& x : facet.corners) panel.box.extend(Vector2d(x.head<2>()));
      panel.facets.push_back(std::move(facet));
    }
    order_by_depth(panel.facets);
  }
  area.all = all_of(drawing.panels);
  area.size = 1.08 * (area.follows ? largest_of(drawing.panels) : Vector2d(area.all.sizes()));
  area.size = area.size.cwiseMax(thinnest * area.size.maxCoeff());
  give_shades(drawing);
  return drawing;
}

std::string polygons_of(std::span<const DrawnFacet> facets, const Vector2d& shift, double pixels) {
  std::string data;
  for (const DrawnFacet& facet : facets) {
    Corners corners;
    for (const Vector3d& x : facet.corners) corners.push_back(x.head<2>());
    const std::uint32_t colour = facet.colour(), dark = lit(colour, 0.72);
    if (facet.outline) {
      for (std::size_t k = 0; k < corners.size(); ++k)
        data += moved_corners(widened(corners[k], corners[(k + 1) % corners.size()], 0.8 / pixels), shift, 0.0, dark);
    } else if (corners.size() == 1) {
      data += moved_corners(square(corners[0], 2.0 / pixels), shift, 0.0, colour);
    } else if (corners.size() == 2) {
      data += moved_corners(widened(corners[0], corners[1], 2.0 / pixels), shift, 0.5 / pixels, dark);
    } else if (facet.of == DrawnFacet::Of::ball) {
      data += moved_corners(corners, shift, 0.4 / pixels, colour);  // round, without rims
    } else {
      // the facet, in a darker colour and over the seams to its neighbours, then its inner part
      data += moved_corners(corners, shift, 0.4 / pixels, dark);
      data += moved_corners(corners, shift, -0.9 / pixels, colour);
    }
  }
  return data;
}

std::string draw_bodies(std::span<const BodyPanel> panels, const Look& look, const std::string& title,
                        const std::filesystem::path& folder, const std::string& name, const std::string& gnuplot) {
  const Drawing drawing = drawing_of(panels, look, 0.1);
  const Vector2d& size = drawing.area.size;

  constexpr double widest = 1400, highest = 830;  // [pixels]
  const double count = static_cast<double>(std::max<std::size_t>(1, panels.size()));
  constexpr double apart = 1.15, caption = 135;  // times the body's width; [pixels]
  const double pixels = std::min(widest / (count * apart * size.x()), highest / size.y());
  const double pitch = std::max(apart * size.x(), caption / pixels);  // [m] from one time to the next
  const int width = static_cast<int>(std::lround(std::max(560.0, pixels * count * pitch)));
  const Sheet sheet = sheet_of(drawing, look, title, pixels, width, (count - 1) / 2 * pitch, 16);
  std::string data, labels;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const BodyPanel& panel = drawing.panels[k];
    const double middle = static_cast<double>(k) * pitch;
    data += polygons_of(panel.facets, Vector2d(middle, 0) - drawing.area.centre_of(panel.box), pixels);
    labels += sheet.time_of(panel, static_cast<int>(k) + 1, middle);
    if (k > 0)
      labels += fmt::format("set arrow {0} from {1:.6g},{2:.6g} to {1:.6g},{3:.6g} nohead linecolor rgb \"#d8d8d8\"\n",
                            k, middle - pitch / 2, -size.y() / 2 - Sheet::times / pixels, size.y() / 2);
  }
  write_plot_file(folder / (name + ".dat"), data);
  const std::string commands = data.empty() ? "plot NaN"
                                            : fmt::format("plot {} using 1:2:3 with polygons fillcolor rgb variable",
                                                          plot_source(name + ".dat"));
  write_plot_file(folder / (name + ".gnuplot"),
                  sheet.commands + labels + for_both_pictures(commands, name, width, sheet.canvas.height));
  return run_gnuplot(gnuplot, folder, name);
}

}  // namespace dartboard
