#include "validation/solvers/solver_bodies.h"

#include <algorithm>

#include "core/mechanics/adapt.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_all.h"
#include "core/operations/tear_fan.h"
#include "core/plain/random.h"
#include "core/views/spring_ends.h"

namespace dartboard {
namespace {

using TetBody = MassSpringBody<TetMap, Held::by_every_dart>;

SpringColumns columns_of(const TetBody& body, double stretch) {
  SpringEndsView ends;
  ends.rebuild(body);
  const VertexColumns& v = body.vertices;
  SpringColumns columns{ends.ends, body.springs.list(), v.mass,     v.inverse_mass, v.viscosity,
                        v.fixed,   {0, 0, 0},           v.position, v.velocity};
  Eigen::Matrix3d field;
  field << 1.0 + stretch, 0.5 * stretch, 0.0, 0.0, 1.0 + 0.6 * stretch, 0.3 * stretch, 0.2 * stretch, 0.0,
      1.0 + 0.3 * stretch;
  if (stretch != 0.0)
    for (Eigen::Vector3d& p : columns.x) p = field * p;
  return columns;
}

}  // namespace

DissociationPairs dissociation_pairs(int side, double stretch, std::size_t count) {
  Problem problem;
  problem.mesh = kuhn_box(side - 1, side - 1, side - 1, 0.1, 0.25, 1);
  problem.material = {.density = 1000.0, .stiffness = 5.0, .damping = 0.0, .viscosity = 0.0};
  const TetBody body = build_body<TetMap, Held::by_every_dart>(problem);
  DissociationPairs pairs{columns_of(body, stretch), {}};

  std::vector<std::uint32_t> interior;
  const double far = 0.1 * (side - 1);
  for (std::uint32_t k = 0; k < body.vertices.size(); ++k) {
    const Eigen::Vector3d& p = body.vertices.position[k];
    if (p.minCoeff() > 0.02 && p.maxCoeff() < far - 0.02) interior.push_back(k);
  }
  SplitMix64 random(7);
  for (std::size_t k = interior.size(); k > 1; --k) std::swap(interior[k - 1], interior[random.below(k)]);
  for (const std::uint32_t k : interior) {
    if (pairs.torn.size() == count) break;
    TetBody torn = body;
    const auto faces = fan(torn.map, torn.vertices.dart[k]);
    if (faces.empty()) continue;
    adapt(torn, dissociate_all(torn.map, std::span<const Dart>(faces)));
    if (torn.vertices.size() == body.vertices.size() + 1) pairs.torn.push_back(columns_of(torn, stretch));
  }
  return pairs;
}

SolverMatrix::SolverMatrix(const SpringColumns& columns, Compression compression, double tau) {
  const SpringSystem system = columns.system();
  evaluate_tangents(system, columns.x, compression, tangents);
  step.evaluate(system, tangents, tau);
  step.assemble(node_pattern_of(system), blocks);
}

std::vector<Eigen::Vector3d> drawn_vectors(std::size_t count, std::uint64_t seed) {
  SplitMix64 random(seed);
  std::vector<Eigen::Vector3d> result(count);
  for (Eigen::Vector3d& p : result)
    for (int c = 0; c < 3; ++c) p[c] = random.next_signed();
  return result;
}

}  // namespace dartboard
