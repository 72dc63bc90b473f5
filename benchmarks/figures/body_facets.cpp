#include "benchmarks/figures/body_facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace dartboard {
namespace {

using Eigen::Vector3d;

// A colour between two; beyond the second, as far as channels go.
std::uint32_t between(std::uint32_t from, std::uint32_t to, double share) {
  std::uint32_t out = 0;
  for (const int shift : {16, 8, 0}) {
    const double low = (from >> shift) & 0xff, high = (to >> shift) & 0xff;
    out |= static_cast<std::uint32_t>(std::lround(std::min(255.0, low + share * (high - low)))) << shift;
  }
  return out;
}

std::uint32_t colour_of_held(std::uint8_t held) {
  return held == 1 ? colours::held : held == 2 ? colours::driven : colours::held_in_part;
}

std::uint32_t colour_of_number(std::uint32_t number) { return colours::numbers[number % colours::numbers.size()]; }

}  // namespace

std::uint32_t lit(std::uint32_t colour, double light) { return between(0, colour, light); }

std::uint32_t shade_of(double share) {
  // from blue to yellow, in steps for the same reason as those of light
  constexpr std::array<std::uint32_t, 5> shades{0x3b4ca8, 0x2f86c0, 0x3fb39a, 0xa6cf5c, 0xf8e14b};
  constexpr double steps = 16.0;
  const double at = share > 0.0 ? 4.0 * std::min(1.0, std::floor(steps * share) / (steps - 1.0)) : 0.0;
  const auto low = std::min<std::size_t>(3, static_cast<std::size_t>(at));
  return between(shades[low], shades[low + 1], at - static_cast<double>(low));
}

std::vector<std::pair<std::uint32_t, std::string>> legend_of(const Look& look) {
  std::vector<std::pair<std::uint32_t, std::string>> legend;
  if (look.colour == ColourBy::material)
    for (std::uint32_t k = 0; k < colours::numbers.size(); ++k)
      legend.emplace_back(colours::numbers[k], "material " + std::to_string(k));
  for (const auto& [colour, meaning] : {std::pair(colours::inside, "was inside"),
                                        {colours::held, "held"},
                                        {colours::driven, "driven"},
                                        {colours::held_in_part, "held along some axes"},
                                        {colours::attached, "attached"},
                                        {colours::obstacle, "obstacle"}})
    legend.emplace_back(colour, meaning);
  return legend;
}

BodyFacets::BodyFacets(const Look& look, const Frame& first) : view_(look.view), colour_(look.colour), facets_(first) {}

BodyPanel BodyFacets::of(const Frame& frame) {
  BodyPanel panel{.time = frame.time};
  std::vector<Vector3d> x;
  for (const Vector3d& place : frame.mesh.points) {
    x.push_back(view_.seen(place));
    panel.reach.extend(place);
    panel.box.extend(Eigen::Vector2d(x.back().head<2>()));
  }
  const std::vector<std::uint32_t> lasting = components_.of(frame);
  const FrameValues values(colour_, frame);
  panel.unit = values.unit();
  const auto colour_of_cell = [&](std::size_t c) {
    if (colour_ == ColourBy::material) return colour_of_number(frame.material.empty() ? 0 : frame.material[c]);
    return colour_of_number(lasting[frame.component[c]]);
  };
  std::vector<bool> is_seen(x.size(), false);
  for (const FrameFacet& facet : facets_.of(frame)) {
    DrawnFacet d;
    Vector3d normal(0, 0, 0);
    for (std::size_t k = 0; k < facet.nodes.size(); ++k) {
      const Vector3d &here = x[facet.nodes[k]], &next = x[facet.nodes[(k + 1) % facet.nodes.size()]];
      d.corners.push_back(here);
      normal += (here - x[facet.nodes[0]]).cross(next - x[facet.nodes[0]]);
    }
    // a face of a volume that looks away is hidden by the others
    if (dimension(frame.mesh.kinds[facet.cell]) == 3 && normal.z() <= 0.0) continue;
    d.base = colour_ == ColourBy::component && facet.was_inside ? colours::inside : colour_of_cell(facet.cell);
    d.value = values.at(facet.nodes, dimension(frame.mesh.kinds[facet.cell]));
    // lit from the visible side
    const double side = normal.z() < 0.0 ? -1.0 : 1.0;
    const double cosine = normal.norm() > 0.0 ? side * normal.normalized().dot(view_.light()) : 0.0;
    // in steps: an animated GIF has 256 colours, and takes the nearest of these, of whatever hue, for others
    constexpr double steps = 12.0;
    d.light = 0.62 + 0.45 * std::round(steps * std::max(0.0, cosine)) / steps;
    for (const std::uint32_t k : facet.nodes) is_seen[k] = true;
    panel.facets.push_back(std::move(d));
  }
  for (std::size_t k = 0; k < frame.links.size(); ++k) {
    const auto [a, b] = frame.links[k];
    panel.facets.push_back(
        {.corners = {x[a], x[b]}, .base = colour_of_cell(frame.mesh.cell_count() + k), .value = values.at_link(k)});
    is_seen[a] = is_seen[b] = true;
  }
  for (std::size_t k = 0; k < frame.held.size(); ++k)
    if (frame.held[k] != 0 && is_seen[k])
      panel.facets.push_back({.corners = {x[k]}, .base = colour_of_held(frame.held[k])});
  for (const auto& [vertex, place] : frame.attachments) {
    panel.facets.push_back({.corners = {view_.seen(vertex)}, .base = colours::attached});
    if (vertex != place)
      panel.facets.push_back({.corners = {view_.seen(vertex), view_.seen(place)}, .base = colours::attached});
  }
  return panel;
}

}  // namespace dartboard
