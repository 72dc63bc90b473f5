#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/tell.h"
#include "core/meshes/mesh_io.h"
#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/summary.h"

namespace dartboard {
namespace {

MapSummary summary_of(const Mesh& mesh) {
  return mesh.dimension() == 2 ? summarize(build_map<Map2>(mesh).map) : summarize(build_map<Map3>(mesh).map);
}

nlohmann::ordered_json to_json(const std::string& file, const LoadedMesh& loaded, const MapSummary& s) {
  nlohmann::ordered_json json{
      {"file", file},     {"format", loaded.format}, {"dimension", s.dimension}, {"points", loaded.mesh.points.size()},
      {"darts", s.darts}, {"vertices", s.cells[0]},  {"edges", s.cells[1]},      {"faces", s.cells[2]}};
  if (s.dimension == 3) json["volumes"] = s.cells[3];
  json["components"] = s.components;
  json[s.dimension == 3 ? "boundary_faces" : "boundary_edges"] = s.boundary_facets;
  json["euler"] = s.euler;
  json["orientable"] = s.orientable;
  json["valid"] = s.violation.empty();
  if (!s.violation.empty()) json["violation"] = s.violation;
  json["notices"] = loaded.notices;
  return json;
}

}  // namespace

void add_mesh(CLI::App& app, Outcome& outcome) {
  struct Options {
    std::string file;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("mesh", "Look at a mesh file.");
  verb->require_subcommand(1);
  auto* info = verb->add_subcommand("info", "Build the map of a mesh and count its cells.");
  info->add_option("FILE", options->file, "Medit .mesh, TetGen .node/.ele, Gmsh .msh, VTK .vtk or .vtu")->required();
  info->add_flag("--json", options->json, "print JSON");
  info->callback([options, &outcome] {
    const LoadedMesh loaded = read_mesh(options->file);
    MapSummary summary;
    try {
      summary = summary_of(loaded.mesh);
    } catch (const InputError& error) {  // the mesh, not the command line, is at fault
      throw IoError(fmt::format("{}: {}", options->file, error.what()));
    }
    const auto json = to_json(options->file, loaded, summary);
    if (options->json) {
      tell("{}\n", json_text(json, 2));
    } else {
      for (const auto& [key, value] : json.items())
        if (key != "notices")
          tell("{:15} {}\n", key, value.is_string() ? terminal_text(value.get<std::string>()) : json_text(value));
      for (const std::string& notice : loaded.notices) tell(stderr, "notice: {}\n", notice);
    }
    outcome.exit_code = summary.violation.empty() ? exit_agrees : exit_disagrees;
  });
}

}  // namespace dartboard
