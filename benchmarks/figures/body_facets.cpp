#include "benchmarks/figures/body_facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "core/mechanics/fracture/stress.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
using Key = BodyFacets::Key;

constexpr std::array component_colours{0x7ba7d9u, 0xe0b15au, 0x86bf7cu, 0xb18cc8u, 0x5fb8b3u, 0xd98ba5u, 0xa8a878u};

std::uint32_t colour_of_number(std::uint32_t number) { return component_colours[number % component_colours.size()]; }

Key sorted(Key nodes) {
  std::ranges::sort(nodes);
  return nodes;
}

struct Facet {
  Key nodes;  // in order around it
  std::size_t cell;
};

// The polygons of a surface; the faces of volumes that belong to one cell.
std::vector<Facet> facets_of(const Mesh& mesh) {
  std::vector<Facet> all;
  std::map<Key, int> cells_at;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto nodes = mesh.cell(c);
    for (const std::vector<int>& face : faces_of(mesh.kinds[c])) {
      Facet facet{{}, c};
      for (const int k : face) facet.nodes.push_back(nodes[static_cast<std::size_t>(k)]);
      if (dimension(mesh.kinds[c]) == 3) ++cells_at[sorted(facet.nodes)];
      all.push_back(std::move(facet));
    }
  }
  std::erase_if(all, [&](const Facet& facet) {
    const auto found = cells_at.find(sorted(facet.nodes));
    return found != cells_at.end() && found->second > 1;
  });
  return all;
}

// The points of the mesh by which facets are compared: their own, or those of the face of the mesh that contains them.
class Origins {
 public:
  explicit Origins(const Frame& panel) : panel_(panel) {
    for (const RefinedFacet& facet : panel.refined_facets)
      lies_in_.try_emplace(sorted(Key(facet.points.begin(), facet.points.end())),
                           sorted(Key(facet.lies_in.begin(), facet.lies_in.end())));
  }
  // For a facet inside a cell of the mesh, the points include a vertex made by refinement.
  Key of(const Facet& facet) const {
    Key points;
    for (const std::uint32_t k : facet.nodes) points.push_back(static_cast<std::uint32_t>(panel_.mesh_point[k]));
    const auto found = lies_in_.find(sorted(facet.nodes));
    return found == lies_in_.end() ? sorted(std::move(points)) : found->second;
  }

 private:
  const Frame& panel_;
  std::map<Key, Key> lies_in_;
};

/// The quantity by which the parts of a frame are coloured: stresses in one unit, of the cells of the highest
/// dimension.
class Values {
 public:
  Values(ColourBy by, const Frame& frame) : frame_(frame) {
    if (by == ColourBy::speed) {
      unit_ = "m/s";
      for (const Vector3d& v : frame.velocity) at_points_.push_back(v.norm());
    }
    if (by != ColourBy::stress) return;
    for (const Eigen::Matrix3d& stress : frame.stress) at_points_.push_back(measures_of(stress).von_mises);
    least_ = 1;
    for (const CellKind kind : frame.mesh.kinds) least_ = std::max(least_, dimension(kind));
    unit_ = least_ == 3 ? "Pa" : least_ == 2 ? "N/m" : "N";
  }
  /// The mean of the corners of a facet of a cell of this dimension; no_value where it has none.
  template <class Nodes>
  double at(const Nodes& nodes, int dimension) const {
    if (at_points_.empty() || dimension < least_) return DrawnFacet::no_value;
    double sum = 0.0;
    for (const std::uint32_t k : nodes) sum += at_points_[k] / static_cast<double>(nodes.size());
    return sum;
  }
  double at_link(std::size_t k) const { return least_ == 1 ? std::abs(frame_.tension[k]) : at(frame_.links[k], 1); }
  const std::string& unit() const { return unit_; }

 private:
  const Frame& frame_;
  std::vector<double> at_points_;
  int least_ = 0;  // the dimension of cells that have values, or more
  std::string unit_;
};

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
    for (std::uint32_t k = 0; k < component_colours.size(); ++k)
      legend.emplace_back(component_colours[k], "material " + std::to_string(k));
  for (const auto& [colour, meaning] : {std::pair(colours::inside, "was inside"),
                                        {colours::held, "held"},
                                        {colours::driven, "driven"},
                                        {colours::held_in_part, "held along some axes"},
                                        {colours::attached, "attached"},
                                        {colours::obstacle, "obstacle"}})
    legend.emplace_back(colour, meaning);
  return legend;
}

std::vector<std::uint32_t> LastingComponents::of(const Frame& frame) {
  const auto cell = [&frame](std::size_t c) {
    return std::uint64_t{frame.body.empty() ? 0 : frame.body[c]} << 32 |
           (frame.mesh_cell.empty() ? c : frame.mesh_cell[c]);
  };
  const std::uint32_t components = frame.component.empty() ? 0 : *std::ranges::max_element(frame.component) + 1;
  constexpr std::uint32_t none = 0xffffffff;
  std::vector<std::uint32_t> number(components, none);
  // of each component, the cells that each number had before; (cells, component) of the largest for each number
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> had;
  std::map<std::uint32_t, std::pair<std::size_t, std::uint32_t>> largest;
  for (std::size_t c = 0; c < frame.component.size(); ++c)
    if (const auto found = before_.find(cell(c)); found != before_.end()) ++had[{frame.component[c], found->second}];
  for (const auto& [of, cells] : had)
    if (cells > largest[of.second].first) largest[of.second] = {cells, of.first};
  for (const auto& [kept, by] : largest)
    if (number[by.second] == none) number[by.second] = kept;
  std::vector<std::size_t> cells(components, 0);
  for (const std::uint32_t of : frame.component) ++cells[of];
  std::vector<std::uint32_t> others;
  for (std::uint32_t k = 0; k < components; ++k)
    if (number[k] == none) others.push_back(k);
  if (count_ > 0) std::ranges::stable_sort(others, std::greater{}, [&cells](std::uint32_t k) { return cells[k]; });
  for (const std::uint32_t k : others) number[k] = count_++;
  before_.clear();
  for (std::size_t c = 0; c < frame.component.size(); ++c) before_[cell(c)] = number[frame.component[c]];
  return number;
}

BodyFacets::BodyFacets(const Look& look, const Frame& first) : view_(look.view), colour_(look.colour) {
  const Origins origins(first);
  for (const Facet& facet : facets_of(first.mesh)) skin_.insert(origins.of(facet));
}

BodyPanel BodyFacets::of(const Frame& frame) {
  BodyPanel panel{.time = frame.time};
  std::vector<Vector3d> x;
  for (const Vector3d& place : frame.mesh.points) {
    x.push_back(view_.seen(place));
    panel.reach.extend(place);
    panel.box.extend(Eigen::Vector2d(x.back().head<2>()));
  }
  const std::vector<std::uint32_t> lasting = components_.of(frame);
  const Values values(colour_, frame);
  panel.unit = values.unit();
  const auto colour_of_cell = [&](std::size_t c) {
    if (colour_ == ColourBy::material) return colour_of_number(frame.material.empty() ? 0 : frame.material[c]);
    return colour_of_number(lasting[frame.component[c]]);
  };
  std::vector<bool> is_seen(x.size(), false);
  const Origins origins(frame);
  for (const Facet& facet : facets_of(frame.mesh)) {
    DrawnFacet d;
    Vector3d normal(0, 0, 0);
    for (std::size_t k = 0; k < facet.nodes.size(); ++k) {
      const Vector3d &here = x[facet.nodes[k]], &next = x[facet.nodes[(k + 1) % facet.nodes.size()]];
      d.corners.push_back(here);
      normal += (here - x[facet.nodes[0]]).cross(next - x[facet.nodes[0]]);
    }
    // a face of a volume that looks away is hidden by the others
    if (dimension(frame.mesh.kinds[facet.cell]) == 3 && normal.z() <= 0.0) continue;
    const bool was_inside = colour_ == ColourBy::component && !skin_.contains(origins.of(facet));
    d.base = was_inside ? colours::inside : colour_of_cell(facet.cell);
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
