#include "core/forces/face_pressure.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/forces/force_size.h"
#include "core/forces/rows_of_part.h"
#include "core/forces/semidefinite.h"

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A triangle of a face by places of its corners, and its share.
struct Part {
  std::array<std::uint32_t, 3> corner;
  double share;
};
constexpr std::array<Part, 1> whole{{{{0, 1, 2}, 1.0}}};
constexpr std::array<Part, 4> both_splits{{{{0, 1, 2}, 0.5}, {{0, 2, 3}, 0.5}, {{0, 1, 3}, 0.5}, {{1, 2, 3}, 0.5}}};

std::span<const Part> parts_of(std::uint32_t corners) {
  if (corners == 3) return whole;
  return both_splits;
}

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// The two edges of a triangle from its first corner, and their changes within a step.
struct Edges {
  Vector3d first, second;
  Edges(const StagePlaces& at, const PressedFace& face, const Part& part)
      : first(at.line(face.corner[part.corner[0]], face.corner[part.corner[1]])),
        second(at.line(face.corner[part.corner[0]], face.corner[part.corner[2]])) {}
};

/// The force at each corner [N] over a cross product of edges, or its mean.
double factor(double pressure, const Part& part) { return -(pressure / 6.0) * part.share; }

}  // namespace

std::array<Vector3d, 4> forces_of_pressure(double pressure, std::uint32_t corners, const std::array<Vector3d, 4>& x) {
  std::array<Vector3d, 4> force;
  force.fill(Vector3d(0, 0, 0));
  for (const Part& part : parts_of(corners)) {
    const auto [a, b, c] = part.corner;
    const Vector3d share = factor(pressure, part) * (x[b] - x[a]).cross(x[c] - x[a]);
    for (const std::uint32_t k : part.corner) force[k] += share;
  }
  return force;
}

void FacePressureTerm::add_forces(const StagePlaces& at, std::span<Vector3d> force) const {
  for (const PressedFace& face : rows_)
    for (const Part& part : parts_of(face.count)) {
      const Edges edge(at, face, part);
      const Vector3d share = factor(pressure_[face.force], part) * edge.first.cross(edge.second);
      for (const std::uint32_t k : part.corner) force[face.corner[k]] += share;
    }
}

// Edges are linear in time, so the mean of their product is that half way and a twelfth of that of their changes.
void FacePressureTerm::add_discrete_forces(const StagePlaces& at, std::span<Vector3d> force) const {
  for (const PressedFace& face : rows_)
    for (const Part& part : parts_of(face.count)) {
      const Edges edge(at, face, part);
      Vector3d product = edge.first.cross(edge.second);
      if (!at.w.empty()) {
        const Edges change({at.w}, face, part);
        product += (4.0 * at.t * at.t / 12.0) * change.first.cross(change.second);
      }
      const Vector3d share = factor(pressure_[face.force], part) * product;
      for (const std::uint32_t k : part.corner) force[face.corner[k]] += share;
    }
}

void FacePressureTerm::add_force_sizes(const StagePlaces& at, std::span<double> size) const {
  for (const PressedFace& face : rows_)
    for (const Part& part : parts_of(face.count)) {
      const auto [a, b, c] = part.corner;
      const double product =
          line_size(at, face.corner[a], face.corner[b]) * line_size(at, face.corner[a], face.corner[c]);
      // each of the three components of a cross product has two summands, and both edges are rounded
      for (const std::uint32_t k : part.corner)
        size[face.corner[k]] += 4.0 * std::abs(factor(pressure_[face.force], part)) * product;
    }
}

EnergyChange FacePressureTerm::energy_change(const StagePlaces& at, std::span<const Vector3d> step,
                                             double scale) const {
  EnergyChange sum;
  for (const PressedFace& face : rows_)
    for (const Part& part : parts_of(face.count)) {
      const Edges edge(at, face, part), change({step}, face, part);
      const Vector3d mean = edge.first.cross(edge.second) +
                            (scale / 2.0) * (edge.first.cross(change.second) + change.first.cross(edge.second)) +
                            (scale * scale / 3.0) * change.first.cross(change.second);
      Vector3d way(0, 0, 0);
      double length = 0.0;
      for (const std::uint32_t k : part.corner) {
        way += scale * step[face.corner[k]];
        length += std::abs(scale) * step[face.corner[k]].norm();
      }
      const double by_area = factor(pressure_[face.force], part);
      sum.value -= by_area * mean.dot(way);
      sum.sizes += std::abs(by_area) * (edge.first.norm() + std::abs(scale) * change.first.norm()) *
                   (edge.second.norm() + std::abs(scale) * change.second.norm()) * length;
    }
  return sum;
}

double FacePressureTerm::power(std::span<const std::uint32_t> pieces, std::span<const Vector3d> x,
                               std::span<const Vector3d> w) const {
  double sum = 0.0;
  for (const std::uint32_t row : pieces) {
    const PressedFace& face = rows_[row];
    for (const Part& part : parts_of(face.count)) {
      const Edges edge({x}, face, part);
      Vector3d way(0, 0, 0);
      for (const std::uint32_t k : part.corner) way += w[face.corner[k]];
      sum += factor(pressure_[face.force], part) * edge.first.cross(edge.second).dot(way);
    }
  }
  return sum;
}

// With e_b the edge across from corner b, the product of edges changes by e_b x dx_b.
void FacePressureTerm::for_each_tangent(const StagePlaces& at, Compression compression,
                                        const VisitTangent& visit) const {
  for (const PressedFace& face : rows_) {
    std::array<Matrix3d, 10> blocks;
    blocks.fill(Matrix3d::Zero());
    for (const Part& part : parts_of(face.count)) {
      const Edges edge(at, face, part);
      const std::array<Vector3d, 3> across{edge.second - edge.first, -edge.second, edge.first};
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < a; ++b)
          blocks[part.corner[a] * (part.corner[a] + 1) / 2 + part.corner[b]] +=
              (-0.5 * factor(pressure_[face.force], part)) * cross_matrix(across[b] - across[a]);
    }
    const auto all = std::span(blocks).first(face.count * (face.count + 1) / 2);
    if (compression == Compression::projected) make_semidefinite(all, face.count);
    visit(face.corners(), all);
  }
}

void FacePressureTerm::for_each_constant_tangent(const VisitTangent& visit) const {
  for (const PressedFace& face : rows_) {
    std::array<Matrix3d, 10> blocks;
    blocks.fill(Matrix3d::Zero());
    for (std::size_t a = 0; a < face.count; ++a) blocks[a * (a + 3) / 2] = face.stiffness * Matrix3d::Identity();
    visit(face.corners(), std::span(blocks).first(face.count * (face.count + 1) / 2));
  }
}

TermOfPart FacePressureTerm::of_part(const VertexSubset& part) const {
  const auto own = std::make_shared<std::vector<PressedFace>>(
      rows_of_part(rows_, pieces_of_part(*this, part), part,
                   [](PressedFace& face) { return std::span(face.corner).first(face.count); }));
  return {own, std::make_unique<FacePressureTerm>(*own, pressure_)};
}

void FacePressureTerm::begin_step(std::span<const Vector3d> x) {
  begin_.resize(rows_.size());
  for (std::size_t row = 0; row < rows_.size(); ++row)
    for (std::uint32_t k = 0; k < rows_[row].count; ++k) begin_[row][k] = x[rows_[row].corner[k]];
}

double FacePressureTerm::work(std::span<const Vector3d> x) const {
  double sum = 0.0;
  for (std::size_t row = 0; row < rows_.size(); ++row)
    for (const Part& part : parts_of(rows_[row].count)) {
      const auto [a, b, c] = part.corner;
      const auto moved = [&](std::uint32_t k) { return Vector3d(x[rows_[row].corner[k]] - begin_[row][k]); };
      const Vector3d first = begin_[row][b] - begin_[row][a], second = begin_[row][c] - begin_[row][a];
      const Vector3d more = moved(b) - moved(a), more_still = moved(c) - moved(a);
      const Vector3d mean =
          first.cross(second) + 0.5 * (first.cross(more_still) + more.cross(second)) + more.cross(more_still) / 3.0;
      sum += factor(pressure_[rows_[row].force], part) * mean.dot(moved(a) + moved(b) + moved(c));
    }
  return sum;
}

}  // namespace dartboard
