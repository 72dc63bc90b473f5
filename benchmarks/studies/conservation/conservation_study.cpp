#include "benchmarks/studies/conservation/conservation_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <utility>

#include "benchmarks/harness/clock.h"
#include "benchmarks/studies/conservation/conservation_report.h"
#include "core/base/escape.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "validation/conservation/refinement_conservation.h"

namespace dartboard {
namespace {

/// One body to be taken apart on one storage.
struct Session {
  Problem problem;
  std::function<ConservationResult(const Problem&, const ConservationPlan&)> validate;
  TakenApart body;
};

enum class Mode { take_apart, refine };

template <class Map, Mode mode = Mode::take_apart>
Session session(std::string name, std::string storage, Mesh mesh, const Material& material, std::uint64_t seed) {
  const auto validate = [](const Problem& problem, const ConservationPlan& plan) {
    if constexpr (mode == Mode::refine)
      return validate_refinement<Map>(problem, plan);
    else
      return validate_conservation<Map>(problem, plan);
  };
  if (mode == Mode::refine) name += ", refined";
  Problem problem = moving_problem(std::move(mesh), material, seed);
  TakenApart body{std::move(name), std::move(storage), problem.mesh.cell_count(), seed, problem.h, {}, 0.0};
  return {std::move(problem), validate, std::move(body)};
}

// The liver's material of benchmarks/paper/paper_bodies.cpp. None of its damping, nor the volumes of a mesh, is a power
// of two.
constexpr Material soft{.density = 1000.0, .stiffness = 5.0, .damping = 0.005, .viscosity = 0.5};

// A box where masses and stiffnesses are powers of two: the volume of its tetrahedra is (2^-3)^3 / 6, rounded; 768 is
// 6 * 2^7, and 6 fl(1/6) rounds to 1, so their mass is 2^-2 kg. Its sums are exact, and the drift must be zero.
constexpr Material powers_of_two{.density = 768.0, .stiffness = 4.0, .damping = 0.25, .viscosity = 0.5};

std::vector<Session> sessions_for(const ConservationStudyPlan& plan) {
  std::vector<Session> sessions;
  try {
    const Mesh& mesh = plan.mesh;
    const std::string name = std::filesystem::path(plan.mesh_name).filename().string();
    if (mesh.dimension() == 2) {
      sessions.push_back(session<Map2>(name, "general", mesh, soft, plan.seed));
      return sessions;
    }
    if (std::all_of(mesh.kinds.begin(), mesh.kinds.end(),
                    [](CellKind kind) { return kind == CellKind::tetrahedron; })) {
      sessions.push_back(session<TetMap>(name, "tetrahedral", mesh, soft, plan.seed));
      sessions.push_back(session<TetMap, Mode::refine>(name, "tetrahedral", mesh, soft, plan.seed + 3));
    }
    sessions.push_back(session<Map3>(name, "general", mesh, soft, plan.seed + 1));
  } catch (const InputError& error) {  // the mesh, not the command line, is at fault
    throw IoError(fmt::format("{}: {}", plan.mesh_name, error.what()));
  }
  sessions.push_back(
      session<TetMap>("box of powers of two", "tetrahedral", kuhn_box(5, 5, 5, 0.125), powers_of_two, plan.seed + 2));
  sessions.push_back(
      session<Map3, Mode::refine>("box", "general", kuhn_box(3, 3, 3, 0.125, 0.2, 1), soft, plan.seed + 4));
  sessions.push_back(
      session<Map2>("sheet of triangles", "general", triangle_sheet(16, 16, 0.125), soft, plan.seed + 5));
  return sessions;
}

void run(Session& session, std::size_t operations, StudyLog& log) {
  ConservationPlan plan;
  plan.seed = session.body.seed;
  plan.operations = operations;
  // comparing everything takes longer for a larger body, and more so building another
  plan.everything_every = std::max<std::size_t>(20, session.problem.mesh.cell_count() / 20);
  plan.oracle_every = std::max<std::size_t>(operations / 20, 4 * plan.everything_every);
  plan.progress = [&](std::size_t done) { log.advance(fmt::format("{}: {} operations", session.body.name, done)); };
  const auto start = steady_wall_ns();
  try {
    session.body.result = session.validate(session.problem, plan);
  } catch (const InputError& error) {
    throw IoError(fmt::format("{}: {}", session.body.name, error.what()));
  }
  const double seconds = static_cast<double>(steady_wall_ns() - start) * 1e-9;
  session.body.operations_per_s = static_cast<double>(session.body.result.operations()) / seconds;
}

}  // namespace

Report conservation_study(const ConservationStudyPlan& plan, StudyLog& log) {
  std::vector<Session> sessions = sessions_for(plan);
  log.begin("validate conservation", sessions.size() * (plan.operations / 1000));
  const std::string repeat = fmt::format("dartboard validate conservation {} --operations {} --seed {}",
                                         shell_word(plan.mesh_name), plan.operations, plan.seed);
  Report report;
  bool hold = true;
  report.numbers = {{"holds", true}, {"seed", plan.seed}, {"operations", plan.operations}};
  for (Session& session : sessions) {
    run(session, plan.operations, log);
    report.opening += to_text(session.body, repeat);
    report.numbers["sessions"].push_back(to_json(session.body));
    hold = session.body.holds();
    if (!hold) break;
  }
  report.numbers["holds"] = hold;
  report.data_files = {{"conservation.json", report.numbers}};
  if (hold)
    report.sentence = "All is conserved.";
  else
    report.disagreements.emplace_back("Something is not conserved: see above.");
  return report;
}

}  // namespace dartboard
