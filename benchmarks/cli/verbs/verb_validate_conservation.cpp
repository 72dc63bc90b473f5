#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/progress.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/conservation/conservation_report.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/meshes/mesh_io.h"
#include "core/plain/error.h"
#include "validation/conservation/conservation.h"
#include "validation/conservation/refinement_conservation.h"

namespace dartboard {
namespace {

struct Options {
  std::string mesh = (std::filesystem::path(DARTBOARD_SOURCE_DIR) / "benchmarks/meshes/liver564.mesh").string();
  bool json = false, quick = false;
  std::optional<std::size_t> operations;
  std::uint64_t seed = 1;
  std::size_t count() const { return operations.value_or(quick ? 1000 : 10000); }
};

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

Mesh find_mesh(const std::string& name) {
  for (const NamedMesh& mesh : test_meshes())
    if (mesh.name == name) return mesh.make();
  LoadedMesh loaded = read_mesh(name);
  for (const std::string& notice : loaded.notices) tell(stderr, "notice: {}: {}\n", name, notice);
  return std::move(loaded.mesh);
}

// The liver's material of benchmarks/paper/scenes.cpp. None of its damping, nor the volumes of a mesh, is a power of
// two.
constexpr Material soft{.density = 1000.0, .stiffness = 5.0, .damping = 0.005, .viscosity = 0.5};

// A box where masses and stiffnesses are powers of two: the volume of its tetrahedra is (2^-3)^3 / 6, rounded; 768 is
// 6 * 2^7, and 6 fl(1/6) rounds to 1, so their mass is 2^-2 kg. Its sums are exact, and the drift must be zero.
constexpr Material powers_of_two{.density = 768.0, .stiffness = 4.0, .damping = 0.25, .viscosity = 0.5};

std::vector<Session> sessions_for(const Options& options) {
  std::vector<Session> sessions;
  try {
    const Mesh mesh = find_mesh(options.mesh);
    const std::string name = std::filesystem::path(options.mesh).filename().string();
    if (mesh.dimension() == 2) {
      sessions.push_back(session<Map2>(name, "general", mesh, soft, options.seed));
      return sessions;
    }
    if (std::all_of(mesh.kinds.begin(), mesh.kinds.end(),
                    [](CellKind kind) { return kind == CellKind::tetrahedron; })) {
      sessions.push_back(session<TetMap>(name, "tetrahedral", mesh, soft, options.seed));
      sessions.push_back(session<TetMap, Mode::refine>(name, "tetrahedral", mesh, soft, options.seed + 3));
    }
    sessions.push_back(session<Map3>(name, "general", mesh, soft, options.seed + 1));
  } catch (const InputError& error) {  // the mesh, not the command line, is at fault
    throw IoError(fmt::format("{}: {}", options.mesh, error.what()));
  }
  sessions.push_back(session<TetMap>("box of powers of two", "tetrahedral", kuhn_box(5, 5, 5, 0.125), powers_of_two,
                                     options.seed + 2));
  sessions.push_back(
      session<Map3, Mode::refine>("box", "general", kuhn_box(3, 3, 3, 0.125, 0.2, 1), soft, options.seed + 4));
  sessions.push_back(
      session<Map2>("sheet of triangles", "general", triangle_sheet(16, 16, 0.125), soft, options.seed + 5));
  return sessions;
}

void run(Session& session, const Options& options, Progress& progress) {
  ConservationPlan plan;
  plan.seed = session.body.seed;
  plan.operations = options.count();
  // comparing everything takes longer for a larger body, and more so building another
  plan.everything_every = std::max<std::size_t>(20, session.problem.mesh.cell_count() / 20);
  plan.oracle_every = std::max<std::size_t>(options.count() / 20, 4 * plan.everything_every);
  plan.progress = [&](std::size_t done) {
    progress.advance(fmt::format("{}: {} operations", session.body.name, done));
  };
  const auto start = steady_wall_ns();
  try {
    session.body.result = session.validate(session.problem, plan);
  } catch (const InputError& error) {
    throw IoError(fmt::format("{}: {}", session.body.name, error.what()));
  }
  const double seconds = static_cast<double>(steady_wall_ns() - start) * 1e-9;
  session.body.operations_per_s = static_cast<double>(session.body.result.operations()) / seconds;
}

void validate(const Options& options, Outcome& outcome) {
  std::vector<Session> sessions = sessions_for(options);
  Progress progress("validate conservation", sessions.size() * (options.count() / 1000), options.json);
  std::size_t ran = 0;
  bool hold = true;
  for (Session& session : sessions) {
    run(session, options, progress);
    ++ran;
    hold = hold && session.body.holds();
    if (!hold) break;
  }
  sessions.resize(ran);

  outcome.exit_code = hold ? exit_agrees : exit_disagrees;
  if (options.json) {
    nlohmann::ordered_json json{{"holds", hold}, {"seed", options.seed}, {"operations", options.count()}};
    for (const Session& session : sessions) json["sessions"].push_back(to_json(session.body));
    tell("{}\n", json_text(json, 2));
    return;
  }
  const std::string repeat = fmt::format("dartboard validate conservation {} --operations {} --seed {}",
                                         shell_word(options.mesh), options.count(), options.seed);
  for (const Session& session : sessions) tell("{}", to_text(session.body, repeat));
  tell("{}\n", hold ? "All is conserved." : "Something is not conserved: see above.");
}

}  // namespace

void add_validate_conservation(CLI::App& validate_verb, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  auto* verb = validate_verb.add_subcommand(
      "conservation", "Masses, stiffnesses, momenta and energies through random operations on a moving body.");
  verb->add_option("MESH", options->mesh, "a mesh file, or the name of a mesh of the project [liver564.mesh]");
  verb->add_option("--operations", options->operations, "random operations per body [10000; 1000 with --quick]");
  verb->add_option("--seed", options->seed, "of the random operations [1]");
  verb->add_flag("--quick", options->quick, "fewer operations");
  verb->add_flag("--json", options->json, "print JSON");
  verb->callback([options, &outcome] { validate(*options, outcome); });
}

}  // namespace dartboard
