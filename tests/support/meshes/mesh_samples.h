#pragma once
// One small body in every format: two tetrahedra on the points 0, x, y, z and (1, 1, 1), sharing the face x y z.

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/meshes/mesh_io.h"
#include "core/plain/error.h"

namespace dartboard::samples {

inline constexpr std::string_view medit = R"(MeshVersionFormatted 2
Dimension
3
# the points, each with a reference
Vertices
5
0 0 0 1
1 0 0 1
0 1 0 1
0 0 1 1
1 1 1 2
Triangles 1
1 2 3 7
Tetrahedra
2
1 2 3 4 0
2 3 4 5 0
End
)";

inline constexpr std::string_view tetgen_node = R"(5 3 1 1
# number x y z attribute marker
0 0 0 0 0.5 1
1 1 0 0 0.5 1
2 0 1 0 0.5 1
3 0 0 1 0.5 0
4 1 1 1 0.5 1
)";

inline constexpr std::string_view tetgen_ele = R"(2 4 1
0 0 1 2 3 7
1 1 2 3 4 7
)";

inline constexpr std::string_view gmsh1 = R"($NOD
5
1 0 0 0
2 1 0 0
3 0 1 0
40 0 0 1
7 1 1 1
$ENDNOD
$ELM
3
1 2 1 1 3 1 2 3
2 4 1 1 4 1 2 3 40
3 4 1 1 4 2 3 40 7
$ENDELM
)";

inline constexpr std::string_view gmsh2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
3 1 "the body"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 1 1 1
$EndNodes
$Elements
4
1 15 2 0 1 1
2 1 2 0 1 1 2
3 4 2 0 1 1 2 3 4
4 4 2 0 1 2 3 4 5
$EndElements
)";

inline constexpr std::string_view gmsh4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 0 0 1
1 0 0 0 1 1 1 0 0
$EndEntities
$Nodes
2 5 1 5
2 1 1 2
1
2
0 0 0 0.25 0.75
1 0 0 0.5 0.5
3 1 0 3
3
4
5
0 1 0
0 0 1
1 1 1
$EndNodes
$Elements
2 3 1 3
2 1 2 1
1 1 2 3
3 1 4 2
2 1 2 3 4
3 2 3 4 5
$EndElements
)";

inline constexpr std::string_view vtk4 = R"(# vtk DataFile Version 3.0
two tetrahedra
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 double
0 0 0 1 0 0
0 1 0 0 0 1 1 1 1
METADATA
INFORMATION 0

CELLS 3 14
3 0 1 2
4 0 1 2 3
4 1 2 3 4
CELL_TYPES 3
5 10 10
POINT_DATA 5
SCALARS temperature double
LOOKUP_TABLE default
1 2 3 4 5
)";

inline constexpr std::string_view vtk5 = R"(# vtk DataFile Version 5.1
two tetrahedra
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 float
0 0 0 1 0 0
0 1 0 0 0 1 1 1 1
CELLS 3 8
OFFSETS vtktypeint64
0 4 8
CONNECTIVITY vtktypeint64
0 1 2 3
1 2 3 4
CELL_TYPES 2
10 10
)";

inline constexpr std::string_view vtu_ascii = R"(<?xml version="1.0"?>
<!-- the byte order means nothing here -->
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="BigEndian">
  <UnstructuredGrid>
    <Piece NumberOfPoints="5" NumberOfCells="2">
      <PointData><DataArray type="Float32" Name="unused" format="ascii">nan</DataArray></PointData>
      <Points>
        <DataArray type="Float32" NumberOfComponents="3" format="ascii">
          0 0 0
          1 0 0
          0 1 0
          0 0 1
          1 1 1
        </DataArray>
      </Points>
      <Cells>
        <DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3 1 2 3 4</DataArray>
        <DataArray type="Int32" Name="offsets" format="ascii">4 8</DataArray>
        <DataArray type="UInt8" Name="types" format="ascii">10 10</DataArray>
      </Cells>
    </Piece>
  </UnstructuredGrid>
</VTKFile>
)";

inline constexpr std::string_view vtu_base64 = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt32">
  <UnstructuredGrid>
    <Piece NumberOfPoints="5" NumberOfCells="2">
      <Points>
        <DataArray type="Float32" NumberOfComponents="3" format="binary">
          PAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAACAPwAAgD8AAIA/AACAPw==
        </DataArray>
      </Points>
      <Cells>
        <DataArray type="Int64" Name="connectivity" format="binary">QAAAAAAAAAAAAAAAAQAAAAAAAAACAAAAAAAAAAMAAAAAAAAAAQAAAAAAAAACAAAAAAAAAAMAAAAAAAAABAAAAAAAAAA=</DataArray>
        <DataArray type="Int32" Name="offsets" format="binary">CAAAAAQAAAAIAAAA</DataArray>
        <DataArray type="UInt8" Name="types" format="binary">AgAAAAoK</DataArray>
      </Cells>
    </Piece>
  </UnstructuredGrid>
</VTKFile>
)";

inline constexpr std::string_view vtu_base64_wide = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <UnstructuredGrid>
    <Piece NumberOfPoints="5" NumberOfCells="2">
      <Points>
        <DataArray type="Float64" NumberOfComponents="3" format="binary">
          eAAAAAAAAAA=AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA8D8AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAADwPwAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAPA/AAAAAAAA8D8AAAAAAADwPwAAAAAAAPA/
        </DataArray>
      </Points>
      <Cells>
        <DataArray type="Int64" Name="connectivity" format="binary">QAAAAAAAAAA=AAAAAAAAAAABAAAAAAAAAAIAAAAAAAAAAwAAAAAAAAABAAAAAAAAAAIAAAAAAAAAAwAAAAAAAAAEAAAAAAAAAA==</DataArray>
        <DataArray type="Int32" Name="offsets" format="binary">CAAAAAAAAAA=BAAAAAgAAAA=</DataArray>
        <DataArray type="UInt8" Name="types" format="binary">AgAAAAAAAAA=Cgo=</DataArray>
      </Cells>
    </Piece>
  </UnstructuredGrid>
</VTKFile>
)";

/// The corners of a unit cube, as a hexahedron has them.
inline const std::vector<Eigen::Vector3d> cube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                               {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

inline std::string tetgen() { return std::string(tetgen_node) + std::string(tetgen_ele); }

/// The text with one part of it replaced by another.
inline std::string with(std::string_view text, std::string_view old_part, std::string_view new_part) {
  std::string out(text);
  const auto at = out.find(old_part);
  EXPECT_NE(at, out.npos) << "the sample has no " << old_part;
  return at == out.npos ? out : out.replace(at, old_part.size(), new_part);
}

inline void expect_two_tetrahedra(const LoadedMesh& loaded) {
  const Mesh& mesh = loaded.mesh;
  ASSERT_EQ(mesh.points.size(), 5u);
  ASSERT_EQ(mesh.cell_count(), 2u);
  EXPECT_EQ(mesh.nodes, (std::vector<std::uint32_t>{0, 1, 2, 3, 1, 2, 3, 4}));
  EXPECT_EQ(mesh.points[1], Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(mesh.points[4], Eigen::Vector3d(1, 1, 1));
  EXPECT_DOUBLE_EQ(signed_measure(mesh, 0), 1.0 / 6.0);
  EXPECT_DOUBLE_EQ(signed_measure(mesh, 1), 1.0 / 3.0);
}

/// The reader's message on a text that it must refuse; empty, and a failure, when the reader accepts it.
inline std::string refusal(std::string_view text, MeshFormat format) {
  try {
    parse_mesh(text, format, "file");
  } catch (const IoError& error) {
    return error.what();
  }
  ADD_FAILURE() << "read without an error:\n" << text;
  return "";
}

inline void expect_part(const std::string& text, std::string_view part) {
  EXPECT_NE(text.find(part), text.npos) << "no '" << part << "' in: " << text;
}

}  // namespace dartboard::samples
