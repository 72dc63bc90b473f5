#include "core/contact/way_inside.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

/// An end of a way in or out of joined blocks. Outside, only its place and its energy of 0 count.
struct End {
  Vector3d place{0, 0, 0};
  bool inside = false;
  std::size_t box = 0;  // whose law counts
  WayToSurface out{};

  Vector3d normal() const { return out.way / out.distance; }
};

End end_at(const JoinedBlocks& joined, const Vector3d& y) {
  End end{.place = y};
  if (!joined.boxes.contains(y)) return end;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t box = 0; box < joined.law.size(); ++box) {
    if (!joined.boxes.has_surface(box)) continue;
    const WayToSurface out = joined.boxes.nearest(box, y);
    const double energy = joined.law[box].energy(1.0, out.distance);
    if (energy > least || (energy == least && !out.is_before(end.out))) continue;
    least = energy;
    end.box = box;
    end.out = out;
  }
  end.inside = end.out.distance > 0.0;
  return end;
}

bool have_one_load(const ContactLaw& a, const ContactLaw& b) {
  return a.pressure == b.pressure && a.depth == b.depth && a.exponent == b.exponent;
}

/// A way in joined blocks: the change of energy, a force that does most of its work, and the rest of it.
struct JointWay {
  EnergyChange change;
  Vector3d force{0, 0, 0};
  double rest = 0.0;  // [J] of the change and the work of that force, together
};

/// With the ways out a and b from both ends, |b| - |a| = (b - a) . (a + b) / (|a| + |b|), and b - a is minus the way
/// along axes on which both lead to one coordinate: there nothing cancels, and nothing is left.
JointWay inside_of(const JoinedBlocks& joined, double area, const End& from, const End& to, const Vector3d& way) {
  const WayToSurface &a = from.out, &b = to.out;
  const ContactLaw &law = joined.law[from.box], &other = joined.law[to.box];
  if (!have_one_load(law, other)) {
    const double before = law.energy(area, a.distance), after = other.energy(area, b.distance);
    const Vector3d force =
        0.5 * (law.force(area, a.distance) * from.normal() + other.force(area, b.distance) * to.normal());
    return {{after - before, before + after}, force, after - before + force.dot(way)};
  }
  const double mean = law.mean_force(area, a.distance, b.distance);
  const Vector3d normal = (a.way + b.way) / (a.distance + b.distance);
  double deeper = 0.0, rest = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double change = a.point[k] == b.point[k] ? -way[k] : b.way[k] - a.way[k];
    deeper += change * normal[k];
    rest += (change + way[k]) * normal[k];
  }
  return {{mean * deeper, mean * way.norm()}, mean * normal, mean * rest};
}

/// One end is outside: beyond the plane across the way out of the other end, as for a half-space; or else what depth
/// that has there does not count.
JointWay into(const JoinedBlocks& joined, double area, const End& from, const End& to, const Vector3d& way) {
  const End &in = from.inside ? from : to, &outside = from.inside ? to : from;
  const ContactLaw& law = joined.law[in.box];
  const Vector3d normal = in.normal();
  const double beyond = normal.dot(in.out.point - outside.place), deeper = -way.dot(normal);
  if (beyond <= 0.0) {
    const double mean =
        from.inside ? law.mean_force(area, in.out.distance, beyond) : law.mean_force(area, beyond, in.out.distance);
    return {{mean * deeper, mean * way.norm()}, mean * normal, 0.0};
  }
  const double mean = law.mean_force(area, 0.0, in.out.distance), energy = law.energy(area, in.out.distance),
               change = from.inside ? -energy : energy;
  return {{change, energy}, mean * normal, change - mean * deeper};
}

JointWay joint_way(const JoinedBlocks& joined, double area, const Vector3d& y, const Vector3d& way) {
  const End from = end_at(joined, y), to = end_at(joined, y + way);
  if (from.inside && to.inside) return inside_of(joined, area, from, to, way);
  return from.inside || to.inside ? into(joined, area, from, to, way) : JointWay{};
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

bool find_way_out(const JoinedBlocks& joined, const Vector3d& y, Penetration& found, std::size_t& box) {
  const End end = end_at(joined, y);
  if (!end.inside) return false;
  box = end.box;
  found.depth = end.out.distance;
  found.normal = end.normal();
  found.curvature.setZero();
  if (end.out.axes > 1) {  // to an edge or a corner: the normal turns
    found.curvature = found.normal * found.normal.transpose() / end.out.distance;
    for (int k = 0; k < 3; ++k)
      if (end.out.way[k] != 0.0) found.curvature(k, k) -= 1.0 / end.out.distance;
  }
  return true;
}

EnergyChange change_on_way(const JoinedBlocks& joined, double area, const Vector3d& y, const Vector3d& way) {
  return joint_way(joined, area, y, way).change;
}

Vector3d mean_force_on_way(const JoinedBlocks& joined, double area, const Vector3d& y, const Vector3d& way) {
  const JointWay on_it = joint_way(joined, area, y, way);
  const double length = way.norm();
  // a way of the size of a rounding has no direction
  if (on_it.rest == 0.0 || !(length > 1e-15 * y.norm())) return on_it.force;
  return on_it.force - (on_it.rest / length) * (way / length);
}

}  // namespace dartboard
