#include "core/forces/shifted_term.h"

#include <algorithm>
#include <array>

namespace dartboard {
namespace {

using Eigen::Vector3d;

StagePlaces places_from(std::uint32_t first, const StagePlaces& at) {
  return {at.x.subspan(first), at.w.empty() ? at.w : at.w.subspan(first), at.t};
}

ForceTerm::VisitTangent shifted(std::uint32_t first, const ForceTerm::VisitTangent& visit) {
  return [first, &visit](ForceTerm::Nodes nodes, std::span<const Eigen::Matrix3d> blocks) {
    std::array<std::uint32_t, 8> there{};  // no piece has more vertices
    for (std::size_t k = 0; k < nodes.size(); ++k) there.at(k) = first + nodes[k];
    visit(ForceTerm::Nodes(there).first(nodes.size()), blocks);
  };
}

}  // namespace

void ShiftedTerm::shift_to(std::uint32_t first) {
  first_ = first;
  nodes_.clear();
  first_node_.assign(1, 0);
  for (std::size_t piece = 0; piece < term_.size(); ++piece) {
    for (const std::uint32_t node : term_.nodes(piece)) nodes_.push_back(first + node);
    first_node_.push_back(static_cast<std::uint32_t>(nodes_.size()));
  }
}

void ShiftedTerm::add_forces(const StagePlaces& at, std::span<Vector3d> force) const {
  term_.add_forces(places_from(first_, at), force.subspan(first_));
}
void ShiftedTerm::add_forces_in_part(const StagePlaces& at, PieceRun run, VertexRange own,
                                     std::span<Vector3d> force) const {
  own.first = std::max(own.first, first_) - first_;
  own.last = std::max(own.last, first_) - first_;
  term_.add_forces_in_part(places_from(first_, at), run, own, force.subspan(first_));
}
void ShiftedTerm::add_discrete_forces(const StagePlaces& at, std::span<Vector3d> force) const {
  term_.add_discrete_forces(places_from(first_, at), force.subspan(first_));
}
void ShiftedTerm::add_force_sizes(const StagePlaces& at, std::span<double> size) const {
  term_.add_force_sizes(places_from(first_, at), size.subspan(first_));
}
double ShiftedTerm::energy(std::span<const Vector3d> x, std::size_t first, std::size_t stride) const {
  return term_.energy(x.subspan(first_), first, stride);
}
EnergyChange ShiftedTerm::energy_change(const StagePlaces& at, std::span<const Vector3d> step, double scale) const {
  return term_.energy_change(places_from(first_, at), step.subspan(first_), scale);
}
double ShiftedTerm::power(std::span<const std::uint32_t> pieces, std::span<const Vector3d> x,
                          std::span<const Vector3d> w) const {
  return term_.power(pieces, x.subspan(first_), w.subspan(first_));
}
void ShiftedTerm::for_each_tangent(const StagePlaces& at, Compression compression, const VisitTangent& visit) const {
  term_.for_each_tangent(places_from(first_, at), compression, shifted(first_, visit));
}
void ShiftedTerm::for_each_constant_tangent(const VisitTangent& visit) const {
  term_.for_each_constant_tangent(shifted(first_, visit));
}

void ShiftedTerm::Damping::add_forces(const StagePlaces& at, std::span<const Vector3d> v,
                                      std::span<Vector3d> force) const {
  own().add_forces(places_from(of_.first_, at), v.subspan(of_.first_), force.subspan(of_.first_));
}
void ShiftedTerm::Damping::add_force_sizes(const StagePlaces& at, std::span<const Vector3d> v,
                                           std::span<double> size) const {
  own().add_force_sizes(places_from(of_.first_, at), v.subspan(of_.first_), size.subspan(of_.first_));
}
double ShiftedTerm::Damping::power(std::span<const std::uint32_t> pieces, std::span<const Vector3d> x,
                                   std::span<const Vector3d> v, std::span<const Vector3d> w) const {
  return own().power(pieces, x.subspan(of_.first_), v.subspan(of_.first_), w.subspan(of_.first_));
}
EnergyChange ShiftedTerm::Damping::rate_change(const StagePlaces& at, std::span<const Vector3d> v,
                                               std::span<const Vector3d> step, double scale) const {
  return own().rate_change(places_from(of_.first_, at), v.subspan(of_.first_), step.subspan(of_.first_), scale);
}
void ShiftedTerm::Damping::for_each_tangent(const StagePlaces& at, const VisitTangent& visit) const {
  own().for_each_tangent(places_from(of_.first_, at), shifted(of_.first_, visit));
}
void ShiftedTerm::Damping::for_each_constant_tangent(const VisitTangent& visit) const {
  own().for_each_constant_tangent(shifted(of_.first_, visit));
}
void ShiftedTerm::Damping::decay(std::span<const Vector3d> x, double h, const Mobility& mobility, bool backwards,
                                 std::span<Vector3d> v) const {
  own().decay(x.subspan(of_.first_), h, mobility.from(of_.first_), backwards, v.subspan(of_.first_));
}

Virial ShiftedTerm::virial(std::span<const Vector3d> x, std::size_t piece) const {
  return term_.virial(x.subspan(first_), piece);
}

}  // namespace dartboard
