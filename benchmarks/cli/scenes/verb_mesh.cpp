#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <span>

#include "benchmarks/cli/scenes/scene_verbs.h"
#include "benchmarks/figures/body_facets.h"
#include "benchmarks/figures/body_picture.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/tell.h"
#include "core/base/counted.h"
#include "core/base/folder_claim.h"
#include "core/meshes/mesh_facts.h"
#include "core/meshes/mesh_io.h"
#include "core/meshes/touching.h"
#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/storage/hash.h"
#include "core/topology/summary.h"

namespace dartboard {
namespace {

MapSummary summary_of(const Mesh& mesh) {
  if (mesh.dimension() == 2) return summarize(build_map<Map2>(mesh).map);
  const auto is_tetrahedron = [](CellKind kind) { return kind == CellKind::tetrahedron; };
  return std::ranges::all_of(mesh.kinds, is_tetrahedron) ? summarize(build_map<TetMap>(mesh).map)
                                                         : summarize(build_map<Map3>(mesh).map);
}

struct Examined {
  MapSummary summary;
  MeshFacts facts;
  TouchingCells touching;
};

void build_and_measure(const std::string& file, const Mesh& mesh, Examined& e) {
  // the facts of a large mesh take nearly as long as its map
  std::future<MeshFacts> facts = std::async(std::launch::async, facts_of, std::cref(mesh));
  try {
    e.summary = summary_of(mesh);
  } catch (const InputError& error) {  // the mesh, not the command line, is at fault
    throw IoError(fmt::format("{}: {}", file, error.what()));
  }
  e.facts = facts.get();
}

/// Examines a mesh, which then has a point for each vertex of its map. Only where the map has more vertices than the
/// mesh has points, or more edges than these have, do cells touch without sharing a face.
Examined examine(const std::string& file, LoadedMesh& loaded) {
  Examined e;
  build_and_measure(file, loaded.mesh, e);
  const bool may_touch =
      loaded.crossed.any() || e.summary.cells[0] != loaded.mesh.points.size() || e.summary.cells[1] != e.facts.edges;
  if (!may_touch) return e;
  e.touching = split_touching_points(loaded.mesh);
  if (e.touching.any()) loaded.notices.push_back(to_string(e.touching, loaded.place_of_point));
  if (!e.touching.copied.empty()) build_and_measure(file, loaded.mesh, e);
  return e;
}

using Cells = std::vector<std::uint32_t>;
constexpr std::size_t most_values = 50;  // listed of one column: numbers of cells would be as many as these

/// Equal for meshes of the same points, kinds and nodes, to the last bit.
std::string hash_of(const Mesh& mesh) {
  Hash hash;
  hash.add_bytes(mesh.points.data(), mesh.points.size() * sizeof(mesh.points[0]));
  hash.add(mesh.kinds);
  hash.add(mesh.nodes);
  return fmt::format("{:016x}", hash.value());
}

/// Each column of cell numbers: the values that occur, their names, and how many cells have each.
nlohmann::ordered_json regions_of(const LoadedMesh& loaded) {
  auto regions = nlohmann::ordered_json::array();
  for (const CellTags& tags : loaded.tags) {
    std::vector<std::int32_t> sorted = tags.values;
    if (!std::ranges::is_sorted(sorted)) std::ranges::sort(sorted);
    auto values = nlohmann::ordered_json::array();
    std::size_t distinct = 0;
    for (auto at = sorted.begin(); at != sorted.end(); ++distinct) {
      const auto end = std::find_if(at, sorted.end(), [value = *at](std::int32_t other) { return other != value; });
      if (values.size() < most_values) {
        nlohmann::ordered_json row{{"value", *at}, {"cells", static_cast<std::size_t>(end - at)}};
        if (const auto name = tags.names.find(*at); name != tags.names.end()) row["name"] = name->second;
        values.push_back(std::move(row));
      }
      at = end;
    }
    regions.push_back({{"name", tags.name}, {"distinct", distinct}, {"values", std::move(values)}});
  }
  return regions;
}

nlohmann::ordered_json json_of(const std::optional<OfCell>& figure, const char* unit) {
  if (!figure) return nullptr;
  return {{unit, figure->value}, {"cell", figure->cell}};
}

Cells first_ten(const Cells& cells) {
  return {cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(cells.size(), 10))};
}

/// Size, edges, worst cells and boundary of the mesh, which has a point for each vertex of its map.
void add_facts(nlohmann::ordered_json& json, const MeshFacts& facts, int dimension) {
  const auto point = [](const Eigen::Vector3d& x) { return nlohmann::ordered_json{x.x(), x.y(), x.z()}; };
  json["from"] = point(facts.low);
  json["to"] = point(facts.high);
  json[dimension == 3 ? "volume" : "area"] = facts.measure;
  json["edge_lengths"] = {{"least", facts.least_edge}, {"median", facts.median_edge}, {"largest", facts.largest_edge}};
  json["smallest_angle"] = json_of(facts.smallest_angle, "degrees");
  json["largest_angle"] = json_of(facts.largest_angle, "degrees");
  if (facts.least_radius_ratio) json["least_radius_ratio"] = json_of(facts.least_radius_ratio, "ratio");
  json["flat_cells"] = {{"count", facts.flat.size()}, {"first", first_ten(facts.flat)}};
  json["boundary_parts"] = facts.boundary_parts;
  if (facts.genus) json["genus"] = *facts.genus;
}

/// The reason why no body can be made of a mesh; empty if one can.
std::string violation_of(const LoadedMesh& loaded, const MapSummary& s) {
  if (!loaded.crossed.any()) return s.violation;
  return fmt::format("{}; expected {}", loaded.crossed.found(), loaded.crossed.remedy());
}

nlohmann::ordered_json to_json(const std::string& file, const LoadedMesh& loaded, const MapSummary& s,
                               const MeshFacts& facts, const TouchingCells& touching, const std::string& hash) {
  nlohmann::ordered_json json{{"file", file},
                              {"format", loaded.format},
                              {"dimension", s.dimension},
                              {"points", loaded.mesh.points.size() - touching.copied.size()},
                              {"darts", s.darts},
                              {"vertices", s.cells[0]},
                              {"edges", s.cells[1]},
                              {"faces", s.cells[2]}};
  if (s.dimension == 3) json["volumes"] = s.cells[3];
  json["components"] = s.components;
  json[s.dimension == 3 ? "boundary_faces" : "boundary_edges"] = s.boundary_facets;
  json["euler"] = s.euler;
  add_facts(json, facts, s.dimension);
  const CrossedCells& crossed = loaded.crossed;
  json["crossed_cells"] = {
      {"count", crossed.cells.size()}, {"voxel_order", crossed.voxel_order}, {"first", first_ten(crossed.cells)}};
  json["touching"] = {{"points", touching.points.size()}, {"edges", touching.edges.size()}};
  json["orientable"] = s.orientable;
  const std::string violation = violation_of(loaded, s);
  json["valid"] = violation.empty();
  if (!violation.empty()) json["violation"] = violation;
  json["hash"] = hash;
  json["regions"] = regions_of(loaded);
  json["notices"] = loaded.notices;
  return json;
}

void tell_regions(const nlohmann::ordered_json& regions) {
  for (const auto& column : regions) {
    tell("{:18} {}\n", "regions", terminal_text(column["name"].get<std::string>()));
    for (const auto& row : column["values"]) {
      const std::string name = row.contains("name") ? " '" + row["name"].get<std::string>() + "'" : "";
      tell("{:18} {}{}: {}\n", "", row["value"].get<std::int32_t>(), terminal_text(name),
           counted(row["cells"].get<std::size_t>(), "cell"));
    }
    if (const auto left = column["distinct"].get<std::size_t>() - column["values"].size(); left != 0)
      tell("{:18} and {} more\n", "", left);
  }
}

/// "least 0.0216, median 0.238, largest 0.971": a value as people read it.
std::string shown(const nlohmann::ordered_json& value) {
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  if (value.is_string()) return terminal_text(value.get<std::string>());
  if (!value.is_structured()) return json_text(value);
  std::string text;
  for (const auto& [key, part] : value.items()) {
    if (part.is_array() && part.empty()) continue;
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", value.is_object() ? key + " " : "", shown(part));
  }
  return text;
}

void tell_info(const nlohmann::ordered_json& json) {
  for (const auto& [key, value] : json.items())
    if (key == "regions")
      tell_regions(value);
    else if (key != "notices")
      tell("{:18} {}\n", key, shown(value));
}

void tell_formats(bool as_json) {
  auto json = nlohmann::ordered_json::array();
  for (const MeshFormatInfo& format : mesh_formats()) {
    json.push_back({{"name", format.name},
                    {"extensions", std::vector<std::string_view>(format.extensions.begin(), format.extensions.end())},
                    {"read", format.read}});
    if (!format.written.empty()) json.back()["written"] = format.written;
    if (as_json) continue;
    tell("{} ({})\n  read: {}\n", format.name, fmt::join(format.extensions, ", "), format.read);
    if (!format.written.empty()) tell("  written: {}\n", format.written);
  }
  if (as_json) tell("{}\n", json_text(json, 2));
}

std::string known_extensions() {
  std::string known;
  for (const MeshFormatInfo& format : mesh_formats())
    known += fmt::format("{}{} {}", known.empty() ? "" : ", ", format.name, fmt::join(format.extensions, "/"));
  return known;
}

}  // namespace

void add_mesh(CLI::App& app, Outcome& outcome) {
  struct Options {
    std::string file, out;
    std::optional<double> weld;
    bool json = false, formats = false;
  };
  auto options = std::make_shared<Options>();
  auto* verb = app.get_subcommand("mesh");
  verb->require_subcommand(0, 1);
  auto* formats = verb->add_flag("--formats", options->formats, "list the formats that are read and written");
  verb->add_flag("--json", options->json, "print JSON")->needs(formats);
  auto* info = verb->add_subcommand(
      "info", "Build the map of a mesh: its cells, size, edges, worst cells, boundary and regions.");
  info->add_option("FILE", options->file, known_extensions())->required();
  info->add_option("--out", options->out, "folder for a picture of it, new or empty [nothing is drawn]");
  info->add_option("--weld", options->weld,
                   "make points one that are at most this far apart, in the units of the file [none]");
  info->add_flag("--json", options->json, "print JSON");
  verb->callback([options, verb] {
    if (options->formats && verb->get_subcommands().empty()) return tell_formats(options->json);
    if (options->formats) throw InputError("mesh --formats takes no subcommand");
    if (verb->get_subcommands().empty()) throw InputError("mesh needs a subcommand, info FILE, or --formats");
  });
  info->callback([options, &outcome] {
    if (options->formats) return;  // refused by the verb
    LoadedMesh loaded = read_mesh_file(options->file, {.weld = options->weld, .keep_crossed = true});
    const std::string hash = hash_of(loaded.mesh);
    const auto [summary, facts, touching] = examine(options->file, loaded);
    const auto json = to_json(options->file, loaded, summary, facts, touching, hash);
    if (!options->out.empty()) {
      const FolderClaim claim(options->out);
      Frame frame;
      frame.mesh = loaded.mesh;
      frame.component.assign(loaded.mesh.cell_count(), 0);
      frame.mesh_point.resize(loaded.mesh.points.size());
      std::iota(frame.mesh_point.begin(), frame.mesh_point.end(), 0);
      const BodyPanel panel = BodyFacets({}, frame).of(frame);
      picture_missing(outcome,
                      draw_bodies(std::span(&panel, 1), {}, std::filesystem::path(options->file).filename().string(),
                                  options->out, "mesh"));
    }
    if (options->json) {
      tell("{}\n", json_text(json, 2));
    } else {
      tell_info(json);
      for (const std::string& notice : loaded.notices) tell(stderr, "notice: {}\n", notice);
    }
    if (outcome.exit_code != exit_io)
      outcome.exit_code = violation_of(loaded, summary).empty() ? exit_agrees : exit_disagrees;
  });
}

}  // namespace dartboard
