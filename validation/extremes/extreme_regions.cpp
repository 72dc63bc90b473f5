// Axis of bodies of two materials: springs and laws side by side, ratios of stiffness, density and damping, and cells
// at the limits of laws where the materials meet.

#include <fmt/format.h>

#include <utility>

#include "validation/extremes/extreme_matrix.h"
#include "validation/scenes/elastic_solid.h"

namespace dartboard {
namespace {

struct Regions {
  Material one, other;
  double thickness = 1.0;  // [m] of the other

  SpringColumns body(std::string_view scene) const { return elastic_body(scene, one, other, thickness); }
};

/// The regions with the damping ratio `zeta` in the other one, as far as the highest frequency is its own.
Regions damped_there(Regions regions, std::string_view scene, double zeta) {
  const double time = 2 * zeta / highest_frequency(regions.body(scene));
  (regions.other.model == Model::springs ? regions.other.damping : regions.other.damping_time) = time;
  return regions;
}

/// Squashes the first cell of the other region along x, across the face where both regions meet.
void squash_cell(SpringColumns& body, double factor) {
  const auto corners = body.solid->rest().cell(body.solid->rest().cell_count() / 2);
  double middle = 0.0;
  for (const std::uint32_t corner : corners) middle += body.x[corner].x() / static_cast<double>(corners.size());
  for (const std::uint32_t corner : corners) body.x[corner].x() = middle + factor * (body.x[corner].x() - middle);
}

void add_pair(ExtremeMatrix& matrix, Model one, Model other) {
  constexpr std::uint64_t steps = 40;
  const auto add = [&](const std::string& what, double theta, auto make) {
    matrix.add(fmt::format("{} and {}{}, h omega {:g}", name(one), name(other), what, theta), elastic_bodies, make);
  };
  const Regions alike{elastic_material(one), elastic_material(other)};
  const auto move = [&add](const std::string& what, double theta, const Regions& regions) {
    add(what, theta, [=](std::string_view scene) {
      return with_theta(in_motion(regions.body(scene), 1e-3 * regions.thickness), theta, steps);
    });
  };
  using Value = std::pair<double, double>;  // and h omega
  for (const auto& [ratio, theta] : {Value{1e5, 0.3}, Value{1e10, 30.0}, Value{1e-10, 0.3}}) {
    Regions regions = alike;
    regions.other.young *= ratio;
    move(fmt::format(" {:g} times as stiff", ratio), theta, regions);
  }
  Regions dense = alike;
  dense.other.density *= 1e6;
  move(" 1e+06 times as dense", 0.3, dense);
  for (const auto& [thickness, theta] : {Value{1e-3, 30.0}, Value{1e-6, 0.3}})
    move(fmt::format(" in a layer of {:g}", thickness), theta, {alike.one, alike.other, thickness});
  for (const auto& [zeta, theta] : {Value{0.7, 0.1}, Value{50.0, 30.0}})
    add(fmt::format(" with damping ratio {:g}", zeta), theta, [=, zeta = zeta, theta = theta](std::string_view scene) {
      return with_theta(in_motion(damped_there(alike, scene, zeta).body(scene), 0.01), theta, steps);
    });
  if (other == Model::springs) return;
  struct Shape {
    const char* name;
    double factor, theta;
  };
  for (const Shape& shape :
       {Shape{"flat", 0.0, 0.2}, Shape{"inverted", -1.0, 20.0}, Shape{"a sliver of 1e-12", 1e-12, 0.2}})
    add(fmt::format(", a cell between them {}", shape.name), shape.theta, [=](std::string_view scene) {
      SpringColumns body = in_motion(alike.body(scene), 1e-3);
      const double omega = highest_frequency(body);
      squash_cell(body, shape.factor);
      return ExtremeSetup{.body = std::move(body), .h = shape.theta / omega, .steps = steps, .compare = false};
    });
}

}  // namespace

void add_regions(ExtremeMatrix& matrix) {
  using enum Model;
  add_pair(matrix, springs, springs);
  for (const Model law : {neo_hookean, corotational, stvk}) add_pair(matrix, springs, law);
  add_pair(matrix, neo_hookean, corotational);
  add_pair(matrix, corotational, stvk);
  add_pair(matrix, stvk, neo_hookean);
}

}  // namespace dartboard
