#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/scene/file/scene_file.h"

namespace dartboard {
namespace {

/// The largest rate of change between two entries.
template <class T, class Size>
double largest_rate(const TimeTable<T>& table, const Size& size) {
  double largest = 0.0;
  for (std::size_t k = 1; k < table.at.size(); ++k)
    largest = std::max(largest, size(table.value[k] - table.value[k - 1]) / (table.at[k] - table.at[k - 1]));
  return largest;
}

}  // namespace

Eigen::Vector3d SceneDrive::velocity_of(const Eigen::Vector3d& x, double begin, double end) const {
  if (!way.empty()) return way.rate(begin, end);
  if (!turn) return velocity.at(x);
  // the chord from one place on the circle to the next: R(b) r - R(a) r = (R(b - a) - 1) R(a) r
  const double before = turn->angle(begin) - turn->angle.value.front(), by = turn->angle(end) - turn->angle(begin);
  const Eigen::Vector3d r = Eigen::AngleAxisd(before, turn->axis) * (x - turn->centre);
  const Eigen::Vector3d across = turn->axis.cross(r);
  const double sine = std::sin(by / 2);  // 1 - cos = 2 sin^2(by / 2), without cancellation
  return (std::sin(by) * across + 2.0 * sine * sine * turn->axis.cross(across)) / (end - begin);
}

double SceneDrive::largest_speed_of(const Eigen::Vector3d& x) const {
  if (!way.empty()) return largest_rate(way, [](const Eigen::Vector3d& d) { return d.norm(); });
  if (!turn) return velocity.at(x).norm();
  return largest_rate(turn->angle, [](double a) { return std::abs(a); }) * turn->axis.cross(x - turn->centre).norm();
}

}  // namespace dartboard
