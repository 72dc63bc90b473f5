// Contact in scenes: the effect of obstacles on a run, the report on them, and the warnings before it begins.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

#include "core/scene/body/contact_forecast.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/plan/scene_plan.h"
#include "core/scene/survey/scene_warnings.h"
#include "core/time/integrators.h"
#include "tests/support/moving_box.h"
#include "tests/support/plan_memory.h"
#include "tests/support/run_in_memory.h"

namespace dartboard::contact_scene_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

constexpr double g = 9.81;

/// A cube of 0.1 m and 1 kg, a millimetre above a floor.
Json above_a_floor() {
  return Json::parse(R"({"name": "cube", "step": 0.0002, "duration": 0.05, "integrator": "verlet",
    "body": {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05}}, "translate": [0, 0, 0.001]},
    "material": {"density": 1000, "young": 200000, "damping": 0, "viscosity": 0},
    "contact": {"pressure": 2000, "depth": 0.002,
                "obstacles": [{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}]}})");
}
/// The same cube, sliding and bouncing.
Json thrown() {
  Json scene = above_a_floor();
  scene["initial_velocity"] = {0.4, 0.1, -0.6};
  scene["contact"]["restitution"] = 0.5;
  scene["contact"]["friction"] = 0.3;
  return scene;
}
/// A floor that rises, and a body that no other force moves.
Json lifted() {
  Json scene = above_a_floor();
  scene["gravity"] = {0, 0, 0};
  scene["contact"]["obstacles"][0]["velocity"] = {0, 0, 0.5};
  return scene;
}
bool some_warning_has(const std::vector<std::string>& warnings, const std::string& words) {
  return std::ranges::any_of(warnings, [&words](const std::string& w) { return w.find(words) != std::string::npos; });
}

// ---- runs

// The vertices along the edges stand for a twelfth of each triangle of the sides, too: 0.0125 m^2 press onto the floor.
constexpr double lower_area = 0.01 + 4 * 6 * 0.00125 / 12;

// The weight of 1 kg on them needs sqrt(9.81 / 0.0125 / 2000) of 2 mm. Motion decays as exp(-15 t), to 1e-13 in 2
// s.
TEST(ContactScene, RestsOnAFloorAtTheDepthThatItsWeightNeeds) {
  for (const char* integrator : {"verlet", "rk4", "backward-euler", "energy-momentum", "bdf2"}) {
    Json scene = above_a_floor();
    scene["material"]["viscosity"] = 30;
    scene["step"] = 0.0005;
    scene["duration"] = 2;
    scene["integrator"] = integrator;
    Simulation simulation(parse(scene));
    run(simulation);
    const ObstacleContact& contact = *simulation.body().contacts().obstacles;
    const auto& x = simulation.body().vertices().position;
    const ContactState state = simulation.body().contacts().state_at(x);
    EXPECT_EQ(state.contacts, 9u + 8u) << integrator;
    EXPECT_NEAR(state.force_on[0].z(), -g, 1e-6) << integrator;
    double depth = 0.0;
    for (const SkinSample& sample : contact.samples()) {
      const double z = ObstacleContact::place_of(sample, {x}).z();
      if (z < 0.0) depth -= sample.area * z / lower_area;
    }
    // 1 %: the lower side is not quite flat, and the mean of a square is not the square of a mean
    const double expected = 0.002 * std::sqrt(g / lower_area / 2000);
    EXPECT_NEAR(depth, expected, 0.01 * expected) << integrator;
  }
}

// Second order with h omega of some 0.2 leaves (h omega)^2 / 24 of the energy of the vibrations, 2e-3 of it.
TEST(ContactScene, AccountsForAllThatABounceLoses) {
  for (const char* integrator : {"verlet", "blanes-moan-4", "rk4", "implicit-midpoint", "energy-momentum"}) {
    Json scene = thrown();
    scene["integrator"] = integrator;
    Simulation simulation(parse(scene));
    const Diagnostics before = simulation.diagnostics();
    run(simulation);
    const Diagnostics after = simulation.diagnostics();
    ASSERT_TRUE(after.contact);
    EXPECT_GT(after.contact->damped, 0.1 * before.kinetic) << integrator;
    EXPECT_GT(after.contact->rubbed, 0.01 * before.kinetic) << integrator;
    EXPECT_EQ(after.contact->supplied, 0.0) << integrator;
    EXPECT_NEAR(after.energy() + after.contact->damped + after.contact->rubbed, before.energy(), 2e-3 * before.kinetic)
        << integrator;
  }
}

TEST(ContactScene, CountsTheEnergyOfContactsOnceAndApartFromTheElasticOne) {
  Json scene = above_a_floor();
  scene["body"]["translate"] = {0, 0, -0.001};
  const Simulation simulation(parse(scene));
  const Diagnostics d = simulation.diagnostics();
  // at half the depth: a P0 delta / 3 (1/2)^3, and springs at rest
  EXPECT_NEAR(d.contact->energy, lower_area * 2000 * 0.002 / 3 / 8, 1e-14);
  EXPECT_LT(d.elastic, 1e-20);
  EXPECT_EQ(d.contact->contacts, 17u);
  EXPECT_DOUBLE_EQ(d.contact->deepest, 0.001);
  EXPECT_EQ(d.energy(), d.kinetic + d.elastic + d.gravitational + d.contact->energy);
}

// mu g: 0.3 m/s are gone after 0.3 / (0.3 g) = 0.1 s and 15.3 mm. A flat slab on a stiff floor neither rocks nor hops;
// that its upper side is ahead of the lower one by 4 F / (5 A) of its height over its modulus is less than 1 %.
TEST(ContactScene, StopsWhereFrictionSays) {
  Json scene = above_a_floor();
  scene["body"]["generate"]["box"]["cells"] = {4, 4, 1};
  scene["body"]["translate"] = {0, 0, -1e-4};
  scene["initial_velocity"] = {0.3, 0, 0};
  scene["contact"]["friction"] = 0.3;
  scene["contact"]["restitution"] = 0.3;
  scene["contact"]["pressure"] = 2e5;
  scene["duration"] = 0.15;
  Simulation simulation(parse(scene));
  const double start = simulation.body().vertices().position[0].x();
  const auto centre = [&simulation] {
    const VertexColumns& v = simulation.body().vertices();
    Vector3d sum(0, 0, 0);
    for (std::size_t k = 0; k < v.size(); ++k) sum += v.mass[k] * v.position[k];
    return sum.x() / simulation.body().mass();
  };
  const double from = centre();
  run(simulation);
  const double expected = 0.3 * 0.3 / (2 * 0.3 * g);
  EXPECT_NEAR(centre() - from, expected, 0.03 * expected);
  EXPECT_GT(simulation.body().vertices().position[0].x(), start);
}

// All energy comes from the floor: a detector without this knowledge would stop the run.
TEST(ContactScene, KnowsTheWorkOfAnObstacleThatMoves) {
  for (const char* integrator : {"verlet", "rk4", "energy-momentum"}) {
    Json scene = lifted();
    scene["integrator"] = integrator;
    Simulation simulation(parse(scene));
    run(simulation);
    const Diagnostics d = simulation.diagnostics();
    // thrown ahead at nearly twice the speed of the floor, less the energy of its vibrations
    EXPECT_GT(d.momentum.z(), 0.8) << integrator;
    EXPECT_EQ(d.contact->contacts, 0u) << integrator;
    EXPECT_NEAR(d.energy(), d.contact->supplied, 2e-3 * d.energy()) << integrator;
  }
}

TEST(ContactScene, MovesAnObstacleOnlyInItsTime) {
  Json scene = lifted();
  scene["contact"]["obstacles"][0]["from"] = 0.01;
  scene["contact"]["obstacles"][0]["until"] = 0.0115;  // 0.75 mm: not up to the body
  Simulation simulation(parse(scene));
  run(simulation);
  EXPECT_EQ(simulation.diagnostics().kinetic, 0.0);
  scene["contact"]["obstacles"][0]["until"] = 0.0125;  // 1.25 mm
  Simulation touched(parse(scene));
  run(touched);
  EXPECT_GT(touched.diagnostics().kinetic, 0.0);
}

TEST(ContactScene, HasTheSameBitsOnAMapAndWithout) {
  const Json without = thrown();
  const Json with = with_events(thrown(), R"([{"at": 0.05, "remove": {"ids": [0]}}])");
  Simulation columns(parse(without)), map(parse(with));
  EXPECT_EQ(columns.body().map_name(), "no map");
  EXPECT_NE(map.body().map_name(), "no map");
  for (int k = 0; k < 200; ++k) {
    ASSERT_FALSE(columns.advance());
    ASSERT_FALSE(map.advance());
  }
  EXPECT_GT(map.diagnostics().contact->rubbed, 0.0);
  EXPECT_EQ(columns.body().state_hash(), map.body().state_hash());
}

// A cut in the air changes no energy, and its sides are felt from then on.
TEST(ContactScene, FollowsACut) {
  Json scene = with_events(thrown(),
                           R"([{"at": 0.001, "dissociate": {"plane": {"point": [0.05, 0, 0], "normal": [1, 0, 0]}}}])");
  scene["contact"]["obstacles"].push_back(Json::parse(R"({"sphere": {"centre": [0.05, 0.05, 0.13], "radius": 0.02}})"));
  Simulation simulation(parse(scene));
  simulation.watch_events(true);
  const std::size_t whole = simulation.body().contacts().obstacles->samples().size();
  run(simulation);
  EXPECT_EQ(simulation.body().counts().components, 2u);
  // of 26 vertices and 48 faces: a cut of 8 triangles gives both sides these, and the vertex in the middle twice, and
  // the 8 around it once more
  EXPECT_EQ(whole, 26u + 48u);
  EXPECT_EQ(simulation.body().contacts().obstacles->samples().size(), whole + 2 * 8 + 2 + 8);
  EXPECT_LE(simulation.jumps().energy, 1e-14);
  // areas at rest: six sides of 0.01 m^2, and two more
  double area = 0.0;
  for (const SkinSample& sample : simulation.body().contacts().obstacles->samples()) area += sample.area;
  EXPECT_NEAR(area, 8 * 0.01, 1e-14);
}

TEST(ContactScene, GoesOnFromACheckpointWithTheSameBits) {
  for (const char* integrator : {"verlet", "bdf2", "energy-momentum"}) {
    Json scene = thrown();
    scene["integrator"] = integrator;
    scene["contact"]["obstacles"][0]["velocity"] = {0.1, 0, 0.05};
    scene["output"] = Json::parse(R"({"frames_every": 0.01, "diagnostics_every": 0.005,
                                      "fields": ["held", "contact"]})");
    const SceneFile file = parse(scene);
    const recorded::RunInMemory whole = recorded::whole(file);
    EXPECT_GT(whole.result.last.contact->supplied, 0.0);
    recorded::expect_same(whole, recorded::in_two(file, 60));
  }
}

TEST(ContactScene, GoesOnFromACheckpointAfterACut) {
  Json scene =
      with_events(thrown(), R"([{"at": 0.01, "dissociate": {"plane": {"point": [0.05, 0, 0], "normal": [1, 0, 0]}}}])");
  scene["output"] = Json::parse(R"({"frames_every": 0.01, "diagnostics_every": 0.005, "fields": ["contact"]})");
  const SceneFile file = parse(scene);
  recorded::expect_same(recorded::whole(file), recorded::in_two(file, 120));
}

TEST(ContactScene, DividesAStepAroundTheImpulses) {
  Json scene = thrown();
  scene["step"] = 0.005;
  scene["unstable_step"] = "substep";
  Simulation simulation(parse(scene));
  ASSERT_TRUE(simulation.step_warning());
  const Diagnostics before = simulation.diagnostics();
  run(simulation);
  const Diagnostics after = simulation.diagnostics();
  // parts near the limit leave an energy that oscillates by its own size
  EXPECT_NEAR(after.energy() + after.contact->damped + after.contact->rubbed, before.energy(), 0.2 * before.kinetic);
  EXPECT_GT(after.contact->damped, 0.1 * before.kinetic);
}

// Obstacles are at their places in the middle of each part.
TEST(ContactScene, AccountsForFloorsThatMoveWhereAStepIsDivided) {
  Json scene = lifted();
  scene["step"] = 0.005;
  scene["unstable_step"] = "substep";
  Simulation divided(parse(scene)), fine(parse(lifted()));
  ASSERT_GT(divided.step_warning()->parts, 2u);
  while (divided.steps_done() < divided.step_count()) {
    ASSERT_FALSE(divided.advance());
    // the floor has risen at 0.5 m/s to its place at the end of the last part
    const double depth = divided.body().contacts().obstacles->penetration_in(0, {0, 0, 0}).depth;
    EXPECT_NEAR(depth, 0.5 * divided.time(), 1e-15);
  }
  run(fine);
  EXPECT_NEAR(divided.diagnostics().momentum.z(), fine.diagnostics().momentum.z(), 0.05);
}

TEST(ContactScene, KeepsTheOrderOfEventsAtTheirTimesWithObstaclesThatMove) {
  Json scene = with_events(
      lifted(), R"([{"at": 0.00213, "dissociate": {"plane": {"point": [0.05, 0, 0], "normal": [1, 0, 0]}}}])");
  scene["event_times"] = "exact";
  Simulation simulation(parse(scene));
  run(simulation);
  const Diagnostics d = simulation.diagnostics();
  EXPECT_NEAR(d.energy(), d.contact->supplied, 2e-3 * d.energy());
}

// The faces of a cut have their middles in the floor, too: that is the contact's energy, and not the body's.
TEST(ContactScene, CountsWhatACutAddsToContactsApartFromTheBody) {
  Json scene = with_events(above_a_floor(),
                           R"([{"at": 0.001, "dissociate": {"plane": {"point": [0.05, 0, 0], "normal": [1, 0, 0]}}}])");
  scene["body"]["translate"] = {0, 0, -0.04};
  Simulation simulation(parse(scene));
  simulation.watch_events(true);
  for (int n = 0; n < 6; ++n) ASSERT_FALSE(simulation.advance());
  ASSERT_EQ(simulation.jumps().events, 1u);
  EXPECT_LE(simulation.jumps().energy, 1e-15);
  EXPECT_GT(simulation.jumps().contact, 0.01);
}

// Contacts are in the pattern of the matrix whether they touch or not, and change velocities, not the system.
TEST(ContactScene, KeepsAFactorWhileContactsComeAndGo) {
  Json scene = thrown();
  scene["contact"]["friction"] = 0;
  scene["integrator"] = "backward-euler";
  scene["step"] = 0.001;
  Simulation kept(parse(scene));
  scene["solver"] = "fresh-factor";
  Simulation fresh(parse(scene));
  run(kept);
  run(fresh);
  ASSERT_EQ(kept.work().steps, 50u);
  EXPECT_GT(kept.diagnostics().contact->damped, 0.0);
  EXPECT_LE(kept.work().factorisations, 10u);
  EXPECT_GE(fresh.work().factorisations, 50u);
  const auto &x = kept.body().vertices().position, &y = fresh.body().vertices().position;
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_LE((x[k] - y[k]).norm(), 1e-9);
}

// ---- output

TEST(ContactScene, ShowsForcesAndDepthsOfVerticesWhereTheyAreAskedFor) {
  Json scene = above_a_floor();
  scene["body"]["translate"] = {0, 0, -0.001};
  scene["output"] = Json::parse(R"({"fields": ["contact"]})");
  const Simulation simulation(parse(scene));
  const Frame frame = simulation.frame();
  const std::size_t points = frame.mesh.points.size();
  ASSERT_EQ(frame.contact_force.size(), points);
  ASSERT_EQ(frame.contact_depth.size(), points);
  Vector3d sum(0, 0, 0);
  for (std::size_t k = 0; k < points; ++k) {
    const double z = frame.mesh.points[k].z();
    sum += frame.contact_force[k];
    EXPECT_NEAR(frame.contact_depth[k], std::max(0.0, -z), 1e-17);
    EXPECT_EQ(frame.contact_force[k].z() > 0.0, z < 0.0);
  }
  // a quarter of 2000 Pa
  EXPECT_NEAR(sum.z(), 500 * lower_area, 1e-12);
  const std::string vtu = to_vtu(frame);
  EXPECT_NE(vtu.find("\"contact_force\""), std::string::npos);
  EXPECT_NE(vtu.find("\"contact_depth\""), std::string::npos);
  EXPECT_EQ(to_vtu(simulation.frame({})).find("contact"), std::string::npos);
}

TEST(ContactScene, ListsThePairsInContactWhereTheyAreAskedFor) {
  Json scene = above_a_floor();
  scene["body"]["translate"] = {0, 0, -0.001};
  scene["output"] = Json::parse(R"({"fields": ["contact"]})");
  const Simulation simulation(parse(scene));
  const Frame frame = simulation.frame();
  EXPECT_EQ(frame.contact_pairs.size(), simulation.diagnostics().contact->contacts);
  ASSERT_FALSE(frame.contact_pairs.empty());
  for (const FramePair& pair : frame.contact_pairs) {
    EXPECT_EQ(pair.obstacle, 0);
    EXPECT_EQ(pair.face, FramePair{}.face);
    EXPECT_NEAR(pair.depth, 0.001, 1e-17);
    for (const std::int64_t point : pair.sample)
      if (point != FramePair::none) {
        EXPECT_LT(frame.mesh.points.at(static_cast<std::size_t>(point)).z(), 0.0);
      }
  }
  EXPECT_TRUE(simulation.frame({}).contact_pairs.empty());
}

// ---- forecasts

// Numbers by hand: 1000 kg/m^3, 0.1 m high, falling from a highest place of 0.101 m onto the floor.
TEST(ContactForecast, HasTheClosedFormsOfAColumn) {
  Json scene = above_a_floor();
  scene["duration"] = 10;
  scene["contact"]["obstacles"].push_back(
      Json::parse(R"({"sphere": {"centre": [0, 0, -1], "radius": 0.5}, "pressure": 4000, "velocity": [0, 0, 2]})"));
  scene["contact"]["obstacles"].push_back(
      Json::parse(R"({"box": {"min": [0, 0, -3], "max": [1, 1, -2]}, "depth": 0.004})"));
  const SceneFile file = parse(scene);
  const std::vector<ContactForecast> f = expect_contacts(file, make_problem(file)).obstacles;
  ASSERT_EQ(f.size(), 3u);
  EXPECT_NEAR(f[0].mass_behind, 100, 1e-12);
  EXPECT_NEAR(f[0].depth_at_rest, 0.002 * std::sqrt(981.0 / 2000), 1e-15);
  EXPECT_NEAR(f[0].speed, std::sqrt(2 * g * 0.101), 1e-12);
  EXPECT_NEAR(f[0].depth_at_impact, 0.002 * std::cbrt(3 * 100 * 2 * g * 0.101 / (2 * 2000 * 0.002)), 1e-14);
  EXPECT_NEAR(f[0].share, f[0].depth_at_impact / 0.002, 1e-12);
  // the top of the sphere is at -0.5, and it comes at 2 m/s
  EXPECT_NEAR(f[1].speed, std::sqrt(4 + 2 * g * 0.601), 1e-12);
  EXPECT_NEAR(f[1].depth_at_rest, 0.002 * std::sqrt(981.0 / 4000), 1e-15);
  EXPECT_NEAR(f[2].speed, std::sqrt(2 * g * 2.101), 1e-12);
  EXPECT_NEAR(f[2].depth_at_rest, 0.004 * std::sqrt(981.0 / 2000), 1e-15);
  EXPECT_EQ(expect_contacts(file, make_problem(file)).share(), f[2].share);
  EXPECT_GT(f[2].share, f[1].share);
}

TEST(ContactForecast, IsNoFasterThanARunLasts) {
  Json scene = above_a_floor();
  scene["initial_velocity"] = {3, 0, 4};
  scene["contact"]["obstacles"][0]["plane"]["point"] = {0, 0, -1000};
  const SceneFile file = parse(scene);
  EXPECT_NEAR(expect_contacts(file, make_problem(file)).obstacles[0].speed, 5 + 0.05 * g, 1e-12);
}

TEST(ContactForecast, TakesTheMassBehindASurfaceFromItsDensity) {
  Json scene = above_a_floor();
  scene["body"] = Json::parse(R"({"generate": {"sheet": {"cells": [2, 2], "spacing": 0.05}}})");
  scene["material"]["density"] = 0.2;
  const SceneFile surface = parse(scene);
  EXPECT_EQ(expect_contacts(surface, make_problem(surface)).obstacles[0].mass_behind, 0.2);
}

TEST(ContactForecast, KnowsHowFastVerticesAreDriven) {
  Json scene = above_a_floor();
  scene["gravity"] = {0, 0, 0};
  scene["driven"] = Json::parse(R"([{"plane": {"point": [0, 0, 0.1], "normal": [0, 0, 1]}, "velocity": [0, 3, -4]}])");
  const SceneFile file = parse(scene);
  EXPECT_DOUBLE_EQ(expect_contacts(file, make_problem(file)).obstacles[0].speed, 5.0);
}

// The limit is for a mass on a spring of the contact's stiffness: 2 / omega of Verlet's method. The bound is not below
// it: a step that is stable by the bound is stable.
TEST(ContactScene, ExplainsTheLongestStepAtTheDepthOfTheImpact) {
  Json scene = above_a_floor();
  scene["contact"]["pressure"] = 2e6;
  scene["duration"] = 0.2;
  const SceneFile file = parse(scene);
  const ScenePlan plan = plan_scene(file);
  ASSERT_TRUE(plan.contact);
  EXPECT_GT(plan.contact->contact_rate, plan.contact->body_rate);
  EXPECT_LT(plan.contact->stable_step, plan.contact->body_step);
  EXPECT_NEAR(plan.contact->stable_step, 2.0 / std::hypot(plan.contact->contact_rate, plan.contact->body_rate),
              0.01 * plan.contact->stable_step);
  // the limit used by the run
  EXPECT_NEAR(Simulation(file).step_limit().stable, plan.contact->stable_step, 1e-6 * plan.contact->stable_step);
}

TEST(ContactScene, IsPlannedToTheByteAndLeftOutWhereNoKeyAsksForIt) {
  for (const bool changes : {false, true}) {
    Json scene = thrown();
    if (changes) scene = with_events(scene, R"([{"at": 0.01, "remove": {"ids": [0]}}])");
    const SceneFile file = parse(scene);
    const Problem problem = make_problem(file);
    ScenePlan plan = plan_scene(file);
    EXPECT_TRUE(plan.unplanned.empty()) << name(plan.unplanned.front().part);
    const auto item = std::ranges::find(plan.items, Part::contact, &PlanItem::part);
    ASSERT_NE(item, plan.items.end());
    EXPECT_NE(item->what.find("74 places of the surface"), std::string::npos) << item->what;
    EXPECT_EQ(item->why, "/contact/obstacles: 1");
    EXPECT_EQ(item->bytes, memory::predicted_bytes(file, problem, plan, *item));
    scene.erase("contact");
    const SceneFile without = parse(scene);
    const ScenePlan other = plan_scene(without);
    EXPECT_FALSE(other.contact);
    EXPECT_TRUE(std::ranges::none_of(other.items, [](const PlanItem& i) { return i.part == Part::contact; }));
    EXPECT_TRUE(std::ranges::any_of(other.left_out, [](const LeftOut& l) { return l.why == "/contact: not given"; }));
    for (const MemoryItem& part : measured_memory(without)) EXPECT_NE(part.part, Part::contact);
  }
}

// ---- warnings

TEST(ContactScene, WarnsOfAStepThatIsTooLongWhereContactsAreAsDeepAsIsExpected) {
  Json scene = above_a_floor();
  scene["step"] = 0.001;
  scene["contact"]["pressure"] = 2e6;
  const SceneFile file = parse(scene);
  const Simulation simulation(file);
  EXPECT_TRUE(
      some_warning_has(warnings_of(file, {}, simulation), "is stable where contacts are as deep as is expected"));
  Json soft = scene;
  soft["contact"]["pressure"] = 2000;
  const SceneFile other = parse(soft);
  EXPECT_FALSE(Simulation(other).step_warning());
  scene["unstable_step"] = "refuse";
  EXPECT_NE(refusal(scene).find("is too long for verlet"), std::string::npos) << refusal(scene);
  scene["integrator"] = "backward-euler";
  EXPECT_EQ(refusal(scene), "accepted");
}

TEST(ContactScene, WarnsOfABodyThatStartsInside) {
  Json scene = above_a_floor();
  scene["body"]["translate"] = {0, 0, -0.001};
  const SceneFile file = parse(scene);
  const Simulation simulation(file);
  ASSERT_EQ(simulation.contact_warnings().size(), 1u);
  const ContactWarning& warning = simulation.contact_warnings()[0];
  EXPECT_EQ(warning.kind, ContactWarning::Kind::starts_inside);
  EXPECT_EQ(warning.samples, 17u);
  EXPECT_DOUBLE_EQ(warning.value, 0.001);
  EXPECT_TRUE(some_warning_has(warnings_of(file, {}, simulation),
                               "17 places of the boundary are inside obstacles at the start, the deepest vertex "));
  EXPECT_TRUE(Simulation(parse(above_a_floor())).contact_warnings().empty());
}

TEST(ContactScene, SaysNothingOfContactsThatAreNoDeeperThanAllowed) {
  Json scene = above_a_floor();
  scene["contact"]["pressure"] = 8000;
  Simulation simulation(parse(scene));
  std::size_t contacts = 0;
  while (simulation.steps_done() < simulation.step_count()) {
    ASSERT_FALSE(simulation.advance());
    contacts = std::max(contacts, simulation.diagnostics().contact->contacts);
  }
  EXPECT_EQ(contacts, 17u);
  EXPECT_TRUE(simulation.contact_warnings().empty());
}

TEST(ContactScene, WarnsOnceOfAContactThatIsDeeperThanItsLawSays) {
  Json scene = thrown();
  scene["initial_velocity"] = {0, 0, -3};
  const SceneFile file = parse(scene);
  Simulation simulation(file);
  run(simulation);
  ASSERT_EQ(simulation.contact_warnings().size(), 2u);
  EXPECT_EQ(simulation.contact_warnings()[0].kind, ContactWarning::Kind::soft_body);
  const ContactWarning warning = simulation.contact_warnings()[1];
  EXPECT_EQ(warning.kind, ContactWarning::Kind::too_deep);
  EXPECT_GT(warning.value, 0.002);
  EXPECT_LT(warning.value, 0.004);
  EXPECT_EQ(warning.limit, 0.002);
  // 1 mm to the floor and 2 mm into it at some 3 m/s
  EXPECT_NEAR(warning.time, 0.001, 0.0004);
  EXPECT_TRUE(
      some_warning_has(warnings_of(file, {}, simulation), "m inside /contact/obstacles/0, deeper than the 0.002 m"));
}

/// A block of 0.5 kg that slides over boxes, to the places of its vertices and their velocities at the end.
Json over_boxes(const char* integrator, double speed, const std::vector<double>& seams) {
  Json scene = above_a_floor();
  scene["integrator"] = integrator;
  scene["duration"] = 0.06;
  scene["body"]["translate"] = {0, 0, 0};
  scene["material"]["density"] = 500;
  scene["initial_velocity"] = {speed, 0, 0};
  scene["contact"]["obstacles"] = Json::array();
  double from = -1;
  for (const double to : seams) {
    scene["contact"]["obstacles"].push_back({{"box", {{"min", {from, -1, -0.5}}, {"max", {to, 1, 0}}}}});
    from = to;
  }
  return scene;
}

// To 12 digits of 0.1 m and of 1 m/s. Vertices in the middle of the block pass the first of the seams on their way, and
// the foremost ones the second; with friction and losses, too. Then the iterations of energy-momentum, where places
// stop, make 1e-9 m of a rounding of the speed, over one box as well: it goes without.
TEST(ContactScene, SlidesOverASeamOfTwoBoxesAsOverOne) {
  for (const char* integrator : {"verlet", "energy-momentum", "backward-euler"})
    for (const double speed : {0.2, 0.05})
      for (const double beyond : {0.001, 0.002, 0.00237}) {
        Json whole = over_boxes(integrator, speed, {1.0}),
             seam = over_boxes(integrator, speed, {0.05 + beyond, 0.1 + beyond, 1.0});
        for (const bool rubs : {false, true}) {
          if (rubs && std::string_view(integrator) == "energy-momentum") continue;
          if (rubs)
            for (Json* scene : {&whole, &seam}) {
              (*scene)["contact"]["friction"] = 0.05;
              (*scene)["contact"]["restitution"] = 0.5;
            }
          Simulation over_one(parse(whole)), over_three(parse(seam));
          run(over_one);
          run(over_three);
          const VertexColumns &one = over_one.body().vertices(), &three = over_three.body().vertices();
          double place = 0.0, velocity = 0.0;
          for (std::size_t i = 0; i < one.position.size(); ++i) {
            place = std::max(place, (one.position[i] - three.position[i]).norm());
            velocity = std::max(velocity, (one.velocity[i] - three.velocity[i]).norm());
          }
          EXPECT_LE(place, 1e-13) << integrator << ' ' << speed << ' ' << beyond << ' ' << rubs;
          EXPECT_LE(velocity, 1e-12) << integrator << ' ' << speed << ' ' << beyond << ' ' << rubs;
          const auto& force_on = over_three.body().contacts().state_at(three.position).force_on;
          EXPECT_LT(force_on[1].z(), 0.0);  // the middle one is under the block
        }
      }
}

TEST(ContactScene, WarnsOfAVertexThatMayPassThroughAnObstacleInAStep) {
  Json scene = above_a_floor();
  scene["gravity"] = {0, 0, 0};
  scene["initial_velocity"] = {0, 0, -30};
  scene["contact"]["obstacles"] = Json::parse(R"([{"box": {"min": [-1, -1, -2], "max": [1, 1, -1.99]}}])");
  const SceneFile file = parse(scene);
  Simulation simulation(file);
  // 6 mm in a step, and the plate is 5 mm deep in its middle: a warning before the run, and one when it happens. It is
  // too thin as well for what comes at 30 m/s.
  ASSERT_EQ(simulation.contact_warnings().size(), 2u);
  EXPECT_EQ(simulation.contact_warnings()[0].kind, ContactWarning::Kind::will_be_fast);
  EXPECT_EQ(simulation.contact_warnings()[1].kind, ContactWarning::Kind::too_thin);
  EXPECT_TRUE(some_warning_has(warnings_of(file, {}, simulation),
                               "at the expected speeds a vertex moves 0.006 m in a step relative to "
                               "/contact/obstacles/0"));
  ASSERT_FALSE(simulation.advance());
  ASSERT_EQ(simulation.contact_warnings().size(), 3u);
  EXPECT_EQ(simulation.contact_warnings()[2].kind, ContactWarning::Kind::too_fast);
  for (const ContactWarning& warning : simulation.contact_warnings()) {
    if (warning.kind != ContactWarning::Kind::too_thin) {
      EXPECT_NEAR(warning.value, 0.006, 1e-12);
    }
    EXPECT_NEAR(warning.limit, 0.005, 1e-15);
  }
  EXPECT_TRUE(std::ranges::any_of(warnings_of(file, {}, simulation), [](const std::string& warning) {
    return warning.starts_with("at t = ") &&
           warning.find(" moves 0.006 m in a step relative to /contact/obstacles/0") != std::string::npos;
  }));
  scene["initial_velocity"] = {0, 0, -24};
  Simulation slower(parse(scene));
  ASSERT_FALSE(slower.advance());
  EXPECT_EQ(slower.contact_warnings().size(), 1u);
}

TEST(ContactScene, PutsItsObstaclesBackAfterADivergence) {
  Json scene = lifted();
  scene["step"] = 0.02;
  scene["duration"] = 20;
  Simulation simulation(parse(scene));
  std::optional<Divergence> divergence;
  while (!divergence && simulation.steps_done() < simulation.step_count()) divergence = divergence_of_step(simulation);
  ASSERT_TRUE(divergence);
  const Obstacle& floor = simulation.body().contacts().obstacles->obstacles()[0];
  const Penetration found = simulation.body().contacts().obstacles->penetration_in(0, {0, 0, 0});
  EXPECT_NEAR(found.depth, floor.moved_by(simulation.time()).z(), 1e-12);
}

}  // namespace
}  // namespace dartboard::contact_scene_test
