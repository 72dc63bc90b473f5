#include "tests/determinism/state_hashes.h"

#include <memory>
#include <utility>
#include <vector>

#include "benchmarks/paper/paper_bodies.h"
#include "core/mechanics/fracture/seam.h"
#include "core/mechanics/fracture/stress.h"
#include "core/mechanics/fracture/tearing.h"
#include "core/mechanics/refine.h"
#include "core/mechanics/split_off.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_all.h"
#include "core/operations/dissociate_face.h"
#include "core/operations/remove_volume.h"
#include "core/operations/tear_fan.h"
#include "core/plain/error.h"
#include "core/time/explicit/dormand_prince_54.h"
#include "core/time/implicit/baraff_witkin.h"
#include "core/time/implicit/bdf2.h"
#include "core/time/implicit/one_stage.h"
#include "core/time/implicit/ros2.h"
#include "core/time/implicit/sdirk2.h"
#include "core/time/integrators.h"
#include "core/time/system/energy.h"
#include "core/time/watch/stable_step.h"
#include "core/topology/storage/hash.h"
#include "core/views/views.h"
#include "core/walks/dart_coverage.h"
#include "core/walks/embedding_lists.h"
#include "core/walks/runge_kutta_4.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

// ---- bodies

// A body with all its views, which follow its changes.
template <class Map>
struct Moving {
  MassSpringBody<Map, Held::by_every_dart> body;
  Views views;
  std::unique_ptr<Integrator> integrator;
  Hash hash;

  Moving(const Problem& problem, std::unique_ptr<Integrator> with)
      : body(build_body<Map, Held::by_every_dart>(problem)), integrator(std::move(with)) {
    views.rebuild(body);
  }

  SpringSystem system() const {
    const VertexColumns& v = body.vertices;
    return {.ends = views.ends.ends,
            .springs = body.springs,
            .mass = v.mass,
            .inverse_mass = v.inverse_mass,
            .viscosity = v.viscosity,
            .fixed = v.fixed,
            .gravity = body.surroundings.gravity};
  }
  Motion motion() { return {body.vertices.position, body.vertices.velocity}; }

  void steps(int count, double h) {
    for (int k = 0; k < count; ++k)
      if (const StepResult result = integrator->step(system(), motion(), h); !result.ok())
        throw SolverError(to_string(result));
  }
  void follow(const TopologyChange& change) { follow(change, adapt(body, change)); }
  void follow(const TopologyChange& change, const ChangedEmbeddings& changed) {
    views.apply(body, change, changed);
    integrator->restart();
  }
  void cut(const Vector3d& point, const Vector3d& normal) {
    std::vector<Dart> seam;
    if constexpr (Map::dimension == 2)
      seam = edges_on_plane(body, point, normal);
    else
      seam = faces_on_plane(body, point, normal);
    follow(dissociate_all(body.map, std::span<const Dart>(seam)));
  }

  void add(double number) { hash.add_bytes(&number, sizeof number); }
  std::uint64_t end() {
    hash.add(body.vertices.position);
    hash.add(body.vertices.velocity);
    hash.add(body.vertices.mass);
    hash.add(body.springs.list());
    hash.add(views.ends.ends);
    add(total_energy(system(), body.vertices.position, body.vertices.velocity));
    return hash.value();
  }
};

// Points of the plane z = 0 are held; the others turn and shear.
Problem turning(Mesh mesh) {
  Problem problem;
  problem.mesh = std::move(mesh);
  problem.material = {.density = 1000.0, .stiffness = 60.0, .damping = 0.05, .viscosity = 0.5};
  for (std::uint32_t i = 0; i < problem.mesh.points.size(); ++i) {
    const Vector3d& x = problem.mesh.points[i];
    if (x.z() == 0.0) problem.fixed.push_back(i);
    problem.initial_velocity.emplace_back(x.z() * (3.0 - x.y()), 2.0 * x.x() * x.z(), -0.5 * x.z());
  }
  return problem;
}
Problem small_box() { return turning(kuhn_box(3, 3, 3, 0.05, 0.2, 11)); }
const Vector3d middle(0.075, 0.075, 0.0749);

// ---- runs

// A cut in the middle of the motion: the integrator restarts with its memory, an implicit one updates its factor.
std::uint64_t cut_while_moving(std::unique_ptr<Integrator> integrator, int steps, double h) {
  Moving<TetMap> moving(small_box(), std::move(integrator));
  moving.steps(steps, h);
  moving.cut(middle, {0.3, 1.0, 0.2});
  moving.steps(steps, h);
  return moving.end();
}

template <class Method>
std::unique_ptr<Integrator> implicit(ImplicitOptions options, FactorKind kind = FactorKind::simplicial) {
  options.cholesky.kind = kind;
  return std::make_unique<Method>(options);
}
template <class Method>
std::uint64_t implicit_run() {
  return cut_while_moving(implicit<Method>({}), 4, 0.01);
}

// Step-size control takes powers, so these bits need a libm whose `pow` gives the same.
std::uint64_t adaptive_run() {
  Moving<TetMap> moving(small_box(), std::make_unique<DormandPrince54>());
  auto& method = static_cast<AdaptiveIntegrator&>(*moving.integrator);
  for (int k = 0; k < 4; ++k) {
    if (const StepResult result = method.advance(moving.system(), moving.motion(), 0.01, {1e-8, 1e-6}); !result.ok())
      throw SolverError(to_string(result));
    if (k == 1) moving.cut(middle, {0.3, 1.0, 0.2});
  }
  return moving.end();
}

// As many springs as several threads share.
std::uint64_t cut_when_large() {
  Moving<TetMap> moving(turning(kuhn_box(20, 20, 20, 0.05, 0.2, 11)), make_integrator("rk4"));
  moving.steps(3, 5e-4);
  moving.cut({0.5, 0.5, 0.499}, {0.3, 1.0, 0.2});
  moving.steps(3, 5e-4);
  return moving.end();
}

// A bar that hangs from its end tears under its weight where the stress is high enough, and is measured meanwhile.
template <class Map>
std::uint64_t torn_by_weight() {
  Problem problem = turning(kuhn_box(2, 2, 8, 0.02, 0.2, 1));
  problem.surroundings.gravity = {0.0, 0.0, 30.0};
  Moving<Map> moving(problem, make_integrator("blanes-moan-4"));
  std::vector<Eigen::Matrix3d> stress;
  const TearRule rule{.threshold = 1500.0};
  const auto follow = [&](const TopologyChange& change) { moving.follow(change); };
  StableStepEstimate estimate;
  std::size_t faces = 0;
  for (int k = 0; k < 20; ++k) {
    moving.steps(5, 1e-3);
    faces += tear_where_stressed(moving.body, moving.views.ends.ends, rule, {}, follow, stress).faces;
    moving.add(largest_principal_stress(stress));
    moving.add(estimate.follow(moving.system(), moving.body.vertices.position).lower);
  }
  if (faces == 0) throw InputError("nothing was torn");
  return moving.end();
}

template <class Map>
Dart draw_dart(const Map& map, SplitMix64& random) {
  for (;;)
    if (const Dart d{random.below(map.capacity())}; map.is_live(d)) return d;
}

// Dissociations, fans and removals drawn at random, and components that leave.
template <class Map>
std::uint64_t eroded() {
  Moving<Map> moving(small_box(), make_integrator("rk4"));
  SplitMix64 random(5);
  for (int k = 0; k < 40; ++k) {
    auto& map = moving.body.map;
    const Dart d = draw_dart(map, random);
    moving.follow(k % 3 == 0 ? tear_fan(map, d) : k % 3 == 1 ? dissociate_face(map, d) : remove_volume(map, d));
    if (k == 20) {
      moving.cut(middle, {1.0, 0.1, 0.2});
      const auto apart = split_off(moving.body, draw_dart(map, random));
      moving.follow(apart.change, apart.changed);
      moving.hash.add(apart.part.vertices.position);
    }
    moving.steps(2, 5e-4);
  }
  return moving.end();
}

// Edges, faces and tetrahedra drawn at random are refined; then the body is cut.
template <class Map>
std::uint64_t refined() {
  Moving<Map> moving(small_box(), make_integrator("verlet"));
  SplitMix64 random(9);
  for (int k = 0; k < 30; ++k) {
    auto& body = moving.body;
    const Dart d = draw_dart(body.map, random);
    const double bracing = 0.25 * (k % 2);
    moving.follow({}, k % 3 == 0   ? refine(body, Edge{d}, bracing)
                      : k % 3 == 1 ? refine(body, Face{d}, bracing)
                                   : refine(body, Volume{d}, bracing));
    if (k == 20) moving.cut(middle, {0.3, 1.0, 0.2});
    moving.steps(2, 1e-4);
  }
  return moving.end();
}

template <class Map>
std::uint64_t cut_mesh(Mesh mesh, const Vector3d& point) {
  Moving<Map> moving(turning(std::move(mesh)), make_integrator("symplectic-euler"));
  moving.steps(20, 5e-4);
  moving.cut(point, {1.0, 0.1, 0.2});
  moving.steps(20, 5e-4);
  return moving.end();
}

// The paper's body under the paper's integrator.
template <class Map, Held held, class Walk>
std::uint64_t liver() {
  const Problem problem = paper_body("liver").make();
  auto body = build_body<Map, held>(problem);
  Walk walk;
  if constexpr (requires { walk.rebuild(body); }) walk.rebuild(body);
  RungeKutta4 integrator;
  for (int k = 0; k < 20; ++k) integrator.step(walk, body, problem.h);
  return body.state_hash();
}

constexpr auto one = Held::by_one_dart;
constexpr auto every = Held::by_every_dart;

struct Pinned {
  const char* name;
  std::uint64_t hash;
};

std::vector<HashedRun> make_runs() {
  constexpr std::uint64_t of_liver = 0x58a4e0c7384a4139, torn = 0xcb5b59d751bcbeae;
  std::vector<HashedRun> runs{
      {"liver, dart coverage", liver<Map3, one, DartCoverage>, of_liver},
      {"liver, embedding lists", liver<Map3, one, EmbeddingLists>, of_liver},
      {"liver, cell arrays", liver<Map3, every, CellArrays>, of_liver},
      {"liver, tetrahedral storage, cell arrays", liver<TetMap, every, CellArrays>, of_liver},
      {"liver, tetrahedral storage, dart coverage", liver<TetMap, one, DartCoverage>, of_liver},
      {"torn by weight, tetrahedral storage", torn_by_weight<TetMap>, torn},
      {"torn by weight, general storage", torn_by_weight<Map3>, torn},
      {"eroded and split, tetrahedral storage", eroded<TetMap>, 0xb19519ea836bfdde},
      {"eroded and split, general storage", eroded<Map3>, 0x85432d4de71571d4},
      {"refined and cut, tetrahedral storage", refined<TetMap>, 0x487f829d48946d48},
      {"refined and cut, general storage", refined<Map3>, 0xf07122f8b2345e35},
      {"cut surface",
       [] {
         return cut_mesh<Map2>(triangle_sheet(6, 6, 0.05), {0.151, 0.15, 0.0});
       },
       0x7b28b2d643e5023d},
      {"cut mixed cells",
       [] {
         return cut_mesh<Map3>(mixed_box(4, 3, 3, 0.05), {0.101, 0.07, 0.07});
       },
       0x644896b6b86aae33},
      {"cut when large enough for several threads", cut_when_large, 0xc3631428d56e31e7},
      {"adaptive steps", adaptive_run, 0x84005c95b8ab4cac},
      {"backward-euler", implicit_run<BackwardEuler>, 0x61a3a5b08c7b9ce0},
      {"baraff-witkin", implicit_run<BaraffWitkin>, 0x4c6b11ead002c00d},
      {"ros2", implicit_run<Ros2>, 0x9f0b602a74d4461d},
      {"sdirk2", implicit_run<Sdirk2>, 0xdaeb0908989b8b72},
      {"implicit-midpoint", implicit_run<ImplicitMidpoint>, 0x0a66c6ceebd29320},
      {"bdf2", implicit_run<Bdf2>, 0xc1ebcb2999163314},
      {"energy-momentum",
       [] { return cut_while_moving(implicit<EnergyMomentum>(EnergyMomentum::to_rounding()), 4, 0.01); },
       0xcd4fde5caf76c68d},
      // its factor is of the vertices, too small for supernodes
      {"local-global", [] { return cut_while_moving(make_integrator("local-global"), 4, 0.01); }, 0xba133bc6d9aa58de},
      {"a fresh factor",
       [] { return cut_while_moving(implicit<BackwardEuler>({.solver = LinearSolver::fresh_factor}), 4, 0.01); },
       0xc4cf5395046ab1a1},
      {"conjugate gradients",
       [] { return cut_while_moving(implicit<BackwardEuler>({.solver = LinearSolver::conjugate_gradients}), 4, 0.01); },
       0xd0a9097283e5bc00},
  };
  constexpr Pinned of_explicit[] = {
      {"explicit-euler", 0x9d670412de3dd715},
      {"symplectic-euler", 0xa221d6391db7ac1d},
      {"verlet", 0x17fc079e69dd53aa},
      {"verlet-compensated", 0xafbdb8dc3956508d},
      {"blanes-moan-4", 0xb394b59ccaaae07a},
      {"blanes-moan-4-compensated", 0xea8cf1e7d27ba9b8},
      {"rk4", 0xb83fde209054429c},
      {"dormand-prince-54", 0x0a6b2928e28aeb53},
  };
  for (const Pinned& p : of_explicit)
    runs.push_back({p.name, [p] { return cut_while_moving(make_integrator(p.name), 15, 1e-3); }, p.hash});
  return runs;
}

}  // namespace

std::span<const HashedRun> hashed_runs() {
  static const std::vector<HashedRun> runs = make_runs();
  return runs;
}

std::uint64_t hash_with_supernodal_factor() {
  return cut_while_moving(implicit<BackwardEuler>({}, FactorKind::supernodal), 4, 0.01);
}

}  // namespace dartboard
