// Expected ends of the scenes of the gallery, by other ways than core's: closed forms, a chain in the plane, and a body
// of corners (corner_body.h) without a map, integrated here.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "benchmarks/checkout/source_folder.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/file/selections/selection.h"
#include "core/scene/run/simulation.h"
#include "tests/support/bodies/corner_body.h"
#include "tests/support/gallery_for_tests.h"

namespace dartboard::gallery_physics_test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// The position after a time, from x with v, under gravity and viscosity alone: v' = g - c v.
Vector3d flight(const Vector3d& x, const Vector3d& v, const SceneFile& scene, double time) {
  const double c = scene.material.viscosity;
  return x + scene.gravity / c * time + (v - scene.gravity / c) * (1 - std::exp(-c * time)) / c;
}

std::uint32_t point_of(const Probe& probe, const Mesh& mesh) {
  if (const auto* point = std::get_if<std::uint32_t>(&probe.vertex)) return *point;
  const auto& near = std::get<Vector3d>(probe.vertex);
  std::uint32_t best = 0;
  for (std::uint32_t p = 0; p < mesh.points.size(); ++p)
    if ((mesh.points[p] - near).norm() < (mesh.points[best] - near).norm()) best = p;
  return best;
}

/// A body of corners through the events of a scene, in steps a quarter as long as its own.
CornerBody body_at_end(const SceneFile& scene) {
  const Problem problem = make_problem(scene);
  CornerBody::Drive drive;
  if (!scene.driven.empty()) {
    const SceneDrive& driven = scene.driven.at(0);
    const auto points = select_points(driven.vertices, problem.mesh.points, "");
    drive = [driven, points, rest = problem.mesh.points](std::uint32_t p, double time, Vector3d& x, Vector3d& v) {
      if (!std::ranges::binary_search(points, p)) return false;
      const double turn = driven.reverse_every.value_or(1e9), legs = std::floor(time / turn + 1e-6);
      const bool forth = std::fmod(legs, 2.0) == 0.0;
      v = (forth ? 1.0 : -1.0) * driven.velocity.at(rest[p]);
      const double since = time - legs * turn;
      x = rest[p] + driven.velocity.at(rest[p]) * (forth ? since : turn - since);
      return true;
    };
  }
  CornerBody body(problem, drive);
  const double step = scene.accuracy ? 2e-4 : scene.step;
  std::vector<std::pair<double, const Action*>> events;
  for (const SceneEvent& event : scene.events)
    for (double at = event.from; at <= event.until * (1 + 1e-9); at += event.every.value_or(1e9))
      events.emplace_back(std::ceil(at / step - 1e-6) * step, &event.action);
  std::ranges::stable_sort(events, {}, &std::pair<double, const Action*>::first);
  double now = 0.0;
  for (const auto& [time, action] : events) {
    if (time > now) body.run(now, time, step / 4);
    now = time;
    if (const auto* remove = std::get_if<Remove>(action)) {
      const auto& sphere = std::get<SphereSelection>(remove->cells);
      body.remove([&](const Vector3d& x) { return (x - sphere.centre).norm() <= sphere.radius; });
    } else if (const auto* cut = std::get_if<Dissociate>(action)) {
      if (const auto* plane = std::get_if<PlaneSelection>(&cut->faces))
        body.cut([&](const Vector3d& x) { return plane->normal.dot(x - plane->point) >= 0; });
      else
        for (const auto& points : std::get<0>(cut->faces)) body.open(points);
    } else {
      throw std::runtime_error(scene.name + ": an event that bodies of corners know nothing of");
    }
  }
  body.run(now, scene.duration, step / 4);
  return body;
}

// ---- scenes that a body of corners can simulate to the end

class FollowedScene : public testing::TestWithParam<const char*> {};

TEST_P(FollowedScene, EndsWhereABodyOfCornersEnds) {
  const SceneFile scene = gallery(GetParam());
  const CornerBody body = body_at_end(scene);
  const Mesh mesh = make_problem(scene).mesh;
  ASSERT_FALSE(scene.expect.places.empty());
  for (const ExpectedPlace& place : scene.expect.places) {
    const std::uint32_t point = point_of(scene.probes[place.probe], mesh);
    expect_place(scene, place, place.of_part ? body.part_of(point).centre : body.x.at(body.class_at(point)));
  }
  EXPECT_EQ(scene.expect.cells, body.cells());
  EXPECT_NEAR(body.mass() / *scene.expect.mass, 1.0, 5e-12 + static_cast<double>(body.cells()) * 0x1p-52);
}

INSTANTIATE_TEST_SUITE_P(Gallery, FollowedScene,
                         testing::Values("ball_twisted", "beam_to_accuracy", "liver_cut", "liver_of_two_tissues",
                                         "liver_removal", "sheet_cut"),
                         [](const auto& which) { return which.param; });

// The part that is cut off is a free body: whatever its springs do, its centre of mass moves as in free flight.
TEST(GalleryPhysics, ThePartCutOffTheLiverFlies) {
  SceneFile scene = gallery("liver_cut");
  const std::uint32_t point = point_of(scene.probes.at(place_of(scene, "right", true).probe), make_problem(scene).mesh);
  const double end = scene.duration, cut = scene.events.at(0).from;
  scene.duration = cut;
  const CornerBody::Part part = body_at_end(scene).part_of(point);
  expect_place(scene, place_of(scene, "right", true), flight(part.centre, part.velocity, scene, end - cut));
}

// ---- a chain that hangs: link k of n holds the n - k + 1/2 link masses below its upper end

TEST(GalleryPhysics, TheChainIsAsLongAsTheWeightBelowEachLinkMakesIt) {
  const SceneFile scene = gallery("chain_hanging");
  const auto& mesh = std::get<ChainMesh>(scene.body.mesh);
  double x = 0.0;
  for (int k = 1; k <= mesh.links; ++k) {
    const double below = scene.material.density * mesh.spacing * (mesh.links - k + 0.5);
    x += mesh.spacing + below * scene.gravity.x() / scene.material.stiffness;
    if (k == 10) expect_place(scene, place_of(scene, "middle"), {x, 0, 0});
  }
  expect_place(scene, place_of(scene, "tip"), {x, 0, 0});
  EXPECT_NEAR(*scene.expect.mass, scene.material.density * mesh.spacing * mesh.links, 1e-15);
}

// ---- hexahedra shear without a force, and all strings along the beam weigh and pull in proportion, so that sections
// stay as they are and each string moves alike: a chain in the plane

/// Backward Euler for a chain along x that sags along z: n + 1 nodes, the first held, and the last held too or half as
/// heavy as the others. Newton's method with differences for derivatives.
struct PlaneChain {
  double spacing, mass, stiffness, damping, viscosity, gravity;
  bool last_held;
  std::vector<Vector2d> x, v;

  Eigen::VectorXd rest(const Eigen::VectorXd& next_v, double h) const {
    const std::size_t n = x.size();
    std::vector<Vector2d> at(x), speed(v), f(n, Vector2d::Zero());
    for (std::size_t k = 1; k < n; ++k) {
      if (k + 1 == n && last_held) break;
      speed[k] = next_v.segment<2>(2 * static_cast<Eigen::Index>(k - 1));
      at[k] = x[k] + h * speed[k];
    }
    for (std::size_t k = 0; k + 1 < n; ++k) {
      const Vector2d d = at[k + 1] - at[k], u = d.normalized();
      const Vector2d pull = (stiffness * (d.norm() - spacing) + damping * (speed[k + 1] - speed[k]).dot(u)) * u;
      f[k] += pull;
      f[k + 1] -= pull;
    }
    Eigen::VectorXd residual(next_v.size());
    for (Eigen::Index k = 0; k < next_v.size() / 2; ++k) {
      const auto node = static_cast<std::size_t>(k) + 1;
      const double m = node + 1 == n ? mass / 2 : mass;
      const Vector2d a = f[node] / m - viscosity * speed[node] + Vector2d(0, gravity);
      residual.segment<2>(2 * k) = speed[node] - v[node] - h * a;
    }
    return residual;
  }
  void step(double h) {
    const Eigen::Index free = static_cast<Eigen::Index>(x.size()) - (last_held ? 2 : 1);
    Eigen::VectorXd next(2 * free);
    for (Eigen::Index k = 0; k < free; ++k) next.segment<2>(2 * k) = v[static_cast<std::size_t>(k) + 1];
    for (int iteration = 0; iteration < 30; ++iteration) {
      const Eigen::VectorXd r = rest(next, h);
      if (r.norm() < 1e-13) break;
      Eigen::MatrixXd slope(2 * free, 2 * free);
      for (Eigen::Index j = 0; j < 2 * free; ++j) {
        Eigen::VectorXd ahead = next, behind = next;
        ahead[j] += 1e-6;
        behind[j] -= 1e-6;
        slope.col(j) = (rest(ahead, h) - rest(behind, h)) / 2e-6;
      }
      next -= slope.partialPivLu().solve(r);
    }
    for (Eigen::Index k = 0; k < free; ++k) {
      v[static_cast<std::size_t>(k) + 1] = next.segment<2>(2 * k);
      x[static_cast<std::size_t>(k) + 1] += h * v[static_cast<std::size_t>(k) + 1];
    }
  }
};

TEST(GalleryPhysics, TheBeamOfHexahedraMovesAsAChainDoes) {
  const SceneFile scene = gallery("beam_of_hexahedra");
  const auto& box = std::get<BoxMesh>(scene.body.mesh);
  // a string with one cell around each link: an eighth of a hexahedron on either side of a node
  const double cell = scene.material.density * std::pow(box.spacing, 3);
  PlaneChain chain{box.spacing,
                   2 * cell / 8,
                   scene.material.stiffness,
                   scene.material.damping,
                   scene.material.viscosity,
                   scene.gravity.z(),
                   true,
                   {},
                   {}};
  for (int k = 0; k <= box.cells[0]; ++k) chain.x.emplace_back(box.spacing * k, 0.0);
  chain.v.assign(chain.x.size(), Vector2d::Zero());
  const auto steps_to = [&scene](double time) { return std::lround(time / scene.step); };
  const double cut = scene.events.at(0).from;
  for (long k = 0; k < steps_to(cut); ++k) chain.step(scene.step);
  chain.x.resize(static_cast<std::size_t>(box.cells[0]) / 2 + 1);
  chain.v.resize(chain.x.size());
  chain.last_held = false;
  for (long k = steps_to(cut); k < steps_to(scene.duration); ++k) chain.step(scene.step);
  const ExpectedPlace& place = place_of(scene, "left");
  const auto& rest = std::get<Vector3d>(scene.probes[place.probe].vertex);
  const Vector2d moved = chain.x.at(static_cast<std::size_t>(std::lround(rest.x() / box.spacing)));
  expect_place(scene, place, {moved.x(), rest.y(), rest.z() + moved.y()});
  EXPECT_NEAR(*scene.expect.mass, cell * box.cells[0] * box.cells[1] * box.cells[2], 1e-14);
}

// A bar of Poisson's ratio 0 that hangs is pulled at z by the weight below: u' = rho g z / E from the upper end down,
// so that its mean sag is rho g L^2 / 3E. Strains are up to 8 %, and laws differ in their squares.
TEST(GalleryPhysics, TheTwoBarsSagByTheirOwnWeight) {
  const SceneFile scene = gallery("two_bars");
  ASSERT_EQ(scene.bodies().size(), 2u);
  double mass = 0.0;
  for (std::size_t b = 0; b < 2; ++b) {
    const BodySource& body = scene.bodies()[b];
    const auto& box = std::get<BoxMesh>(body.mesh);
    const Vector3d size = box.spacing * Vector3d(box.cells[0], box.cells[1], box.cells[2]);
    const Material& of = body.material.value();
    EXPECT_EQ(of.poisson, 0.0);
    const double sag = of.density * -scene.gravity.z() * size.z() * size.z() / (3.0 * of.young);
    const ExpectedPlace& place = place_of(scene, b == 0 ? "stiff" : "soft", true);
    EXPECT_LE(place.within, sag / 30);
    EXPECT_LT((place.position - (body.translate + 0.5 * size - Vector3d(0, 0, sag))).norm(), 1e-12);
    mass += of.density * size.prod();
  }
  EXPECT_NEAR(*scene.expect.mass, mass, 1e-12);
}

// ---- free bodies

// Pulled apart from its centre without gravity: momentum is 0 by symmetry, and tearing changes neither it nor the
// masses.
TEST(GalleryPhysics, TheBlockThatTearsStaysWhereItIs) {
  const SceneFile scene = gallery("vertex_tear");
  const auto& box = std::get<BoxMesh>(scene.body.mesh);
  const Vector3d centre = 0.5 * box.spacing * Vector3d(box.cells[0], box.cells[1], box.cells[2]);
  EXPECT_EQ(scene.initial_velocity.centre, centre);
  EXPECT_EQ(scene.gravity, Vector3d(0, 0, 0));
  expect_place(scene, place_of(scene, "corner", true), centre);
  EXPECT_NEAR(*scene.expect.mass, scene.material.density * 8 * centre.prod(), 1e-14);
}

// A block that spins about its centre, as a rigid one: the removed part takes its momentum along, and the rest goes the
// other way. Springs let it grow by some percent, and whole tetrahedra are removed, so the estimate is good to a third
// of the distance.
TEST(GalleryPhysics, TheSpinningBlockGivesWayWhereACornerIsTaken) {
  const SceneFile scene = gallery("corner_refined");
  const auto& box = std::get<BoxMesh>(scene.body.mesh);
  const double side = box.spacing * box.cells[0], c = scene.material.viscosity,
               spin = scene.initial_velocity.linear(1, 0);
  const Vector3d centre = Vector3d::Constant(side / 2);
  const double taken_at = scene.events.at(2).from, mass = scene.material.density * std::pow(side, 3);
  const Eigen::AngleAxisd turn(spin * (1 - std::exp(-c * taken_at)) / c, Vector3d::UnitZ());
  const auto& sphere = std::get<SphereSelection>(std::get<Remove>(scene.events.at(2).action).cells);
  constexpr int n = 60;
  int inside = 0;
  Vector3d sum = Vector3d::Zero();
  for (int k = 0; k < n * n * n; ++k) {
    const Vector3d p = side / n * (Vector3d(k % n, k / n % n, k / n / n) + Vector3d::Constant(0.5));
    const Vector3d now = centre + turn * (p - centre);
    if ((now - sphere.centre).norm() > sphere.radius) continue;
    ++inside;
    sum += now;
  }
  const double taken = mass * inside / (n * n * n);
  const Vector3d where = sum / inside;
  EXPECT_NEAR(*scene.expect.mass, mass - taken, 0.3 * taken);
  const double lost = mass - *scene.expect.mass;  // whole cells
  const Vector3d speed = spin * std::exp(-c * taken_at) * Vector3d::UnitZ().cross(where - centre);
  const Vector3d left = centre - lost / (mass - lost) * (where - centre), left_speed = -lost / (mass - lost) * speed;
  const ExpectedPlace& place = place_of(scene, "far", true);
  const Vector3d end = left + left_speed * (1 - std::exp(-c * (scene.duration - taken_at))) / c;
  expect_place(scene, place, end);
  EXPECT_LE(place.within, (end - centre).norm() / 3);
}

// Each of the 6 n^3 tetrahedra is removed once: ten at a time are gone before the last draw, and their mass with them.
TEST(GalleryPhysics, TheErodedBlockIsGoneWhenEveryTetrahedronHasBeenDrawn) {
  const SceneFile scene = gallery("block_eroded");
  const auto& box = std::get<BoxMesh>(scene.body.mesh);
  const auto tetrahedra = static_cast<std::uint64_t>(6 * box.cells[0] * box.cells[1] * box.cells[2]);
  EXPECT_EQ(scene.expect.operations, tetrahedra);
  EXPECT_EQ(scene.expect.mass, 0.0);
  EXPECT_EQ(scene.expect.vertices, 0u);
  const auto& random = std::get<RandomSelection>(std::get<Remove>(scene.events.at(0).action).cells);
  const double draws = std::floor(scene.events.at(0).until / *scene.events.at(0).every + 1e-9);
  EXPECT_GE(draws * random.count, static_cast<double>(tetrahedra));
  EXPECT_FALSE(scene.expect.why.empty());
}

// ---- tearing by stress

TEST(GalleryPhysics, ThePlateIsWhereItsSpeedTakesIt) {
  const SceneFile scene = gallery("plate_pulled");
  const SceneDrive& plate = scene.driven.at(0);
  const ExpectedPlace& place = place_of(scene, "plate");
  const Vector3d rest = std::get<Vector3d>(scene.probes[place.probe].vertex);
  expect_place(scene, place, rest + *plate.until * plate.velocity.constant);
}

// The seam tears at vertices where the largest stress passes the threshold. The mean over the section is then between
// half of it and all of it: two times, and from each the part below flies. The expected end lies between.
TEST(GalleryPhysics, TheBarFallsFromWhenItsWeightPullsEnough) {
  const SceneFile scene = gallery("bar_torn_by_weight");
  const auto& tear = std::get<TearWhereStressed>(scene.events.at(0).action);
  const Problem problem = make_problem(scene);
  const auto& box = std::get<BoxMesh>(scene.body.mesh);
  const double area = box.cells[0] * box.cells[1] * box.spacing * box.spacing;
  const auto above = [&](const Vector3d& x) { return contains(*tear.seam, x, 0.0); };
  std::vector<Vector3d> ends;
  for (const double part : {0.5, 1.0}) {
    CornerBody body(problem);
    double now = 0.0;
    while (body.pull_across(above, -Vector3d::UnitZ()) < part * tear.threshold * area && now < scene.duration) {
      body.step(now, scene.step);
      now += scene.step;
    }
    ASSERT_LT(now, scene.duration) << part;
    body.cut(above);
    const CornerBody::Part lower = body.part_of(0);
    ends.push_back(flight(lower.centre, lower.velocity, scene, scene.duration - now));
  }
  const ExpectedPlace& place = place_of(scene, "foot", true);
  expect_place(scene, place, ends[0]);
  expect_place(scene, place, ends[1]);
  // not wider than the distance between them
  EXPECT_LE(place.within, 0.55 * (ends[1] - ends[0]).norm() + 1e-3);
}

// ---- elements

// d'Alembert: a bar that is let go sinks by density g L^2 / E until the wave from its support is back, after 2 L / c.
TEST(GalleryPhysics, TheBarOfElementsIsLowestWhenItsWaveIsBack) {
  const SceneFile scene = gallery("bar_of_elements");
  const auto& box = std::get<BoxMesh>(scene.body.mesh);
  const double length = box.cells[2] * box.spacing, speed = std::sqrt(scene.material.young / scene.material.density);
  EXPECT_NEAR(scene.duration, 2.0 * length / speed, scene.step);
  EXPECT_EQ(scene.material.poisson, 0.0);  // one dimension
  const double sinks = -scene.gravity.z() * scene.material.density * length * length / scene.material.young;
  expect_place(scene, place_of(scene, "foot"), {0, 0, -sinks});
}

// Elements or springs, the part that is cut off is a free body.
TEST(GalleryPhysics, ThePartCutOffTheLiverOfElementsFlies) {
  SceneFile scene = gallery("liver_of_elements");
  const double end = scene.duration, cut = scene.events.at(0).from;
  const std::size_t right = place_of(scene, "right", true).probe;
  scene.duration = cut + scene.step;
  Simulation simulation(scene);
  while (simulation.steps_done() < simulation.step_count()) ASSERT_FALSE(simulation.advance());
  const Frame frame = simulation.body().frame({});
  const std::uint32_t point = point_of(scene.probes.at(right), make_problem(scene).mesh);
  const auto& points = simulation.body().vertices().point;
  const auto vertex = static_cast<std::uint32_t>(std::ranges::find(points, point) - points.begin());
  std::uint32_t component = 0;
  for (std::size_t c = 0; c < frame.mesh.cell_count(); ++c)
    for (const std::uint32_t k : frame.mesh.cell(c))
      if (k == vertex) component = frame.component[c];
  std::set<std::uint32_t> part;
  for (std::size_t c = 0; c < frame.mesh.cell_count(); ++c)
    if (frame.component[c] == component) part.insert(frame.mesh.cell(c).begin(), frame.mesh.cell(c).end());
  double mass = 0.0;
  Vector3d centre(0, 0, 0), velocity(0, 0, 0);
  for (const std::uint32_t k : part) {
    mass += frame.mass[k];
    centre += frame.mass[k] * frame.mesh.points[k];
    velocity += frame.mass[k] * frame.velocity[k];
  }
  expect_place(scene, place_of(scene, "right", true),
               flight(centre / mass, velocity / mass, scene, end - scene.duration));
}

// ---- springs that are not edges, and bending

// A bar of a Young's modulus E under its weight: density g L^2 / (2 E) longer, of which 3/4 at half its length, and
// thinner by Poisson's ratio 1/4 times the strain there.
TEST(GalleryPhysics, TheLatticeHangsAsASolidOfItsYoungsModulus) {
  const SceneFile scene = gallery("lattice_sags");
  const auto& box = std::get<BoxMesh>(scene.body.mesh);
  const double length = box.cells[2] * box.spacing;
  const double strain = -scene.gravity.z() * scene.material.density * length / (2.0 * scene.material.young);
  expect_place(scene, place_of(scene, "foot"), {0, 0, -strain * length});
  const double thinner = strain / 4 * box.spacing / 2;
  expect_place(scene, place_of(scene, "side"), {thinner, thinner, length / 2 - 0.75 * strain * length});
}

// Rows of a wide sheet at distance h are a beam with a hinge of D / h at each: D times the fourth difference of the sag
// is the load. A polynomial solves this; it vanishes on the last two rows, which are held, on either side.
TEST(GalleryPhysics, TheSheetSagsAsAPlateOfItsRigidity) {
  const SceneFile scene = gallery("sheet_sags");
  const auto& sheet = std::get<SheetMesh>(scene.body.mesh);
  const double h = sheet.spacing, length = (sheet.cells[0] - 2) * h, load = scene.material.density * -scene.gravity.z();
  for (const auto& [probe, row] : {std::pair{"middle", sheet.cells[0] / 2}, {"quarter", sheet.cells[0] / 4}}) {
    const double x = (row - 1) * h;
    const double sag = load * x * (x + h) * (length - x) * (length + h - x) / (24.0 * scene.bending.rigidity);
    expect_place(scene, place_of(scene, probe), {row * h, sheet.cells[1] / 2 * h, -sag});
  }
}

// Along the curtain its weight pulls, across it weight and wind balance: a plane at an angle theta from the vertical,
// tan theta = drag u / (density g), longer by the integral of what hangs below over the modulus.
TEST(GalleryPhysics, TheCurtainHangsWhereWeightAndWindBalance) {
  const SceneFile scene = gallery("curtain_blown");
  const auto& sheet = std::get<SheetMesh>(scene.body.mesh);
  const double length = sheet.cells[1] * sheet.spacing, weight = scene.material.density * -scene.gravity.y();
  const double theta = std::atan(scene.air->drag * scene.air->velocity.z() / weight);
  const double stretch = 0.5 * weight * std::cos(theta) * length * length / scene.material.young;
  const double hangs = length + stretch;
  expect_place(scene, place_of(scene, "hem"),
               {0.5 * sheet.cells[0] * sheet.spacing, length - hangs * std::cos(theta), hangs * std::sin(theta)});
}

// Provot's cloth without cells: points of a grid with springs to their neighbours, across the squares, and to the
// second neighbours along each line. On the border there is half of what there is within.
TEST(GalleryPhysics, TheClothHangsAsANetOfSpringsDoes) {
  const SceneFile scene = gallery("cloth_hangs");
  const auto& sheet = std::get<SheetMesh>(scene.body.mesh);
  const int n = sheet.cells[0];
  ASSERT_EQ(n, sheet.cells[1]);
  const auto at = [n](int i, int j) { return static_cast<std::size_t>(j * (n + 1) + i); };
  struct Link {
    std::size_t a, b;
    double rest, stiffness;
  };
  std::vector<Link> links;
  std::vector<Vector3d> x, v;
  std::vector<double> mass;
  const double k = scene.material.stiffness, second = scene.bending.second_neighbours, a = sheet.spacing;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      x.emplace_back(i * a, j * a, 0);
      const double sides = (i % n == 0 ? 0.5 : 1.0) * (j % n == 0 ? 0.5 : 1.0);
      mass.push_back(scene.material.density * a * a * sides);
      const double along_x = j % n == 0 ? 1 : 2, along_y = i % n == 0 ? 1 : 2;
      if (i < n) links.push_back({at(i, j), at(i + 1, j), a, along_x * k});
      if (j < n) links.push_back({at(i, j), at(i, j + 1), a, along_y * k});
      if (i + 1 < n) links.push_back({at(i, j), at(i + 2, j), 2 * a, along_x / 2 * second});
      if (j + 1 < n) links.push_back({at(i, j), at(i, j + 2), 2 * a, along_y / 2 * second});
      if (i < n && j < n) {
        links.push_back({at(i, j), at(i + 1, j + 1), std::sqrt(2.0) * a, k});
        links.push_back({at(i + 1, j), at(i, j + 1), std::sqrt(2.0) * a, k});
      }
    }
  v.assign(x.size(), Vector3d(0, 0, 0));
  const std::size_t held[] = {at(0, 0), at(n, 0)};
  std::vector<Vector3d> force(x.size());
  const auto kick = [&](double h) {
    for (std::size_t p = 0; p < x.size(); ++p) force[p] = mass[p] * scene.gravity;
    for (const Link& link : links) {
      const Vector3d line = x[link.b] - x[link.a];
      const Vector3d f = link.stiffness * (1 - link.rest / line.norm()) * line;
      force[link.a] += f;
      force[link.b] -= f;
    }
    for (std::size_t p = 0; p < x.size(); ++p) v[p] += h / mass[p] * force[p];
    for (const std::size_t p : held) v[p].setZero();
  };
  // leapfrog, with the viscosity as an exact decay around it
  const double h = scene.step / 16, decay = std::exp(-scene.material.viscosity * h / 2);
  for (double t = 0.0; t < scene.duration - h / 2; t += h) {
    for (Vector3d& w : v) w *= decay;
    kick(h / 2);
    for (std::size_t p = 0; p < x.size(); ++p) x[p] += h * v[p];
    kick(h / 2);
    for (Vector3d& w : v) w *= decay;
  }
  expect_place(scene, place_of(scene, "hem"), x[at(n / 2, n)]);
  expect_place(scene, place_of(scene, "collar"), x[at(n / 2, 0)]);
}

// ---- membranes

// A strip of Young's modulus times thickness Y under its weight: density g L^2 / (2 Y) longer, of which 3/4 at half its
// length, and narrower by Poisson's ratio times the strain there.
TEST(GalleryPhysics, TheMembraneHangsAsAStripOfItsYoungsModulus) {
  const SceneFile scene = gallery("membrane_hangs");
  const auto& sheet = std::get<SheetMesh>(scene.body.mesh);
  const double length = sheet.cells[1] * sheet.spacing, width = sheet.cells[0] * sheet.spacing;
  const double strain = -scene.gravity.y() * scene.material.density * length / (2.0 * scene.material.young);
  expect_place(scene, place_of(scene, "foot"), {width / 2, -strain * length, 0});
  expect_place(scene, place_of(scene, "side"),
               {scene.material.poisson * strain * width / 2, length / 2 - 0.75 * strain * length, 0});
}

// ---- contact

// A table without friction pushes only upwards: along it, a part that has landed goes on with its old velocity.
TEST(GalleryPhysics, ThePartOfTheLiverThatLandsGoesOnAlongTheTable) {
  SceneFile scene = gallery("liver_lands");
  const ExpectedPlace& place = place_of(scene, "right", true);
  const Mesh mesh = make_problem(scene).mesh;
  const double end = scene.duration, cut = scene.events.at(0).from;
  SceneFile until_cut = scene;
  until_cut.duration = cut;
  const CornerBody::Part part = body_at_end(until_cut).part_of(point_of(scene.probes.at(place.probe), mesh));
  const Vector3d flown = flight(part.centre, part.velocity, scene, end - cut);
  EXPECT_LE((flown - place.position).head<2>().norm(), place.within) << flown.transpose();
  // and above the table, by at most its own size
  const HalfSpace& table = std::get<HalfSpace>(scene.obstacles.at(0).obstacle.shape);
  EXPECT_EQ(table.normal, Vector3d(0, 0, 1));
  EXPECT_LT(flown.z(), table.point.z());
  EXPECT_GT(place.position.z(), table.point.z());
  EXPECT_LT(place.position.z(), table.point.z() + 0.15);
}

// The mesh is its own mirror image in the middle of the bar, so half way along nothing moves along the axis.
TEST(GalleryPhysics, TheWrungBarTurnsHalfAsFarHalfWay) {
  const SceneFile scene = gallery("bar_wrung");
  Simulation simulation(scene);
  while (simulation.steps_done() < simulation.step_count()) ASSERT_FALSE(simulation.advance());
  const VertexColumns& v = simulation.body().vertices();
  const std::vector<Eigen::Vector3d> rest = make_problem(scene).mesh.points;
  Eigen::Vector3d mean(0, 0, 0);
  double across = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < v.size(); ++k) {
    const Eigen::Vector3d& x = rest[v.point[k]];
    if (std::abs(x.z() - 0.2) > 1e-9) continue;
    mean += v.position[k];
    // a quarter of a turn: (x, y) goes to (-y, x)
    const Eigen::Vector3d turned(0.04 - (x.y() - 0.04), 0.04 + (x.x() - 0.04), 0.2);
    across = std::max(across, (v.position[k] - turned).norm());
    ++count;
  }
  ASSERT_EQ(count, 9);
  EXPECT_NEAR(mean.z() / 9, 0.2, 1e-9);
  EXPECT_LE(across, 0.003);  // the diagonals of the tetrahedra move the axis by a millimetre
  // nothing is lost but by viscosity, and the weight is gone: it did less work going than it took back
  EXPECT_GT(simulation.diagnostics().elastic, 6.0);
}

// ---- attachments

// Bars under their weights and those below: how much lower than at rest each part hangs in the mean. What has been cut
// off falls as a whole and, at its last speed, is as long as at rest.
TEST(GalleryPhysics, AttachedBodiesHangByTheirSpringsAndFallTogether) {
  const SceneFile scene = gallery("bodies_attached");
  const double g = -scene.gravity.z(), young = scene.material.young, density = scene.material.density;
  const auto side = [](const BodySource& body) {
    const auto& box = std::get<BoxMesh>(body.mesh);
    return box.cells[2] * box.spacing;
  };
  const double block = side(scene.bodies()[0]), glued = side(scene.bodies()[1]), area = block * block;
  const double half = density * area * block / 2, small = density * glued * glued * glued;
  const auto stretched = [&](double length) {
    return density * g * length * length / young;
  };  // 3 times that of its mean
  const double held = scene.attachments.at(0).stiffness, carried = scene.attachments.at(1).stiffness;
  expect_place(scene, place_of(scene, "above", true),
               {0.05, 0.05, 0.4 - block / 4 - half * g / held - stretched(block / 2) / 3});
  // in the lower half of a bar, means over the height of its shape under its own weight and the one below
  const double down = (2 * half + small) * g / held, strain = small * g / (area * young);
  const double lower = 0.4 - 0.75 * block - down - 0.75 * block * strain - stretched(block) * (0.75 - 7.0 / 24);
  const double lowest =
      0.3 - glued / 2 - down - block * strain - stretched(block) / 2 - small * g / carried - stretched(glued) / 3;
  const double falls = scene.duration - scene.events.at(0).from, whole = half + small;
  const Vector3d centre(0.05, 0.05, (half * lower + small * lowest) / whole);
  const Vector3d end = flight(centre, Vector3d(0, 0, 0), scene, falls), apart(0, 0, block / 4 + glued / 2);
  expect_place(scene, place_of(scene, "below", true), end + small / whole * apart);
  expect_place(scene, place_of(scene, "glued", true), end - half / whole * apart);
}

// A chain of point masses in the plane, each end held by a spring: its shape follows from the force at the first end,
// which Newton's method finds. The curtain is a bar under its own weight; what is cut off falls as a whole.
TEST(GalleryPhysics, TheRopeHangsAsAChainAndTheHemFalls) {
  const SceneFile scene = gallery("rope_and_curtain");
  const double g = -scene.gravity.z();
  const BodySource &rope = scene.bodies()[2], &curtain = scene.bodies()[3];
  const auto& chain = std::get<ChainMesh>(rope.mesh);
  const double link = chain.spacing, k = rope.material->stiffness, held = scene.attachments.at(0).stiffness;
  const double m = rope.material->density * link;
  const Vector2d left(rope.translate.x(), rope.translate.z());
  const Vector2d right = left + Vector2d(chain.links * link + scene.driven.at(0).velocity.constant.x(), 0);
  // the places of all masses, and that of the second holder, if the first one pulls with this force
  const auto shape = [&](const Vector2d& force) {
    Vector2d pull = -force, x = left - force / held;  // of the links to the right
    pull.y() += m / 2 * g;
    std::vector<Vector2d> places{x};
    for (int n = 1; n <= chain.links; ++n) {
      x += pull.normalized() * (link + pull.norm() / k);
      places.push_back(x);
      pull.y() += (n < chain.links ? m : m / 2) * g;
    }
    places.push_back(x + pull / held);
    return places;
  };
  Vector2d force(-0.3, chain.links * m * g / 2);
  for (int n = 0; n < 50; ++n) {
    const Vector2d error = shape(force).back() - right;
    Eigen::Matrix2d slope;
    for (int c = 0; c < 2; ++c)
      slope.col(c) = (shape(force + 1e-7 * Vector2d::Unit(c)).back() - shape(force).back()) / 1e-7;
    const Vector2d move = -slope.lu().solve(error);
    force += move * std::min(1.0, 0.3 / move.norm());
  }
  ASSERT_LT((shape(force).back() - right).norm(), 1e-9);
  for (const auto& [probe, number] : {std::pair("rope", 6), {"quarter", 3}}) {
    const Vector2d x = shape(force)[static_cast<std::size_t>(number)];
    expect_place(scene, place_of(scene, probe), {x.x(), 0.05, x.y()});
  }

  const auto& sheet = std::get<SheetMesh>(curtain.mesh);
  const double length = sheet.cells[1] * sheet.spacing, density = curtain.material->density;
  const double block = 0.1, weight = density * g * length * sheet.cells[0] * sheet.spacing;
  const double down = scene.material.density * g * block * block / (2 * scene.material.young) +
                      weight / scene.attachments.at(2).stiffness;
  const auto lowered = [&](double s) { return density * g * (length * s - s * s / 2) / curtain.material->young; };
  double centre = 0.0;  // of the lower half, by rows, of which the outer ones have half of the mass
  for (int row = 4; row <= 8; ++row) {
    const double s = row * sheet.spacing;
    centre -= (row == 4 || row == 8 ? 0.125 : 0.25) * (s + lowered(s) + down);
  }
  const double falls = scene.duration - scene.events.at(0).from;
  expect_place(scene, place_of(scene, "hem", true),
               flight(Vector3d(0.05, 0.05, centre), Vector3d(0, 0, 0), scene, falls));
}

// ---- all scenes are tested

TEST(GalleryPhysics, IsExpectedOfEveryScene) {
  for (const auto& entry : fs::directory_iterator(source_folder() / "benchmarks" / "scenes")) {
    const SceneFile scene = read_scene(entry.path());
    EXPECT_TRUE(!scene.expect.places.empty() || scene.name == "block_eroded") << entry.path();
    EXPECT_FALSE(scene.expect.why.empty()) << entry.path();
    for (const ExpectedPlace& place : scene.expect.places) EXPECT_FALSE(place.why.empty()) << entry.path();
  }
}

}  // namespace
}  // namespace dartboard::gallery_physics_test
