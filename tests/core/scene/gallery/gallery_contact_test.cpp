// Expected ends of the scenes of the gallery with contact, from closed forms and symmetry.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <variant>
#include <vector>

#include "core/contact/obstacle.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/run/simulation.h"
#include "tests/support/gallery_for_tests.h"

namespace dartboard::gallery_contact_test {
namespace {

using Eigen::Vector3d;

// A point that slides: gravity along the slope less mu times its normal force; a box is the mean of its points.
TEST(GalleryContact, TheBlockSlidesAsAPointWithFriction) {
  const SceneFile scene = gallery("block_slides");
  const SceneObstacle& slope = scene.obstacles.at(0);
  const Vector3d normal = std::get<HalfSpace>(slope.obstacle.shape).normal, v = scene.initial_velocity.constant;
  const Mesh mesh = make_problem(scene).mesh;
  Vector3d centre(0, 0, 0);
  for (const Vector3d& x : mesh.points) centre += x / static_cast<double>(mesh.points.size());
  const double presses = -scene.gravity.dot(normal), time = scene.duration;
  EXPECT_NEAR(v.dot(normal), 0.0, 1e-15);
  const Vector3d acceleration = scene.gravity + presses * normal - slope.law.friction * presses * v.normalized();
  expect_place(scene, place_of(scene, "corner", true), centre + v * time + acceleration * (time * time / 2));
  // and it starts as deep as its weight needs
  const Simulation simulation(scene);
  const ContactState state = simulation.body().contacts().state_at(simulation.body().vertices().position);
  EXPECT_NEAR(-state.force_on.at(0).dot(normal), simulation.body().mass() * presses, 1e-4 * presses);
}

TEST(GalleryContact, TheSheetHangsFromTheHighestPointOfTheBall) {
  const SceneFile scene = gallery("sheet_drapes");
  const Ball& ball = std::get<Ball>(scene.obstacles.at(0).obstacle.shape);
  const ExpectedPlace& crown = place_of(scene, "crown");
  // anywhere from the surface to the depth allowed
  EXPECT_LE(crown.within, scene.obstacles.at(0).law.depth / 2);
  expect_place(scene, crown, ball.centre + Vector3d(0, 0, ball.radius - crown.within));
  const Mesh mesh = make_problem(scene).mesh;
  Vector3d centre(0, 0, 0);
  for (const Vector3d& x : mesh.points) centre += x / static_cast<double>(mesh.points.size());
  EXPECT_LE((centre - ball.centre).head<2>().norm(), 1e-12);
}

// Columns on each other: each is as deep in the one below as the weight above needs, and shortened by the mean of the
// weights on its two ends.
TEST(GalleryContact, StackedBoxesAreAsDeepInEachOtherAsTheWeightAboveNeeds) {
  const SceneFile scene = gallery("boxes_stacked");
  struct Column {
    double side, mass;
  };
  std::vector<Column> columns;
  for (const BodySource& body : scene.bodies()) {
    const auto& box = std::get<BoxMesh>(body.mesh);
    const double side = box.cells[2] * box.spacing;
    columns.push_back({side, scene.material.density * side * side * side});
  }
  const ContactLaw& law = scene.obstacles.at(0).law;
  EXPECT_EQ(scene.touches.at(0).law.depth, law.depth);
  EXPECT_EQ(scene.touches.at(0).law.pressure, law.pressure);
  const double g = -scene.gravity.z();
  std::vector<double> centre;
  double z = 0.0;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto [side, mass] = columns[k];
    double above = 0.0;
    for (std::size_t j = k + 1; j < columns.size(); ++j) above += columns[j].mass * g;
    z -= law.depth_at_rest((above + mass * g) / (side * side));
    const double height = side * (1.0 - (above + mass * g / 2) / (side * side) / scene.material.young);
    centre.push_back(z + height / 2);
    z += height;
  }
  expect_place(scene, place_of(scene, "middle", true), {0.05, 0.05, centre[1]});
  expect_place(scene, place_of(scene, "top", true), {0.05, 0.05, centre[2]});
}

// A solid ball that rolls without slipping: gravity along the slope moves mass and, by 2/5 of it, the spin.
TEST(GalleryContact, TheStiffBallRollsAsARigidOneAndTheSoftOneFallsBehind) {
  const SceneFile scene = gallery("balls_roll");
  const auto& ball = std::get<BallMesh>(scene.bodies()[0].mesh);
  const Vector3d normal = std::get<HalfSpace>(scene.obstacles.at(0).obstacle.shape).normal;
  EXPECT_NEAR(-scene.gravity.dot(normal) / scene.gravity.norm(), std::cos(20 * M_PI / 180), 1e-9);
  EXPECT_GT(scene.obstacles.at(0).law.friction, 2.0 / 7.0 * std::tan(20 * M_PI / 180));
  const Vector3d along = scene.gravity - scene.gravity.dot(normal) * normal;
  const Vector3d rolled = 0.5 * (5.0 / 7.0) * along * scene.duration * scene.duration;
  const ExpectedPlace &stiff = place_of(scene, "stiff", true), &soft = place_of(scene, "soft", true);
  expect_place(scene, stiff, rolled + (ball.radius - 0.5 * scene.obstacles.at(0).law.depth) * normal);
  EXPECT_LT(soft.position.dot(along), stiff.position.dot(along));
  EXPECT_LT(soft.position.dot(normal), stiff.position.dot(normal));
}

// Half a turn about the axis through the middle of the plate changes the flaps, their ways and their forces into each
// other, so that the middle of what is whole stays on it, and each edge is half of the overlap beyond it.
TEST(GalleryContact, TheFlapsOfThePlateMeetInTheMiddle) {
  const SceneFile scene = gallery("plate_rubs");
  const auto& box = std::get<BoxMesh>(scene.body.mesh);
  const Vector3d middle = 0.5 * box.spacing * Vector3d(box.cells[0], box.cells[1], box.cells[2]);
  ASSERT_EQ(scene.driven.size(), 2u);
  for (double time = 0.0; time < scene.duration; time += 0.05)
    EXPECT_LE((scene.driven[0].way(time) - Vector3d(1, -1, -1).cwiseProduct(scene.driven[1].way(time))).norm(), 1e-15);
  const ExpectedPlace& whole = place_of(scene, "whole");
  expect_place(scene, whole, {whole.position.x(), middle.y(), middle.z()});
  const ExpectedPlace& edge = place_of(scene, "edge");
  const double depth = scene.touches.at(0).law.depth;
  EXPECT_LE(std::abs(edge.position.y() - middle.y()) + edge.within, depth / 2);
  // its friction holds it aside of where symmetry alone would have it
  EXPECT_GT(std::abs(edge.position.z() - middle.z()), 2 * edge.within);
}

TEST(GalleryContact, TheLiverIsPressedInAsFarAsTheInstrumentGoes) {
  const SceneFile scene = gallery("liver_pressed");
  const SceneObstacle& instrument = scene.obstacles.at(0);
  const Ball& ball = std::get<Ball>(instrument.obstacle.shape);
  const Vector3d centre = ball.centre + instrument.obstacle.velocity * instrument.obstacle.until;
  const ExpectedPlace& under = place_of(scene, "under");
  // from the surface to the depth allowed
  EXPECT_LE(under.within, instrument.law.depth / 2);
  expect_place(scene, under, centre - Vector3d(0, 0, ball.radius - under.within));
  // and not where it would be without an instrument
  const auto& near = std::get<Vector3d>(scene.probes.at(under.probe).vertex);
  EXPECT_GT((near - under.position).norm(), 10 * under.within);
}

}  // namespace
}  // namespace dartboard::gallery_contact_test
