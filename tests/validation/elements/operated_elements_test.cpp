#include "validation/elements/operated_elements.h"

#include <gtest/gtest.h>

#include "core/meshes/generators/mesh_generators.h"

namespace dartboard::operated_elements_test {
namespace {

const ElementOperationsPlan brief{.operations = 400, .check_every = 50, .seed = 7};

// Separating cells moves no summand; the reference is summed otherwise, with some hundred roundings.
void expect_sound(const ElementOperations& found) {
  EXPECT_EQ(found.operations(), brief.operations);
  EXPECT_GT(found.dissociated, 3 * found.removed);
  EXPECT_GT(found.removed, 20u);
  EXPECT_EQ(found.compared, 8u);
  EXPECT_EQ(found.dissociation, 0.0);
  EXPECT_LT(found.removal, 1e-13);
  EXPECT_LT(found.energy, 1e-13);
  EXPECT_LT(found.force, 1e-13);
  EXPECT_LT(found.mass, 1e-13);
  EXPECT_GT(found.removal + found.energy + found.force, 0.0);  // other numbers were compared
}

TEST(OperatedElements, OfTetrahedraKeepWhatIsTheirs) {
  for (const Model model : {Model::neo_hookean, Model::corotational, Model::stvk})
    expect_sound(operate_on_elements(kuhn_box(3, 3, 3, 0.1, 0.2, 5), model, brief));
}

TEST(OperatedElements, OfAllKindsKeepWhatIsTheirs) {
  expect_sound(operate_on_elements(mixed_box(3, 3, 3, 0.1), Model::neo_hookean, brief));
}

// At the hundredth operation a vertex moves, or a cell forgets its shape; the next operations go on from there.
TEST(OperatedElements, SeeAVertexThatMoves) {
  const Mesh mesh = kuhn_box(3, 3, 3, 0.1, 0.2, 5);
  ElementOperationsPlan plan = brief;
  std::size_t separations = 0;
  plan.meddles = [&separations](std::size_t k, auto& position, auto&) {
    if (k >= 100 && separations++ < 16) position[0].x() += 1e-6;
  };
  const ElementOperations found = operate_on_elements(mesh, Model::neo_hookean, plan);
  EXPECT_GT(found.dissociation, 1e-9);
  EXPECT_GT(found.removal, 1e-9);  // of sixteen operations some are removals
  EXPECT_LT(found.force, 1e-13);   // both bodies have the vertex at this place
}

TEST(OperatedElements, SeeACellThatForgetsItsShape) {
  const Mesh mesh = kuhn_box(3, 3, 3, 0.1, 0.2, 5);
  ElementOperationsPlan plan{.operations = 50, .check_every = 50, .seed = 7};
  plan.meddles = [](std::size_t k, auto&, auto& shape) {
    if (k == 10) shape[0] *= 1.0001;
  };
  const ElementOperations found = operate_on_elements(mesh, Model::neo_hookean, plan);
  EXPECT_GT(found.dissociation, 1e-9);
  EXPECT_GT(found.energy, 1e-9);
  EXPECT_GT(found.force, 1e-9);
}

TEST(OperatedElements, AreTheSameForTheSameSeedAndOthersForAnother) {
  const Mesh mesh = kuhn_box(2, 2, 2, 0.1, 0.2, 5);
  ElementOperationsPlan plan{.operations = 100, .check_every = 50, .seed = 1};
  const ElementOperations a = operate_on_elements(mesh, Model::stvk, plan),
                          b = operate_on_elements(mesh, Model::stvk, plan);
  EXPECT_EQ(a.removed, b.removed);
  EXPECT_EQ(a.force, b.force);
  plan.seed = 2;
  EXPECT_NE(a.force, operate_on_elements(mesh, Model::stvk, plan).force);
}

}  // namespace
}  // namespace dartboard::operated_elements_test
