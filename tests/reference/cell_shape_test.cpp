#include "reference/cell_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace dartboard::reference::cell_shape_test {
namespace {

using Nodes = std::set<int>;

std::set<Nodes> faces(CellKind kind) {
  std::set<Nodes> all;
  for (const auto& face : own_faces(kind)) all.insert(Nodes(face.begin(), face.end()));
  return all;
}

// By hand, from the drawings of Gmsh's manual.
TEST(CellShape, HasTheFacesOfItsKind) {
  EXPECT_EQ(faces(CellKind::tetrahedron), (std::set<Nodes>{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}));
  EXPECT_EQ(faces(CellKind::pyramid), (std::set<Nodes>{{0, 1, 2, 3}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {0, 3, 4}}));
  EXPECT_EQ(faces(CellKind::prism), (std::set<Nodes>{{0, 1, 2}, {3, 4, 5}, {0, 1, 3, 4}, {1, 2, 4, 5}, {0, 2, 3, 5}}));
  EXPECT_EQ(faces(CellKind::hexahedron),
            (std::set<Nodes>{{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 4, 5}, {1, 2, 5, 6}, {2, 3, 6, 7}, {0, 3, 4, 7}}));
  EXPECT_EQ(faces(CellKind::triangle), (std::set<Nodes>{{0, 1, 2}}));
  EXPECT_EQ(faces(CellKind::quadrilateral), (std::set<Nodes>{{0, 1, 2, 3}}));
}

TEST(CellShape, HasTheEdgesOfItsKindOnce) {
  using Edges = std::vector<std::pair<int, int>>;
  const auto edges = [](CellKind kind) { return Edges(own_edges(kind).begin(), own_edges(kind).end()); };
  EXPECT_EQ(edges(CellKind::tetrahedron), (Edges{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}));
  EXPECT_EQ(edges(CellKind::pyramid), (Edges{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}}));
  EXPECT_EQ(edges(CellKind::prism), (Edges{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}}));
  EXPECT_EQ(edges(CellKind::hexahedron),
            (Edges{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}}));
  EXPECT_EQ(edges(CellKind::quadrilateral), (Edges{{0, 1}, {0, 3}, {1, 2}, {2, 3}}));
}

// Every face is a cycle: its neighbours are joined by edges, and each edge is on two faces.
TEST(CellShape, HasFacesThatRunAlongItsEdges) {
  for (const CellKind kind : {CellKind::tetrahedron, CellKind::pyramid, CellKind::prism, CellKind::hexahedron})
    for (const auto& edge : own_edges(kind)) {
      int met = 0;
      for (const auto& face : own_faces(kind))
        for (std::size_t k = 0; k < face.size(); ++k)
          met += std::minmax({face[k], face[(k + 1) % face.size()]}) == edge ? 1 : 0;
      EXPECT_EQ(met, 2) << name(kind) << " " << edge.first << " " << edge.second;
    }
}

// The table of core/plain, from which core builds its maps, agrees.
TEST(CellShape, IsThatOfThePlainMesh) {
  for (const CellKind kind : {CellKind::triangle, CellKind::quadrilateral, CellKind::tetrahedron, CellKind::pyramid,
                              CellKind::prism, CellKind::hexahedron}) {
    std::set<Nodes> plain;
    for (const auto& face : faces_of(kind)) plain.insert(Nodes(face.begin(), face.end()));
    EXPECT_EQ(plain, faces(kind)) << name(kind);
  }
}

}  // namespace
}  // namespace dartboard::reference::cell_shape_test
