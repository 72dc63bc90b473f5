#include <array>

#include "core/meshes/mesh_io.h"

namespace dartboard {
namespace {

template <std::size_t N>
using Names = std::array<std::string_view, N>;

constexpr Names<1> gmsh{".msh"}, vtk{".vtk"}, vtu{".vtu"}, stl{".stl"}, obj{".obj"}, ply{".ply"}, off{".off"};
constexpr Names<2> medit{".mesh", ".meshb"}, tetgen{".node", ".ele"};

constexpr MeshFormatInfo table[] = {
    {MeshFormat::medit, "Medit", medit,
     "versions 0 to 4, ASCII and, of either byte order, binary; references; P2 cells by their corners",
     "version 2, ASCII, 17 digits"},
    {MeshFormat::tetgen, "TetGen", tetgen, "ASCII; regions; 6- and 10-node cells by their corners", ""},
    {MeshFormat::gmsh, "Gmsh", gmsh,
     "versions 1, 2.x, 4.0 and 4.1, ASCII and binary; physical groups, also of partitioned meshes; cells of "
     "higher order by their corners",
     ""},
    {MeshFormat::vtk_legacy, "legacy VTK", vtk,
     "versions 1.0 to 5.1, ASCII and BINARY; unstructured grids, cells of higher order by their corners; polygon data, "
     "triangles, quadrilaterals and strips; whole numbers of cells",
     ""},
    {MeshFormat::vtu, "VTK XML", vtu,
     "ASCII, base64 or raw, inline or appended, of either byte order; uncompressed or by zlib or LZ4; whole "
     "numbers of cells; cells of higher order by their corners",
     "the frames of scenes: base64 inline, uncompressed"},
    {MeshFormat::stl, "STL", stl,
     "ASCII and binary; equal corners are one point; facets with two equal corners are left out; solids", ""},
    {MeshFormat::obj, "OBJ", obj,
     "triangles and quadrilaterals; points of two or three coordinates; groups and materials", ""},
    {MeshFormat::ply, "PLY", ply,
     "ASCII and binary of either byte order; triangles, quadrilaterals and strips; points of two or three coordinates",
     ""},
    {MeshFormat::off, "OFF", off,
     "ASCII and BINARY; triangles and quadrilaterals; also COFF, NOFF, CNOFF, STOFF, nOFF and 2OFF, points of two or three coordinates",
     ""},
};

}  // namespace

std::span<const MeshFormatInfo> mesh_formats() { return table; }

}  // namespace dartboard
