#include "core/elements/membranes.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/elements/element_term.h"
#include "core/elements/membrane_law.h"
#include "core/elements/part_of_elements.h"

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Gradients = std::array<Vector2d, 4>;

/// A quadrature rule: at each point the gradients of the shape functions in reference coordinates. Every
/// point has the same weight.
struct Rule {
  std::array<Gradients, 4> gradients;
  double weight;
};

// The triangle (0, 0), (1, 0), (0, 1).
Rule triangle_rule() {
  Rule rule{{}, 0.5};
  for (Gradients& g : rule.gradients) g = {Vector2d(-1, -1), Vector2d(1, 0), Vector2d(0, 1), Vector2d(0, 0)};
  return rule;
}

// The square [-1, 1]^2, at +-1/sqrt(3) along each axis.
Rule square_rule() {
  constexpr int corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const double at = 1.0 / std::sqrt(3.0);
  Rule rule{{}, 1.0};
  for (std::size_t q = 0; q < 4; ++q)
    for (std::size_t a = 0; a < 4; ++a)
      rule.gradients[q][a] = {0.25 * corner[a][0] * (1.0 + corner[a][1] * at * corner[q][1]),
                              0.25 * corner[a][1] * (1.0 + corner[a][0] * at * corner[q][0])};
  return rule;
}

const Rule& rule_of(std::size_t corners) {
  static const Rule triangle = triangle_rule(), square = square_rule();
  return corners == 3 ? triangle : square;
}

/// f(point, area) at each point of a cell with so many corners; gradients are those in the plane at rest.
template <class Points, class F>
void for_each_point_of(std::size_t count, const Points& points, F&& f) {
  const Rule& rule = rule_of(count);
  GaussPoint<2, 4> point(count);
  point.gradient.fill(Vector2d(0, 0));
  for (std::size_t q = 0; q < points.size(); ++q) {
    const auto [a, b, c] = points[q];
    for (std::size_t k = 0; k < count; ++k) {
      const Vector2d& own = rule.gradients[q][k];
      point.gradient[k] = {a * own[0], b * own[0] + c * own[1]};
    }
    f(point, rule.weight / (a * c));
  }
}

template <class Points, class Line>
Virial share_of(const MembraneLaw& law, const Points& points, std::size_t count, const Line& line) {
  return virial_share(
      law, count, [&](const auto& f) { for_each_point_of(count, points, f); }, line,
      [](const MembraneLaw&, const SurfaceGradient& f) { return f.col(0).cross(f.col(1)).norm() - 1.0; });
}

/// The laws by the number of a cell's material.
class Laws {
 public:
  explicit Laws(const CellMaterials& materials) : materials_(materials) {
    for (const Material& material : materials.all()) laws_.emplace_back(material);
  }
  const MembraneLaw& operator[](std::size_t cell) const { return laws_[materials_.number(cell)]; }

 private:
  CellMaterials materials_;
  std::vector<MembraneLaw> laws_;
};

template <class Columns>
class SurfaceCells {
 public:
  static constexpr int d = 2;
  static constexpr std::size_t most = 4;
  explicit SurfaceCells(const Columns& columns) : columns_(columns) {}

  static std::string_view name() { return "membranes"; }
  std::size_t size() const { return columns_.size(); }
  auto nodes(std::size_t c) const { return columns_.corners(c); }
  auto points(std::size_t c) const { return columns_.points(c); }
  template <class F>
  void for_each_point(const Laws&, std::size_t c, F&& f) const {
    for_each_point_of(nodes(c).size(), points(c), f);
  }

 private:
  Columns columns_;
};

template <class Columns>
class Membranes final : public ElementTerm<SurfaceCells<Columns>, Laws> {
 public:
  Membranes(const CellMaterials& materials, const Columns& columns)
      : ElementTerm<SurfaceCells<Columns>, Laws>(Laws(materials), SurfaceCells<Columns>(columns)),
        materials_(materials),
        columns_(columns) {}

  Virial virial(std::span<const Vector3d> x, std::size_t c) const override {
    const auto n = this->cells_.nodes(c);
    return share_of(this->laws_[c], this->cells_.points(c), n.size(), CornerLines<4>({x}, n));
  }
  TermOfPart of_part(const VertexSubset& part) const override {
    return part_of_elements(*this, materials_, columns_, part);
  }

 private:
  CellMaterials materials_;
  Columns columns_;
};

/// The inverse of a Jacobian with these columns; its last number is negative if their normal points against `up`.
PlaneInverse plane_inverse(const Vector3d& first, const Vector3d& second, const Vector3d& up) {
  const Vector3d normal = first.cross(second);
  const double length = first.norm(), area = normal.dot(up) > 0.0 ? normal.norm() : -normal.norm();
  return {1.0 / length, -first.dot(second) / length / area, length / area};
}

}  // namespace

PlaneInverse triangle_shape_of(const Vector3d& x0, const Vector3d& x1, const Vector3d& x2) {
  return membrane_shape_of(std::array{x0, x1, x2})[0];
}

MembraneShape membrane_shape_of(std::span<const Vector3d> x) {
  const Vector3d up =
      x.size() == 3 ? (x[1] - x[0]).cross(x[2] - x[0]) : (x[2] - x[0]).cross(x[3] - x[1]);  // of its middle
  MembraneShape shape{};
  for (std::size_t q = 0; q < membrane_points(x.size()); ++q) {
    SurfaceGradient jacobian = SurfaceGradient::Zero();
    for (std::size_t a = 1; a < x.size(); ++a)
      jacobian += (x[a] - x[0]) * rule_of(x.size()).gradients[q][a].transpose();
    shape[q] = plane_inverse(jacobian.col(0), jacobian.col(1), up);
  }
  return shape;
}

std::unique_ptr<ForceTerm> make_membranes(const CellMaterials& materials, const TriangleColumns& columns) {
  return std::make_unique<Membranes<TriangleColumns>>(materials, columns);
}
std::unique_ptr<ForceTerm> make_membranes(const CellMaterials& materials, const MembraneColumns& columns) {
  return std::make_unique<Membranes<MembraneColumns>>(materials, columns);
}

Virial membrane_virial(const Material& material, std::span<const PlaneInverse> points, std::span<const Vector3d> x) {
  return share_of(MembraneLaw(material), points, x.size(), [&x](std::size_t a) -> Vector3d { return x[a] - x[0]; });
}

}  // namespace dartboard
