#include "core/meshes/mesh_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "core/meshes/formats/mesh_builder.h"
#include "core/meshes/formats/mesh_check.h"
#include "core/meshes/formats/mesh_formats.h"
#include "core/meshes/formats/weld_points.h"
#include "core/meshes/gmsh/gmsh.h"
#include "core/meshes/surfaces/surface_formats.h"
#include "core/meshes/text/file_text.h"
#include "core/meshes/text/letter_case.h"
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

std::optional<MeshFormat> format_of(const fs::path& path) {
  const std::string extension = lower(path.extension().string());
  for (const MeshFormatInfo& info : mesh_formats())
    if (std::ranges::find(info.extensions, extension) != info.extensions.end()) return info.format;
  return std::nullopt;
}

/// The format of VTK that a text is in, whatever the extension of its file; no value if it cannot be recognised.
std::optional<MeshFormat> vtk_format_of(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // a byte order mark
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  constexpr std::string_view legacy = "# vtk DataFile";
  if (same_letters(text.substr(0, legacy.size()), legacy)) return MeshFormat::vtk_legacy;
  if (!text.starts_with("<") || text.find("<VTKFile") == text.npos) return std::nullopt;
  return MeshFormat::vtu;  // its reader reports any other type
}

/// The format of VTK that the text is in: some files have the extension of another.
MeshFormat true_format(std::string_view text, MeshFormat format, MeshBuilder& builder) {
  const bool is_vtk = format == MeshFormat::vtk_legacy || format == MeshFormat::vtu;
  const auto found = is_vtk ? vtk_format_of(text) : std::nullopt;
  if (!found || *found == format) return format;
  const auto info = [](MeshFormat wanted) -> const MeshFormatInfo& {
    return *std::ranges::find(mesh_formats(), wanted, &MeshFormatInfo::format);
  };
  builder.add_notice(fmt::format("the text is in the format {} ({}) and was read so, not as {} ({})", info(*found).name,
                                 info(*found).extensions[0], info(format).name, info(format).extensions[0]));
  return *found;
}

/// The contents of a mesh file. Lines that end as on old Macs, in CR alone, end in LF instead.
std::string mesh_text(const fs::path& path, std::string_view wanted) {
  std::string text = file_text(path, wanted);
  const bool is_text = text.find('\0') == text.npos;
  if (is_text && text.find('\n') == text.npos) std::ranges::replace(text, '\r', '\n');
  return text;
}

fs::path with(fs::path stem, std::string_view extension) { return stem += extension; }

LoadedMesh finish(MeshBuilder& builder, std::string format, std::string_view text, const MeshReading& reading) {
  LoadedMesh loaded = builder.finish(std::move(format), text);
  if (reading.weld) weld_points(loaded, *reading.weld, builder.cell_file(), builder.cell_lines());
  check_and_repair(loaded, builder.cell_file(), builder.cell_lines(), reading.keep_crossed);
  return loaded;
}

LoadedMesh read_tetgen_files(const fs::path& node_path, const fs::path& ele_path, const MeshReading& reading) {
  const std::string node_text = mesh_text(node_path, "the TetGen points that belong to the .ele file");
  const std::string ele_text = mesh_text(ele_path, "the TetGen cells that belong to the .node file");
  TextScanner node(node_text, node_path.string(), '#');
  TextScanner ele(ele_text, ele_path.string(), '#');
  MeshBuilder builder(node.file(), ele.file());
  std::string format = read_tetgen(node, ele, builder);
  return finish(builder, std::move(format), ele_text, reading);
}

}  // namespace

LoadedMesh read_mesh_file(const fs::path& path, const MeshReading& reading) {
  if (!is_there(path) && is_there(with(path, ".node")))
    return read_tetgen_files(with(path, ".node"), with(path, ".ele"), reading);
  const auto format = format_of(path);
  const bool is_file = is_there(path) && !is_folder(path);
  if (is_file && !format)
    fail_at(path.string(), 0, fmt::format("the extension {} is unknown", in_quotes(path.extension().string())),
            known_extensions());
  if (is_file && format == MeshFormat::tetgen) {
    const fs::path stem = fs::path(path).replace_extension();
    return lower(path.extension().string()) == ".node" ? read_tetgen_files(path, with(stem, ".ele"), reading)
                                                       : read_tetgen_files(with(stem, ".node"), path, reading);
  }
  const std::string text = mesh_text(path, fmt::format("a mesh file: {}", known_extensions()));
  return parse_mesh(text, *format, path.string(), reading);
}

Mesh read_mesh(const fs::path& path, const MeshReading& reading) { return read_mesh_file(path, reading).mesh; }

LoadedMesh parse_mesh(std::string_view text, MeshFormat format, const std::string& name, const MeshReading& reading) {
  MeshBuilder builder(name, name);
  if (text.find_first_not_of(" \t\r\n\v\f") == text.npos) fail_at(name, 1, "the file is empty", "a mesh");
  std::string exact;
  switch (true_format(text, format, builder)) {
    case MeshFormat::medit: exact = read_medit(text, builder); break;
    case MeshFormat::gmsh: exact = read_gmsh(text, builder); break;
    case MeshFormat::vtk_legacy: exact = read_vtk_legacy(text, builder); break;
    case MeshFormat::vtu: exact = read_vtu(text, builder); break;
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
  return finish(builder, std::move(exact), text, reading);
}

}  // namespace dartboard
