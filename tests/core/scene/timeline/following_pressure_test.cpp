// A pressure that acts along the current normals of its faces.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/time/integrators.h"
#include "tests/support/moving_box.h"
#include "tests/support/run_in_memory.h"

namespace dartboard::following_pressure_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

constexpr const char* everywhere = R"({"box": {"min": [-1, -1, -1], "max": [1, 1, 1]}})";
constexpr const char* side = R"({"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}})";

/// A box of elements that nothing but a pressure acts on.
Json pressed_box(const char* where, double pressure, const char* normals = "current") {
  Json scene = moving_box();
  scene.erase("initial_velocity");
  scene["gravity"] = {0, 0, 0};
  scene["material"] = Json::parse(R"({"density": 768, "young": 20000, "poisson": 0.3, "viscosity": 0})");
  Json force = Json::parse(where);
  force["pressure"] = pressure;
  force["normals"] = normals;
  scene["forces"] = Json::array({force});
  return scene;
}
Json spinning(Json scene) {
  scene["initial_velocity"] = Json::parse(R"({"linear": [[0, -30, 0], [30, 0, 0], [0, 0, 0]],
                                              "centre": [0.125, 0.125, 0.125]})");
  return scene;
}

/// The forces from outside at all vertices [N].
std::vector<Vector3d> applied_forces(const Simulation& simulation) {
  const VertexColumns& v = simulation.body().vertices();
  std::vector<Vector3d> force(v.size(), Vector3d(0, 0, 0));
  for (std::size_t k = 0; k < v.pull.size(); ++k) force[k] = v.mass[k] * v.pull[k];
  for (const ForceTerm* term : simulation.body().system().terms)
    if (term->pieces_name() == "faces under pressure") term->add_forces({v.position}, force);
  return force;
}
Vector3d sum_of_forces(const Simulation& simulation) {
  Vector3d sum(0, 0, 0);
  for (const Vector3d& force : applied_forces(simulation)) sum += force;
  return sum;
}
double volume_of(const Simulation& simulation) {
  const Frame frame = simulation.frame({});
  double sum = 0.0;
  for (std::size_t c = 0; c < frame.mesh.cell_count(); ++c) sum += signed_measure(frame.mesh, c);
  return sum;
}

TEST(FollowingPressure, BeginsAsThatOnFacesAtRest) {
  for (const char* body : {R"({"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.125, "kind": "mixed"}}})",
                           R"({"generate": {"sheet": {"cells": [3, 2], "spacing": 0.125}}})"}) {
    Json current = pressed_box(everywhere, 500), at_rest = pressed_box(everywhere, 500, "at rest");
    current["body"] = at_rest["body"] = Json::parse(body);
    const Simulation a(parse(current)), b(parse(at_rest));
    const std::vector<Vector3d> force_a = applied_forces(a), force_b = applied_forces(b);
    double largest = 0.0;
    for (const Vector3d& force : force_b) largest = std::max(largest, force.norm());
    EXPECT_GT(largest, 0.5);
    for (std::size_t k = 0; k < force_a.size(); ++k) EXPECT_LE((force_a[k] - force_b[k]).norm(), 2e-15 * largest) << k;
  }
}

// The forces on faces all round have no sum, and turn with the body; those along the normals at rest do not.
TEST(FollowingPressure, AllRoundKeepsBothMomentaOfABodyThatTurns) {
  const auto change = [](const char* normals) {
    Json scene = spinning(pressed_box(everywhere, 500, normals));
    scene["integrator"] = "verlet";
    scene["step"] = 0.0005;
    scene["duration"] = 0.05;
    Simulation simulation(parse(scene));
    const Diagnostics before = simulation.diagnostics();
    run(simulation);
    const Diagnostics after = simulation.diagnostics();
    EXPECT_LE((after.momentum - before.momentum).norm(), 1e-12 * before.angular_momentum.norm());
    return (after.angular_momentum - before.angular_momentum).norm() / before.angular_momentum.norm();
  };
  EXPECT_LE(change("current"), 1e-14);
  EXPECT_GT(change("at rest"), 0.05);
}

TEST(FollowingPressure, AllRoundDoesItsProductWithTheLostVolumeAsWork) {
  for (const char* kind : {"tetrahedra", "mixed"}) {
    Json scene = spinning(pressed_box(everywhere, 2000));
    scene["body"]["generate"]["box"]["kind"] = kind;
    scene["duration"] = 0.04;
    Simulation simulation(parse(scene));
    EXPECT_EQ(*simulation.diagnostics().applied, 0.0);
    const double volume = volume_of(simulation);
    run(simulation);
    const double change = 2000 * (volume_of(simulation) - volume);
    EXPECT_LT(change, -0.005);
    // other cells than tetrahedra are split from their centres here
    EXPECT_NEAR(*simulation.diagnostics().applied / change, 1.0, kind[0] == 't' ? 1e-11 : 1e-3);
  }
}

// The discrete forces of the method do the work along its straight steps, also where the rim of the faces moves.
TEST(FollowingPressure, IsInTheEnergyAccountToRoundingWithEnergyMomentum) {
  for (const char* event_times : {"steps", "exact"})
    for (const bool within_steps : {false, true}) {
      Json scene = spinning(pressed_box(side, 2000));
      scene["integrator"] = "energy-momentum";
      scene["event_times"] = event_times;
      scene["duration"] = 0.05;
      if (within_steps) scene["forces"][0].update({{"from", 0.0023}, {"until", 0.0457}});
      Simulation simulation(parse(scene));
      const double before = simulation.diagnostics().energy();
      run(simulation);
      const Diagnostics end = simulation.diagnostics();
      EXPECT_GT(std::abs(*end.applied), 0.5);
      EXPECT_NEAR(end.energy(), before, 1e-9 * end.kinetic) << event_times << within_steps;
    }
}

// The second removal of a cell changes nothing, and ends a part of a step all the same.
TEST(FollowingPressure, CountsItsWorkOnceWhereAnEventWithinAStepChangesNothing) {
  const auto applied = [](const char* events) {
    Json scene = with_events(spinning(pressed_box(side, 2000)), events);
    scene["event_times"] = "exact";
    Simulation simulation(parse(scene));
    run(simulation);
    return *simulation.diagnostics().applied;
  };
  const double once = applied(R"([{"at": 0.002, "remove": {"ids": [3]}}])");
  const double idle = applied(R"([{"at": 0.002, "remove": {"ids": [3]}}, {"at": 0.0055, "remove": {"ids": [3]}}])");
  EXPECT_GT(std::abs(once), 0.01);
  EXPECT_NEAR(idle, once, 1e-3 * std::abs(once));
}

TEST(FollowingPressure, KeepsTheOrderOfEveryIntegrator) {
  for (const IntegratorEntry& entry : integrators()) {
    if (entry.name == "explicit-euler") continue;  // nothing is damped, so no step is stable
    const auto place = [&entry](double step) {
      Json scene = pressed_box(side, 3000);
      scene["body"] = Json::parse(R"({"generate": {"box": {"cells": [2, 1, 2], "spacing": 0.125}}})");
      scene["fixed"] = Json::parse(R"([{"plane": {"point": [0, 0, 0], "normal": [0, 0, -1]}}])");
      scene["integrator"] = entry.name;
      scene["step"] = step;
      scene["duration"] = 0.016;
      Simulation simulation(parse(scene));
      run(simulation);
      const VertexColumns& v = simulation.body().vertices();
      return v.position[static_cast<std::size_t>(std::ranges::find(v.point, 17u) - v.point.begin())];
    };
    const int order = scheme_of(entry.name).order;
    const double h = order > 2 ? 0.004 : order > 1 ? 0.0005 : 0.0001;
    const Vector3d a = place(h), b = place(h / 2), c = place(h / 4);
    EXPECT_NEAR(std::log2((a - b).norm() / (b - c).norm()), order, 0.25) << entry.name;
  }
}

// The corner that is removed takes the pressure on its three faces along; what it leaves is not under pressure.
TEST(FollowingPressure, GoesWithACellThatIsRemoved) {
  const Simulation simulation(parse(with_events(pressed_box(everywhere, 640), R"([
    {"at": 0, "remove": {"box": {"min": [0.125, 0.125, 0.125], "max": [0.25, 0.25, 0.25]}}}])")));
  ASSERT_EQ(cells(simulation), 42u);
  EXPECT_LE((sum_of_forces(simulation) - Vector3d(10, 10, 10)).norm(), 1e-13);
}

// Both halves are pushed by what was their common boundary before: towards each other.
TEST(FollowingPressure, IsThatOfOneBodyWhereSurfacesAreBesideItAndCellsGo) {
  const auto places = [](bool with_sheet) {
    Json scene = with_events(pressed_box(everywhere, 640), R"([{"at": 0.003, "remove": {"ids": [0, 7]}}])");
    scene["bodies"] = Json::array({scene["body"]});
    scene.erase("body");
    if (with_sheet)
      scene["bodies"].push_back(
          Json::parse(R"({"generate": {"sheet": {"cells": [2, 2], "spacing": 0.1}}, "translate": [0, 0, 0.6]})"));
    Simulation simulation(parse(scene));
    run(simulation);
    return simulation.frame({}).mesh.points;
  };
  const std::vector<Vector3d> alone = places(false), beside = places(true);
  ASSERT_EQ(beside.size(), alone.size() + 9);
  for (std::size_t k = 0; k < alone.size(); ++k) EXPECT_LE((beside[k] - alone[k]).norm(), 1e-13) << k;
}

TEST(FollowingPressure, StaysOnTheFacesOfBothSidesOfACut) {
  Simulation simulation(parse(with_events(pressed_box(everywhere, 640), R"([
    {"at": 0, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}])")));
  ASSERT_EQ(simulation.body().counts().components, 2u);
  const VertexColumns& v = simulation.body().vertices();
  const std::vector<Vector3d> force = applied_forces(simulation);
  Vector3d left(0, 0, 0);
  for (std::size_t k = 0; k < v.size(); ++k)
    if (v.position[k].x() < 0.125) left += force[k];
  EXPECT_GT(left.x(), 0.0);
  EXPECT_LE(sum_of_forces(simulation).norm(), 1e-13);
  run(simulation);
  EXPECT_LE(simulation.diagnostics().momentum.norm(), 1e-12);
}

TEST(FollowingPressure, GoesOnFromACheckpointWithTheSameBits) {
  Json scene = spinning(pressed_box(everywhere, 640));
  scene["output"] = Json::parse(R"({"diagnostics_every": 0.001, "checkpoint": 0.001})");
  for (const char* events :
       {"[]", R"([{"at": 0.002, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}},
      {"at": 0.003, "remove": {"box": {"min": [0.125, 0.125, 0.125], "max": [0.25, 0.25, 0.25]}}},
      {"at": 0.008, "remove": {"ids": [0]}}])"}) {
    const SceneFile file = parse(with_events(scene, events));
    recorded::expect_same(recorded::in_two(file, 5), recorded::whole(file));
  }
}

TEST(FollowingPressure, IsRefusedWhereItHasNoMeaning) {
  Json force = pressed_box(side, 1);
  force["forces"][0].erase("pressure");
  force["forces"][0]["force"] = {1, 0, 0};
  EXPECT_EQ(refusal(force),
            "file: /forces/0/normals: is \"current\" without 'pressure'; expected a pressure, or no such key");
}

}  // namespace
}  // namespace dartboard::following_pressure_test
