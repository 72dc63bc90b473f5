#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/progress.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/topology/topology_verdict.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/meshes/mesh_io.h"
#include "core/plain/error.h"
#include "validation/cgal/delaunay_ball.h"

namespace dartboard {
namespace {

struct Options {
  std::string mesh, replay, script_out;
  bool all = false, json = false, quick = false, self = false;
  std::optional<std::size_t> operations;
  std::uint64_t seed = 1;
  std::size_t count() const { return operations.value_or(quick ? 1000 : 10000); }
};

/// A mesh with a name by which a script can find it again.
struct Target {
  std::string name;
  std::function<Mesh()> make;
};

Target file_target(const std::filesystem::path& path) {
  return {path.string(), [path] {
            LoadedMesh loaded = read_mesh(path);
            for (const std::string& notice : loaded.notices) tell(stderr, "notice: {}: {}\n", path.string(), notice);
            return std::move(loaded.mesh);
          }};
}

/// The generated meshes, those that CGAL makes included.
std::vector<Target> generated_targets() {
  std::vector<Target> targets;
  for (const auto meshes : {test_meshes(), delaunay_meshes()})
    for (const NamedMesh& mesh : meshes) targets.push_back({mesh.name, mesh.make});
  return targets;
}

/// A mesh of the project by its name, or a file.
Target find_target(const std::string& name) {
  for (const Target& target : generated_targets())
    if (target.name == name) return target;
  return file_target(name);
}

std::vector<Target> all_targets() {
  std::vector<Target> targets = generated_targets();
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(DARTBOARD_SOURCE_DIR) / "benchmarks/meshes"))
    if (entry.path().extension() == ".mesh") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) targets.push_back(file_target(file));
  return targets;
}

std::string short_name(const Target& target) { return std::filesystem::path(target.name).filename().string(); }

bool is_all_tetrahedra(const Mesh& mesh) {
  return std::all_of(mesh.kinds.begin(), mesh.kinds.end(), [](CellKind kind) { return kind == CellKind::tetrahedron; });
}

// With both oracles only what a combinatorial map can carry; with the generalized map anything goes, folds and flips
// too.
std::vector<FuzzSeries> sessions_for(const Mesh& mesh, const Options& options) {
  const auto compact = is_all_tetrahedra(mesh) ? ScriptStorage::tetrahedral : ScriptStorage::general;
  if (options.self) return {{compact, ScriptOracles::none, options.seed, {}, 0.0}};
  std::vector<FuzzSeries> sessions{{compact, ScriptOracles::both, options.seed, {}, 0.0},
                                   {ScriptStorage::general, ScriptOracles::gmap, options.seed + 1, {}, 0.0}};
  if (compact == ScriptStorage::tetrahedral)
    sessions.push_back({compact, ScriptOracles::gmap, options.seed + 2, {}, 0.0});
  return sessions;
}

std::string write_script(const FuzzResult& result, const Target& target, std::uint64_t seed, const Options& options) {
  const std::string file = options.script_out.empty()
                               ? fmt::format("disagreement-{}-{}.txt",
                                             file_name_of(std::filesystem::path(target.name).stem().string()), seed)
                               : options.script_out;
  write_topology_script(file, result.script);
  return file;
}

TopologyVerdict judge(const Target& target, const Options& options, Progress& progress) {
  TopologyVerdict verdict;
  verdict.name = short_name(target);
  Mesh mesh;
  try {
    mesh = target.make();
    verdict.at_rest = compare_topology(mesh);
  } catch (const InputError& error) {  // the mesh, not the command line, is at fault
    throw IoError(fmt::format("{}: {}", target.name, error.what()));
  }
  verdict.darts = alphas_of(mesh).darts.size();
  progress.advance(verdict.name);
  if (options.count() == 0) return verdict;
  for (FuzzSeries& session : verdict.sessions = sessions_for(mesh, options)) {
    FuzzPlan plan;
    plan.mesh_name = target.name;
    plan.storage = session.storage;
    plan.oracles = session.oracles;
    plan.seed = session.seed;
    plan.operations = options.count();
    plan.everything_every = 2000 + verdict.darts;  // comparing everything takes longer for a larger body
    plan.progress = [&](std::size_t done) { progress.advance(fmt::format("{}: {} operations", verdict.name, done)); };
    const auto start = steady_wall_ns();
    session.result = fuzz_topology(mesh, plan);
    const double seconds = static_cast<double>(steady_wall_ns() - start) * 1e-9;
    const auto& r = session.result;
    session.operations_per_s = static_cast<double>(r.applied + r.illegal + r.not_carried) / seconds;
    if (!r.disagreement) continue;
    verdict.script_file = write_script(r, target, session.seed, options);
    break;
  }
  return verdict;
}

void replay(const Options& options, Outcome& outcome) {
  const TopologyScript script = read_topology_script(options.replay);
  FuzzResult result;
  try {
    result = replay_topology(find_target(script.mesh).make(), script);
  } catch (const InputError& error) {  // the script's mesh or storage, not the command line
    throw IoError(fmt::format("{}: {}", options.replay, error.what()));
  }
  outcome.exit_code = result.disagreement ? exit_disagrees : exit_agrees;
  if (options.json) {
    nlohmann::ordered_json json{{"script", options.replay},
                                {"agrees", !result.disagreement},
                                {"applied", result.applied},
                                {"illegal", result.illegal},
                                {"not_carried", result.not_carried}};
    if (result.disagreement) json["disagreement"] = to_json(*result.disagreement);
    tell("{}\n", json_text(json, 2));
  } else {
    tell("{}: {} operations, {} of them illegal and {} not carried by every map\n{}\n", options.replay,
         script.operations.size(), result.illegal, result.not_carried,
         result.disagreement ? to_string(*result.disagreement) : "All agree.");
  }
}

void validate(const Options& options, Outcome& outcome) {
  if (!options.replay.empty()) return replay(options, outcome);
  const auto targets = options.all ? all_targets() : std::vector{find_target(options.mesh)};
  const std::size_t at_most_sessions = options.self ? 1 : 3;
  Progress progress("validate topology", targets.size() * (1 + at_most_sessions * ((options.count() + 999) / 1000)),
                    options.json);
  std::vector<TopologyVerdict> verdicts;
  for (const Target& target : targets) verdicts.push_back(judge(target, options, progress));

  const bool agree = std::all_of(verdicts.begin(), verdicts.end(), [](const TopologyVerdict& v) { return v.agrees(); });
  outcome.exit_code = agree ? exit_agrees : exit_disagrees;
  if (options.json) {
    nlohmann::ordered_json json{{"agrees", agree}, {"seed", options.seed}, {"operations", options.count()}};
    for (const TopologyVerdict& v : verdicts) json["meshes"].push_back(to_json(v));
    tell("{}\n", json_text(json, 2));
    return;
  }
  if (!options.all) tell("{}\n", to_text(rest_table(verdicts[0].at_rest)));
  tell("{}\n", to_text(summary_table(verdicts)));
  for (const TopologyVerdict& v : verdicts) tell("{}", disagreements_text(v));
  tell("{}\n", agree ? "All agree." : "There are disagreements: see above.");
}

}  // namespace

void add_validate(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("validate", "Compare with independent implementations.");
  verb->require_subcommand(1);
  auto* topology = verb->add_subcommand("topology",
                                        "Our map against CGAL's generalized and combinatorial maps, at rest and "
                                        "through random operations.");
  auto* what = topology->add_option_group("WHAT");
  what->add_option("MESH", options->mesh, "a mesh file, or the name of a mesh of the project");
  what->add_flag("--all", options->all, "every mesh of the project");
  what->add_option("--replay", options->replay, "a script, as written at a disagreement");
  what->require_option(1);
  topology->add_option("--operations", options->operations, "random operations per series [10000; 1000 with --quick]");
  topology->add_option("--seed", options->seed, "of the random operations [1]");
  topology->add_option("--script-out", options->script_out,
                       "where to write the script of a disagreement "
                       "[disagreement-MESH-SEED.txt]");
  topology->add_flag("--self", options->self,
                     "without CGAL during the operations: our storages against each other, and checks");
  topology->add_flag("--quick", options->quick, "fewer operations");
  topology->add_flag("--json", options->json, "print JSON");
  topology->callback([options, &outcome] { validate(*options, outcome); });
  add_validate_conservation(*verb, outcome);
  add_validate_order(*verb, outcome);
  add_validate_solvers(*verb, outcome);
}

}  // namespace dartboard
