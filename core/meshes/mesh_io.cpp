#include "core/meshes/mesh_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "core/meshes/formats/mesh_builder.h"
#include "core/meshes/formats/mesh_check.h"
#include "core/meshes/formats/mesh_formats.h"
#include "core/meshes/gmsh/gmsh.h"
#include "core/meshes/surfaces/surface_formats.h"
#include "core/meshes/text/file_text.h"
#include "core/meshes/text/text_scanner.h"
#include "core/meshes/vtk/vtk_formats.h"

namespace dartboard {
namespace fs = std::filesystem;
namespace {

/// ".mesh (Medit), .node or .ele (TetGen), ... or .off (OFF)".
std::string known_extensions() {
  std::string known;
  for (const MeshFormatInfo& info : mesh_formats()) {
    if (!known.empty()) known += info.format == mesh_formats().back().format ? " or " : ", ";
    known += fmt::format("{} ({})", fmt::join(info.extensions, " or "), info.name);
  }
  return known;
}

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::optional<MeshFormat> format_of(const fs::path& path) {
  const std::string extension = lower(path.extension().string());
  for (const MeshFormatInfo& info : mesh_formats())
    if (std::ranges::find(info.extensions, extension) != info.extensions.end()) return info.format;
  return std::nullopt;
}

fs::path with(fs::path stem, std::string_view extension) { return stem += extension; }

LoadedMesh finish(MeshBuilder& builder, std::string format, std::string_view text) {
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  const bool ends_with_line = text.empty() || text.back() == '\n';
  LoadedMesh loaded = builder.finish(std::move(format), std::max<std::size_t>(1, lines + (ends_with_line ? 0 : 1)));
  check_and_repair(loaded, builder.cell_file(), builder.cell_lines());
  return loaded;
}

LoadedMesh read_tetgen_files(const fs::path& node_path, const fs::path& ele_path) {
  const std::string node_text = file_text(node_path, "the TetGen points that belong to the .ele file");
  const std::string ele_text = file_text(ele_path, "the TetGen cells that belong to the .node file");
  TextScanner node(node_text, node_path.string(), '#');
  TextScanner ele(ele_text, ele_path.string(), '#');
  MeshBuilder builder(node.file(), ele.file());
  std::string format = read_tetgen(node, ele, builder);
  return finish(builder, std::move(format), ele_text);
}

}  // namespace

LoadedMesh read_mesh(const fs::path& path) {
  if (!is_there(path) && is_there(with(path, ".node")))
    return read_tetgen_files(with(path, ".node"), with(path, ".ele"));
  const auto format = format_of(path);
  const bool is_file = is_there(path) && !is_folder(path);
  if (is_file && !format)
    fail_at(path.string(), 0, fmt::format("the extension {} is unknown", in_quotes(path.extension().string())),
            known_extensions());
  if (is_file && format == MeshFormat::tetgen) {
    const fs::path stem = fs::path(path).replace_extension();
    return lower(path.extension().string()) == ".node" ? read_tetgen_files(path, with(stem, ".ele"))
                                                       : read_tetgen_files(with(stem, ".node"), path);
  }
  const std::string text = file_text(path, fmt::format("a mesh file: {}", known_extensions()));
  return parse_mesh(text, *format, path.string());
}

LoadedMesh parse_mesh(std::string_view text, MeshFormat format, const std::string& name) {
  MeshBuilder builder(name, name);
  if (text.find_first_not_of(" \t\r\n\v\f") == text.npos) fail_at(name, 1, "the file is empty", "a mesh");
  std::string exact;
  switch (format) {
    case MeshFormat::medit: exact = read_medit(text, builder); break;
    case MeshFormat::gmsh: exact = read_gmsh(text, builder); break;
    case MeshFormat::vtk_legacy: exact = read_vtk_legacy(text, builder); break;
    case MeshFormat::vtu: exact = read_vtu(text, builder); break;
    case MeshFormat::vtp: exact = read_vtp(text, builder); break;
    case MeshFormat::pvtu: exact = read_pvtu(text, builder); break;
    case MeshFormat::stl: exact = read_stl(text, builder); break;
    case MeshFormat::obj: exact = read_obj(text, builder); break;
    case MeshFormat::ply: exact = read_ply(text, builder); break;
    case MeshFormat::off: exact = read_off(text, builder); break;
    case MeshFormat::tetgen: {
      TextScanner both(text, name, '#');
      exact = read_tetgen(both, both, builder);
      break;
    }
  }
  return finish(builder, std::move(exact), text);
}

}  // namespace dartboard
