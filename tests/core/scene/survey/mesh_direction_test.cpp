#include "core/scene/survey/mesh_direction.h"

#include <gtest/gtest.h>

#include "core/meshes/generators/mesh_generators.h"
#include "core/scene/file/scene_problem.h"
#include "tests/support/moving_box.h"

namespace dartboard::mesh_direction_test {
namespace {

using namespace moving;

// The squares of the edges of six tetrahedra around a diagonal: 20 times the identity, 10 everywhere else.
TEST(MeshDirection, OfABoxCutAlikeIsItsDiagonal) {
  const auto found = direction_of(kuhn_box(3, 2, 4, 0.5));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->ratio, 4.0, 1e-12);
  EXPECT_NEAR(found->axis.dot(Eigen::Vector3d(1, 1, 1).normalized()), 1.0, 1e-12);
}

TEST(MeshDirection, OfABoxInMirrorImagesIsNone) {
  EXPECT_NEAR(direction_of(mirrored_box(2, 4, 2, 0.5))->ratio, 1.0, 1e-12);
  EXPECT_NEAR(direction_of(mirrored_box(1, 1, 1, 0.5))->ratio, 4.0, 1e-12);  // for even counts only
  EXPECT_NEAR(direction_of(hexahedron_box(3, 2, 4, 0.5))->ratio, 1.0, 1e-12);
}

TEST(MeshDirection, IsNotThereInALineAPlaneOrNothing) {
  EXPECT_FALSE(direction_of(Mesh{}));
  EXPECT_FALSE(direction_of(triangle_sheet(2, 2, 0.5)));
}

TEST(MeshDirection, IsSaidOfOneAndAHalfAndMoreWithTheKeyThatHelps) {
  const SceneFile scene = parse(moving_box());
  const std::string said = direction_in_words(scene, make_mesh(scene));
  EXPECT_NE(said.find("4 times as much along [0.58, 0.58, 0.58]"), std::string::npos) << said;
  EXPECT_NE(said.find("/body/generate/box/pattern \"mirrored\" has none for even counts of cells."), std::string::npos)
      << said;
  EXPECT_EQ(direction_in_words(scene, mirrored_box(2, 2, 2, 0.125)), "");
}

}  // namespace
}  // namespace dartboard::mesh_direction_test
