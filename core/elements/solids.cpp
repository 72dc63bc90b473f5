#include "core/elements/solids.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/elements/force_size.h"
#include "core/elements/strain_damping.h"
#include "core/elements/with_law.h"
#include "core/forces/compensated_sum.h"

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Gradients = std::array<Vector3d, 8>;

/// Gauss points of a kind of cell: gradients of the functions of its corners by its own coordinates, and weights.
struct Rule {
  std::vector<Gradients> gradients;
  std::vector<double> weights;
};

// On the cube [-1, 1]^3, at +-1/sqrt(3) along each axis.
Rule cube_rule() {
  constexpr int corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  const double at = 1.0 / std::sqrt(3.0);
  Rule rule;
  for (const auto& point : corner) {
    Gradients g;
    for (std::size_t a = 0; a < 8; ++a) {
      Vector3d factor;  // (1 +- xi) / 2 along each axis
      for (int c = 0; c < 3; ++c) factor[c] = 0.5 * (1.0 + corner[a][c] * at * point[c]);
      g[a] = {0.5 * corner[a][0] * factor[1] * factor[2], 0.5 * corner[a][1] * factor[0] * factor[2],
              0.5 * corner[a][2] * factor[0] * factor[1]};
    }
    rule.gradients.push_back(g);
    rule.weights.push_back(1.0);
  }
  return rule;
}

// The four corners of the upper side are one.
Rule pyramid_rule() {
  Rule rule = cube_rule();
  for (Gradients& g : rule.gradients) {
    g[4] += g[5] + g[6] + g[7];
    g[5] = g[6] = g[7] = Vector3d::Zero();
  }
  return rule;
}

// Three points of the triangle (0, 0), (1, 0), (0, 1), exact for squares, times two along [-1, 1].
Rule prism_rule() {
  const double slope[3][2] = {{-1, -1}, {1, 0}, {0, 1}};
  Rule rule;
  for (const double sign : {-1.0, 1.0})
    for (std::size_t near = 0; near < 3; ++near) {
      const double z = sign / std::sqrt(3.0);
      Gradients g;
      g.fill(Vector3d::Zero());
      for (std::size_t a = 0; a < 3; ++a) {
        const double share = a == near ? 2.0 / 3.0 : 1.0 / 6.0;
        g[a] = {0.5 * (1.0 - z) * slope[a][0], 0.5 * (1.0 - z) * slope[a][1], -0.5 * share};
        g[a + 3] = {0.5 * (1.0 + z) * slope[a][0], 0.5 * (1.0 + z) * slope[a][1], 0.5 * share};
      }
      rule.gradients.push_back(g);
      rule.weights.push_back(1.0 / 6.0);
    }
  return rule;
}

Rule tetrahedron_rule() {
  Gradients g;
  g.fill(Vector3d::Zero());
  g[0] = {-1, -1, -1};
  for (int c = 0; c < 3; ++c) g[static_cast<std::size_t>(c) + 1] = Vector3d::Unit(c);
  return {{g}, {1.0 / 6.0}};
}

const Rule& rule_of(CellKind kind) {
  static const Rule cube = cube_rule(), prism = prism_rule(), pyramid = pyramid_rule(),
                    tetrahedron = tetrahedron_rule();
  switch (kind) {
    case CellKind::hexahedron: return cube;
    case CellKind::prism: return prism;
    case CellKind::pyramid: return pyramid;
    default: return tetrahedron;
  }
}

/// The gradients [1/m] of the functions of the corners at Gauss point q, at rest.
void gradients_at(const SolidShape& shape, const Rule& rule, std::size_t q, std::size_t count, Gradients& g) {
  for (std::size_t a = 0; a < count; ++a) g[a] = shape.inverse[q].transpose() * rule.gradients[q][a];
}

/// sum (line from the first corner to corner a) times g_a', which is F for places, as the gradients add up to nothing.
template <class Line>
Matrix3d gradient(std::size_t count, const Gradients& g, const Line& line) {
  Matrix3d f = Matrix3d::Zero();
  for (std::size_t a = 1; a < count; ++a) f += line(a) * g[a].transpose();
  return f;
}

// The sum over the points of V P F', shared equally by the corners.
template <class Law, class Line>
Virial virial_share(const Law& law, const SolidShape& shape, std::size_t count, const Line& line) {
  const Rule& rule = rule_of(shape.kind);
  Gradients g;
  Matrix3d sum = Matrix3d::Zero();
  double growth = 0.0;
  for (std::size_t q = 0; q < rule.weights.size(); ++q) {
    gradients_at(shape, rule, q, count, g);
    const Matrix3d f = gradient(count, g, line);
    sum += shape.volume[q] * (law.stress(f) * f.transpose());
    growth += shape.volume[q] * (volume_ratio(law, f) - 1.0);
  }
  return {(0.5 / static_cast<double>(count)) * (sum + sum.transpose()), growth / static_cast<double>(count)};
}

/// The Gauss points of each cell, for its damping.
class SolidPoints {
 public:
  explicit SolidPoints(const SolidColumns& columns) : columns_(columns) {}
  std::size_t size() const { return columns_.nodes.size(); }
  ForceTerm::Nodes nodes(std::size_t piece) const {
    return {columns_.nodes[piece].at.data(), columns_.nodes[piece].count};
  }
  std::size_t points(std::size_t piece) const { return rule_of(columns_.shape[piece].kind).weights.size(); }
  double place(std::size_t piece, std::size_t q, const DampedMaterial&, Gradients& g) const {
    const SolidShape& shape = columns_.shape[piece];
    gradients_at(shape, rule_of(shape.kind), q, columns_.nodes[piece].count, g);
    return shape.volume[q];
  }

 private:
  SolidColumns columns_;
};

template <class Laws>
class Solids final : public ForceTerm {
 public:
  Solids(const Laws& laws, const CellMaterials& materials, const SolidColumns& columns)
      : laws_(laws), columns_(columns), damping_(materials, SolidPoints(columns)) {}

  std::string_view pieces_name() const override { return "solid cells"; }
  std::size_t size() const override { return columns_.nodes.size(); }
  Nodes nodes(std::size_t piece) const override {
    return {columns_.nodes[piece].at.data(), columns_.nodes[piece].count};
  }

  void add_forces(const StagePlaces& at, std::span<Vector3d> force) const override {
    for (std::size_t c = 0; c < size(); ++c) {
      const Lines lines(at, columns_.nodes[c]);
      add_stresses(c, force,
                   [&](const Gradients& g, std::size_t count) { return laws_[c].stress(gradient(count, g, lines)); });
    }
  }

  void add_discrete_forces(const StagePlaces& at, std::span<Vector3d> force) const override {
    for (std::size_t c = 0; c < size(); ++c) {
      const Lines from({at.x}, columns_.nodes[c]), move({at.w}, columns_.nodes[c]);
      add_stresses(c, force, [&](const Gradients& g, std::size_t count) {
        return discrete_stress(laws_[c], gradient(count, g, from), (2.0 * at.t) * gradient(count, g, move));
      });
    }
  }

  void add_force_sizes(const StagePlaces& at, std::span<double> size) const override {
    for (std::size_t c = 0; c < columns_.nodes.size(); ++c) {
      const SolidNodes& n = columns_.nodes[c];
      for_each_point(c, [&](const Gradients& g, double volume) {
        double summed = 0.0;
        for (std::size_t a = 1; a < n.count; ++a) summed += line_size(at, n.at[0], n.at[a]) * g[a].norm();
        const double stress = stress_size(laws_[c].modulus(), summed);
        for (std::size_t a = 0; a < n.count; ++a) size[n.at[a]] += volume * stress * g[a].norm();
      });
    }
  }

  double energy(std::span<const Vector3d> x, std::size_t first, std::size_t stride) const override {
    CompensatedSum sum;
    for (std::size_t c = first; c < size(); c += stride) {
      const Lines lines({x}, columns_.nodes[c]);
      for_each_point(c, [&](const Gradients& g, double volume) {
        sum.add(volume * laws_[c].energy(gradient(columns_.nodes[c].count, g, lines)));
      });
    }
    return sum.value();
  }

  EnergyChange energy_change(const StagePlaces& at, std::span<const Vector3d> step, double scale) const override {
    EnergyChange sum;
    for (std::size_t c = 0; c < size(); ++c) {
      const Lines from(at, columns_.nodes[c]), move({step}, columns_.nodes[c]);
      for_each_point(c, [&](const Gradients& g, double volume) {
        const std::size_t count = columns_.nodes[c].count;
        const EnergyChange change = laws_[c].change(gradient(count, g, from), scale * gradient(count, g, move));
        sum.value += volume * change.value;
        sum.sizes += volume * change.sizes;
      });
    }
    return sum;
  }

  double power(std::span<const std::uint32_t> pieces, std::span<const Vector3d> x,
               std::span<const Vector3d> w) const override {
    double sum = 0.0;
    for (const std::uint32_t c : pieces) {
      const Lines lines({x}, columns_.nodes[c]), moving({w}, columns_.nodes[c]);
      for_each_point(c, [&](const Gradients& g, double volume) {
        const std::size_t count = columns_.nodes[c].count;
        sum -= volume * laws_[c].stress(gradient(count, g, lines)).cwiseProduct(gradient(count, g, moving)).sum();
      });
    }
    return sum;
  }

  void for_each_tangent(const StagePlaces& at, Compression compression, const VisitTangent& visit) const override {
    std::array<Matrix3d, 36> blocks;
    for (std::size_t c = 0; c < size(); ++c) {
      const std::size_t count = columns_.nodes[c].count;
      const Lines lines(at, columns_.nodes[c]);
      std::ranges::fill(blocks, Matrix3d::Zero());
      for_each_point(c, [&](const Gradients& g, double volume) {
        const Hessian h = laws_[c].hessian(gradient(count, g, lines), compression);
        for (std::size_t b = 0; b < count; ++b) {
          const Eigen::Matrix<double, 9, 3> along =
              volume * (g[b][0] * h.middleCols<3>(0) + g[b][1] * h.middleCols<3>(3) + g[b][2] * h.middleCols<3>(6));
          for (std::size_t a = b; a < count; ++a)
            blocks[a * (a + 1) / 2 + b] += g[a][0] * along.template middleRows<3>(0) +
                                           g[a][1] * along.template middleRows<3>(3) +
                                           g[a][2] * along.template middleRows<3>(6);
        }
      });
      visit(nodes(c), {blocks.data(), count * (count + 1) / 2});
    }
  }

  void for_each_constant_tangent(const VisitTangent& visit) const override {
    std::array<Matrix3d, 36> blocks;
    for (std::size_t c = 0; c < size(); ++c) {
      const std::size_t count = columns_.nodes[c].count;
      std::ranges::fill(blocks, Matrix3d::Zero());
      for_each_point(c, [&](const Gradients& g, double volume) {
        for (std::size_t a = 0, k = 0; a < count; ++a)
          for (std::size_t b = 0; b <= a; ++b, ++k)
            blocks[k] += (volume * laws_[c].modulus() * g[a].dot(g[b])) * Matrix3d::Identity();
      });
      visit(nodes(c), {blocks.data(), count * (count + 1) / 2});
    }
  }

  Virial virial(std::span<const Vector3d> x, std::size_t c) const override {
    return virial_share(laws_[c], columns_.shape[c], columns_.nodes[c].count, Lines({x}, columns_.nodes[c]));
  }

  const TermDamping* damping() const override { return damping_.any() ? &damping_ : nullptr; }

 private:
  /// From the first corner to the others.
  struct Lines {
    std::array<Vector3d, 8> to;
    Lines(const StagePlaces& at, const SolidNodes& n) {
      for (std::size_t a = 1; a < n.count; ++a) to[a] = at.line(n.at[0], n.at[a]);
    }
    const Vector3d& operator()(std::size_t a) const { return to[a]; }
  };

  /// f(gradients, volume)
  template <class F>
  void for_each_point(std::size_t c, F&& f) const {
    const SolidShape& shape = columns_.shape[c];
    const Rule& rule = rule_of(shape.kind);
    Gradients g;
    for (std::size_t q = 0; q < rule.weights.size(); ++q) {
      gradients_at(shape, rule, q, columns_.nodes[c].count, g);
      f(g, shape.volume[q]);
    }
  }

  template <class Stress>
  void add_stresses(std::size_t c, std::span<Vector3d> force, const Stress& stress_of) const {
    const SolidNodes& n = columns_.nodes[c];
    std::array<Vector3d, 8> sum;
    sum.fill(Vector3d::Zero());
    for_each_point(c, [&](const Gradients& g, double volume) {
      const Matrix3d weighted = volume * stress_of(g, n.count);
      for (std::size_t a = 1; a < n.count; ++a) sum[a] += weighted * g[a];
    });
    // the force on the first corner is minus the sum of the others: rounding changes no momentum
    for (std::size_t a = 1; a < n.count; ++a) {
      sum[0] += sum[a];
      force[n.at[a]] -= sum[a];
    }
    force[n.at[0]] += sum[0];
  }

  Laws laws_;
  SolidColumns columns_;
  StrainDamping<SolidPoints> damping_;
};

}  // namespace

std::size_t gauss_points(CellKind kind) { return rule_of(kind).weights.size(); }

SolidShape solid_shape_of(CellKind kind, std::span<const Vector3d> x) {
  const Rule& rule = rule_of(kind);
  SolidShape shape;
  shape.kind = kind;
  shape.inverse.fill(Matrix3d::Zero());
  for (std::size_t q = 0; q < rule.weights.size(); ++q) {
    Matrix3d jacobian = Matrix3d::Zero();
    for (std::size_t a = 1; a < x.size(); ++a) jacobian += (x[a] - x[0]) * rule.gradients[q][a].transpose();
    const Matrix3d cof = cofactors(jacobian);
    const double det = jacobian.row(0).dot(cof.row(0));
    shape.inverse[q] = cof.transpose() / det;
    shape.volume[q] = rule.weights[q] * det;
  }
  return shape;
}

std::unique_ptr<ForceTerm> make_solids(const CellMaterials& materials, const SolidColumns& columns) {
  return with_laws_of(materials, [&]<class Laws>(const Laws& laws) -> std::unique_ptr<ForceTerm> {
    return std::make_unique<Solids<Laws>>(laws, materials, columns);
  });
}

Virial solid_virial(const Material& material, const SolidShape& shape, std::span<const Vector3d> x) {
  const auto line = [&x](std::size_t a) -> Vector3d { return x[a] - x[0]; };
  if (material.model == Model::springs) return virial_share(NoLaw(), shape, x.size(), line);
  return with_law_of(material, [&](const auto& law) { return virial_share(law, shape, x.size(), line); });
}

}  // namespace dartboard
