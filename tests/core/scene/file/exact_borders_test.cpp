// Places selected and cut by boxes, planes and spheres, compared with integers.
//
// Meshes and borders have small whole coordinates, so that many places lie exactly on borders, and are then scaled and
// moved by numbers that are not exact in binary. The witness (reference/exact_sides.h) sees the whole numbers. A place
// off a border is some 1/(8 |n|) or more of a cell away from it, ten million times the thickness of borders.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "core/mechanics/fracture/seam.h"
#include "core/mechanics/mass_spring_body.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/places/border.h"
#include "core/plain/random.h"
#include "core/scene/file/scene_materials.h"
#include "core/scene/file/selections/selection.h"
#include "core/topology/cells.h"
#include "reference/exact_sides.h"

namespace dartboard::exact_borders_test {
namespace {

using Eigen::Vector3d;
using reference::WholePoint;

// Positions of whole coordinates in a body: cells of two units, in decimetres, millimetres, far from the origin.
struct Placing {
  double unit;
  Vector3d origin;
  Vector3d operator()(const WholePoint& p) const { return unit * p.cast<double>() + origin; }
};
const std::vector<Placing> placings{{0.05, {0, 0, 0}}, {0.001, {0.1, -0.7, 0.3}}, {1.0 / 3, {100, 200, -300}}};

struct WholeMesh {
  std::string name;
  Mesh mesh;
  std::vector<WholePoint> points;
};

// The points of a mesh of spacing 2 are whole, those in the middles of its cubes too.
std::vector<WholeMesh> whole_meshes() {
  std::vector<WholeMesh> all{{"tetrahedra", kuhn_box(3, 2, 2, 2.0), {}},
                             {"hexahedra", hexahedron_box(3, 3, 2, 2.0), {}},
                             {"all kinds", mixed_box(2, 2, 2, 2.0), {}},
                             {"triangles", triangle_sheet(4, 3, 2.0), {}},
                             {"quadrilaterals", quad_sheet(4, 3, 2.0), {}}};
  for (WholeMesh& whole : all)
    for (const Vector3d& p : whole.mesh.points) {
      whole.points.push_back(p.array().round().cast<std::int64_t>());
      EXPECT_EQ(whole.points.back().cast<double>(), p);
    }
  return all;
}

Mesh placed(const WholeMesh& whole, const Placing& place) {
  Mesh mesh = whole.mesh;
  for (std::size_t p = 0; p < mesh.points.size(); ++p) mesh.points[p] = place(whole.points[p]);
  return mesh;
}

std::int64_t whole(SplitMix64& random, int low, int high) {
  return low + static_cast<std::int64_t>(random.below(static_cast<std::size_t>(high - low + 1)));
}
WholePoint whole_point(SplitMix64& random, int low, int high) {
  return {whole(random, low, high), whole(random, low, high), whole(random, low, high)};
}

struct RandomBox {
  reference::WholeBox exact;
  BoxSelection given;
  RandomBox(SplitMix64& random, const Placing& place)
      : exact{whole_point(random, -1, 3), {0, 0, 0}}, given{place(exact.min), {0, 0, 0}} {
    exact.max = exact.min + whole_point(random, 0, 4);
    given.max = place(exact.max);
  }
};
struct RandomPlane {
  reference::WholePlane exact;
  PlaneSelection given;
  RandomPlane(SplitMix64& random, const Placing& place)
      : exact{whole_point(random, -1, 7), whole_point(random, -3, 3)} {
    if (exact.normal.isZero()) exact.normal.x() = 1;
    given = {place(exact.point), exact.normal.cast<double>().normalized()};
  }
};
struct RandomSphere {
  reference::WholeSphere exact;
  SphereSelection given;
  RandomSphere(SplitMix64& random, const Placing& place)
      : exact{whole_point(random, -1, 7), whole(random, 0, 5)},
        given{place(exact.centre), place.unit * static_cast<double>(exact.radius)} {}
};

struct Tally {
  int shapes = 0, differ = 0, with_some_on_the_border = 0;
};

// A place on a border is not in the interior: of boxes and spheres that shrink, of a plane that is
// turned.
bool has_some_on(const reference::WholePlane& plane, std::span<const WholePoint> points) {
  return std::any_of(points.begin(), points.end(),
                     [&](const WholePoint& p) { return (p - plane.point).dot(plane.normal) == 0; });
}
bool has_some_on(const reference::WholeBox& box, std::span<const WholePoint> points) {
  return std::any_of(points.begin(), points.end(), [&](const WholePoint& p) {
    return ((p.array() == box.min.array()) || (p.array() == box.max.array())).any();
  });
}
bool has_some_on(const reference::WholeSphere& sphere, std::span<const WholePoint> points) {
  return std::any_of(points.begin(), points.end(), [&](const WholePoint& p) {
    return (p - sphere.centre).squaredNorm() == sphere.radius * sphere.radius;
  });
}

// 10^4 shapes of a kind over all meshes and places: points and cells that they select.
template <class Shape>
void expect_exact_selections() {
  SplitMix64 random(1);
  Tally tally;
  for (const WholeMesh& whole : whole_meshes())
    for (const Placing& place : placings) {
      const Mesh mesh = placed(whole, place);
      const std::vector<Vector3d> middles = centroids(mesh);
      for (int k = 0; k < 667; ++k) {
        const Shape shape(random, place);
        std::vector<std::uint32_t> points;
        for (std::uint32_t p = 0; p < whole.points.size(); ++p)
          if (contains_mean(shape.exact, std::span(&whole.points[p], 1))) points.push_back(p);
        const bool same = select_points(shape.given, mesh.points, "") == points &&
                          cells_in(shape.given, middles, border_thickness(mesh.points)) ==
                              cells_inside(shape.exact, whole.mesh, whole.points);
        ++tally.shapes;
        tally.with_some_on_the_border += has_some_on(shape.exact, whole.points);
        if (!same && ++tally.differ == 1)
          ADD_FAILURE() << whole.name << ", unit " << place.unit << ", shape " << k << " selects other points or cells";
      }
    }
  EXPECT_EQ(tally.differ, 0);
  EXPECT_GE(tally.shapes, 10000);
  EXPECT_GE(tally.with_some_on_the_border, 1000);
}

TEST(ExactBorders, OfBoxesSelectWhatIntegersSelect) { expect_exact_selections<RandomBox>(); }
TEST(ExactBorders, OfPlanesSelectWhatIntegersSelect) { expect_exact_selections<RandomPlane>(); }
TEST(ExactBorders, OfSpheresSelectWhatIntegersSelect) { expect_exact_selections<RandomSphere>(); }

template <class Map>
std::set<std::vector<std::uint32_t>> cut_by(const MassSpringBody<Map, Held::by_every_dart>& body,
                                            const PlaneSelection& plane) {
  constexpr int n = Map::dimension;
  std::vector<Dart> seam;
  if constexpr (n == 3)
    seam = faces_on_plane(body, plane.point, plane.normal);
  else
    seam = edges_on_plane(body, plane.point, plane.normal);
  std::set<std::vector<std::uint32_t>> facets;
  for (const Dart d : seam) {
    std::set<std::uint32_t> points;
    for_each_dart_of(body.map, Cell<n - 1>{d},
                     [&](Dart at) { points.insert(body.vertices.point[body.vertex(body.map, at)]); });
    facets.emplace(points.begin(), points.end());
  }
  return facets;
}

template <class Map>
int planes_that_cut_otherwise(const WholeMesh& whole, const Placing& place, SplitMix64& random, int count) {
  Problem problem;
  problem.mesh = placed(whole, place);
  problem.material = {.density = 1.0, .stiffness = 1.0};
  const auto body = build_body<Map, Held::by_every_dart>(problem);
  int differ = 0;
  for (int k = 0; k < count; ++k) {
    const RandomPlane plane(random, place);
    differ += cut_by(body, plane.given) != facets_between(plane.exact, whole.mesh, whole.points);
  }
  return differ;
}

TEST(ExactBorders, OfPlanesCutTheFacesBetweenCellsThatIntegersSeparate) {
  SplitMix64 random(2);
  for (const WholeMesh& whole : whole_meshes())
    for (const Placing& place : placings) {
      const int differ = whole.mesh.dimension() == 2  ? planes_that_cut_otherwise<Map2>(whole, place, random, 667)
                         : whole.name == "tetrahedra" ? planes_that_cut_otherwise<TetMap>(whole, place, random, 667)
                                                      : planes_that_cut_otherwise<Map3>(whole, place, random, 667);
      EXPECT_EQ(differ, 0) << whole.name << ", unit " << place.unit;
    }
}

}  // namespace
}  // namespace dartboard::exact_borders_test
