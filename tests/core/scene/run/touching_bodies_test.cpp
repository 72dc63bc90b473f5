// Contact between the bodies of a scene, and of a body with itself: the run, its reports, and its warnings.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/scene/body/contact_forecast.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/plan/scene_plan.h"
#include "core/scene/survey/scene_warnings.h"
#include "core/time/system/energy.h"
#include "tests/support/bodies/surveys_for_tests.h"
#include "tests/support/moving_box.h"
#include "tests/support/run_in_memory.h"

namespace dartboard::touching_bodies_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

constexpr double g = 9.81;

/// A cube of 0.1 m and 1 kg, and one of 0.08 m and 0.512 kg, a millimetre above its middle.
Json small_on_large() {
  return Json::parse(R"({"name": "two cubes", "step": 0.0002, "duration": 0.05, "integrator": "verlet",
    "bodies": [{"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05, "pattern": "kuhn"}}},
               {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.04, "pattern": "kuhn"}}, "translate": [0.01, 0.012, 0.101]}],
    "material": {"density": 1000, "young": 200000, "damping": 0, "viscosity": 0},
    "contact": {"pressure": 4000, "depth": 0.002, "bodies": "others"}})");
}
/// No vertex is held, and the small one comes down on the large one, turning and across.
Json colliding() {
  Json scene = small_on_large();
  scene["gravity"] = {0, 0, 0};
  scene["bodies"][1]["initial_velocity"] = Json::parse(
      R"({"constant": [0.3, 0.1, -0.6], "linear": [[0, -1, 0], [1, 0, 0], [0, 0, 0]], "centre": [0.05, 0.05, 0.14]})");
  return scene;
}
/// A bar that runs together towards its middle and is cut there, along x.
Json cut_in_two() {
  return with_events(Json::parse(R"({"name": "cut", "step": 0.0002, "duration": 0.05, "integrator": "verlet",
    "body": {"generate": {"box": {"cells": [4, 2, 2], "spacing": 0.05}}, "translate": [-0.1, 0, 0]},
    "material": {"density": 1000, "young": 200000, "damping": 0, "viscosity": 0}, "gravity": [0, 0, 0],
    "initial_velocity": {"linear": [[-4, 0, 0], [0, 0, 0], [0, 0, 0]]},
    "contact": {"pressure": 20000, "depth": 0.004, "bodies": "themselves"}})"),
                     R"([{"at": 0.001, "dissociate": {"plane": {"point": [0, 0, 0], "normal": [1, 0, 0]}}}])");
}

std::uint32_t body_of(const Simulation& simulation, std::uint32_t vertex, std::uint32_t points_of_first) {
  return simulation.body().vertices().point[vertex] < points_of_first ? 0u : 1u;
}
bool some_warning_has(const std::vector<std::string>& warnings, const std::string& words) {
  return std::ranges::any_of(warnings, [&words](const std::string& w) { return w.find(words) != std::string::npos; });
}
const ContactWarning* warning_of(const Simulation& simulation, ContactWarning::Kind kind) {
  const auto all = simulation.contact_warnings();
  const auto found = std::ranges::find(all, kind, &ContactWarning::kind);
  return found == all.end() ? nullptr : &*found;
}

// ---- runs

/// A block of 0.5 kg that slides over bodies that are held, side by side.
Json over_held_bodies(const char* integrator, double speed, const std::vector<int>& cells) {
  Json scene = Json::parse(R"({"name": "slide", "step": 0.0002, "duration": 0.06,
    "bodies": [{"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05}}, "translate": [0, 0, 0.0001]}],
    "material": {"density": 500, "young": 200000, "damping": 0, "viscosity": 0},
    "fixed": [{"plane": {"point": [0, 0, 0.00005], "normal": [0, 0, -1]}}],
    "contact": {"pressure": 2000, "depth": 0.002, "bodies": "others"}})");
  scene["integrator"] = integrator;
  scene["bodies"][0]["initial_velocity"] = {speed, 0, 0};
  double from = -0.198;
  for (const int n : cells) {
    Json one = Json::parse(R"({"generate": {"box": {"spacing": 0.05, "pattern": "kuhn"}}})");
    one["generate"]["box"]["cells"] = {n, 4, 1};
    one["translate"] = {from, -0.05, -0.05};
    scene["bodies"].push_back(one);
    from += n * 0.05;
  }
  return scene;
}

// The seams are 2 mm before vertices of the block, which pass them or come near: they are pushed upwards alone. (Places
// of what is below push along the normals of the block, which is bent.)
TEST(TouchingBodies, AreNotPushedSidewaysWhereTheySlideOverASeam) {
  for (const char* integrator : {"verlet", "backward-euler"})
    for (const double speed : {0.2, 0.1, 0.05})
      for (const std::vector<int>& cells : {std::vector<int>{5, 5}, {5, 1, 1, 3}}) {
        Simulation simulation(parse(over_held_bodies(integrator, speed, cells)));
        const VertexColumns& vertices = simulation.body().vertices();
        const BodyContact& contact = *simulation.body().contacts().bodies;
        std::size_t near = 0;
        while (simulation.steps_done() < simulation.step_count()) {
          ASSERT_FALSE(simulation.advance());
          for (const BodyTouch& touch : contact.touching({vertices.position})) {
            const SkinSample& sample = contact.samples()[touch.sample];
            if (vertices.fixed[sample.nodes[0]] != 0) continue;
            EXPECT_LE(touch.depth * touch.normal.head<2>().norm(), 1e-11) << integrator << ' ' << speed;
            const double x = ObstacleContact::place_of(sample, {vertices.position}).x();
            near += std::abs(x - 0.052) < touch.depth || std::abs(x - 0.102) < touch.depth ? 1 : 0;
          }
        }
        EXPECT_GT(near, 10u) << integrator << ' ' << speed;
      }
}

// Drag damps the motion by exp(-15 t), 1e-6 of it is left after a second; creep against drag on the soft contact takes
// longer, and still presses with 1e-4 of the weight.
TEST(TouchingBodies, RestOnEachOtherAndCarryTheWeight) {
  for (const char* integrator : {"verlet", "rk4", "backward-euler"}) {
    Json scene = small_on_large();
    scene["contact"]["obstacles"] = Json::parse(R"([{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}])");
    scene["material"]["viscosity"] = 30;
    scene["integrator"] = integrator;
    scene["step"] = 0.0005;
    scene["duration"] = 1;
    scene["output"] = Json::parse(R"({"fields": ["contact"]})");
    Simulation simulation(parse(scene));
    run(simulation);
    const Frame frame = simulation.frame({.contact = true});
    Vector3d force[2] = {{0, 0, 0}, {0, 0, 0}};
    double deepest = 0.0;
    for (std::uint32_t k = 0; k < frame.mesh.points.size(); ++k) {
      const std::uint32_t body = body_of(simulation, k, 27);
      force[body] += frame.contact_force[k];
      if (body == 1) deepest = std::max(deepest, frame.contact_depth[k]);
    }
    EXPECT_NEAR(force[1].z(), 0.512 * g, 1e-3) << integrator;
    EXPECT_NEAR(force[0].z(), g, 1e-3) << integrator;
    // 4000 Pa on 0.0064 m^2 at 2 mm: the weight needs 0.44 of that depth; the vertices of edges represent sides, too,
    // and samples of one side are not at the places of those of the other
    EXPECT_NEAR(deepest, 0.002 * std::sqrt(0.512 * g / 0.0064 / 4000), 0.25 * 0.0009) << integrator;
  }
}

// Second order with h omega of some 0.2 leaves (h omega)^2 / 24 of the energy of the vibrations, 2e-3 of it; kinks of
// the depth as much again.
TEST(TouchingBodies, AccountForAllThatACollisionLoses) {
  for (const char* integrator : {"verlet", "blanes-moan-4", "rk4", "implicit-midpoint"}) {
    Json scene = colliding();
    scene["contact"]["restitution"] = 0.5;
    scene["contact"]["friction"] = 0.3;
    scene["integrator"] = integrator;
    Simulation simulation(parse(scene));
    const Diagnostics before = simulation.diagnostics();
    std::size_t contacts = 0;
    while (simulation.steps_done() < simulation.step_count()) {
      ASSERT_FALSE(simulation.advance());
      contacts = std::max(contacts, simulation.diagnostics().contact->contacts);
    }
    const Diagnostics after = simulation.diagnostics();
    EXPECT_GT(contacts, 5u) << integrator;
    EXPECT_EQ(after.contact->contacts, 0u) << integrator;
    EXPECT_GT(after.contact->damped, 0.02 * before.kinetic) << integrator;
    EXPECT_GT(after.contact->rubbed, 0.001 * before.kinetic) << integrator;
    EXPECT_EQ(after.contact->supplied, 0.0) << integrator;
    EXPECT_NEAR(after.energy() + after.contact->damped + after.contact->rubbed, before.energy(), 4e-3 * before.kinetic)
        << integrator;
    // 250 steps of some hundred forces each: roundings of 0.36 kg m/s; and the residual of an implicit one's solver,
    // 1e-10 of forces that reverse that
    const bool implicit = std::string_view(integrator) == "implicit-midpoint";
    EXPECT_LE((after.momentum - before.momentum).norm(), (implicit ? 1e-10 : 250 * 100 * 1.2e-16) * 0.36) << integrator;
  }
}

TEST(TouchingBodies, CountTheEnergyOfContactsOnceAndApartFromTheElasticOne) {
  Json scene = small_on_large();
  scene["bodies"][1]["translate"] = {0.01, 0.012, 0.0995};
  scene["contact"]["obstacles"] = Json::parse(R"([{"plane": {"point": [0, 0, 0.0005], "normal": [0, 0, 1]}}])");
  const Simulation simulation(parse(scene));
  const auto& x = simulation.body().vertices().position;
  const Contacts contacts = simulation.body().contacts();
  const ContactState floor = contacts.only(false).state_at(x), bodies = contacts.only(true).state_at(x);
  const Diagnostics d = simulation.diagnostics();
  EXPECT_GT(floor.energy, 0.0);
  EXPECT_GT(bodies.energy, 0.0);
  EXPECT_DOUBLE_EQ(d.contact->energy, floor.energy + bodies.energy);
  EXPECT_EQ(d.contact->contacts, floor.contacts + bodies.contacts);
  EXPECT_EQ(d.contact->deepest, std::max(floor.deepest, bodies.deepest));
  EXPECT_LT(d.elastic, 1e-20);
}

TEST(TouchingBodies, KeepTheirAngularMomentumWhereNothingRubs) {
  Simulation simulation(parse(colliding()));
  const Diagnostics before = simulation.diagnostics();
  run(simulation);
  const Diagnostics after = simulation.diagnostics();
  EXPECT_GT((after.momentum - before.momentum).norm() + std::abs(after.kinetic - before.kinetic), 1e-3);
  EXPECT_LE((after.angular_momentum - before.angular_momentum).norm(), 1e-13);
}

TEST(TouchingBodies, PassThroughEachOtherWhereThePairIsOff) {
  Json off = colliding(), none = colliding();
  off["contact"]["bodies"] = "all";
  off["contact"]["pairs"] = Json::parse(R"([{"of": [1, 0], "touch": "no"}])");
  none.erase("contact");
  Simulation one(parse(off)), other(parse(none)), touching(parse(colliding()));
  run(one);
  run(other);
  run(touching);
  EXPECT_EQ(one.body().state_hash(), other.body().state_hash());
  EXPECT_NE(touching.body().state_hash(), other.body().state_hash());
}

TEST(TouchingBodies, HaveTheLawOfTheirPair) {
  Json own = colliding(), all = colliding();
  own["contact"]["pairs"] = Json::parse(R"([{"of": [0, 1], "pressure": 9000, "depth": 0.003}])");
  all["contact"]["pressure"] = 9000;
  all["contact"]["depth"] = 0.003;
  Simulation one(parse(own)), other(parse(all)), plain(parse(colliding()));
  run(one);
  run(other);
  run(plain);
  EXPECT_EQ(one.body().state_hash(), other.body().state_hash());
  EXPECT_NE(one.body().state_hash(), plain.body().state_hash());
}

TEST(TouchingBodies, MoveWithTheSameBitsOnAMap) {
  Json scene = colliding();
  Json on_map = with_events(scene, R"([{"at": 0.05, "remove": {"box": {"min": [9, 9, 9], "max": [10, 10, 10]}}}])");
  Simulation one(parse(scene)), other(parse(on_map));
  ASSERT_NE(one.body().map_name(), other.body().map_name());
  run(one);
  run(other);
  EXPECT_EQ(one.body().state_hash(), other.body().state_hash());
}

// A fresh cut touches nothing; then its sides do, and the halves part again.
TEST(TouchingBodies, KeepTheSidesOfACutApart) {
  Simulation simulation(parse(cut_in_two()));
  simulation.watch_events(true);
  while (simulation.body().counts().components == 1) ASSERT_FALSE(simulation.advance());
  EXPECT_LE(simulation.jumps().energy, 1e-14);
  EXPECT_EQ(simulation.diagnostics().contact->contacts, 0u);
  double deepest = 0.0;
  while (simulation.steps_done() < simulation.step_count()) {
    ASSERT_FALSE(simulation.advance());
    deepest = std::max(deepest, simulation.diagnostics().contact->deepest);
  }
  EXPECT_GT(deepest, 1e-4);
  EXPECT_LT(deepest, 0.004);
  // each half has turned round: the vertices that were at x > 0 move to positive x
  const VertexColumns& v = simulation.body().vertices();
  double momentum = 0.0;
  for (std::uint32_t k = 0; k < v.size(); ++k)
    if (v.point[k] % 5 > 2) momentum += v.mass[k] * v.velocity[k].x();
  EXPECT_GT(momentum, 0.0);
  Json without = cut_in_two();
  without.erase("contact");
  Simulation through(parse(without));
  run(through);
  EXPECT_NE(through.body().state_hash(), simulation.body().state_hash());
}

TEST(TouchingBodies, KnowWhichBodyWhatIsLeftOfACutIsOf) {
  Json scene = with_events(colliding(), R"([
    {"at": 0, "remove": {"random": {"count": 7, "seed": 3}}},
    {"at": 0, "dissociate": {"plane": {"point": [0.05, 0, 0], "normal": [1, 0, 0]}}},
    {"at": 0, "refine": {"cells": {"random": {"count": 5, "seed": 2}}, "at": "centre"}}])");
  const Simulation simulation(parse(scene));
  const SkinSolids& solids = simulation.body().contacts().bodies->solids();
  std::size_t of[2] = {0, 0};
  for (const SkinTetrahedron& t : solids.tetrahedra()) {
    // vertices made by refinement have no point of the mesh: one that has
    const auto known =
        std::ranges::find_if(t.nodes, [&](std::uint32_t k) { return simulation.body().vertices().point[k] < 2 * 27u; });
    ASSERT_NE(known, t.nodes.end());
    EXPECT_EQ(t.group, body_of(simulation, *known, 27));
    ++of[t.group];
  }
  EXPECT_GT(of[0], 30u);
  EXPECT_GT(of[1], 30u);
  // and the way out is through all of the boundary, the sides of the cut included
  const auto& x = simulation.body().vertices().position;
  double area = 0.0;
  for (const SkinTriangle& t : solids.triangles())
    area += 0.5 * (x[t.nodes[1]] - x[t.nodes[0]]).cross(x[t.nodes[2]] - x[t.nodes[0]]).norm();
  EXPECT_NEAR(area, simulation.diagnostics().boundary, 1e-13);
}

TEST(TouchingBodies, GoOnFromACheckpointWithTheSameBits) {
  for (const char* integrator : {"verlet", "bdf2"}) {
    Json scene = colliding();
    scene["integrator"] = integrator;
    scene["contact"]["friction"] = 0.3;
    scene["contact"]["restitution"] = 0.5;
    scene["duration"] = 0.02;
    scene["output"] = Json::parse(R"({"frames_every": 0.01, "diagnostics_every": 0.005, "fields": ["contact"]})");
    const SceneFile file = parse(scene);
    const recorded::RunInMemory whole = recorded::whole(file);
    EXPECT_GT(whole.result.last.contact->rubbed, 0.0);
    recorded::expect_same(whole, recorded::in_two(file, 30));
  }
}

TEST(TouchingBodies, GoOnFromACheckpointAfterACut) {
  Json scene = cut_in_two();
  scene["duration"] = 0.02;
  scene["output"] = Json::parse(R"({"frames_every": 0.01, "diagnostics_every": 0.005, "fields": ["contact"]})");
  const SceneFile file = parse(scene);
  recorded::expect_same(recorded::whole(file), recorded::in_two(file, 60));
}

// ---- warnings

// 0.005 m of the small cube is in the large one: its lower corners are the nearest to the upper side of that.
TEST(TouchingBodies, AreNamedWhereTheyStartInsideEachOther) {
  Json scene = small_on_large();
  scene["bodies"][1]["translate"] = {0.01, 0.012, 0.095};
  const SceneFile file = parse(scene);
  const Simulation simulation(file);
  const ContactWarning* warning = warning_of(simulation, ContactWarning::Kind::starts_inside);
  ASSERT_NE(warning, nullptr);
  EXPECT_TRUE(warning->of_bodies);
  EXPECT_EQ(warning->samples, simulation.diagnostics().contact->contacts);
  EXPECT_NEAR(warning->value, 0.005, 1e-15);
  EXPECT_NE(warning->from, warning->into);
  const std::vector<std::string> said = warnings_of(file, {}, simulation);
  EXPECT_TRUE(some_warning_has(said, "of the boundary are inside bodies at the start, the deepest "));
  EXPECT_TRUE(some_warning_has(said, warning->into == 0 ? " of /bodies/1, 0.005 m inside /bodies/0"
                                                        : " of /bodies/0, 0.005 m inside /bodies/1"));
  EXPECT_EQ(warning_of(Simulation(parse(small_on_large())), ContactWarning::Kind::starts_inside), nullptr);
}

TEST(TouchingBodies, AreNamedOnceWhereTheyAreDeeperThanAllowed) {
  Json scene = colliding();
  scene["contact"]["pressure"] = 1000;
  const SceneFile file = parse(scene);
  Simulation simulation(file);
  run(simulation);
  const ContactWarning* warning = warning_of(simulation, ContactWarning::Kind::too_deep);
  ASSERT_NE(warning, nullptr);
  EXPECT_EQ(std::ranges::count(simulation.contact_warnings(), ContactWarning::Kind::too_deep, &ContactWarning::kind),
            1);
  EXPECT_GT(warning->value, 0.002);
  EXPECT_EQ(warning->limit, 0.002);
  EXPECT_GT(warning->time, 0.001);
  EXPECT_TRUE(some_warning_has(warnings_of(file, {}, simulation), warning->into == 0
                                                                      ? "m inside /bodies/0, deeper than"
                                                                      : "m inside /bodies/1, deeper than"));
  scene["contact"]["pressure"] = 40000;
  Simulation stiff(parse(scene));
  run(stiff);
  EXPECT_EQ(warning_of(stiff, ContactWarning::Kind::too_deep), nullptr);
}

// A cube cut in six has the altitude spacing / sqrt(2): 0.04 / sqrt(2) / 2 is 14.1 mm, and 71 m/s are 14.2 mm in a
// step.
TEST(TouchingBodies, AreToldWhereTheyMayPassThroughEachOtherInAStep) {
  Json scene = small_on_large();
  scene["gravity"] = {0, 0, 0};
  scene["bodies"][1]["initial_velocity"] = {0, 0, 71};
  const SceneFile file = parse(scene);
  Simulation simulation(file);
  const ContactWarning* before = warning_of(simulation, ContactWarning::Kind::will_be_fast);
  ASSERT_NE(before, nullptr);
  EXPECT_NEAR(before->value, 0.0142, 1e-12);
  EXPECT_NEAR(before->limit, 0.02 / std::sqrt(2.0), 1e-15);
  EXPECT_TRUE(some_warning_has(warnings_of(file, {}, simulation),
                               "at the expected speeds a vertex moves 0.0142 m in a step relative to /bodies/1"));
  EXPECT_EQ(warning_of(simulation, ContactWarning::Kind::too_fast), nullptr);
  ASSERT_FALSE(simulation.advance());
  const ContactWarning* now = warning_of(simulation, ContactWarning::Kind::too_fast);
  ASSERT_NE(now, nullptr);
  EXPECT_NEAR(now->value, 0.0142, 1e-12);
  EXPECT_TRUE(some_warning_has(warnings_of(file, {}, simulation), "moves 0.0142 m in a step relative to others"));
  scene["bodies"][1]["initial_velocity"] = {0, 0, 70};
  Simulation slower(parse(scene));
  ASSERT_FALSE(slower.advance());
  EXPECT_EQ(warning_of(slower, ContactWarning::Kind::will_be_fast), nullptr);
  EXPECT_EQ(warning_of(slower, ContactWarning::Kind::too_fast), nullptr);
  // both as fast
  scene["initial_velocity"] = {0, 0, 300};
  scene["bodies"][1].erase("initial_velocity");
  Simulation together(parse(scene));
  ASSERT_FALSE(together.advance());
  EXPECT_EQ(warning_of(together, ContactWarning::Kind::too_fast), nullptr);
}

// Too soft a law for a shot: it goes through the outer cells of a finer cube, and inside there is nothing to feel.
TEST(TouchingBodies, AreToldWhereNoWayOutIsFound) {
  Json scene = small_on_large();
  scene["gravity"] = {0, 0, 0};
  scene["bodies"][0]["generate"]["box"] = {{"cells", {8, 8, 8}}, {"spacing", 0.0125}};
  scene["bodies"][1]["generate"]["box"] = {{"cells", {1, 1, 1}}, {"spacing", 0.02}};
  scene["bodies"][1]["translate"] = {0.041, 0.042, 0.101};
  scene["bodies"][1]["initial_velocity"] = {0, 0, -10};
  scene["contact"]["pressure"] = 1;
  scene["step"] = 0.0001;
  scene["duration"] = 0.008;
  const SceneFile file = parse(scene);
  Simulation simulation(file);
  run(simulation);
  const ContactWarning* warning = warning_of(simulation, ContactWarning::Kind::out_of_reach);
  ASSERT_NE(warning, nullptr);
  EXPECT_GT(warning->time, 0.001);
  EXPECT_TRUE(some_warning_has(warnings_of(file, {}, simulation), "so far inside a body that no way out is found"));
}

// ---- forecasts

// By hand: two cubes of 1000 kg/m^3, 0.1 and 0.08 m high; the heights of both less the smaller one is 0.1 m. The higher
// falls from 0.181 m to 0.1 m.
TEST(TouchForecast, HasTheClosedFormsOfAColumn) {
  Json scene = small_on_large();
  scene["duration"] = 1;
  const SceneFile file = parse(scene);
  const std::vector<TouchForecast> f = expect_contacts(file, make_problem(file)).bodies;
  ASSERT_EQ(f.size(), 1u);
  EXPECT_EQ(f[0].path, "/contact/bodies");
  EXPECT_EQ(f[0].first, 0u);
  EXPECT_EQ(f[0].second, 1u);
  EXPECT_NEAR(f[0].contact.mass_behind, 100, 1e-11);
  EXPECT_NEAR(f[0].contact.depth_at_rest, 0.002 * std::sqrt(100 * g / 4000), 1e-15);
  const double speed = std::sqrt(2 * g * 0.081);
  EXPECT_NEAR(f[0].contact.speed, speed, 1e-12);
  EXPECT_NEAR(f[0].contact.depth_at_impact, 0.002 * std::cbrt(3 * 100 * speed * speed / 2 / (4000 * 0.002)), 1e-15);
  EXPECT_NEAR(f[0].contact.share, f[0].contact.depth_at_impact / 0.002, 1e-12);
  // no faster than possible in the time that the run lasts
  const SceneFile brief = parse(small_on_large());
  EXPECT_NEAR(expect_contacts(brief, make_problem(brief)).bodies[0].contact.speed, 0.05 * g, 1e-12);
}

TEST(TouchForecast, OfAStackIsTheLoadOfItsLowest) {
  Json scene = small_on_large();
  for (int k = 0; k < 3; ++k) {
    scene["bodies"].push_back(scene["bodies"][1]);
    scene["bodies"].back()["translate"][2] = 0.182 + 0.081 * k;
  }
  const SceneFile stack = parse(scene);
  EXPECT_NEAR(expect_contacts(stack, make_problem(stack)).bodies[0].contact.mass_behind, 1000 * (0.1 + 3 * 0.08), 1e-9);
  // side by side nothing is higher than the highest
  for (std::size_t k = 1; k < 5; ++k) scene["bodies"][k]["translate"] = {0.2 * static_cast<double>(k), 0, 0};
  const SceneFile row = parse(scene);
  EXPECT_NEAR(expect_contacts(row, make_problem(row)).bodies[0].contact.mass_behind, 100, 1e-9);
}

TEST(TouchForecast, HasARowForEachKeyAndOfItsPairsTheDeepest) {
  Json scene = small_on_large();
  scene["contact"]["bodies"] = "all";
  scene["contact"]["pairs"] = Json::parse(R"([{"of": [0, 0], "depth": 0.004}])");
  const SceneFile file = parse(scene);
  const std::vector<TouchForecast> f = expect_contacts(file, make_problem(file)).bodies;
  ASSERT_EQ(f.size(), 2u);
  EXPECT_EQ(f[0].path, "/contact/pairs/0");
  EXPECT_EQ(f[0].law.depth, 0.004);
  EXPECT_NEAR(f[0].contact.mass_behind, 100, 1e-11);
  EXPECT_EQ(f[0].contact.speed, 0.0);
  // 0 with 1, and 1 with itself, which does not fall on itself
  EXPECT_EQ(f[1].path, "/contact/bodies");
  EXPECT_EQ(f[1].first, 0u);
  EXPECT_EQ(f[1].second, 1u);
}

TEST(TouchForecast, CountsBothSpeedsAndTheFallOfWhatIsCut) {
  Json scene = small_on_large();
  scene["gravity"] = {0, 0, 0};
  scene["bodies"][0]["initial_velocity"] = {0, 3, 0};
  scene["bodies"][1]["initial_velocity"] = {0, 0, -4};
  const SceneFile two = parse(scene);
  EXPECT_EQ(expect_contacts(two, make_problem(two)).bodies[0].contact.speed, 7.0);
  Json cut = cut_in_two();
  cut["gravity"] = {0, 0, -g};
  cut["initial_velocity"] = {0, 0, 0};
  cut["duration"] = 1;
  const SceneFile one = parse(cut);
  EXPECT_NEAR(expect_contacts(one, make_problem(one)).bodies[0].contact.speed, std::sqrt(2 * g * 0.1), 1e-12);
}

TEST(TouchingBodies, AreInThePlanWithWhatTheyCostAndTheStepTheyAllow) {
  const SceneFile file = parse(small_on_large());
  const ScenePlan plan = plan_scene(file);
  const auto item = std::ranges::find(plan.items, Part::contact, &PlanItem::part);
  ASSERT_NE(item, plan.items.end());
  // 26 vertices and 48 faces of each; all 48 tetrahedra of each have a corner on the boundary
  EXPECT_EQ(item->what, "148 places of the surface, each held against 96 tetrahedra along the surface");
  EXPECT_EQ(item->why, "/contact/bodies");
  ASSERT_TRUE(plan.contact);
  EXPECT_TRUE(plan.contact->expected.obstacles.empty());
  ASSERT_EQ(plan.contact->expected.bodies.size(), 1u);
  EXPECT_EQ(plan.contact->expected.share(), plan.contact->expected.bodies[0].contact.share);
  EXPECT_GT(plan.contact->contact_rate, 0.0);
  EXPECT_LT(plan.contact->stable_step, plan.contact->body_step);
  const Simulation simulation(file);
  std::size_t bytes = 0;
  for (const MemoryItem& part : simulation.memory())
    if (part.part == Part::contact) bytes += part.bytes;
  EXPECT_GT(bytes, 148 * sizeof(SkinSample) + 96 * sizeof(SkinTetrahedron));
}

TEST(TouchingBodies, LimitTheStepByTheirStiffness) {
  Json scene = small_on_large();
  scene["contact"]["pressure"] = 4e7;
  scene["step"] = 0.001;
  const SceneFile file = parse(scene);
  EXPECT_TRUE(some_warning_has(warnings_before_run(file), "is stable where contacts are as deep as is expected"));
}

/// A box that falls on a body that is held, 5 mm thick, through which its law lets it come.
Json onto_a_thin_body(double pressure) {
  Json scene = small_on_large();
  scene["bodies"][0] = Json::parse(
      R"({"generate": {"box": {"cells": [20, 20, 1], "spacing": 0.005, "pattern": "kuhn"}}, "translate": [0, 0, 0.095]})");
  scene["fixed"] = Json::parse(R"([{"plane": {"point": [0, 0, 0.1005], "normal": [0, 0, -1]}}])");
  scene["contact"]["pressure"] = pressure;
  scene["contact"]["depth"] = 0.01;
  scene["duration"] = 0.1;
  return scene;
}

// 785 Pa at 10 mm carry the box at its depth there; the plate has 2.5 mm to its middle.
TEST(TouchingBodies, AreToldBeforeTheRunThatOneIsTooThin) {
  const SceneFile file = parse(onto_a_thin_body(785.0));
  const Simulation simulation(file);
  const ContactWarning* warning = warning_of(simulation, ContactWarning::Kind::too_thin);
  ASSERT_NE(warning, nullptr);
  EXPECT_TRUE(warning->of_bodies);
  EXPECT_EQ(warning->into, 0u);
  EXPECT_NEAR(warning->limit, 0.0025, 1e-12);
  EXPECT_GT(warning->value, 0.01);
  EXPECT_TRUE(some_warning_has(warnings_of(file, {}, simulation), "/bodies/0 may be 0.0"));
  EXPECT_EQ(warning_of(Simulation(parse(onto_a_thin_body(1e8))), ContactWarning::Kind::too_thin), nullptr);
}

TEST(TouchingBodies, AreToldWhenOneComesThroughAnother) {
  const SceneFile file = parse(onto_a_thin_body(785.0));
  Simulation simulation(file);
  run(simulation);
  const ContactWarning* warning = warning_of(simulation, ContactWarning::Kind::comes_through);
  ASSERT_NE(warning, nullptr);
  EXPECT_EQ(warning->from, 1u);
  EXPECT_EQ(warning->into, 0u);
  EXPECT_GT(warning->value, 0.002);
  EXPECT_LE(warning->value, 0.0025 + 1e-12);
  EXPECT_TRUE(some_warning_has(warnings_of(file, {}, simulation), " comes through /bodies/0: 0.002"));
  Simulation held(parse(onto_a_thin_body(1e6)));
  run(held);
  EXPECT_EQ(warning_of(held, ContactWarning::Kind::comes_through), nullptr);
}

// ---- places inside several bodies at once

/// A cube that comes into two others, which are at the same place and do not touch each other.
Json into_two(bool both) {
  Json scene = small_on_large();
  scene["gravity"] = {0, 0, 0};
  scene["bodies"].push_back(scene["bodies"][0]);
  scene["bodies"][1]["translate"] = {0.01, 0.012, 0.099};
  scene["contact"]["bodies"] = "none";
  scene["contact"]["pairs"] = Json::parse(R"([{"of": [1, 0]}])");
  if (both) scene["contact"]["pairs"].push_back(Json::parse(R"({"of": [1, 2]})"));
  return scene;
}

TEST(TouchingBodies, AreFeltEachWhereAPlaceIsInsideSeveral) {
  const Simulation one(parse(into_two(false))), two(parse(into_two(true)));
  const ContactDiagnostics in_one = *one.diagnostics().contact, in_two = *two.diagnostics().contact;
  EXPECT_GT(in_one.contacts, 8u);
  EXPECT_EQ(in_two.contacts, 2 * in_one.contacts);
  EXPECT_NEAR(in_two.energy, 2.0 * in_one.energy, 1e-12 * in_one.energy);
}

// A fresh cut brings places to the boundary of the other part, which are inside another body, too: had they felt only
// the first, the energy would jump with the rounding of their places, and no velocities would solve a step.
TEST(TouchingBodies, MayBeCutUnderAnotherBodyWithNewtonsMethod) {
  for (const char* integrator : {"backward-euler", "bdf2", "implicit-midpoint"}) {
    Json scene = Json::parse(R"({"name": "slope", "step": 0.001, "duration": 0.06,
      "bodies": [{"generate": {"box": {"cells": [3, 2, 3], "spacing": 0.05}}},
                 {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05}}, "translate": [0.0483, 0.0243, 0.151]}],
      "material": {"density": 1000, "young": 238000, "poisson": 0.3}, "gravity": [4.4366, 0, -8.7494],
      "contact": {"pressure": 10000, "depth": 0.002, "friction": 0.5, "bodies": "all",
                  "obstacles": [{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}]},
      "events": [{"at": 0.05, "dissociate": {"plane": {"point": [0.06, 0, 0], "normal": [1, 0, 0.28]}}}]})");
    scene["integrator"] = integrator;
    Simulation simulation(parse(scene));
    while (simulation.steps_done() < simulation.step_count()) {
      const auto end = simulation.advance();
      ASSERT_FALSE(end) << integrator << ": " << to_string(*end);
    }
    EXPECT_GT(simulation.operations(), 10u);
  }
}

}  // namespace
}  // namespace dartboard::touching_bodies_test
