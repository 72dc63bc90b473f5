#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/meshes/mesh_io.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

std::string_view section(CellKind kind) {
  switch (kind) {
    case CellKind::triangle: return "Triangles";
    case CellKind::quadrilateral: return "Quadrilaterals";
    case CellKind::tetrahedron: return "Tetrahedra";
    case CellKind::pyramid: return "Pyramids";
    case CellKind::prism: return "Prisms";
    case CellKind::hexahedron: break;
  }
  return "Hexahedra";
}

void append_cells(std::string& out, const Mesh& mesh, CellKind kind) {
  std::size_t count = 0;
  for (CellKind k : mesh.kinds) count += k == kind;
  if (count == 0) return;
  fmt::format_to(std::back_inserter(out), "{}\n{}\n", section(kind), count);
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    if (mesh.kinds[c] != kind) continue;
    for (std::uint32_t node : mesh.cell(c)) {
      if (node >= mesh.points.size())
        throw InputError(fmt::format("cell {} has the point {}, expected less than {}", c, node, mesh.points.size()));
      fmt::format_to(std::back_inserter(out), "{} ", std::uint64_t{node} + 1);
    }
    out += "0\n";
  }
}

}  // namespace

void write_medit(const std::filesystem::path& path, const Mesh& mesh) {
  std::string out = fmt::format("MeshVersionFormatted 2\nDimension 3\nVertices\n{}\n", mesh.points.size());
  for (const auto& x : mesh.points)
    fmt::format_to(std::back_inserter(out), "{:.17g} {:.17g} {:.17g} 0\n", x[0], x[1], x[2]);
  for (CellKind kind : {CellKind::triangle, CellKind::quadrilateral, CellKind::tetrahedron, CellKind::pyramid,
                        CellKind::prism, CellKind::hexahedron})
    append_cells(out, mesh, kind);
  out += "End\n";

  // "x" makes the refusal and the creation one step, so two writers cannot both win
  std::FILE* file = std::fopen(path.c_str(), "wbx");
  if (file == nullptr && errno == EEXIST)
    throw IoError(fmt::format("{}: the file exists already; expected a new name", path.string()));
  if (file == nullptr)
    throw IoError(fmt::format("{}: {}; expected a place to write a mesh to", path.string(), std::strerror(errno)));
  const bool written = std::fwrite(out.data(), 1, out.size(), file) == out.size();
  if (std::fclose(file) != 0 || !written)
    throw IoError(fmt::format("{}: {}; expected room for {} bytes", path.string(), std::strerror(errno), out.size()));
}

}  // namespace dartboard
