#include "core/scene/run/probes.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/escape.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

std::uint32_t vertex_of(const Probe& probe, const VertexColumns& v) {
  if (const auto* point = std::get_if<std::uint32_t>(&probe.vertex)) {
    const auto found = std::find(v.point.begin(), v.point.end(), *point);
    if (found == v.point.end())
      throw InputError(
          fmt::format("{}/vertex: is {}; expected a point of the mesh, less than {}", probe.path, *point, v.size()));
    return static_cast<std::uint32_t>(found - v.point.begin());
  }
  std::uint32_t best = 0, lowest = no_point;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t k = 0; k < v.size(); ++k) {
    const double far = (v.position[k] - std::get<Eigen::Vector3d>(probe.vertex)).squaredNorm();
    // at equal distances the lowest point of the mesh: vertices are numbered in another order
    if (far < least || (far == least && v.point[k] < lowest)) {
      best = k;
      least = far;
      lowest = v.point[k];
    }
  }
  if (lowest == no_point) throw InputError(probe.path + "/near: the body has no vertex; expected one");
  // a distance above the size of the body means that another place was intended
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& x : v.position) box.extend(x);
  const double size = box.diagonal().norm();
  if (std::sqrt(least) > size)
    throw InputError(
        fmt::format("{}/near: is {:.6g} m from the nearest vertex; expected a place no farther away than "
                    "the body is large, {:.6g} m",
                    probe.path, std::sqrt(least), size));
  return best;
}

}  // namespace

void track_probes(std::span<const Probe> probes, SimulatedBody& body) {
  for (const Probe& probe : probes) body.track(vertex_of(probe, body.vertices()));
}

std::string probes_header(std::span<const Probe> probes) {
  std::string header = "time [s]";
  for (const Probe& probe : probes)
    for (const char* quantity : {"x [m]", "y [m]", "z [m]", "vx [m/s]", "vy [m/s]", "vz [m/s]"})
      header += ',' + csv_field(probe.name + ' ' + quantity);
  return header + '\n';
}

std::string probes_row(const ProbeRow& row) {
  std::string text = fmt::format("{:.17g}", row.time);
  for (const auto& probe : row.probes) {
    if (!probe) {
      text += ",,,,,,";
      continue;
    }
    for (const Eigen::Vector3d& value : {probe->position, probe->velocity})
      for (int k = 0; k < 3; ++k) fmt::format_to(std::back_inserter(text), ",{:.17g}", value[k]);
  }
  return text + '\n';
}

}  // namespace dartboard
