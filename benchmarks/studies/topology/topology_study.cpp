#include "benchmarks/studies/topology/topology_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "benchmarks/harness/clock.h"
#include "benchmarks/studies/topology/topology_verdict.h"
#include "core/base/escape.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

std::string short_name(const MeshSource& target) { return std::filesystem::path(target.name).filename().string(); }

bool is_all_tetrahedra(const Mesh& mesh) {
  return std::all_of(mesh.kinds.begin(), mesh.kinds.end(), [](CellKind kind) { return kind == CellKind::tetrahedron; });
}

// With both oracles only operations that a combinatorial map supports; with the generalized map all of them, folds and
// flips too.
std::vector<FuzzSeries> sessions_for(const Mesh& mesh, const TopologyStudyPlan& plan) {
  const auto compact = is_all_tetrahedra(mesh) ? ScriptStorage::tetrahedral : ScriptStorage::general;
  if (plan.self) return {{compact, ScriptOracles::none, plan.seed, {}, 0.0}};
  std::vector<FuzzSeries> sessions{{compact, ScriptOracles::both, plan.seed, {}, 0.0},
                                   {ScriptStorage::general, ScriptOracles::gmap, plan.seed + 1, {}, 0.0}};
  if (compact == ScriptStorage::tetrahedral) sessions.push_back({compact, ScriptOracles::gmap, plan.seed + 2, {}, 0.0});
  return sessions;
}

std::string write_script(const FuzzResult& result, const MeshSource& target, std::uint64_t seed,
                         const TopologyStudyPlan& plan) {
  const std::string file = plan.script_out.empty()
                               ? fmt::format("disagreement-{}-{}.txt",
                                             file_name_of(std::filesystem::path(target.name).stem().string()), seed)
                               : plan.script_out;
  write_topology_script(file, result.script);
  return file;
}

TopologyVerdict judge(const MeshSource& target, const TopologyStudyPlan& plan, StudyLog& log) {
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
  log.advance(verdict.name);
  if (plan.operations == 0) return verdict;
  for (FuzzSeries& session : verdict.sessions = sessions_for(mesh, plan)) {
    FuzzPlan fuzz;
    fuzz.mesh_name = target.name;
    fuzz.storage = session.storage;
    fuzz.oracles = session.oracles;
    fuzz.seed = session.seed;
    fuzz.operations = plan.operations;
    fuzz.everything_every = 2000 + verdict.darts;  // comparing everything takes longer for a larger body
    fuzz.progress = [&](std::size_t done) { log.advance(fmt::format("{}: {} operations", verdict.name, done)); };
    const auto start = steady_wall_ns();
    session.result = fuzz_topology(mesh, fuzz);
    const double seconds = static_cast<double>(steady_wall_ns() - start) * 1e-9;
    const auto& r = session.result;
    session.operations_per_s = static_cast<double>(r.applied + r.illegal + r.not_carried) / seconds;
    if (!r.disagreement) continue;
    verdict.script_file = write_script(r, target, session.seed, plan);
    break;
  }
  return verdict;
}

}  // namespace

Report topology_study(const TopologyStudyPlan& plan, StudyLog& log) {
  const std::size_t at_most_sessions = plan.self ? 1 : 3;
  log.begin("validate topology", plan.meshes.size() * (1 + at_most_sessions * ((plan.operations + 999) / 1000)));
  std::vector<TopologyVerdict> verdicts;
  for (const MeshSource& mesh : plan.meshes) verdicts.push_back(judge(mesh, plan, log));

  const bool agree = std::ranges::all_of(verdicts, &TopologyVerdict::agrees);
  Report report;
  report.numbers = {{"agrees", agree}, {"seed", plan.seed}, {"operations", plan.operations}};
  for (const TopologyVerdict& v : verdicts) report.numbers["meshes"].push_back(to_json(v));
  report.data_files = {{"topology.json", report.numbers}};
  if (verdicts.size() == 1) report.tables.push_back({"", "", rest_table(verdicts[0].at_rest)});
  report.tables.push_back({"", "", summary_table(verdicts)});
  std::string differences;
  for (const TopologyVerdict& v : verdicts) differences += disagreements_text(v);
  if (agree)
    report.sentence = "All agree.";
  else
    report.disagreements = {differences + "There are disagreements: see above."};
  return report;
}

Report topology_replay(const std::string& script_file, const std::function<MeshSource(const std::string&)>& find_mesh) {
  const TopologyScript script = read_topology_script(script_file);
  FuzzResult result;
  try {
    result = replay_topology(find_mesh(script.mesh).make(), script);
  } catch (const InputError& error) {  // the script's mesh or storage, not the command line
    throw IoError(fmt::format("{}: {}", script_file, error.what()));
  }
  Report report;
  report.numbers = {{"script", script_file},
                    {"agrees", !result.disagreement},
                    {"applied", result.applied},
                    {"illegal", result.illegal},
                    {"not_carried", result.not_carried}};
  report.opening = fmt::format("{}: {} operations, {} of them illegal and {} not carried by every map", script_file,
                               script.operations.size(), result.illegal, result.not_carried);
  if (result.disagreement) {
    report.numbers["disagreement"] = to_json(*result.disagreement);
    report.disagreements.push_back(to_string(*result.disagreement));
  } else {
    report.sentence = "All agree.";
  }
  return report;
}

}  // namespace dartboard
