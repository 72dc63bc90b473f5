#include "core/elements/membranes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/elements/force_size.h"
#include "core/elements/membrane_law.h"
#include "core/forces/compensated_sum.h"

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Gradients = std::array<Vector2d, 4>;

/// A rule of integration: by point the gradients of the functions of the corners by the cell's own coordinates. Every
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

/// f(gradients [1/m] of the functions of the corners in the plane at rest, area) at each point.
template <class Points, class F>
void for_each_point(std::size_t count, const Points& points, F&& f) {
  const Rule& rule = rule_of(count);
  Gradients g;
  for (std::size_t q = 0; q < points.size(); ++q) {
    const auto [a, b, c] = points[q];
    for (std::size_t k = 0; k < count; ++k) {
      const Vector2d& own = rule.gradients[q][k];
      g[k] = {a * own[0], b * own[0] + c * own[1]};
    }
    f(g, rule.weight / (a * c));
  }
}

/// sum (line from the first corner to corner a) times g_a', which is F for places, as the gradients add up to nothing.
template <class Line>
SurfaceGradient gradient(std::size_t count, const Gradients& g, const Line& line) {
  SurfaceGradient f = SurfaceGradient::Zero();
  for (std::size_t a = 1; a < count; ++a) f += line(a) * g[a].transpose();
  return f;
}

// The sum over the points of A P F', shared equally by the corners.
template <class Points, class Line>
Virial virial_share(const MembraneLaw& law, const Points& points, std::size_t count, const Line& line) {
  Matrix3d sum = Matrix3d::Zero();
  double growth = 0.0;
  for_each_point(count, points, [&](const Gradients& g, double area) {
    const SurfaceGradient f = gradient(count, g, line);
    sum += area * (law.stress(f) * f.transpose());
    growth += area * (f.col(0).cross(f.col(1)).norm() - 1.0);
  });
  return {(0.5 / static_cast<double>(count)) * (sum + sum.transpose()), growth / static_cast<double>(count)};
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
class Membranes final : public ForceTerm {
 public:
  Membranes(const CellMaterials& materials, const Columns& columns) : laws_(materials), columns_(columns) {}

  std::string_view pieces_name() const override { return "membranes"; }
  std::size_t size() const override { return columns_.size(); }
  Nodes nodes(std::size_t piece) const override { return columns_.corners(piece); }

  void add_forces(const StagePlaces& at, std::span<Vector3d> force) const override {
    for (std::size_t c = 0; c < size(); ++c) {
      const auto n = columns_.corners(c);
      const Lines lines(at, n);
      add_stresses(c, force, [&](const Gradients& g) { return laws_[c].stress(gradient(n.size(), g, lines)); });
    }
  }

  void add_discrete_forces(const StagePlaces& at, std::span<Vector3d> force) const override {
    for (std::size_t c = 0; c < size(); ++c) {
      const auto n = columns_.corners(c);
      const Lines from({at.x}, n), move({at.w}, n);
      add_stresses(c, force, [&](const Gradients& g) {
        return laws_[c].discrete_stress(gradient(n.size(), g, from), (2.0 * at.t) * gradient(n.size(), g, move));
      });
    }
  }

  void add_force_sizes(const StagePlaces& at, std::span<double> size) const override {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const auto n = columns_.corners(c);
      for_each_point(n.size(), columns_.points(c), [&](const Gradients& g, double area) {
        double summed = 0.0;
        for (std::size_t a = 1; a < n.size(); ++a) summed += line_size(at, n[0], n[a]) * g[a].norm();
        const double stress = stress_size(laws_[c].modulus(), summed);
        for (std::size_t a = 0; a < n.size(); ++a) size[n[a]] += area * stress * g[a].norm();
      });
    }
  }

  double energy(std::span<const Vector3d> x, std::size_t first, std::size_t stride) const override {
    CompensatedSum sum;
    for (std::size_t c = first; c < size(); c += stride) {
      const auto n = columns_.corners(c);
      const Lines lines({x}, n);
      for_each_point(n.size(), columns_.points(c), [&](const Gradients& g, double area) {
        sum.add(area * laws_[c].energy(gradient(n.size(), g, lines)));
      });
    }
    return sum.value();
  }

  EnergyChange energy_change(const StagePlaces& at, std::span<const Vector3d> step, double scale) const override {
    EnergyChange sum;
    for (std::size_t c = 0; c < size(); ++c) {
      const auto n = columns_.corners(c);
      const Lines from(at, n), move({step}, n);
      for_each_point(n.size(), columns_.points(c), [&](const Gradients& g, double area) {
        const EnergyChange change = laws_[c].change(gradient(n.size(), g, from), scale * gradient(n.size(), g, move));
        sum.value += area * change.value;
        sum.sizes += area * change.sizes;
      });
    }
    return sum;
  }

  double power(std::span<const std::uint32_t> pieces, std::span<const Vector3d> x,
               std::span<const Vector3d> w) const override {
    double sum = 0.0;
    for (const std::uint32_t c : pieces) {
      const auto n = columns_.corners(c);
      const Lines lines({x}, n), moving({w}, n);
      for_each_point(n.size(), columns_.points(c), [&](const Gradients& g, double area) {
        const SurfaceGradient stress = laws_[c].stress(gradient(n.size(), g, lines));
        sum -= area * stress.cwiseProduct(gradient(n.size(), g, moving)).sum();
      });
    }
    return sum;
  }

  void for_each_tangent(const StagePlaces& at, Compression compression, const VisitTangent& visit) const override {
    std::array<Matrix3d, 10> blocks;
    for (std::size_t c = 0; c < size(); ++c) {
      const auto n = columns_.corners(c);
      const Lines lines(at, n);
      std::ranges::fill(blocks, Matrix3d::Zero());
      for_each_point(n.size(), columns_.points(c), [&](const Gradients& g, double area) {
        const SurfaceHessian h = laws_[c].hessian(gradient(n.size(), g, lines), compression);
        for (std::size_t b = 0; b < n.size(); ++b) {
          const Eigen::Matrix<double, 6, 3> along =
              area * (g[b][0] * h.template middleCols<3>(0) + g[b][1] * h.template middleCols<3>(3));
          for (std::size_t a = b; a < n.size(); ++a)
            blocks[a * (a + 1) / 2 + b] +=
                g[a][0] * along.template middleRows<3>(0) + g[a][1] * along.template middleRows<3>(3);
        }
      });
      visit(n, {blocks.data(), n.size() * (n.size() + 1) / 2});
    }
  }

  void for_each_constant_tangent(const VisitTangent& visit) const override {
    std::array<Matrix3d, 10> blocks;
    for (std::size_t c = 0; c < size(); ++c) {
      const auto n = columns_.corners(c);
      std::ranges::fill(blocks, Matrix3d::Zero());
      for_each_point(n.size(), columns_.points(c), [&](const Gradients& g, double area) {
        for (std::size_t a = 0, k = 0; a < n.size(); ++a)
          for (std::size_t b = 0; b <= a; ++b, ++k)
            blocks[k] += (area * laws_[c].modulus() * g[a].dot(g[b])) * Matrix3d::Identity();
      });
      visit(n, {blocks.data(), n.size() * (n.size() + 1) / 2});
    }
  }

  Virial virial(std::span<const Vector3d> x, std::size_t c) const override {
    const auto n = columns_.corners(c);
    return virial_share(laws_[c], columns_.points(c), n.size(), Lines({x}, n));
  }

 private:
  /// From the first corner to the others.
  struct Lines {
    std::array<Vector3d, 4> to;
    template <class Corners>
    Lines(const StagePlaces& at, const Corners& n) {
      for (std::size_t a = 1; a < n.size(); ++a) to[a] = at.line(n[0], n[a]);
    }
    const Vector3d& operator()(std::size_t a) const { return to[a]; }
  };

  template <class Stress>
  void add_stresses(std::size_t c, std::span<Vector3d> force, const Stress& stress_of) const {
    const auto n = columns_.corners(c);
    std::array<Vector3d, 4> sum;
    sum.fill(Vector3d::Zero());
    for_each_point(n.size(), columns_.points(c), [&](const Gradients& g, double area) {
      const SurfaceGradient weighted = area * stress_of(g);
      for (std::size_t a = 1; a < n.size(); ++a) sum[a] += weighted * g[a];
    });
    // the force on the first corner is minus the sum of the others: rounding changes no momentum
    for (std::size_t a = 1; a < n.size(); ++a) {
      sum[0] += sum[a];
      force[n[a]] -= sum[a];
    }
    force[n[0]] += sum[0];
  }

  Laws laws_;
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
  return virial_share(MembraneLaw(material), points, x.size(), [&x](std::size_t a) -> Vector3d { return x[a] - x[0]; });
}

}  // namespace dartboard
