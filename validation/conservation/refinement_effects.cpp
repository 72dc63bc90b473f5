#include "validation/conservation/refinement_effects.h"

#include "core/walks/spring_forces.h"

namespace dartboard {

// Three additions and a division in either mean.
RefinementMeans::RefinementMeans(const VertexColumns& before, std::span<const std::uint32_t> corners) {
  for (const std::uint32_t k : corners) {
    x += before.position[k];
    v += before.velocity[k];
    absolute_x += before.position[k].cwiseAbs();
    absolute_v += before.velocity[k].cwiseAbs();
    all_fixed = all_fixed && before.fixed[k];
  }
  const auto s = static_cast<double>(corners.size());
  for (auto* vector : {&x, &v, &absolute_x, &absolute_v}) *vector /= s;
  off = 2.0 * gamma(5) * absolute_x.norm();
  off_v = 2.0 * gamma(5) * absolute_v.norm();
}

ConservedSums given_away(const VertexColumns& before, std::span<const std::uint32_t> corners, const RefinementMeans& m,
                         double mass) {
  ConservedSums lost;
  const double part = mass / (4.0 * static_cast<double>(corners.size()));
  for (const std::uint32_t k : corners) {
    const Eigen::Vector3d x = before.position[k] - m.x, v = before.velocity[k] - m.v;
    const Eigen::Vector3d size_x = before.position[k].cwiseAbs() + m.absolute_x,
                          size_v = before.velocity[k].cwiseAbs() + m.absolute_v;
    const auto add = [&lost](Conserved c, double term, double size) {
      TwofoldSum& sum = lost[c];
      const double magnitude = sum.magnitude + size;
      sum.add(term);
      sum.magnitude = magnitude;
    };
    const auto spin = [&](Conserved c, int j, int l) {
      add(c, part * (x[j] * v[l] - x[l] * v[j]), part * (size_x[j] * size_v[l] + size_x[l] * size_v[j]));
    };
    spin(Conserved::spin_x, 1, 2);
    spin(Conserved::spin_y, 2, 0);
    spin(Conserved::spin_z, 0, 1);
    add(Conserved::kinetic, 0.5 * (part * v.squaredNorm()), 0.5 * (part * size_v.squaredNorm()));
    for (int j = 0; j < 3; ++j)
      add(static_cast<Conserved>(static_cast<int>(Conserved::momentum_x) + j), 0.0, part * size_v[j]);
    add(Conserved::mass, 0.0, 2.0 * part);
  }
  return lost;
}

// For a spring: k (l - L) has an error of some u k (l + L), the damping one of some u c |dv|. An end displaced by d
// changes l by d, and the direction by 2 d / l at most.
template <class Map>
SpringForceSums spring_force_sums(const LiveBody<Map>& body, const CellArrays& arrays, std::uint32_t put_in,
                                  const RefinementMeans* means) {
  const double off = means ? means->off : 0.0, off_v = means ? means->off_v : 0.0;
  const VertexColumns& v = body.vertices;
  SpringForceSums f{std::vector<Eigen::Vector3d>(v.size(), Eigen::Vector3d(0, 0, 0)),
                    std::vector<double>(v.size(), 0.0), std::vector<double>(v.size(), 0.0),
                    std::vector<std::size_t>(v.size(), 0)};
  arrays.for_each_edge(body, [&](std::uint32_t e, std::uint32_t a, std::uint32_t b) {
    const Spring& s = body.springs[e];
    const Eigen::Vector3d dx = v.position[b] - v.position[a], dv = v.velocity[b] - v.velocity[a];
    const Eigen::Vector3d force = spring_force(s, dx, dv);
    const double length = dx.norm();
    const double terms = s.stiffness * (length + s.rest_length) + s.damping * dv.norm();
    double moved = 0.0;
    if ((a == put_in || b == put_in) && length > 0.0)
      moved =
          s.stiffness * off + s.damping * (off_v + dv.norm() * 2.0 * off / length) + force.norm() * 2.0 * off / length;
    f.force[a] += force;
    f.force[b] -= force;
    for (const std::uint32_t end : {a, b}) {
      f.terms[end] += terms;
      f.moved[end] += moved;
      ++f.springs[end];
    }
  });
  return f;
}

template SpringForceSums spring_force_sums(const LiveBody<Map3>&, const CellArrays&, std::uint32_t,
                                           const RefinementMeans*);
template SpringForceSums spring_force_sums(const LiveBody<TetMap>&, const CellArrays&, std::uint32_t,
                                           const RefinementMeans*);

}  // namespace dartboard
