#include "validation/elements/operated_elements.h"

#include <gtest/gtest.h>

#include "core/meshes/generators/mesh_generators.h"

namespace dartboard::operated_elements_test {
namespace {

const ElementOperationsPlan brief{.operations = 400, .check_every = 50, .seed = 7};

// Separating cells moves no summand of elements; the stiffness of springs is summed anew from up to forty cells around
// an edge. The reference is summed otherwise, with some hundred roundings.
void expect_sound(const ElementOperations& found, double jump = 0.0) {
  EXPECT_EQ(found.operations(), brief.operations);
  EXPECT_GT(found.dissociated, 3 * found.removed);
  EXPECT_GT(found.removed, 20u);
  EXPECT_EQ(found.compared, 8u);
  EXPECT_LE(found.dissociation, jump);
  EXPECT_LT(found.removal, 1e-13);
  EXPECT_LT(found.energy, 1e-13);
  EXPECT_LT(found.force, 1e-13);
  EXPECT_LT(found.mass, 1e-13);
  EXPECT_GT(found.removal + found.energy + found.force, 0.0);  // other numbers were compared
  EXPECT_EQ(found.strangers, 0u);
}

TEST(OperatedElements, OfTetrahedraKeepWhatIsTheirs) {
  for (const Model model : {Model::neo_hookean, Model::corotational, Model::stvk})
    expect_sound(operate_on_elements(kuhn_box(3, 3, 3, 0.1, 0.2, 5), uniform(model), brief));
}

TEST(OperatedElements, OfAllKindsKeepWhatIsTheirs) {
  expect_sound(operate_on_elements(mixed_box(3, 3, 3, 0.1), uniform(Model::neo_hookean), brief));
}

TEST(OperatedElements, OfTwoMaterialsKeepWhatIsTheirs) {
  for (const RegionMix& mix : region_mixes()) {
    if (mix.materials.size() == 1) continue;
    SCOPED_TRACE(mix.name);
    expect_sound(operate_on_elements(kuhn_box(3, 3, 3, 0.1, 0.2, 5), mix, brief), 1e-14);
    expect_sound(operate_on_elements(mixed_box(3, 3, 3, 0.1), mix, brief), 1e-14);
  }
}

// At the tenth operation all cells take the material of the other region.
TEST(OperatedElements, SeeCellsThatTakeAnotherMaterial) {
  ElementOperationsPlan plan{.operations = 50, .check_every = 50, .seed = 7};
  plan.meddles = [](std::size_t k, const OperatedColumns& columns) {
    for (MaterialNumber& material : columns.cell_material)
      if (k == 10) material = 1 - material;
  };
  for (const RegionMix& mix : region_mixes()) {
    if (mix.materials.size() == 1) continue;
    SCOPED_TRACE(mix.name);
    const ElementOperations found = operate_on_elements(kuhn_box(3, 3, 3, 0.1, 0.2, 5), mix, plan);
    EXPECT_EQ(found.strangers, 162 - found.removed);
    EXPECT_GT(found.dissociation, 1e-9);
    EXPECT_GT(found.energy, 1e-9);
    EXPECT_GT(found.force, 1e-9);
  }
}

// In the last operations an attachment takes one corner for another.
TEST(OperatedElements, SeeAnAttachmentToAnotherCorner) {
  ElementOperationsPlan plan{.operations = 50, .check_every = 50, .seed = 7};
  plan.meddles = [](std::size_t k, const OperatedColumns& columns) {
    if (k >= 45) columns.attached.at(0).nodes[1] = columns.attached.at(0).nodes[2];
  };
  const ElementOperations found = operate_on_elements(kuhn_box(3, 3, 3, 0.1, 0.2, 5), region_mixes().back(), plan);
  EXPECT_GT(found.dissociation, 1e-9);
  EXPECT_GT(found.energy, 1e-9);
  EXPECT_GT(found.force, 1e-9);
}

// At the hundredth operation a vertex moves, or a cell forgets its shape; the next operations go on from there.
TEST(OperatedElements, SeeAVertexThatMoves) {
  const Mesh mesh = kuhn_box(3, 3, 3, 0.1, 0.2, 5);
  ElementOperationsPlan plan = brief;
  std::size_t separations = 0;
  plan.meddles = [&separations](std::size_t k, const OperatedColumns& columns) {
    if (k >= 100 && separations++ < 16) columns.position[0].x() += 1e-6;
  };
  const ElementOperations found = operate_on_elements(mesh, uniform(Model::neo_hookean), plan);
  EXPECT_GT(found.dissociation, 1e-9);
  EXPECT_GT(found.removal, 1e-9);  // of sixteen operations some are removals
  EXPECT_LT(found.force, 1e-13);   // both bodies have the vertex at this place
}

TEST(OperatedElements, SeeACellThatForgetsItsShape) {
  const Mesh mesh = kuhn_box(3, 3, 3, 0.1, 0.2, 5);
  ElementOperationsPlan plan{.operations = 50, .check_every = 50, .seed = 7};
  plan.meddles = [](std::size_t k, const OperatedColumns& columns) {
    if (k == 10) std::get<std::vector<RestShape>>(columns.shape)[0] *= 1.0001;
  };
  const ElementOperations found = operate_on_elements(mesh, uniform(Model::neo_hookean), plan);
  EXPECT_GT(found.dissociation, 1e-9);
  EXPECT_GT(found.energy, 1e-9);
  EXPECT_GT(found.force, 1e-9);
}

TEST(OperatedElements, AreTheSameForTheSameSeedAndOthersForAnother) {
  const Mesh mesh = kuhn_box(2, 2, 2, 0.1, 0.2, 5);
  ElementOperationsPlan plan{.operations = 100, .check_every = 50, .seed = 1};
  const ElementOperations a = operate_on_elements(mesh, uniform(Model::stvk), plan),
                          b = operate_on_elements(mesh, uniform(Model::stvk), plan);
  EXPECT_EQ(a.removed, b.removed);
  EXPECT_EQ(a.force, b.force);
  plan.seed = 2;
  EXPECT_NE(a.force, operate_on_elements(mesh, uniform(Model::stvk), plan).force);
}

}  // namespace
}  // namespace dartboard::operated_elements_test
