#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <vector>

#include "core/base/counted.h"
#include "core/meshes/text/file_text.h"
#include "core/meshes/text/text_scanner.h"
#include "core/meshes/vtk/join_pieces.h"
#include "core/meshes/vtk/vtk_formats.h"
#include "core/meshes/vtk/vtk_xml.h"

namespace dartboard {
namespace fs = std::filesystem;
namespace {

/// The file of a piece, which no other piece may have: a short file that names a large one often would need more memory
/// than there is.
fs::path file_of_piece(const VtkXml& file, const XmlElement& tag, std::set<fs::path>& known) {
  const auto source = tag.attribute("Source");
  if (!source || source->empty())
    fail_at(file.name, tag.line, "<Piece> has no Source", "<Piece Source=\"a .vtu file\">");
  const fs::path path = (fs::path(file.name).parent_path() / fs::path(*source)).lexically_normal();
  if (!known.insert(path).second)
    fail_at(file.name, tag.line, fmt::format("found the piece {} again", in_quotes(*source)), "every piece once");
  if (!is_there(path) || is_folder(path))
    fail_at(file.name, tag.line, fmt::format("the piece {} is no file", in_quotes(*source)), "a .vtu file");
  return path;
}

}  // namespace

std::string read_pvtu(std::string_view text, MeshBuilder& builder) {
  const std::string name = builder.cell_file();
  const VtkXml file = read_vtk_xml(text, name, "PUnstructuredGrid");
  std::set<fs::path> known;
  std::vector<PieceFile> pieces;
  for (const std::size_t number : file.pieces()) {
    const fs::path path = file_of_piece(file, file.elements[number], known);
    builder.read_from(path.string());
    pieces.push_back({.name = path.filename().string(), .first_point = builder.point_count()});
    add_vtu(file_text(path, "a piece of a .pvtu file"), builder);
  }
  builder.read_from(name);
  note_ghost_cells(builder);
  if (const std::size_t joined = join_pieces(pieces, name, builder); joined != 0)
    builder.add_notice(fmt::format("joined {} with equal points of other pieces, of {}", counted(joined, "point"),
                                   counted(pieces.size(), "piece")));
  return "PVTU";
}

}  // namespace dartboard
