#include "core/elements/attachments.h"

#include <cmath>

#include "core/forces/compensated_sum.h"
#include "core/forces/force_size.h"
#include "core/forces/rows_of_part.h"

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

class AttachmentTerm final : public ForceTerm {
 public:
  AttachmentTerm(const std::vector<AttachedVertex>& rows, const std::vector<double>& mass) : rows_(rows), mass_(mass) {}

  std::string_view pieces_name() const override { return "attachments"; }
  std::size_t size() const override { return rows_.size(); }
  Nodes nodes(std::size_t piece) const override { return {rows_[piece].nodes.data(), rows_[piece].count}; }
  bool is_within_cells() const override { return false; }

  void add_forces(const StagePlaces& at, std::span<Vector3d> force) const override {
    for (const AttachedVertex& row : rows_) {
      const Vector3d pull = stiffness(row) * stretch(at, row);
      if (row.count == 1) force[row.nodes[0]] -= pull;
      // the vertex takes what the corners take, so that the sum is zero to rounding whatever the sum of the weights
      for (std::size_t a = 1; a < row.count; ++a) {
        const Vector3d share = row.weight[a - 1] * pull;
        force[row.nodes[a]] += share;
        force[row.nodes[0]] -= share;
      }
    }
  }
  // the mean of the stretches at both ends of the step, since the energy is quadratic
  void add_discrete_forces(const StagePlaces& at, std::span<Vector3d> force) const override { add_forces(at, force); }
  void add_force_sizes(const StagePlaces& at, std::span<double> size) const override {
    for (const AttachedVertex& row : rows_) {
      const std::uint32_t vertex = row.nodes[0];
      double bound = 0.0, weights = 0.0;
      if (row.count == 1) {
        const double moved = at.w.empty() ? 0.0 : std::abs(at.t) * at.w[vertex].norm();
        bound = at.x[vertex].norm() + row.place.norm() + moved;
        weights = 1.0;
      }
      for (std::size_t a = 1; a < row.count; ++a) {
        bound += std::abs(row.weight[a - 1]) * line_size(at, row.nodes[a], vertex);
        weights += std::abs(row.weight[a - 1]);
      }
      const double k = stiffness(row);
      size[vertex] += weights * k * bound;
      for (std::size_t a = 1; a < row.count; ++a) size[row.nodes[a]] += std::abs(row.weight[a - 1]) * k * bound;
    }
  }

  double energy(std::span<const Vector3d> x, std::size_t first, std::size_t stride) const override {
    CompensatedSum sum;
    for (std::size_t k = first; k < rows_.size(); k += stride)
      sum.add(0.5 * stiffness(rows_[k]) * stretch({x}, rows_[k]).squaredNorm());
    return sum.value();
  }
  EnergyChange energy_change(const StagePlaces& at, std::span<const Vector3d> step, double scale) const override {
    EnergyChange sum;
    for (const AttachedVertex& row : rows_) {
      const double k = stiffness(row);
      const Vector3d before = stretch(at, row), move = scale * rate(step, row);
      sum.value += k * move.dot(before + 0.5 * move);
      sum.sizes += k * move.norm() * (before.norm() + 0.5 * move.norm());
    }
    return sum;
  }
  double power(std::span<const std::uint32_t> pieces, std::span<const Vector3d> x,
               std::span<const Vector3d> w) const override {
    double sum = 0.0;
    for (const std::uint32_t k : pieces) sum -= stiffness(rows_[k]) * stretch({x}, rows_[k]).dot(rate(w, rows_[k]));
    return sum;
  }

  void for_each_tangent(const StagePlaces&, Compression, const VisitTangent& visit) const override {
    for_each_constant_tangent(visit);
  }
  void for_each_constant_tangent(const VisitTangent& visit) const override {
    std::array<Matrix3d, 15> blocks;
    for (const AttachedVertex& row : rows_) {
      const double k = stiffness(row);
      std::array<double, 5> slope{row.count == 1 ? 1.0 : 0.0};
      for (std::size_t a = 1; a < row.count; ++a) {
        slope[a] = -row.weight[a - 1];
        slope[0] += row.weight[a - 1];
      }
      std::size_t count = 0;
      for (std::size_t a = 0; a < row.count; ++a)
        for (std::size_t b = 0; b <= a; ++b) blocks[count++] = (k * slope[a] * slope[b]) * Matrix3d::Identity();
      visit({row.nodes.data(), row.count}, {blocks.data(), count});
    }
  }

  Virial virial(std::span<const Vector3d>, std::size_t) const override { return {}; }
  TermOfPart of_part(const VertexSubset& part) const override {
    struct Columns {
      std::vector<AttachedVertex> rows;
      std::vector<double> mass;
    };
    const auto own = std::make_shared<Columns>();
    own->rows = rows_of_part(rows_, pieces_of_part(*this, part), part,
                             [](AttachedVertex& row) { return std::span(row.nodes).first(row.count); });
    own->mass.resize(mass_.size());
    for (std::size_t i = 0; i < part.number.size(); ++i)
      if (part.number[i] != VertexSubset::none) own->mass[part.number[i]] = mass_[i];
    return {own, make_attachments(own->rows, own->mass)};
  }

 private:
  double stiffness(const AttachedVertex& row) const { return row.per_mass * mass_[row.nodes[0]]; }
  /// [m] From the point that a vertex is attached to, to the vertex.
  static Vector3d stretch(const StagePlaces& at, const AttachedVertex& row) {
    const std::uint32_t vertex = row.nodes[0];
    if (row.count == 1) {
      const Vector3d from = at.x[vertex] - row.place;
      return at.w.empty() ? from : from + at.t * at.w[vertex];
    }
    Vector3d sum(0, 0, 0);
    for (std::size_t a = 1; a < row.count; ++a) sum += row.weight[a - 1] * at.line(row.nodes[a], vertex);
    return sum;
  }
  /// The change of the stretch as vertices move by w.
  static Vector3d rate(std::span<const Vector3d> w, const AttachedVertex& row) {
    return row.count == 1 ? w[row.nodes[0]] : stretch({w}, row);
  }

  const std::vector<AttachedVertex>& rows_;
  const std::vector<double>& mass_;
};

}  // namespace

AttachedVertex attached(const Attachment& attachment, std::uint32_t vertex) {
  return {.count = 1 + attachment.count,
          .nodes = {vertex},
          .weight = attachment.weight,
          .place = attachment.place,
          .per_mass = attachment.per_mass};
}

Vector3d place_of(const AttachedVertex& spring, std::span<const Vector3d> x) {
  Vector3d place = spring.count == 1 ? spring.place : Vector3d(0, 0, 0);
  for (std::size_t a = 1; a < spring.count; ++a) place += spring.weight[a - 1] * x[spring.nodes[a]];
  return place;
}

std::unique_ptr<ForceTerm> make_attachments(const std::vector<AttachedVertex>& rows, const std::vector<double>& mass) {
  return std::make_unique<AttachmentTerm>(rows, mass);
}

}  // namespace dartboard
