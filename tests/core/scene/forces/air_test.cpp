// Drag by still or moving air.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "core/forces/term_damping.h"
#include "core/plain/random.h"
#include "core/scene/file/scene_problem.h"
#include "core/time/integrators.h"
#include "tests/support/moving_box.h"
#include "tests/support/plan_memory.h"
#include "tests/support/run_in_memory.h"

namespace dartboard::air_test {
namespace {

using namespace moving;
using Eigen::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr double drag = 0.5;  // [N s/m^3]

Json with_air(Json scene, const std::array<double, 3>& velocity = {0, 0, 0}) {
  scene["air"] = {{"drag", drag}, {"velocity", velocity}};
  return scene;
}
/// A body at rest that only air and, if asked for, gravity act on.
Json body_of(const char* generate, const char* material, double gravity = 0.0) {
  Json scene = moving_box();
  scene.erase("initial_velocity");
  scene["body"]["generate"] = Json::parse(generate);
  scene["material"] = Json::parse(material);
  scene["gravity"] = {0, 0, -gravity};
  return scene;
}
constexpr const char* sheet = R"({"sheet": {"cells": [3, 2], "spacing": 0.1}})";
constexpr const char* squares = R"({"sheet": {"cells": [3, 2], "spacing": 0.1, "kind": "quadrilaterals"}})";
constexpr const char* tetrahedra = R"({"box": {"cells": [2, 2, 2], "spacing": 0.1}})";
constexpr const char* mixed = R"({"box": {"cells": [2, 2, 2], "spacing": 0.1, "kind": "mixed"}})";
constexpr const char* cloth = R"({"density": 0.2, "stiffness": 0.01, "damping": 0, "viscosity": 0})";
constexpr const char* foam = R"({"density": 20, "young": 2000, "poisson": 0.3, "viscosity": 0})";
constexpr const char* springs = R"({"density": 20, "stiffness": 30, "damping": 0, "viscosity": 0})";

const ForceTerm& air_of(const Simulation& simulation) {
  const ForceTerms terms = simulation.body().system().terms;
  const auto found = std::ranges::find(terms, "faces in the air", &ForceTerm::pieces_name);
  EXPECT_NE(found, terms.end());
  return **found;
}
Vectors random_vectors(std::size_t count, std::uint64_t seed) {
  SplitMix64 random(seed);
  Vectors v(count);
  for (Vector3d& one : v)
    for (double& c : one) c = random.next_signed();
  return v;
}

/// The forces of air that moves at u on faces of one solid, or on the polygons of a surface, face by face.
Vectors forces_by_hand(const Mesh& mesh, const Vectors& v, const Vector3d& u) {
  struct Face {
    std::vector<std::uint32_t> corners;
    int cells = 0;
  };
  std::map<std::vector<std::uint32_t>, Face> faces;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (const std::vector<int>& cycle : faces_of(mesh.kinds[c])) {
      std::vector<std::uint32_t> corners;
      for (const int k : cycle) corners.push_back(mesh.cell(c)[static_cast<std::size_t>(k)]);
      std::vector<std::uint32_t> key = corners;
      std::ranges::sort(key);
      Face& face = faces[key];
      face.corners = corners;
      ++face.cells;
    }
  Vectors force(v.size(), Vector3d(0, 0, 0));
  for (const auto& [key, face] : faces) {
    if (face.cells > 1) continue;
    Vector3d area(0, 0, 0);
    for (std::size_t k = 0; k < face.corners.size(); ++k)
      area += 0.5 * mesh.points[face.corners[k]].cross(mesh.points[face.corners[(k + 1) % face.corners.size()]]);
    const double share = drag * area.norm() / static_cast<double>(face.corners.size());
    for (const std::uint32_t k : face.corners)
      force[k] += share * (u - v[k]).dot(area.normalized()) * area.normalized();
  }
  return force;
}

void expect_forces_by_hand(const Simulation& simulation, const Vector3d& u) {
  const Frame frame = simulation.body().frame({});
  const Vectors& x = simulation.body().vertices().position;
  const Vectors v = random_vectors(x.size(), 3), by_hand = forces_by_hand(frame.mesh, v, u);
  Vectors force(x.size(), Vector3d(0, 0, 0));
  const ForceTerm& air = air_of(simulation);
  air.add_forces({x}, force);
  air.damping()->add_forces({x}, v, force);
  double largest = 0.0;
  for (const Vector3d& one : by_hand) largest = std::max(largest, one.norm());
  EXPECT_GT(largest, 1e-4);
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_LE((force[k] - by_hand[k]).norm(), 1e-14 * largest) << k;
}

TEST(Air, ActsOnEveryFaceAsWrittenByHand) {
  for (const char* generate : {sheet, squares, tetrahedra, mixed}) {
    Json scene = with_air(body_of(generate, springs), {1, -2, 0.5});
    scene["body"]["rotate"] = Json::parse(R"({"axis": [1, 2, 3], "degrees": 40})");
    SCOPED_TRACE(generate);
    expect_forces_by_hand(Simulation(parse(scene)), {1, -2, 0.5});
  }
}

TEST(Air, ActsOnTheFacesThatCutsExposeAndNotOnThoseThatGo) {
  const char* events = R"([{"at": 0.001, "remove": {"ids": [0]}}, {"at": 0.002, "remove": {"ids": [3, 5]}},
                           {"at": 0.003, "dissociate": {"plane": {"point": [0.1, 0, 0], "normal": [1, 0, 0]}}},
                           {"at": 0.005, "remove": {"ids": [4]}}, {"at": 0.006, "remove": {"ids": [2]}}])";
  for (const char* generate : {sheet, squares, tetrahedra, mixed}) {
    SCOPED_TRACE(generate);
    Simulation simulation(parse(with_events(with_air(body_of(generate, springs, 9.81), {1, -2, 0.5}), events)));
    while (simulation.steps_done() < simulation.step_count()) {
      ASSERT_FALSE(simulation.advance());
      expect_forces_by_hand(simulation, {1, -2, 0.5});
    }
    ASSERT_GE(simulation.operations(), 5u);
  }
}

TEST(Air, FollowsRefinementAndTears) {
  for (const char* event : {R"({"at": 0.002, "refine": {"cells": {"ids": [0, 1, 7]}}})",
                            R"({"at": 0.002, "tear": {"vertex": 13, "direction": [1, 0, 0]}})"}) {
    SCOPED_TRACE(event);
    Simulation simulation(parse(
        with_events(with_air(body_of(tetrahedra, springs), {1, 0, 0}), ("[" + std::string(event) + "]").c_str())));
    run(simulation);
    ASSERT_GT(simulation.operations(), 0u);
    expect_forces_by_hand(simulation, {1, 0, 0});
  }
}

// Each vertex of a flat sheet has its mass and its drag by the same areas, so all of them fall alike: m dv/dt = - m g -
// A drag v, whatever holds them together.
TEST(Air, LetsASheetSinkAsTheClosedFormSaysWithTheOrderOfEveryIntegrator) {
  const double tau = 0.2 / drag, t = 0.4, g = 9.81;
  const double speed = g * tau * (1.0 - std::exp(-t / tau));
  for (const IntegratorEntry& entry : integrators()) {
    const auto error = [&](double step) {
      Json scene = with_air(body_of(sheet, cloth, g));
      scene["integrator"] = entry.name;
      scene["step"] = step;
      scene["duration"] = t;
      Simulation simulation(parse(scene));
      run(simulation);
      double largest = 0.0;
      for (const Vector3d& v : simulation.body().vertices().velocity)
        largest = std::max(largest, (v + Vector3d(0, 0, speed)).norm() / speed);
      return largest;
    };
    const double a = error(0.02), b = error(0.01);
    EXPECT_LE(a, 0.05) << entry.name;
    // a compensated method may do better where nothing but air acts
    if (b > 1e-11) {
      EXPECT_GE(std::log2(a / b), scheme_of(entry.name).order - 0.35) << entry.name;
    }
  }
}

TEST(Air, SlowsABoxByTheTwoFacesAcrossItsWay) {
  for (const char* generate : {tetrahedra, mixed}) {
    const Simulation simulation(parse(with_air(body_of(generate, foam))));
    const Vectors& x = simulation.body().vertices().position;
    const Vectors v(x.size(), Vector3d(0, 0, -3));
    Vectors force(x.size(), Vector3d(0, 0, 0));
    air_of(simulation).damping()->add_forces({x}, v, force);
    Vector3d sum(0, 0, 0);
    for (const Vector3d& one : force) sum += one;
    EXPECT_LE((sum - Vector3d(0, 0, 2 * 0.2 * 0.2 * drag * 3)).norm(), 1e-15) << generate;
  }
}

TEST(Air, CarriesABodyAtItsOwnVelocity) {
  for (const char* integrator : {"rk4", "verlet", "backward-euler", "local-global", "energy-momentum"}) {
    Json scene = with_air(body_of(tetrahedra, springs), {1, -0.5, 0.25});
    scene["integrator"] = integrator;
    scene["material"]["damping"] = 0.05;
    scene["air"]["drag"] = 5;
    scene["step"] = 0.005;
    scene["duration"] = 8;
    Simulation simulation(parse(scene));
    run(simulation);
    // kicks by the wind and decays in turn: (rate h)^2 / 12 off, with a rate of 33 / s at some vertex
    const double bound = std::string(integrator) == "verlet" ? 3e-3 : 1e-6;
    for (const Vector3d& v : simulation.body().vertices().velocity)
      EXPECT_LE((v - Vector3d(1, -0.5, 0.25)).norm(), bound) << integrator;
  }
}

/// The drift of the energy, and what the air took.
std::pair<double, double> drift(double step, const char* generate, const char* material, const char* integrator) {
  Json scene = with_air(body_of(generate, material, 9.81), {2, 1, 0});
  scene["initial_velocity"] =
      Json::parse(R"({"linear": [[1, -6, 0], [6, 0.5, 2], [0, -2, -1]], "centre": [0.1, 0.1, 0]})");
  scene["integrator"] = integrator;
  scene["step"] = step;
  scene["duration"] = 0.1;
  Simulation simulation(parse(scene));
  const double before = simulation.diagnostics().energy();
  run(simulation);
  const Diagnostics end = simulation.diagnostics();
  return {end.energy() - before, *end.applied};
}

TEST(Air, IsInTheEnergyAccountToSecondOrderInTheStep) {
  for (const char* integrator : {"rk4", "verlet"})
    for (const auto& [generate, material] : {std::pair(sheet, cloth), {tetrahedra, foam}}) {
      const auto [a, work] = drift(0.001, generate, material, integrator);
      const auto [b, same] = drift(0.0005, generate, material, integrator);
      EXPECT_GT(std::abs(work), 5e-4);
      EXPECT_LE(std::abs(b), 2e-3 * std::abs(work)) << generate;
      EXPECT_NEAR(std::log2(std::abs(a / b)), 2.0, 0.5) << integrator << generate << a << " " << b;
    }
}

/// A term and random places and velocities near rest.
struct Damped {
  explicit Damped(const char* generate)
      : simulation(parse(with_air(body_of(generate, springs), {1, 2, 3}))),
        term(air_of(simulation)),
        damping(*term.damping()),
        x(simulation.body().vertices().position),
        v(random_vectors(x.size(), 1)),
        w(random_vectors(x.size(), 2)) {
    const Vectors moved = random_vectors(x.size(), 5);
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += 0.01 * moved[k];
  }
  /// - C u, at x + t w
  Vectors forces(const Vectors& u, double t = 0.0) const {
    Vectors force(x.size(), Vector3d(0, 0, 0));
    damping.add_forces({x, w, t}, u, force);
    return force;
  }
  static double dot(const Vectors& a, const Vectors& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k].dot(b[k]);
    return sum;
  }
  Simulation simulation;
  const ForceTerm& term;
  const TermDamping& damping;
  Vectors x, v, w;
};

TEST(Air, HasTheMatrixPowerAndRateThatItsForcesAreMadeOf) {
  for (const char* generate : {sheet, squares, tetrahedra, mixed}) {
    SCOPED_TRACE(generate);
    const Damped d(generate);
    Vectors product(d.x.size(), Vector3d(0, 0, 0));
    d.damping.for_each_tangent({d.x}, [&](ForceTerm::Nodes nodes, std::span<const Eigen::Matrix3d> blocks) {
      for (std::size_t a = 0; a < nodes.size(); ++a) product[nodes[a]] -= blocks[a * (a + 3) / 2] * d.v[nodes[a]];
    });
    double constant = 0.0, exact = 0.0;
    d.damping.for_each_constant_tangent([&](ForceTerm::Nodes, std::span<const Eigen::Matrix3d> blocks) {
      EXPECT_EQ(blocks[0], Eigen::Matrix3d(blocks[0](0, 0) * Eigen::Matrix3d::Identity()));
      constant += blocks[0](0, 0);
    });
    d.damping.for_each_tangent({d.x}, [&](ForceTerm::Nodes, std::span<const Eigen::Matrix3d> blocks) {
      exact += blocks[0].trace();  // its one eigenvalue
    });
    EXPECT_NEAR(constant / exact, 1.0, 0.1);
    const Vectors force = d.forces(d.v);
    for (std::size_t k = 0; k < force.size(); ++k) EXPECT_LE((force[k] - product[k]).norm(), 1e-16);

    std::vector<std::uint32_t> all(d.term.size());
    for (std::uint32_t k = 0; k < all.size(); ++k) all[k] = k;
    const double taken = Damped::dot(force, d.v);
    EXPECT_LT(taken, 0.0);
    EXPECT_NEAR(d.damping.power(all, d.x, d.v, d.w), Damped::dot(force, d.w), 1e-15);
    EXPECT_NEAR(Damped::dot(d.forces(d.w), d.v), Damped::dot(force, d.w), 1e-15);  // symmetric

    Vectors after = d.v;
    for (std::size_t k = 0; k < after.size(); ++k) after[k] += 0.3 * d.w[k];
    EXPECT_NEAR(d.damping.rate_change({d.x}, d.v, d.w, 0.3).value, 0.5 * (taken - Damped::dot(d.forces(after), after)),
                1e-15);

    Vectors there = d.x;
    for (std::size_t k = 0; k < there.size(); ++k) there[k] += 0.02 * d.w[k];
    Damped moved(generate);
    moved.x = there;
    const Vectors within = d.forces(d.v, 0.02), at_end = moved.forces(d.v);
    for (std::size_t k = 0; k < within.size(); ++k) EXPECT_LE((within[k] - at_end[k]).norm(), 1e-16);
  }
}

TEST(Air, ItsWorkAlongALineIsThatOfItsForces) {
  const Damped d(tetrahedra);
  double sum = 0.0;
  constexpr int parts = 400;
  for (int k = 0; k < parts; ++k) {
    Vectors force(d.x.size(), Vector3d(0, 0, 0));
    d.term.add_forces({d.x, d.w, 0.01 * (k + 0.5) / parts}, force);
    sum += 0.01 / parts * Damped::dot(force, d.w);
  }
  // by the force half way
  EXPECT_NEAR(-d.term.energy_change({d.x}, d.w, 0.01).value, sum, 1e-2 * std::abs(sum));
}

TEST(Air, DecaysInStepsOfAnyLengthAndAtTheRateOfItsForces) {
  for (const char* generate : {sheet, mixed}) {
    const Damped d(generate);
    const std::vector<double>& inverse_mass = d.simulation.body().vertices().inverse_mass;
    const auto energy = [&](const Vectors& v) {
      double sum = 0.0;
      for (std::size_t k = 0; k < v.size(); ++k) sum += 0.5 * v[k].squaredNorm() / inverse_mass[k];
      return sum;
    };
    for (const double h : {1e-3, 1.0, 1e6, 1e300})
      for (const bool backwards : {false, true}) {
        Vectors v = d.v;
        d.damping.decay(d.x, h, inverse_mass, backwards, v);
        EXPECT_LT(energy(v), energy(d.v)) << h;
      }
    Vectors v = d.v;
    d.damping.decay(d.x, 1e-7, inverse_mass, false, v);
    const Vectors force = d.forces(d.v);
    for (std::size_t k = 0; k < v.size(); ++k)
      EXPECT_LE((v[k] - d.v[k] - 1e-7 * inverse_mass[k] * force[k]).norm(), 1e-4 * (v[k] - d.v[k]).norm() + 1e-15);
  }
}

// Each vertex of a sheet decays at drag over density if nothing else resists it, which no stiffness is behind.
TEST(Air, IsAViscosityInTheLimitsOfSteps) {
  Json scene = with_air(body_of(sheet, cloth));
  scene["unstable_step"] = "refuse";
  const Simulation simulation(parse(scene));
  const StableStep& limits = simulation.stable_step();
  EXPECT_NEAR(limits.viscous_rate.upper, drag / 0.2, 1e-12);
  EXPECT_EQ(limits.damping_time.upper, 0.0);
  scene["air"]["drag"] = 1e4;  // 2.8 / 50,000 s
  EXPECT_NE(refusal(scene).find("/step: "), std::string::npos) << refusal(scene);
  scene["step"] = 5e-5;
  EXPECT_EQ(refusal(scene), "accepted");
}

// A body of surfaces has its vertices after those of solids.
TEST(Air, IsTheSameOnSolidsAndSurfacesOfOneScene) {
  const auto places_of = [](const std::vector<const char*>& bodies, const char* integrator) {
    Json scene = with_air(body_of(sheet, springs, 9.81), {1, 2, 0});
    scene["integrator"] = integrator;
    scene.erase("body");
    for (const char* body : bodies) scene["bodies"].push_back(Json::parse(body));
    scene["duration"] = 0.05;
    Simulation simulation(parse(scene));
    run(simulation);
    return simulation.frame({}).mesh.points;
  };
  const char* box = R"({"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.1}}})";
  const char* cloth_beside = R"({"generate": {"sheet": {"cells": [3, 2], "spacing": 0.1}}, "translate": [1, 0, 0],
                                "material": {"density": 0.2, "stiffness": 10}})";
  const char* rope = R"({"generate": {"chain": {"links": 3, "spacing": 0.1}}, "translate": [0, 1, 0]})";
  for (const char* integrator : {"rk4", "verlet"}) {
    Vectors alone = places_of({box}, integrator);
    const Vectors of_cloth = places_of({cloth_beside}, integrator);
    alone.insert(alone.end(), of_cloth.begin(), of_cloth.end());
    const Vectors together = places_of({box, cloth_beside, rope}, integrator);
    ASSERT_EQ(together.size(), alone.size() + 4);
    for (std::size_t k = 0; k < alone.size(); ++k) EXPECT_LE((together[k] - alone[k]).norm(), 1e-15) << integrator << k;
  }
}

TEST(Air, IsInTheEnergyAccountOfSolidsAndSurfacesOfOneScene) {
  Json scene = with_air(body_of(sheet, springs, 9.81), {1, 2, 0});
  scene.erase("body");
  scene["bodies"] = Json::parse(R"([{"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.1}}},
      {"generate": {"sheet": {"cells": [3, 2], "spacing": 0.1}}, "material": {"density": 0.2, "stiffness": 10}}])");
  scene["material"]["viscosity"] = 0;
  scene["step"] = 0.0005;
  scene["duration"] = 0.1;
  Simulation simulation(parse(scene));
  const double before = simulation.diagnostics().energy();
  run(simulation);
  const Diagnostics end = simulation.diagnostics();
  EXPECT_GT(std::abs(*end.applied), 1e-3);
  EXPECT_NEAR(end.energy(), before, 1e-3 * std::abs(*end.applied));
}

TEST(Air, GoesOnFromACheckpointWithTheSameBits) {
  Json scene = with_events(with_air(body_of(tetrahedra, springs, 9.81), {2, 0, 0}), R"([
      {"at": 0.003, "dissociate": {"plane": {"point": [0.1, 0, 0], "normal": [1, 0, 0]}}},
      {"at": 0.006, "remove": {"ids": [1]}}])");
  scene["output"] = Json::parse(R"({"checkpoint": 0.001, "diagnostics_every": {"steps": 1}})");
  const SceneFile file = parse(scene);
  const recorded::RunInMemory one = recorded::whole(file);
  for (std::uint64_t n = 1; n < 10; ++n) recorded::expect_same(recorded::in_two(file, n), one);
}

TEST(Air, IsPlannedToTheByte) {
  for (const char* generate : {sheet, squares, tetrahedra})
    for (const char* events : {"[]", R"([{"at": 0.005, "remove": {"ids": [3]}}])"}) {
      const SceneFile scene = parse(with_events(with_air(body_of(generate, springs), {1, 0, 0}), events));
      const ScenePlan plan = plan_scene(scene);
      const auto item = std::ranges::find(plan.items, "air", &PlanItem::name);
      ASSERT_NE(item, plan.items.end());
      EXPECT_EQ(item->bytes, memory::predicted_bytes(scene, make_problem(scene), plan, *item)) << generate << events;
      EXPECT_EQ(item->why, "/air/drag: 0.5, velocity: [1, 0, 0]");
      EXPECT_TRUE(plan.unplanned.empty());
    }
}

// A box falls asleep only where the air holds it still.
TEST(Air, IsFeltByBodiesThatSleepingLeavesAwake) {
  Json scene = with_air(body_of(tetrahedra, springs), {1, 0, 0});
  scene["sleep"] = {{"speed", 1e-3}, {"time", 0.002}};
  scene["duration"] = 0.05;
  Simulation slept(parse(scene));
  scene.erase("sleep");
  Simulation awake(parse(scene));
  run(slept);
  run(awake);
  EXPECT_EQ(slept.diagnostics().momentum, awake.diagnostics().momentum);
}

TEST(Air, IsRefusedWhereItHasNoMeaning) {
  EXPECT_EQ(refusal(with_air(body_of(R"({"chain": {"links": 3, "spacing": 0.1}})", springs))),
            "file: /air: is around chains alone, which have no faces; expected a solid or a surface, or no such key");
  Json still = with_air(body_of(sheet, cloth));
  still["expect"] = {{"energy_drift_at_most", 0.1}};
  EXPECT_EQ(refusal(still),
            "file: /expect/energy_drift_at_most: cannot be combined with /air, which changes the energy; expected "
            "damping and viscosity of 0, no driven vertices or events, and constant forces from start to end");
  const Json fast = with_air(body_of(sheet, cloth), {3e8, 0, 0});
  EXPECT_EQ(refusal(fast), "file: /air/velocity: is [300000000.0,0.0,0.0]; expected no speed above that of light");
}

}  // namespace
}  // namespace dartboard::air_test
