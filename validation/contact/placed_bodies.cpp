#include "validation/contact/placed_bodies.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// A rotation that takes one direction into another.
Eigen::Matrix3d turning(const Vector3d& from, const Vector3d& to) {
  // the shortest rotation is not unique for opposite directions, and loses digits near there
  if (from.dot(to) < 0.0) {
    const Vector3d across = from.unitOrthogonal();
    return turning(-from, to) * (2.0 * across * across.transpose() - Eigen::Matrix3d::Identity());
  }
  const Vector3d axis = from.cross(to);  // as long as the sine
  Eigen::Matrix3d cross;
  cross << 0.0, -axis.z(), axis.y(), axis.z(), 0.0, -axis.x(), -axis.y(), axis.x(), 0.0;
  return Eigen::Matrix3d::Identity() + cross + cross * cross / (1.0 + from.dot(to));
}

}  // namespace

PlacedBodies::PlacedBodies(const Mesh& first, const Mesh& second, std::uint64_t seed)
    : random_(seed), cells_of_first_(first.cell_count()) {
  Problem problem;
  problem.mesh = first;
  append(problem.mesh, second);
  BodyNeeds needs = body_needs(problem, false);
  // whether contact is felt does not depend on the law
  const ContactLaw law{.pressure = 1.0, .depth = 1.0};
  needs.touches = {{0, 1, law}};
  needs.first_cell = {0, first.cell_count()};
  body_ = make_simulated_body(problem, needs);
  const Mesh cells = body_->frame({}).mesh;
  for (std::size_t c = 0; c < cells.cell_count(); ++c) {
    const auto k = cells.cell(c);
    cells_.push_back({k[0], k[1], k[2], k[3]});
  }
  rest_ = x_ = cells.points;
  const SkinSolids& solids = contact().solids();
  for (const SkinTriangle& t : solids.triangles()) shapes_[solids.group_at(t.nodes[0])].triangles.push_back(t.nodes);
  for (std::size_t c = 0; c < cells_.size(); ++c)
    for (const std::uint32_t k : cells_[c]) shapes_[c < first.cell_count() ? 0 : 1].vertices.push_back(k);
  for (Shape& shape : shapes_) {
    std::ranges::sort(shape.vertices);
    shape.vertices.erase(std::unique(shape.vertices.begin(), shape.vertices.end()), shape.vertices.end());
    for (const std::uint32_t k : shape.vertices) shape.centre += rest_[k] / static_cast<double>(shape.vertices.size());
  }
}

void PlacedBodies::place(double shallowest) {
  const auto& [a, b] = shapes_;
  const Vector3d here = place_on(a), there = place_on(b), out = (here - a.centre).normalized(),
                 other = (there - b.centre).normalized();
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(3.2 * random_.next_signed(), out).toRotationMatrix() * turning(other, -out);
  const double depth = least_altitude() * (shallowest + (1.0 - shallowest) * 0.5 * (1.0 + random_.next_signed()));
  for (const std::uint32_t k : b.vertices) x_[k] = here - depth * out + turn * (rest_[k] - there);
}

void PlacedBodies::shift(double share) {
  const Vector3d way = share * least_altitude() * random_.next_in_ball();
  for (const std::uint32_t k : shapes_[1].vertices) x_[k] += way;
}

/// A corner, a place on an edge or one within a face of a triangle of the boundary.
Vector3d PlacedBodies::place_on(const Shape& shape) {
  const auto& t = shape.triangles[random_.below(shape.triangles.size())];
  const std::size_t corners = 1 + random_.below(3);
  Vector3d sum(0, 0, 0);
  double weights = 0.0;
  for (std::size_t k = 0; k < corners; ++k) {
    const double weight = 1.0 + 0.999 * random_.next_signed();
    sum += weight * rest_[t[k]];
    weights += weight;
  }
  return sum / weights;
}

std::vector<JudgedOverlap> PlacedBodies::overlaps() const {
  const auto may_touch = [n = cells_of_first_](std::uint32_t a, std::uint32_t b) { return (a < n) != (b < n); };
  return judged_overlaps(contact(), x_, cells_, may_touch);
}

}  // namespace dartboard
