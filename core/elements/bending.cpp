#include "core/elements/bending.h"

#include <cmath>

#include "core/elements/spring_pieces.h"
#include "core/forces/compensated_sum.h"
#include "core/forces/force_size.h"
#include "core/forces/rows_of_part.h"

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

class BendingTerm final : public ForceTerm {
 public:
  explicit BendingTerm(const std::vector<BendingEdge>& edges) : edges_(edges) {}

  std::string_view pieces_name() const override { return "edges with bending"; }
  std::size_t size() const override { return edges_.size(); }
  Nodes nodes(std::size_t piece) const override {
    return {edges_[piece].nodes.data(), edges_[piece].empty() ? std::size_t{0} : 4};
  }

  void add_forces(const StagePlaces& at, std::span<Vector3d> force) const override {
    for (const BendingEdge& e : edges_) add_force(e, bend(at, e), force);
  }
  // the mean of the bends at both ends of the step, since the energy is quadratic
  void add_discrete_forces(const StagePlaces& at, std::span<Vector3d> force) const override { add_forces(at, force); }
  void add_force_sizes(const StagePlaces& at, std::span<double> size) const override {
    for (const BendingEdge& e : edges_) {
      double bound = 0.0, at_first = 0.0;
      for (std::size_t k = 0; k < 3; ++k) bound += std::abs(e.c[k]) * line_size(at, e.nodes[0], e.nodes[k + 1]);
      for (std::size_t k = 0; k < 3; ++k) {
        size[e.nodes[k + 1]] += std::abs(e.c[k]) * bound;
        at_first += std::abs(e.c[k]);
      }
      size[e.nodes[0]] += at_first * bound;
    }
  }

  double energy(std::span<const Vector3d> x, std::size_t first, std::size_t stride) const override {
    CompensatedSum sum;
    for (std::size_t k = first; k < edges_.size(); k += stride) sum.add(0.5 * bend({x}, edges_[k]).squaredNorm());
    return sum.value();
  }
  EnergyChange energy_change(const StagePlaces& at, std::span<const Vector3d> step, double scale) const override {
    EnergyChange sum;
    for (const BendingEdge& e : edges_) {
      const Vector3d before = bend(at, e), move = scale * bend({step}, e);
      sum.value += move.dot(before + 0.5 * move);
      sum.sizes += move.norm() * (before.norm() + 0.5 * move.norm());
    }
    return sum;
  }
  double power(std::span<const std::uint32_t> pieces, std::span<const Vector3d> x,
               std::span<const Vector3d> w) const override {
    double sum = 0.0;
    for (const std::uint32_t k : pieces) sum -= bend({x}, edges_[k]).dot(bend({w}, edges_[k]));
    return sum;
  }

  void for_each_tangent(const StagePlaces&, Compression, const VisitTangent& visit) const override {
    for_each_constant_tangent(visit);
  }
  void for_each_constant_tangent(const VisitTangent& visit) const override {
    std::array<Matrix3d, 10> blocks;
    for (const BendingEdge& e : edges_) {
      if (e.empty()) continue;
      const std::array<double, 4> c{-(e.c[0] + e.c[1] + e.c[2]), e.c[0], e.c[1], e.c[2]};
      for (std::size_t a = 0, k = 0; a < 4; ++a)
        for (std::size_t b = 0; b <= a; ++b) blocks[k++] = (c[a] * c[b]) * Matrix3d::Identity();
      visit(e.nodes, blocks);
    }
  }

  Virial virial(std::span<const Vector3d>, std::size_t) const override { return {}; }
  TermOfPart of_part(const VertexSubset& part) const override {
    const auto own = std::make_shared<std::vector<BendingEdge>>(rows_of_part(
        edges_, pieces_of_part(*this, part), part, [](BendingEdge & edge) -> auto& { return edge.nodes; }));
    return {own, make_bending(*own)};
  }

 private:
  static Vector3d bend(const StagePlaces& at, const BendingEdge& e) {
    return e.c[0] * at.line(e.nodes[0], e.nodes[1]) + e.c[1] * at.line(e.nodes[0], e.nodes[2]) +
           e.c[2] * at.line(e.nodes[0], e.nodes[3]);
  }
  static void add_force(const BendingEdge& e, const Vector3d& bend, std::span<Vector3d> force) {
    const Vector3d one = e.c[0] * bend, two = e.c[1] * bend, three = e.c[2] * bend;
    force[e.nodes[0]] += one + two + three;
    force[e.nodes[1]] -= one;
    force[e.nodes[2]] -= two;
    force[e.nodes[3]] -= three;
  }

  const std::vector<BendingEdge>& edges_;
};

class NeighbourPieces {
 public:
  NeighbourPieces(const std::vector<SecondNeighbours>& edges, double stiffness)
      : edges_(edges), stiffness_(stiffness) {}
  static std::string_view name() { return "edges with second neighbours"; }
  std::size_t size() const { return edges_.size(); }
  ForceTerm::Nodes nodes(std::size_t k) const { return {edges_[k].nodes.data(), edges_[k].count}; }
  template <class F>
  void for_each(std::size_t k, const F& f) const {
    const SecondNeighbours& e = edges_[k];
    if (e.count == 2) f(PieceSpring{0, 1, e.rest_length[0], stiffness_});
    if (e.count != 4) return;
    f(PieceSpring{0, 1, e.rest_length[0], 0.5 * stiffness_});
    f(PieceSpring{2, 3, e.rest_length[1], 0.5 * stiffness_});
  }
  TermOfPart of_part(const std::vector<std::uint32_t>& pieces, const VertexSubset& part) const {
    const auto own = std::make_shared<std::vector<SecondNeighbours>>(rows_of_part(
        edges_, pieces, part, [](SecondNeighbours& edge) { return std::span(edge.nodes).first(edge.count); }));
    return {own, make_second_neighbours(*own, stiffness_)};
  }

 private:
  const std::vector<SecondNeighbours>& edges_;
  double stiffness_;
};

}  // namespace

std::array<double, 3> bending_coefficients(double rigidity, const Vector3d& x0, const Vector3d& x1, const Vector3d& x2,
                                           const Vector3d& x3) {
  const double length = (x1 - x0).norm();
  const Vector3d along = (x1 - x0) / length;
  // the place of the foot of each height along the edge, and the heights
  const double foot2 = along.dot(x2 - x0), foot3 = along.dot(x3 - x0);
  const double h2 = (x2 - x0 - foot2 * along).norm(), h3 = (x3 - x0 - foot3 * along).norm();
  // |e|^2 / (A2 + A3) = 2 |e| / (h2 + h3)
  const double scale = std::sqrt(rigidity * 2.0 * length / (h2 + h3));
  return {-scale * (foot2 / h2 + foot3 / h3) / length, scale / h2, scale / h3};
}

std::unique_ptr<ForceTerm> make_bending(const std::vector<BendingEdge>& edges) {
  return std::make_unique<BendingTerm>(edges);
}

std::unique_ptr<ForceTerm> make_second_neighbours(const std::vector<SecondNeighbours>& edges, double stiffness) {
  return std::make_unique<SpringPieces<NeighbourPieces>>(NeighbourPieces(edges, stiffness));
}

}  // namespace dartboard
