#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "benchmarks/clock.h"
#include "benchmarks/json_text.h"
#include "benchmarks/progress.h"
#include "benchmarks/table.h"
#include "benchmarks/tell.h"
#include "benchmarks/verb_validate.h"
#include "core/meshes/mesh_generators.h"
#include "core/meshes/mesh_io.h"
#include "core/plain/error.h"
#include "validation/conservation.h"
#include "validation/refinement_conservation.h"

namespace dartboard {
namespace {

struct Options {
  std::string mesh = (std::filesystem::path(DARTBOARD_SOURCE_DIR) / "benchmarks/meshes/liver564.mesh").string();
  bool json = false, quick = false;
  std::optional<std::size_t> operations;
  std::uint64_t seed = 1;
  std::size_t count() const { return operations.value_or(quick ? 1000 : 10000); }
};

/// One body taken apart on one storage.
struct Session {
  std::string name, storage;
  Problem problem;
  std::uint64_t seed;
  std::function<ConservationResult(const Problem&, const ConservationPlan&)> validate;
  ConservationResult result;
  double operations_per_s = 0.0;

  bool holds() const {
    return !result.violation && std::all_of(result.rows.begin(), result.rows.end(), [](auto& r) { return r.holds; });
  }
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
  return {
      std::move(name), std::move(storage), moving_problem(std::move(mesh), material, seed), seed, validate, {}, 0.0};
}

Mesh find_mesh(const std::string& name) {
  for (const NamedMesh& mesh : test_meshes())
    if (mesh.name == name) return mesh.make();
  LoadedMesh loaded = read_mesh(name);
  for (const std::string& notice : loaded.notices) tell(stderr, "notice: {}: {}\n", name, notice);
  return std::move(loaded.mesh);
}

// The liver's material of benchmarks/scenes.cpp. None of its damping, nor the volumes of a mesh, is a power of two.
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
  plan.seed = session.seed;
  plan.operations = options.count();
  // comparing everything takes longer for a larger body, and more so building another
  plan.everything_every = std::max<std::size_t>(20, session.problem.mesh.cell_count() / 20);
  plan.oracle_every = std::max<std::size_t>(options.count() / 20, 4 * plan.everything_every);
  plan.progress = [&](std::size_t done) { progress.advance(fmt::format("{}: {} operations", session.name, done)); };
  const auto start = steady_wall_ns();
  try {
    session.result = session.validate(session.problem, plan);
  } catch (const InputError& error) {
    throw IoError(fmt::format("{}: {}", session.name, error.what()));
  }
  const double seconds = static_cast<double>(steady_wall_ns() - start) * 1e-9;
  session.operations_per_s = static_cast<double>(session.result.operations()) / seconds;
}

std::string bound_text(const ConservedRow& row) {
  return !row.bound || *row.bound == 0.0 ? "exact" : fmt::format("{:.2e}", *row.bound);
}

std::string deviation_text(double deviation) { return deviation == 0.0 ? "0" : fmt::format("{:.2e}", deviation); }

Table table_of(const ConservationResult& result) {
  Table table({{"quantity", Align::left},
               {"checks", Align::right},
               {"largest deviation", Align::right},
               {"bound", Align::right},
               {"holds", Align::left}});
  for (const ConservedRow& row : result.rows)
    table.add_row({row.what, fmt::format("{}", row.checks), row.holds || row.bound ? deviation_text(row.largest) : "-",
                   bound_text(row), row.holds ? (row.checks > 0 ? "yes" : "not met") : "NO"});
  return table;
}

void print(const Session& s, const Options& options) {
  const ConservationResult& r = s.result;
  tell("{}, {} storage, {} cells, seed {}, h = {:.3g} s\n", s.name, s.storage, s.problem.mesh.cell_count(), s.seed,
       s.problem.h);
  tell(
      "{} operations ({} dissociations, {} torn fans, {} removals, {} refinements) in {} series, {} steps between; "
      "{} parts split off; the body was emptied and refilled {} times\n",
      r.operations(), r.dissociations, r.tears, r.removals, r.refinements, r.series, r.steps, r.parts_split_off,
      r.refills);
  tell("{:.0f} operations per second, checks and steps included; {} bodies built from scratch{}\n\n",
       s.operations_per_s, r.bodies_from_scratch,
       r.bodies_without_bound == 0
           ? ""
           : fmt::format(", for {} of which the bound of motion says nothing", r.bodies_without_bound));
  tell("{}\n", to_text(table_of(r)));
  if (r.violation)
    tell("{}, {} storage: {}\nRepeat it with: dartboard validate conservation {} --operations {} --seed {}\n\n", s.name,
         s.storage, to_string(*r.violation), shell_word(options.mesh), options.count(), options.seed);
}

nlohmann::ordered_json to_json(const Session& s) {
  const ConservationResult& r = s.result;
  nlohmann::ordered_json json{{"mesh", s.name},
                              {"storage", s.storage},
                              {"cells", s.problem.mesh.cell_count()},
                              {"seed", s.seed},
                              {"h", s.problem.h},
                              {"holds", s.holds()},
                              {"operations", r.operations()},
                              {"dissociations", r.dissociations},
                              {"tears", r.tears},
                              {"removals", r.removals},
                              {"refinements", r.refinements},
                              {"parts_split_off", r.parts_split_off},
                              {"series", r.series},
                              {"steps", r.steps},
                              {"refills", r.refills},
                              {"bodies_from_scratch", r.bodies_from_scratch},
                              {"bodies_without_bound", r.bodies_without_bound},
                              {"operations_per_s", s.operations_per_s}};
  for (const ConservedRow& row : r.rows) {
    nlohmann::ordered_json quantity{
        {"what", row.what}, {"checks", row.checks}, {"largest_deviation", row.largest}, {"holds", row.holds}};
    quantity["exact"] = !row.bound || *row.bound == 0.0;
    if (row.bound) {  // of the check that came closest to its bound
      quantity["deviation"] = row.deviation;
      quantity["bound"] = *row.bound;
    }
    json["quantities"].push_back(quantity);
  }
  if (const auto& v = r.violation)
    json["violation"] = {{"what", v->what},     {"operation", v->operation}, {"seed", v->seed},
                         {"actual", v->actual}, {"expected", v->expected},   {"bound", v->bound}};
  return json;
}

void validate(const Options& options, Outcome& outcome) {
  std::vector<Session> sessions = sessions_for(options);
  Progress progress("validate conservation", sessions.size() * (options.count() / 1000), options.json);
  std::size_t ran = 0;
  bool hold = true;
  for (Session& session : sessions) {
    run(session, options, progress);
    ++ran;
    hold = hold && session.holds();
    if (!hold) break;
  }
  sessions.resize(ran);

  outcome.exit_code = hold ? exit_agrees : exit_disagrees;
  if (options.json) {
    nlohmann::ordered_json json{{"holds", hold}, {"seed", options.seed}, {"operations", options.count()}};
    for (const Session& session : sessions) json["sessions"].push_back(to_json(session));
    tell("{}\n", json_text(json, 2));
    return;
  }
  for (const Session& session : sessions) print(session, options);
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
