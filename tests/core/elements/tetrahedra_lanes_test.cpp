#include "core/elements/lanes/tetrahedra_lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "core/base/lanes.h"
#include "core/forces/term_damping.h"
#include "tests/support/bodies/element_body_for_tests.h"

namespace dartboard::tetrahedra_lanes_test {
namespace {

using Eigen::Vector3d;

/// Tetrahedra between random vertices; the last vertex of the columns is one of the first and one of the last corners.
struct Heap {
  // on the heap: the term keeps references to them when this is moved
  struct Columns {
    std::vector<TetrahedronNodes> nodes;
    std::vector<RestShape> shape;
    std::vector<double> mass;
    Material material;
    std::vector<Material> several;
    std::vector<MaterialNumber> numbers;
  };
  std::unique_ptr<Columns> columns = std::make_unique<Columns>();
  std::vector<TetrahedronNodes>& nodes = columns->nodes;
  std::vector<RestShape>& shape = columns->shape;
  std::vector<double>& mass = columns->mass;
  Material& material = columns->material;
  std::vector<Vector3d> rest, x, v;
  std::unique_ptr<ForceTerm> term;

  Heap(Model model, std::uint32_t vertices, std::size_t tetrahedra, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const auto vector = [&] { return Vector3d(number(random), number(random), number(random)); };
    for (std::uint32_t i = 0; i < vertices; ++i) {
      rest.push_back(vector());
      x.push_back(rest.back() + 0.2 * vector());
      v.push_back(vector());
    }
    for (std::size_t c = 0; c < tetrahedra; ++c) {
      TetrahedronNodes n;
      for (std::size_t a = 0; a < 4; ++a) {
        do n[a] = static_cast<std::uint32_t>(random() % vertices);
        while (std::find(n.begin(), n.begin() + static_cast<std::ptrdiff_t>(a), n[a]) !=
               n.begin() + static_cast<std::ptrdiff_t>(a));
      }
      if (std::find(n.begin(), n.end(), vertices - 1) == n.end() && (c == 0 || c + 1 == tetrahedra))
        n[c == 0 ? 0 : 3] = vertices - 1;
      nodes.push_back(n);
      shape.push_back(rest_shape_of(rest[n[0]], rest[n[1]], rest[n[2]], rest[n[3]]));
      mass.push_back(1.0 + number(random));
    }
    material = {.density = 300.0,
                .stiffness = 0.0,
                .damping = 0.0,
                .young = 1e4,
                .poisson = 0.3,
                .model = model,
                .damping_time = 0.01};
    // a sanitizer sees what is read behind them
    nodes.shrink_to_fit();
    shape.shrink_to_fit();
    mass.shrink_to_fit();
    x.shrink_to_fit();
    v.shrink_to_fit();
    term = make_tetrahedra(material, {nodes, shape, mass});
  }
  /// Each with vertices of its own.
  static Heap apart(Model model, std::uint32_t tetrahedra, unsigned seed) {
    Heap heap(model, 4 * tetrahedra, tetrahedra, seed);
    for (std::uint32_t c = 0; c < tetrahedra; ++c) {
      const TetrahedronNodes& n = heap.nodes[c] = {4 * c, 4 * c + 1, 4 * c + 2, 4 * c + 3};
      heap.shape[c] = rest_shape_of(heap.rest[n[0]], heap.rest[n[1]], heap.rest[n[2]], heap.rest[n[3]]);
    }
    return heap;
  }
};

/// Of several materials, one of them of springs, in runs of one to nine tetrahedra.
Heap of_several_materials(std::size_t tetrahedra, unsigned seed) {
  Heap heap(Model::neo_hookean, 60, tetrahedra, seed);
  Heap::Columns& columns = *heap.columns;
  for (const Model model : {Model::neo_hookean, Model::springs, Model::corotational, Model::stvk}) {
    columns.several.push_back(heap.material);
    columns.several.back().model = model;
    columns.several.back().young *= static_cast<double>(columns.several.size());
  }
  std::mt19937 random(seed);
  while (columns.numbers.size() < tetrahedra)
    columns.numbers.insert(columns.numbers.end(), 1 + random() % 9, static_cast<MaterialNumber>(random() % 4));
  heap.term = make_tetrahedra({heap.material, columns.several, columns.numbers}, {heap.nodes, heap.shape, heap.mass});
  return heap;
}

using Bits = std::vector<std::uint64_t>;

/// Of forces added to -0, so that the sign of a zero is seen, and of a row before and behind them.
template <class AddForces>
Bits bits_of(const Heap& heap, bool in_lanes, const AddForces& add_forces) {
  std::vector<Vector3d> force(heap.x.size() + 2, Vector3d(-0.0, -0.0, -0.0));
  use_lanes(in_lanes);
  add_forces(std::span(force).subspan(1, heap.x.size()));
  use_lanes(true);
  Bits bits;
  for (const Vector3d& row : force)
    for (const double number : row) bits.push_back(std::isnan(number) ? 0 : std::bit_cast<std::uint64_t>(number));
  return bits;
}

/// Forces all at once, those of damping, from the second one on in two whole runs, and those of two threads in runs
/// that they share.
void expect_equal_bits(const Heap& heap) {
  const auto expect_equal = [&](const auto& add_forces) {
    const Bits one_by_one = bits_of(heap, false, add_forces), in_lanes = bits_of(heap, true, add_forces);
    EXPECT_EQ(in_lanes, one_by_one) << name(heap.material.model) << ", " << heap.nodes.size() << " tetrahedra";
  };
  const auto vertices = static_cast<std::uint32_t>(heap.x.size());
  const auto count = static_cast<std::uint32_t>(heap.nodes.size());
  expect_equal([&](std::span<Vector3d> force) { heap.term->add_forces({heap.x}, force); });
  expect_equal([&](std::span<Vector3d> force) { heap.term->damping()->add_forces({heap.x}, heap.v, force); });
  if (count == 0) return;
  const std::uint32_t middle = (1 + count) / 2;
  expect_equal([&](std::span<Vector3d> force) {
    heap.term->add_forces_in_part({heap.x}, {1, middle, true}, {0, vertices}, force);
    heap.term->add_forces_in_part({heap.x}, {middle, count, true}, {0, vertices}, force);
  });
  expect_equal([&](std::span<Vector3d> force) {
    for (const VertexRange own : {VertexRange{0, vertices / 2}, VertexRange{vertices / 2, vertices}})
      heap.term->add_forces_in_part({heap.x}, {0, count, false}, own, force);
  });
}

class TetrahedraLanes : public testing::Test {
 protected:
  void SetUp() override {
    use_lanes(true);
    if (!lanes_are_on()) GTEST_SKIP() << "this processor has no AVX2";
  }
};

TEST_F(TetrahedraLanes, HaveTheBitsOfOneByOneForAnyNumberOfTetrahedra) {
  for (const Model model : element_models) {
    for (std::size_t tetrahedra = 0; tetrahedra < 10; ++tetrahedra)
      for (unsigned seed = 0; seed < 5; ++seed) expect_equal_bits(Heap(model, 5 + 3 * seed, tetrahedra, seed));
    expect_equal_bits(Heap(model, 200, 1003, 7));
  }
}

TEST_F(TetrahedraLanes, HaveThemInABodyOfSeveralMaterials) {
  for (unsigned seed = 0; seed < 20; ++seed) expect_equal_bits(of_several_materials(100, seed));
}

TEST_F(TetrahedraLanes, HaveThemWhereTetrahedraAreInvertedOrCollapsed) {
  for (const Model model : element_models) {
    const auto mapped = [model](const Vector3d& scale) {
      Heap heap(model, 30, 64, 1);
      for (Vector3d& x : heap.x) x = x.cwiseProduct(scale);
      return heap;
    };
    for (const Vector3d& scale :
         {Vector3d(1, 1, -1), Vector3d(1, 1, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 0), Vector3d(1e-200, 1e-200, 1e-200),
          Vector3d(1, 3e-7, 1e-7), Vector3d(1, 1e-6, 3e-7), Vector3d(1e90, 1, 1), Vector3d(1e200, 1, 1e-9)})
      expect_equal_bits(mapped(scale));
    // one of four, in each lane
    for (const std::size_t c : {8, 21, 34, 47}) {
      Heap heap(model, 60, 64, 2);
      for (const std::uint32_t i : heap.nodes[c]) heap.x[i] = heap.x[heap.nodes[c][0]];
      expect_equal_bits(heap);
    }
  }
}

// The sum of the stretches is a threefold root, and Newton's iteration ends beside it in some of them.
TEST_F(TetrahedraLanes, HaveThemWhereOneOfFourIsTurnedInsideOut) {
  for (const Model model : element_models) {
    for (const double size : {0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-3}) {
      Heap heap = Heap::apart(model, 1600, 6);
      for (std::size_t c = 0; c < heap.nodes.size(); c += 5)
        for (const std::uint32_t i : heap.nodes[c]) heap.x[i] = size * heap.v[i] - heap.rest[i];
      expect_equal_bits(heap);
    }
  }
}

// Gradients of the identity, with zeros of both signs.
TEST_F(TetrahedraLanes, HaveThemAtRest) {
  for (const Model model : element_models) {
    Heap heap = Heap::apart(model, 400, 3);
    std::mt19937 random(9);
    const auto zero = [&] { return random() % 2 == 0 ? 0.0 : -0.0; };
    for (std::size_t c = 0; c < heap.nodes.size(); ++c)
      for (Eigen::Index a = 0; a < 4; ++a) {
        Vector3d &x = heap.x[4 * c + static_cast<std::size_t>(a)], &v = heap.v[4 * c + static_cast<std::size_t>(a)];
        x = Vector3d(zero(), zero(), zero());
        v = Vector3d(zero(), zero(), zero());
        if (a == 0) continue;
        heap.shape[c].col(a - 1) = Vector3d(zero(), zero(), zero());
        heap.shape[c](a - 1, a - 1) = x[a - 1] = 1.0;
      }
    expect_equal_bits(heap);
    // the trace of a strain times a modulus is infinite where others of its numbers are zero
    heap.x[1] *= 1e153;
    expect_equal_bits(heap);
  }
}

TEST_F(TetrahedraLanes, KeepWhatIsNotANumber) {
  for (const Model model : element_models) {
    for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity(), 1e200})
      for (const std::size_t corner : {0, 1, 2, 3}) {
        Heap heap(model, 60, 64, 4);
        double& place = heap.x[heap.nodes[9 + corner][corner]].y();
        const double right = std::exchange(place, wrong);
        expect_equal_bits(heap);
        place = right;
        heap.v[heap.nodes[9 + corner][corner]].y() = wrong;
        expect_equal_bits(heap);
      }
  }
}

TEST_F(TetrahedraLanes, CanBeTurnedOffAndOnAgain) {
  EXPECT_TRUE(use_lanes(false));
  EXPECT_FALSE(lanes_are_on());
  EXPECT_FALSE(use_lanes(true));
  EXPECT_TRUE(lanes_are_on());
}

/// The first that is not added of those from the third one on.
std::size_t end_of_lanes(const Heap& heap) {
  std::vector<Vector3d> force(heap.x.size(), Vector3d(0, 0, 0));
  const TetrahedraAt at{heap.nodes.data(), heap.shape.data(), heap.mass.data(), 1.0, heap.x.data(), force.data()};
  const std::size_t last = heap.nodes.size();
  switch (heap.material.model) {
    case Model::neo_hookean: return add_forces_in_lanes(at, NeoHookeanConstants{1.0, 1.0, 0.5}, 2, last);
    case Model::stvk: return add_forces_in_lanes(at, StVenantKirchhoffConstants{1.0, 1.0}, 2, last);
    default: return add_forces_in_lanes(at, CorotationalConstants{1.0, 1.0}, 2, last);
  }
}

TEST_F(TetrahedraLanes, LeaveTheLastThreeAndFourWithoutOneRotation) {
  for (const Model model : element_models) {
    Heap heap(model, 300, 65, 5);
    EXPECT_EQ(end_of_lanes(heap), 62u);
    for (const std::uint32_t i : heap.nodes[31]) heap.x[i] = Vector3d(0, 0, 0);
    EXPECT_EQ(end_of_lanes(heap), model == Model::corotational ? 30u : 62u);

    std::vector<Vector3d> force(heap.x.size(), Vector3d(0, 0, 0));
    const TetrahedraAt at{heap.nodes.data(), heap.shape.data(), heap.mass.data(), 1.0, heap.x.data(), force.data()};
    for (const std::size_t count : {0, 3, 4, 62})
      EXPECT_EQ(add_damping_in_lanes(at, heap.v.data(), {1.0, 1.0}, 3, 3 + count), 3 + count / 4 * 4);
  }
}

}  // namespace
}  // namespace dartboard::tetrahedra_lanes_test
