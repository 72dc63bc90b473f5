#include "validation/contact/random_placements.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/plain/random.h"
#include "core/scene/body/simulated_body.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// The triangles of the boundary of a body, its vertices, and its centre at rest.
struct Shape {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> vertices;
  Vector3d centre{0, 0, 0};
};

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

class Placing {
 public:
  Placing(const Mesh& first, const Mesh& second, std::uint64_t seed) : random_(seed) {
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
      for (const std::uint32_t k : shape.vertices)
        shape.centre += rest_[k] / static_cast<double>(shape.vertices.size());
    }
  }

  const BodyContact& contact() const { return *body_->body_contact(); }
  std::span<const Vector3d> x() const { return x_; }
  std::span<const CellCorners> cells() const { return cells_; }
  double least_altitude() const { return contact().least_altitude(rest_); }

  void place() {
    const auto& [a, b] = shapes_;
    const Vector3d here = place_on(a), there = place_on(b), out = (here - a.centre).normalized(),
                   other = (there - b.centre).normalized();
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(3.2 * random_.next_signed(), out).toRotationMatrix() * turning(other, -out);
    const double depth = least_altitude() * 0.5 * (1.0 + random_.next_signed());
    for (const std::uint32_t k : b.vertices) x_[k] = here - depth * out + turn * (rest_[k] - there);
  }

 private:
  /// A corner, a place on an edge or one within a face of a triangle of the boundary.
  Vector3d place_on(const Shape& shape) {
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

  SplitMix64 random_;
  std::unique_ptr<SimulatedBody> body_;
  std::vector<Vector3d> rest_, x_;
  std::vector<CellCorners> cells_;
  std::array<Shape, 2> shapes_;
};

}  // namespace

void PlacementsFound::add(const PlacementsFound& other) {
  placements += other.placements;
  overlapping += other.overlapping;
  quiet += other.quiet;
  deepest_quiet = std::max(deepest_quiet, other.deepest_quiet);
  least_altitude = other.least_altitude;
  by_depth.add(other.by_depth);
}

PlacementsFound judge_placements(const Mesh& first, const Mesh& second, const PlacementPlan& plan) {
  Placing placing(first, second, plan.seed);
  PlacementsFound found;
  found.placements = plan.placements;
  found.least_altitude = placing.least_altitude();
  const auto may_touch = [n = first.cell_count()](std::uint32_t a, std::uint32_t b) { return (a < n) != (b < n); };
  for (std::size_t k = 0; k < plan.placements; ++k) {
    placing.place();
    const bool lost = plan.loses && plan.loses(k);
    bool quiet = true;
    double deepest = 0.0;
    const auto judged = judged_overlaps(placing.contact(), placing.x(), placing.cells(), may_touch);
    for (const JudgedOverlap& one : judged) {
      const double share = one.overlap.depth / found.least_altitude;
      const bool felt = one.felt && !lost;
      found.by_depth.add(share, felt);
      quiet = quiet && !felt;
      deepest = std::max(deepest, share);
    }
    if (judged.empty()) continue;
    ++found.overlapping;
    if (!quiet) continue;
    ++found.quiet;
    found.deepest_quiet = std::max(found.deepest_quiet, deepest);
  }
  return found;
}

}  // namespace dartboard
