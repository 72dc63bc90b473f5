#include "core/contact/way_inside.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// A part of a way with one normal: depths at its ends, the change of depth, and its share of the way.
struct Part {
  double d0, d1, deeper, share;
  Vector3d normal;
};

/// Calls f(Part) for each part of the way that may be inside.
template <class F>
void for_each_part(const HalfSpace& plane, const Vector3d& y, const Vector3d& way, F&& f) {
  const double d0 = (plane.point - y).dot(plane.normal), deeper = -way.dot(plane.normal);
  if (d0 > 0.0 || d0 + deeper > 0.0) f(Part{d0, d0 + deeper, deeper, 1.0, plane.normal});
}

// With r1 - r0 = way . (2 out + way) / (r0 + r1), nothing cancels, and the mean normal is the gradient of the distance.
template <class F>
void for_each_part(const Ball& ball, const Vector3d& y, const Vector3d& way, F&& f) {
  const Vector3d out = y - ball.centre, both = 2.0 * out + way;
  const double square = ball.radius * ball.radius, first = out.squaredNorm(), last = (out + way).squaredNorm();
  if (first >= square && last >= square) return;
  const double r0 = std::sqrt(first), sum = r0 + std::sqrt(last);
  if (sum == 0.0) return;
  const double deeper = -way.dot(both) / sum, d0 = ball.radius - r0;
  f(Part{d0, d0 + deeper, deeper, 1.0, both / sum});
}

// The depth is the lowest of six linear functions a + b s of the way s: from one to the next with a lesser slope.
template <class F>
void for_each_part(const Block& block, const Vector3d& y, const Vector3d& way, F&& f) {
  struct Face {
    double a, b;
  };
  std::array<Face, 6> face;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    face[2 * k] = {y[axis] - block.low[axis], way[axis]};
    face[2 * k + 1] = {block.high[axis] - y[axis], -way[axis]};
  }
  for (const Face& g : face)
    if (g.a <= 0.0 && g.a + g.b <= 0.0) return;  // all of the way is beyond this face
  std::size_t now = 0;
  for (std::size_t k = 1; k < 6; ++k)
    if (face[k].a < face[now].a || (face[k].a == face[now].a && face[k].b < face[now].b)) now = k;
  double s = 0.0;
  while (true) {
    std::size_t next = now;
    double end = 1.0;
    for (std::size_t k = 0; k < 6; ++k) {
      if (!(face[k].b < face[now].b)) continue;
      const double meet = std::max(s, (face[k].a - face[now].a) / (face[now].b - face[k].b));
      if (meet < end || (meet == end && next != now && face[k].b < face[next].b)) {
        end = meet;
        next = k;
      }
    }
    const auto [a, b] = face[now];
    const double sign = now % 2 == 0 ? -1.0 : 1.0;
    f(Part{a + b * s, a + b * end, b * (end - s), end - s, sign * Vector3d::Unit(static_cast<int>(now / 2))});
    if (next == now) return;
    s = end;
    now = next;
  }
}

}  // namespace

EnergyChange change_on_way(const ContactLaw& law, double area, const ObstacleShape& shape, const Vector3d& y,
                           const Vector3d& way) {
  EnergyChange sum;
  std::visit(
      [&](const auto& s) {
        for_each_part(s, y, way, [&](const Part& part) {
          const double force = law.mean_force(area, part.d0, part.d1);
          sum.value += force * part.deeper;
          sum.sizes += force * part.share * way.norm();
        });
      },
      shape);
  return sum;
}

Vector3d mean_force_on_way(const ContactLaw& law, double area, const ObstacleShape& shape, const Vector3d& y,
                           const Vector3d& way) {
  Vector3d sum(0, 0, 0);
  std::visit(
      [&](const auto& s) {
        for_each_part(s, y, way, [&](const Part& part) {
          sum += (law.mean_force(area, part.d0, part.d1) * part.share) * part.normal;
        });
      },
      shape);
  return sum;
}

}  // namespace dartboard
