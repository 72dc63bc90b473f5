#pragma once
// Files as other programs write them, where they differ from the samples of mesh_samples.h: the same two tetrahedra,
// the square of two triangles of the samples of surfaces, or the same in the plane.

#include <string_view>

namespace dartboard::samples {

inline constexpr std::string_view medit_of_mmg = R"(MeshVersionFormatted 2

Dimension 3

Vertices
5
0 0 0 1
1 0 0 1
0 1 0 1
0 0 1 1
1 1 1 2
Corners
1
5
RequiredVertices
2
1
5
Triangles
1
1 2 3 7
RequiredTriangles
1
1
Edges
1
1 2 0
Ridges
1
1
RequiredEdges
1
1
Tetrahedra
2
1 2 3 4 0
2 3 4 5 0
RequiredTetrahedra
1
2
Normals
1
0 0 -1
NormalAtVertices
2
1 1
2 1
Tangents
1
1 0 0
TangentAtVertices
1
1 1
End
)";

inline constexpr std::string_view medit_of_bamg = R"(MeshVersionFormatted 0

Dimension
2

Identifier
"BAMG, Vertices 7 #1"

Geometry
"a square.msh"

Vertices
4
0 0 1
1 0 1
1 1 1
0 1 1
hVertices
0.5 0.5
0.5 0.5
Edges
1
1 2 1
Triangles
2
1 2 3 0
1 3 4 0
SubDomain
1
3 1 1 0
SubDomainFromGeom
1
2 1 1 0
VertexOnGeometricVertex
1
1 1
VertexOnGeometricEdge
1
3 2 0.5
EdgeOnGeometricEdge
1
1 1
)";

inline constexpr std::string_view medit_in_small_letters = R"(meshversionformatted 2
dimension 3
VERTICES
5
0 0 0 1
1 0 0 1
0 1 0 1
0 0 1 1
1 1 1 2
corners
1
5
solatvertices
5 1 1
1 2 3 4 5
trianglesGid
1
7
edges
1
1 2 0
tetrahedra
2
1 2 3 4 0
2 3 4 5 0
CORNERS
1
4
end
)";

inline constexpr std::string_view gmsh2_of_groups = R"($MeshFormat
2.2 0 8
$EndMeshFormat
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
1 4 2 8 1 1 2 3 4
2 4 2 9 1 1 2 3 4
3 4 2 8 1 2 3 4 5
4 4 2 9 1 4 3 2 5
$EndElements
)";

inline constexpr std::string_view vtk_of_freefem = R"(# vtk DataFile Version 3.0
unstructured Grid written by FreeFem++
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 float
0 0 0 1 0 0
0 1 0 0 0 1 1 1 1
CELLS 3 14
4 0 1 2 3
4 1 2 3 4
3 0 1 2
CELL_TYPES 3
10
10
5

CELL_DATA 3
Scalars  Label int 1
LOOKUP_TABLE FreeFempp_table
7
8
1

LOOKUP_TABLE FreeFempp_table 3
1.00000000 0.00000000 0.00000000 1.00000000
0.00000000 1.00000000 0.00000000 1.00000000
0.00000000 0.00000000 1.00000000 1.00000000

FIELD FieldData 1
k 1 3 int
4
5
6
)";

inline constexpr std::string_view vtk_in_small_letters = R"(# vtk datafile version 5.1
two tetrahedra
ascii
dataset unstructured_grid
points 5 Double
0 0 0 1 0 0
0 1 0 0 0 1 1 1 1
metadata
information 0

cells 3 8
offsets vtktypeint64
0 4 8
connectivity VTKTypeInt64
0 1 2 3 1 2 3 4
cell_types 2
10
10
cell_data 2
scalars part Int
lookup_table default
1
2
field more 1
metadata
information 0

colour 1 2 unsigned_Char
3 4
)";

inline constexpr std::string_view off_of_one_line = "off4 2\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

inline constexpr std::string_view stl_in_capitals = R"(SOLID SQUARE
FACET NORMAL 0.0 0.0 1.0D+00
OUTER LOOP
VERTEX 0.0 0.0 0.0
VERTEX 1.0E+00 0.0 0.0
VERTEX 1.0D+00 1.0 0.0
ENDLOOP
ENDFACET
FACET NORMAL 0.0 0.0 0.0
OUTER LOOP
VERTEX 1.0 0.0 0.0
VERTEX 1.0 1.0 0.0
VERTEX 1.0 0.0 0.0
ENDLOOP
ENDFACET
FACET NORMAL 0.0 0.0 1.0
OUTER LOOP
VERTEX 0.0 0.0 0.0
VERTEX 1.0 1.0 0.0
VERTEX 0.0 1.0 0.0
ENDLOOP
ENDFACET
ENDSOLID SQUARE
)";

inline constexpr std::string_view off_in_the_plane = "nOFF 2\n4 2 0\n0 0\n1 0\n1 1\n0 1\n3 0 1 2\n3 0 2 3\n";

inline constexpr std::string_view ply_in_the_plane = R"(ply
format ascii 1.0
element vertex 4
property uchar red
property float y
property double x
element face 2
property list uchar int vertex_indices
end_header
9 0 0
9 0 1
9 1 1
9 1 0
3 0 1 2
3 0 2 3
)";

inline constexpr std::string_view obj_in_the_plane = "v 0 0\nv 1 0 # right\nv 1 \\\n1\nv 0 1\nf 1 2 3\nf 1 3 4\n";

/// Three tetrahedra: the first is hidden, the others are those of all samples.
inline constexpr std::string_view vtu_with_ghosts = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1">
<UnstructuredGrid><Piece NumberOfPoints="6" NumberOfCells="4">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0 0 0 1 1 1 1 2 2 2
</DataArray></Points>
<Cells>
<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 5 0 1 2 3 1 2 3 4 1 2 3 4</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4 8 12 16</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10 10 10 10</DataArray>
</Cells>
<CellData>
<DataArray type="UInt8" Name="vtkGhostType" format="ascii">32 0 2 1</DataArray>
<DataArray type="Int32" Name="part" format="ascii">5 6 7 8</DataArray>
</CellData>
</Piece></UnstructuredGrid>
</VTKFile>
)";

}  // namespace dartboard::samples
