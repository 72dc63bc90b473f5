#include "core/elements/solids.h"

#include <Eigen/LU>
#include <cmath>
#include <variant>

#include "core/elements/element_term.h"
#include "core/elements/lanes/solids_lanes.h"
#include "core/elements/part_of_elements.h"
#include "core/elements/strain_damping.h"
#include "core/elements/with_law.h"

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Gradients = std::array<Vector3d, 8>;  // or lines, speeds and forces, by corner

/// The quadrature rule of a kind of cell: gradients of the shape functions in reference coordinates, and weights.
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

/// The gradients [1/m] of the shape functions at Gauss point q, at rest.
void gradients_at(const SolidShape& shape, const Rule& rule, std::size_t q, std::size_t count, Gradients& g) {
  for (std::size_t a = 0; a < count; ++a) g[a] = shape.inverse[q].transpose() * rule.gradients[q][a];
}

/// f(point, volume) at each Gauss point, from one on, of a cell with so many corners.
template <class F>
void for_each_point_of(const SolidShape& shape, std::size_t count, F&& f, std::size_t first = 0) {
  const Rule& rule = rule_of(shape.kind);
  GaussPoint<3, 8> point(count);
  for (std::size_t q = first; q < rule.weights.size(); ++q) {
    gradients_at(shape, rule, q, count, point.gradient);
    f(point, shape.volume[q]);
  }
}

template <class Law, class Line>
Virial share_of(const Law& law, const SolidShape& shape, std::size_t count, const Line& line) {
  return virial_share(
      law, count, [&](const auto& f) { for_each_point_of(shape, count, f); }, line,
      [](const auto& of, const Matrix3d& f) { return volume_ratio(of, f) - 1.0; });
}

class SolidCells {
 public:
  static constexpr int d = 3;
  static constexpr std::size_t most = 8;
  explicit SolidCells(const SolidColumns& columns) : columns_(columns) {}

  static std::string_view name() { return "solid cells"; }
  std::size_t size() const { return columns_.nodes.size(); }
  ForceTerm::Nodes nodes(std::size_t c) const { return {columns_.nodes[c].at.data(), columns_.nodes[c].count}; }
  const SolidShape& shape(std::size_t c) const { return columns_.shape[c]; }
  template <class Laws, class F>
  void for_each_point(const Laws&, std::size_t c, F&& f, std::size_t first = 0) const {
    for_each_point_of(shape(c), columns_.nodes[c].count, f, first);
  }
  template <class Law>
  std::size_t add_stresses_in_lanes(const Law& law, std::size_t c, const Gradients& lines, Gradients& sum) const {
    if constexpr (requires { law.constants(); })
      return dartboard::add_stresses_in_lanes(points_at(c), law.constants(), lines.data(), sum.data());
    else if constexpr (requires { law.law(); })
      return std::visit([&](const auto& one) { return add_stresses_in_lanes(one, c, lines, sum); }, law.law());
    else
      return 0;
  }

  // for damping
  std::size_t points(std::size_t c) const { return rule_of(shape(c).kind).weights.size(); }
  double place(std::size_t c, std::size_t q, const DampedMaterial&, Gradients& g) const {
    gradients_at(shape(c), rule_of(shape(c).kind), q, columns_.nodes[c].count, g);
    return shape(c).volume[q];
  }
  std::size_t add_stresses_in_lanes(const DampedMaterial& m, std::size_t c, const Gradients& lines,
                                    const Gradients& speeds, Gradients& sum) const {
    return add_damping_in_lanes(points_at(c), {2.0 * m.mu * m.time, m.lambda * m.time}, lines.data(), speeds.data(),
                                sum.data());
  }

 private:
  GaussPointsAt points_at(std::size_t c) const {
    const Rule& rule = rule_of(shape(c).kind);
    return {rule.gradients.data(), shape(c).inverse.data(), shape(c).volume.data(), rule.weights.size(),
            columns_.nodes[c].count};
  }

  SolidColumns columns_;
};

template <class Laws>
class Solids final : public ElementTerm<SolidCells, Laws> {
 public:
  Solids(const Laws& laws, const CellMaterials& materials, const SolidColumns& columns)
      : ElementTerm<SolidCells, Laws>(laws, SolidCells(columns)),
        materials_(materials),
        columns_(columns),
        damping_(materials, SolidCells(columns)) {}

  Virial virial(std::span<const Vector3d> x, std::size_t c) const override {
    const auto n = cells_.nodes(c);
    return share_of(laws_[c], cells_.shape(c), n.size(), CornerLines<8>({x}, n));
  }
  const TermDamping* damping() const override { return damping_.any() ? &damping_ : nullptr; }
  TermOfPart of_part(const VertexSubset& part) const override {
    return part_of_elements(*this, materials_, columns_, part);
  }

 private:
  using ElementTerm<SolidCells, Laws>::cells_, ElementTerm<SolidCells, Laws>::laws_;
  CellMaterials materials_;
  SolidColumns columns_;
  StrainDamping<SolidCells> damping_;
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
  if (material.model == Model::springs) return share_of(NoLaw(), shape, x.size(), line);
  return with_law_of(material, [&](const auto& law) { return share_of(law, shape, x.size(), line); });
}

}  // namespace dartboard
