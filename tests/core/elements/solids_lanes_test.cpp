// Forces and damping of solid cells, with Gauss points four at a time and one at a time.

#include "core/elements/lanes/solids_lanes.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <utility>

#include "core/base/lanes.h"
#include "core/elements/solids.h"
#include "core/forces/term_damping.h"
#include "core/meshes/generators/mesh_generators.h"
#include "tests/support/bodies/element_body_for_tests.h"

namespace dartboard::solids_lanes_test {
namespace {

using Eigen::Vector3d;

Material elastic(Model model, double young = 1e4) {
  return {.density = 300.0,
          .stiffness = 0.0,
          .damping = 0.0,
          .young = young,
          .poisson = 0.3,
          .model = model,
          .damping_time = 0.01};
}

/// A body with cells of every kind, jittered at rest, and moved at random.
struct Solids {
  struct Columns {  // the term keeps references to them when this is moved
    std::vector<Material> materials;
    std::vector<MaterialNumber> numbers;
    std::vector<SolidNodes> nodes;
    std::vector<SolidShape> shape;
  };
  std::unique_ptr<Columns> columns = std::make_unique<Columns>();
  std::vector<Vector3d> x, v;
  std::unique_ptr<ForceTerm> term;

  explicit Solids(std::vector<Material> materials, double moved = 0.02) {
    Mesh mesh = mixed_box(3, 3, 3, 0.1);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const auto vector = [&] { return Vector3d(number(random), number(random), number(random)); };
    for (Vector3d& point : mesh.points) {
      point += 0.008 * vector();
      x.push_back(point + moved * vector());
      v.push_back(vector());
    }
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      SolidNodes nodes;
      std::vector<Vector3d> corners;
      for (const std::uint32_t p : mesh.cell(c)) {
        nodes.at[nodes.count++] = p;
        corners.push_back(mesh.points[p]);
      }
      columns->nodes.push_back(nodes);
      columns->shape.push_back(solid_shape_of(mesh.kinds[c], corners));
      columns->numbers.push_back(static_cast<MaterialNumber>(c / 4 % materials.size()));
    }
    columns->materials = std::move(materials);
    const std::vector<Material>& all = columns->materials;
    term = make_solids(all.size() == 1 ? CellMaterials(all[0]) : CellMaterials(all[0], all, columns->numbers),
                       {columns->nodes, columns->shape});
  }
};

/// Of forces added to -0, so that the sign of a zero is seen.
template <class AddForces>
std::vector<std::uint64_t> bits_of(std::size_t vertices, bool in_lanes, const AddForces& add_forces) {
  std::vector<Vector3d> force(vertices, Vector3d(-0.0, -0.0, -0.0));
  use_lanes(in_lanes);
  add_forces(std::span(force));
  use_lanes(true);
  std::vector<std::uint64_t> bits;
  for (const Vector3d& row : force)
    for (const double number : row) bits.push_back(std::isnan(number) ? 0 : std::bit_cast<std::uint64_t>(number));
  return bits;
}

void expect_equal_bits(const Solids& solids) {
  const auto expect_equal = [&](const char* what, const auto& add_forces) {
    EXPECT_EQ(bits_of(solids.x.size(), true, add_forces), bits_of(solids.x.size(), false, add_forces)) << what;
  };
  const std::vector<Vector3d>&x = solids.x, &v = solids.v;
  const auto vertices = static_cast<std::uint32_t>(x.size());
  const auto cells = static_cast<std::uint32_t>(solids.columns->nodes.size());
  expect_equal("forces", [&](std::span<Vector3d> force) { solids.term->add_forces({x}, force); });
  expect_equal("forces in a stage", [&](std::span<Vector3d> force) { solids.term->add_forces({x, v, 0.01}, force); });
  expect_equal("damping", [&](std::span<Vector3d> force) { solids.term->damping()->add_forces({x}, v, force); });
  expect_equal("damping in a stage", [&](std::span<Vector3d> force) {
    solids.term->damping()->add_forces({x, v, 0.01}, v, force);
  });
  expect_equal("shares", [&](std::span<Vector3d> force) {
    for (const VertexRange own : {VertexRange{0, vertices / 2}, VertexRange{vertices / 2, vertices}})
      solids.term->add_forces_in_part({x}, {0, cells, false}, own, force);
  });
}

class SolidsLanes : public testing::Test {
 protected:
  void SetUp() override {
    use_lanes(true);
    if (!lanes_are_on()) GTEST_SKIP() << "this processor has no AVX2";
  }
};

TEST_F(SolidsLanes, HaveTheBitsOfOneByOneForEveryKindOfCell) {
  for (const Model model : element_models)
    for (const double moved : {0.0, 0.001, 0.02, 0.3}) expect_equal_bits(Solids({elastic(model)}, moved));
}

TEST_F(SolidsLanes, HaveThemInABodyOfSeveralMaterials) {
  expect_equal_bits(
      Solids({elastic(Model::neo_hookean), elastic(Model::corotational, 3e3), elastic(Model::stvk, 2e4)}));
  Material springs = elastic(Model::springs);
  springs.stiffness = 10.0;
  expect_equal_bits(Solids({springs, elastic(Model::corotational)}));
}

TEST_F(SolidsLanes, HaveThemWhereCellsAreInvertedOrCollapsed) {
  for (const Model model : element_models)
    for (const Vector3d& scale : {Vector3d(1, 1, -1), Vector3d(1, 1, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 0),
                                  Vector3d(1e-200, 1e-200, 1e-200), Vector3d(1e90, 1, 1)}) {
      Solids solids({elastic(model)});
      for (Vector3d& x : solids.x) x = x.cwiseProduct(scale);
      expect_equal_bits(solids);
    }
}

TEST_F(SolidsLanes, KeepWhatIsNotANumber) {
  for (const Model model : element_models)
    for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
      for (const std::size_t corner : {0u, 3u, 9u, 15u}) {
        Solids solids({elastic(model)});
        const double right = std::exchange(solids.x[corner].y(), wrong);
        expect_equal_bits(solids);
        solids.x[corner].y() = right;
        solids.v[corner].y() = wrong;
        expect_equal_bits(solids);
      }
}

// A tetrahedron has one point, a prism six.
TEST_F(SolidsLanes, TakeWholeFoursOfPoints) {
  const Solids solids({elastic(Model::neo_hookean)});
  std::set<CellKind> met;
  for (const SolidShape& shape : solids.columns->shape) {
    met.insert(shape.kind);
    const std::vector<std::array<Vector3d, 8>> gradients(8, {Vector3d(1, 2, 3), Vector3d(1, 0, 0), Vector3d(0, 1, 0)});
    const GaussPointsAt at{gradients.data(), shape.inverse.data(), shape.volume.data(), gauss_points(shape.kind), 3};
    std::array<Vector3d, 8> sum;
    sum.fill(Vector3d(0, 0, 0));
    EXPECT_EQ(add_stresses_in_lanes(at, NeoHookeanConstants{1.0, 1.0, 0.5}, solids.x.data(), sum.data()),
              gauss_points(shape.kind) / 4 * 4);
  }
  EXPECT_EQ(met.size(), 4u);
}

}  // namespace
}  // namespace dartboard::solids_lanes_test
