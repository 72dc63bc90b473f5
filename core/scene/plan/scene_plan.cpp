#include "core/scene/plan/scene_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/counted.h"
#include "core/mechanics/curve_order.h"
#include "core/plain/material.h"
#include "core/scene/body/diagnostics.h"
#include "core/scene/file/force_kind.h"
#include "core/scene/file/keys/scene_keys.h"
#include "core/scene/file/scene_materials.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/run/simulation.h"
#include "core/scene/survey/mesh_direction.h"
#include "core/scene/survey/scene_survey.h"
#include "core/scene/timeline/driven_vertices.h"
#include "core/time/integrators.h"
#include "core/time/watch/divergence.h"
#include "core/time/watch/stable_step.h"

namespace dartboard {
namespace {

/// Is this the default value of the key?
bool is_default(Shape shape, std::string_view key, const nlohmann::json& value) {
  for (const SceneKey& k : scene_keys())
    if (k.shape == shape && k.name == key) return !k.standard.empty() && nlohmann::json::parse(k.standard) == value;
  return false;
}

std::string setting_in_words(std::string_view path, Shape shape, std::string_view key, const nlohmann::json& value) {
  return fmt::format("{}: {}{}", path, value.is_string() ? value.get<std::string>() : value.dump(),
                     is_default(shape, key, value) ? " (the default)" : "");
}

std::string source_of(const SceneFile& scene) {
  if (const auto* file = std::get_if<std::filesystem::path>(&scene.body.mesh))
    return fmt::format("/body/mesh: {}", file->filename().string());
  if (const auto* list = std::get_if<BodyList>(&scene.body.mesh)) return fmt::format("/bodies: {}", list->all.size());
  constexpr const char* keys[] = {"box", "sheet", "ball", "chain"};  // after the file, in the order of the variant
  return fmt::format("/body/generate/{}", keys[scene.body.mesh.index() - 1]);
}

std::string output_reason(std::string_view key, const std::optional<std::uint64_t>& steps) {
  if (steps)
    return fmt::format("/output/{}: every {}, the first and the last state", key,
                       *steps == 1 ? "step" : counted(*steps, "step"));
  return fmt::format("/output: without '{}', the first and the last state", key);
}

/// "1 vertex", "2 vertices".

class Planner {
 public:
  Planner(const SceneFile& scene, const Problem& problem, const Simulation& simulation)
      : scene_(scene), problem_(problem), simulation_(simulation), body_(simulation.body()) {
    plan_.needs = needs_of(scene, problem);
    plan_.counts = body_.counts();
    for (const CellKind kind : problem.mesh.kinds)
      for (const std::vector<int>& face : faces_of(kind)) plan_.darts += 2 * face.size();
    plan_.map = plan_.needs.body.topology_changes ? body_.map_name() : "no map";
    plan_.steps = simulation.step_count();
    SceneSurvey survey = survey_scene(scene, problem, simulation);
    plan_.selections = std::move(survey.selections);
    plan_.events = forecast_events(scene, plan_.selections, plan_.counts.cells);
    for (const SelectionCount& count : plan_.selections)
      if (count.just_outside > 0) plan_.remarks.push_back(near_miss(count));
    for (const StiffBody& body : survey.stiff_bodies) plan_.remarks.push_back(to_string(body));
    for (const Sag& sag : survey.sags) plan_.remarks.push_back(to_string(sag));
    for (std::string& note : survey.notes) plan_.remarks.push_back(std::move(note));
    if (const std::string direction = direction_in_words(scene, problem.mesh); !direction.empty())
      plan_.remarks.push_back(direction);
  }

  ScenePlan plan() {
    if (plan_.needs.body.topology_changes)
      map();
    else if (scene_.is_chain())
      leave_out("map, darts and cells", source_of(scene_) + ": links alone");
    else
      leave_out("map, marks, embeddings and every dart once the body is built",
                "/events: no event changes the topology");
    columns();
    driven();
    forces();
    contact();
    integrator();
    watch();
    for (std::size_t k = 0; k < scene_.events.size(); ++k) event(k);
    output();
    return std::move(plan_);
  }

 private:
  void add(Part part, std::string what, std::string why) {
    plan_.items.push_back({.part = part, .what = std::move(what), .why = std::move(why)});
  }
  void leave_out(std::string what, std::string why) { plan_.left_out.push_back({std::move(what), std::move(why)}); }

  void map() {
    const CellCounts& n = plan_.counts;
    const Storage storage = plan_.needs.body.storage;
    const bool tetrahedra = storage == Storage::tetrahedra;
    const auto first = std::ranges::find_if(scene_.events, changes_topology, &SceneEvent::action);
    const std::string changed = fmt::format("{}/{}: changes the topology", first->path, key_of(first->action));
    const std::string kind = tetrahedra                    ? "tetrahedra alone"
                             : storage == Storage::surface ? "a surface"
                             : storage == Storage::several ? "bodies of several dimensions"
                                                           : "cells other than tetrahedra";
    add(Part::map, fmt::format("{}, {} darts", map_name(storage), plan_.darts),
        fmt::format("{}; {}: {}", changed, source_of(scene_), kind));
    add(Part::marks, "marks by dart, for walks", changed);
    add(Part::embeddings, "the number of its cells at every dart, or its place in a tetrahedron", changed);
    add(Part::cell_darts, "a dart of each vertex, edge, face and cell", changed);
    const CellMaterials materials = problem_.cell_materials();
    const bool springs_of_young = std::ranges::any_of(
        materials.all(), [](const Material& m) { return m.model == Model::springs && m.young > 0.0; });
    add(Part::cells,
        fmt::format("mass, share of a node, side{}{} and mesh number of each cell{}",
                    materials.is_one() ? "" : ", material", materials.has_elements() ? "" : ", corners",
                    springs_of_young ? ", stiffness shares of its edges" : ""),
        changed + (springs_of_young || !materials.is_one() ? "; " + elasticity() : ""));
    add(Part::components, fmt::format("the component of each cell, {} at the start", n.components),
        changed + "; /output: frames and diagnostics report the components");
    if (tetrahedra) leave_out("alphas of each dart (16 bytes)", source_of(scene_) + ": tetrahedra alone");
    if (storage == Storage::surface) leave_out("a third dimension of the map", source_of(scene_) + ": a surface");
    if (!plan_.needs.refinement && !springs_of_young)
      leave_out("stiffness shares by edge and cell, which only refinement needs", "/events: no event refines");
  }

  void columns() {
    const CellCounts& n = plan_.counts;
    const std::vector<std::uint32_t> order = order_along_curve(problem_.mesh);
    add(Part::vertices,
        fmt::format("mass, 1/mass, position, velocity and mesh point by vertex{}",
                    order.empty() ? "" : ", cells and vertices stored along a space-filling curve"),
        order.empty() ? source_of(scene_)
                      : fmt::format("{}: its order is worse, {} cells in place of {} span more than 4096 vertices",
                                    source_of(scene_), count_wide_cells(problem_.mesh, order_of_mesh(problem_.mesh)),
                                    count_wide_cells(problem_.mesh, order)));
    const bool on_map = plan_.needs.body.topology_changes;
    const std::string viscosity =
        setting_in_words("/material/viscosity", Shape::material, "viscosity", problem_.material.viscosity);
    if (plan_.needs.body.viscosity)
      add(Part::viscosity, "drag by vertex, and its term in the force loop", viscosity);
    else if (on_map)
      add(Part::viscosity, "drag by vertex, zero", "changes of the map follow it; " + viscosity);
    if (!plan_.needs.body.viscosity)
      leave_out(on_map ? "term of viscosity" : "column and term of viscosity", viscosity);
    const std::size_t along_axes = problem_.held_axes.size();
    if (plan_.needs.body.fixed || along_axes > 0)
      add(Part::fixed,
          fmt::format("{} of {} vertices are held still or driven", problem_.fixed.size(), n.vertices) +
              (along_axes > 0 ? fmt::format(", {} along some axes", along_axes) : ""),
          fmt::format("/fixed: {}; /driven: {}", counted(scene_.fixed.size(), "selection"), scene_.driven.size()));
    else
      leave_out("column and term of fixed vertices",
                scene_.fixed.empty() ? "/fixed: not given" : "/fixed: its selections are empty");
    if (plan_.needs.body.rest)
      add(Part::rest, "place at rest by vertex",
          scene_.output.fields.displacement ? "/output/fields: frames show 'displacement'"
          : scene_.has_contact()            ? "/contact: areas of the surface follow changes of the map by it"
                                            : fmt::format("{}: follows changes of the map by it", force_at_rest()));
    else
      leave_out("column of places at rest", "/output/fields: without 'displacement'");
  }

  void driven() {
    if (scene_.driven.empty()) {
      leave_out("velocities given in every step, and their work", "/driven: not given");
      return;
    }
    // driven vertices are looked up as in the run, by the points of the mesh
    DrivenVertices vertices(scene_, problem_.mesh.points);
    std::vector<Eigen::Vector3d> x = body_.vertices().position, v = body_.vertices().velocity;
    vertices.apply(0.0, scene_.step, body_.vertices().point, v);
    DivergenceDetector detector;
    detector.start(body_.system(), {x, v}, scene_.step);
    add(Part::driven,
        fmt::format("paths of {}, and {} whose work is summed", counted(vertices.size(), "vertex", "vertices"),
                    counted(detector.driven_springs(), "spring")),
        fmt::format("/driven: {}", counted(scene_.driven.size(), "selection")));
  }

  void forces() {
    const CellCounts& n = plan_.counts;
    const CellMaterials materials = problem_.cell_materials();
    const bool elements = materials.has_elements();
    const bool surface = plan_.needs.body.storage == Storage::surface;
    if (elements)
      add(Part::elements,
          fmt::format("{} {}: rest shape, corners", n.cells,
                      surface                                        ? "membranes"
                      : plan_.needs.body.storage == Storage::several ? "cells of bodies with elements"
                                                                     : "solid cells"),
          source_of(scene_) + "; " + elasticity());
    if (elements && surface && !scene_.bending.any())
      leave_out("stiffness against bending, which membranes do not have", "/bending: not given");
    if (elements && !materials.has_springs()) {
      leave_out("springs and their damping", elasticity());
      if (plan_.needs.body.topology_changes)
        add(Part::springs,
            fmt::format("{} edges: rest length and ends, of which refinement makes new ones; no force", n.edges),
            "changes of the map follow them");
    } else {
      add(Part::springs, fmt::format("{} springs: rest length, stiffness, two ends", n.edges),
          source_of(scene_) + "; " + elasticity());
    }
    springs_within_cells();
    for (const ForceNeed& need : plan_.needs.body.forces) {
      add(Part::force, need.what, need.why);
      plan_.items.back().which = need.kind;
    }
    const std::string damping =
        materials.is_one() ? setting_in_words("/material/damping", Shape::material, "damping", materials[0].damping)
                           : materials_in_words();
    if (plan_.needs.damping)
      add(Part::damping, "by spring, and its term of the force loop or sweep over the springs", damping);
    else if (materials.has_springs())
      leave_out("damping of springs, its term or sweep", damping);
    if (plan_.needs.cell_damping)
      add(Part::cell_damping, "by the rate of strain, its term of the force loop or sweep over the elements",
          damped_elements());
    else if (elements)
      leave_out("damping of elements, its term or sweep", damped_elements());
    const Eigen::Vector3d& g = scene_.gravity;
    const std::string gravity =
        setting_in_words("/gravity", Shape::scene, "gravity", nlohmann::json::array({g[0], g[1], g[2]}));
    if (scene_.forces.empty())
      leave_out("column and term of forces from outside", "/forces: not given");
    else
      add(Part::pull,
          plan_.needs.body.pull ? "by vertex, its share of the external forces; added together with gravity"
                                : "the times of external forces",
          fmt::format("/forces: {}{}", scene_.forces.size(),
                      std::ranges::all_of(scene_.forces, [](const SceneForce& f) { return f.factor.empty(); })
                          ? ""
                          : "; over_time: set anew in every step, and their work is summed"));
    if (plan_.needs.gravity)
      add(Part::gravity, "added where forces are divided by masses", gravity);
    else
      leave_out("gravity (its addition of zero stays)", gravity);
  }

  void springs_within_cells() {
    const CellCounts& n = plan_.counts;
    const CellMaterials materials = problem_.cell_materials();
    if (scene_.diagonals != Diagonals::none) {
      std::size_t springs = 0;
      for (std::size_t c = 0; c < problem_.mesh.cell_count(); ++c)
        if (materials[c].model == Model::springs)
          springs += diagonals_of(problem_.mesh.kinds[c], scene_.diagonals).size();
      add(Part::cell_springs, fmt::format("{} springs within {} cells: rest lengths, corners", springs, n.cells),
          setting_in_words("/diagonals", Shape::scene, "diagonals", std::string(name(scene_.diagonals))));
    }
  }
  /// The key of a force that needs places at rest.
  std::string force_at_rest() const {
    const auto found = std::ranges::find_if(plan_.needs.body.forces, &ForceNeed::rest);
    return fmt::format("/{}", force_kinds()[found->kind].name);
  }

  void contact() {
    if (!scene_.has_contact()) {
      leave_out("contact of bodies with obstacles and with each other", "/contact: not given");
      return;
    }
    const Contacts contacts = body_.contacts();
    const std::size_t places = contacts.samples(contacts.obstacles == nullptr).size();
    ContactPlan plan{.expected = simulation_.expected_contacts()};
    std::string against, why;
    if (contacts.obstacles != nullptr) {
      against = counted(scene_.obstacles.size(), "obstacle");
      why = fmt::format("/contact/obstacles: {}", scene_.obstacles.size());
    }
    if (contacts.bodies != nullptr) {
      against += fmt::format("{}{} tetrahedra along the surface", against.empty() ? "" : " and ",
                             contacts.bodies->solids().tetrahedra().size());
      for (const TouchForecast& touch : plan.expected.bodies) why += (why.empty() ? "" : "; ") + touch.path;
    }
    add(Part::contact,
        fmt::format("{} places of the surface, each held against {}{}", places, against,
                    contacts.has_friction()  ? "; restitution and friction around each step"
                    : contacts.has_damping() ? "; restitution around each step"
                                             : ""),
        why);
    if (contacts.bodies == nullptr)
      leave_out("contact of bodies with each other and themselves", "/contact/bodies: none");
    // the body without contacts, which may exist at the start
    SpringSystem alone = body_.system();
    alone.terms = body_.terms_but_contact(alone.terms);
    const StableStep limits = StableStepEstimate().refresh(alone, body_.vertices().position);
    const Scheme& scheme = scheme_of(scene_.integrator);
    const Horizon horizon = horizon_of(scene_.duration);
    plan.body_rate = limits.upper;
    plan.contact_rate = contact_rate(alone, contacts, plan.expected.share());
    plan.body_step = limits.safe_step(scheme, horizon);
    plan.stable_step = with_contact(limits, plan.contact_rate).safe_step(scheme, horizon);
    plan_.contact = plan;
  }

  void integrator() {
    const bool standard = !scene_.accuracy && scene_.integrator == standard_integrator;
    const std::string why = fmt::format("{}: {}{}", scene_.accuracy ? "/accuracy" : "/integrator", scene_.integrator,
                                        standard ? " (the default)" : "");
    const char* factor = scene_.solver == "conjugate-gradients" ? "" : ", factor";
    add(Part::integrator, "stages and trial state by vertex", why);
    if (plan_.needs.solver)
      add(Part::solver, fmt::format("matrix by spring and by entry, pattern{}", factor), why + " is implicit");
    else
      leave_out("Jacobian, pattern and factor", why + " is explicit");
  }

  void watch() {
    constexpr const char* choices[] = {"warn", "refuse", "substep"};
    const std::string unstable = setting_in_words("/unstable_step", Shape::scene, "unstable_step",
                                                  choices[static_cast<std::size_t>(scene_.unstable_step)]);
    add(Part::detector, "the last good state, to go back to", "always: no run goes on without sense");
    add(Part::speed_check, "no vertex is faster than light, in every sixteenth step",
        "always: no run goes on without sense");
    add(Part::step_check, "the longest stable step, at the start and after operations", unstable);
    if (scene_.sleep) add(Part::sleeping, "components at rest, which are not stepped", "/sleep");
  }

  void event(std::size_t k) {
    const SceneEvent& e = scene_.events[k];
    const EventForecast& f = plan_.events[k];
    const std::string operations = fmt::format("{:.0f}", f.operations);
    std::string what = fmt::format("{}, {}", key_of(e.action), counted(f.times, "time"));
    what += std::holds_alternative<TearWhereStressed>(e.action)
                ? ": the stress of every vertex"
                : fmt::format(", some {} operation{}", operations, operations == "1" ? "" : "s");
    add(Part::event, std::move(what), e.action_path());
    plan_.items.back().which = k;
  }

  void output() {
    const bool on_map = plan_.needs.body.topology_changes;
    if (scene_.is_chain() || (on_map && !problem_.mesh.links.empty()))
      add(Part::output_cells, "masses of links", "/output: diagnostics report mass");
    else if (!on_map)
      add(Part::output_cells,
          fmt::format("cells, their masses{} and the boundary by vertex numbers",
                      problem_.materials.empty() ? "" : ", materials"),
          "/output: frames show the cells, diagnostics report mass and boundary");
    const auto& compressor = scene_.output.compressor;
    add(Part::frames,
        "the cells where they are" + fields_in_words() +
            (compressor ? fmt::format(", compressed by {}", *compressor == Compressor::zlib ? "zlib" : "LZ4") : ""),
        output_reason("frames_every", scene_.output.frame_steps));
    if (!scene_.probes.empty())
      add(Part::probes, counted(scene_.probes.size(), "vertex", "vertices") + " followed", "/output/probes");
    add(Part::diagnostics,
        fmt::format("energies, momenta, boundary, {}", stress_name(problem_.mesh.highest_dimension())),
        output_reason("diagnostics_every", scene_.output.diagnostic_steps));
    if (!plan_.needs.stress_watch) leave_out("stresses in every step", "/events: no event tears by stress");
  }

  std::string elasticity() const {
    if (!problem_.materials.empty()) return materials_in_words();
    const Material& material = problem_.material;
    if (material.model != Model::springs)
      return setting_in_words("/material/young", Shape::material, "young", material.young) + ", " +
             setting_in_words("poisson", Shape::material, "poisson", material.poisson) + "; " + model_in_words();
    return material.young > 0.0
               ? setting_in_words("/material/young", Shape::material, "young", material.young)
               : setting_in_words("/material/stiffness", Shape::material, "stiffness", material.stiffness);
  }

  /// Of the cells of a tissue; of one that is not a body's own, the highest of all.
  int dimension_of(const SceneFile::Tissue& tissue) const {
    const auto bodies = scene_.bodies();
    const Mesh& mesh = problem_.mesh;
    for (std::size_t b = 0; b < bodies.size() && is_mixed(mesh); ++b)
      if (bodies[b].path + "/material" == tissue.path) {
        const std::size_t first = problem_.bodies.cell[b];
        return first < problem_.bodies.cell[b + 1] ? dimension(mesh.kinds[first]) : 1;
      }
    return mesh.highest_dimension();
  }
  /// "/material: springs; /regions/0/material: neo-hookean"
  std::string materials_in_words() const {
    std::string words;
    for (const SceneFile::Tissue& tissue : scene_.tissues())
      words +=
          fmt::format("{}{}: {}", words.empty() ? "" : "; ", tissue.path, name(model_of(tissue, dimension_of(tissue))));
    return words;
  }
  /// "a ratio of 0.1 at 2 Hz", as the text of the scene gives it; at 1 Hz if no text has it.
  std::string damping_in_words(const SceneFile::Tissue& tissue) const {
    const double time = tissue.material.damping_time;
    const auto text = nlohmann::json::parse(scene_.text, nullptr, false);
    const nlohmann::json::json_pointer path(tissue.path + "/damping");
    if (!text.is_discarded() && text.contains(path) && text.at(path).is_object()) {
      const double ratio = text.at(path).at("ratio"), frequency = text.at(path).at("frequency");
      if (damping_time_of(ratio, frequency) == time) return fmt::format("a ratio of {} at {} Hz", ratio, frequency);
    }
    return fmt::format("a ratio of {:.3g} at 1 Hz", time / damping_time_of(1.0, 1.0));
  }
  /// "/material/damping: a ratio of 0.1 at 2 Hz", "/material: without 'damping'"
  std::string damped_elements() const {
    std::string words;
    for (const SceneFile::Tissue& tissue : scene_.tissues()) {
      if (tissue.material.model == Model::springs) continue;
      words += words.empty() ? "" : "; ";
      words += tissue.material.damping_time > 0.0 ? fmt::format("{}/damping: {}", tissue.path, damping_in_words(tissue))
                                                  : fmt::format("{}: without 'damping'", tissue.path);
    }
    return words;
  }
  std::string model_in_words() const { return fmt::format("/material/model: {}", name(problem_.material.model)); }

  std::string fields_in_words() const {
    const FrameFields& fields = scene_.output.fields;
    std::string words;
    if (fields.held) words += ", which vertices are held";
    if (fields.stress)
      words += scene_.is_chain()             ? ", tensions"
               : problem_.mesh.links.empty() ? ", stresses"
                                             : ", stresses and tensions";
    if (fields.displacement) words += ", displacements";
    if (fields.springs) words += ", springs";
    if (fields.contact) words += ", forces and depths of contact";
    return words;
  }

  const SceneFile& scene_;
  const Problem& problem_;
  const Simulation& simulation_;
  const SimulatedBody& body_;
  ScenePlan plan_;
};

/// A step that has something to solve, if the integrator solves: the first from rest may have nothing.
void take_step(Simulation& simulation, const SceneFile& scene) {
  const bool solves = scheme_of(scene.integrator).implicit;
  constexpr int most_steps = 32;
  for (int k = 0; k < most_steps && !simulation.advance(); ++k)
    if (!solves || simulation.work().solves > 0) break;
}

}  // namespace

std::size_t ScenePlan::bytes() const {
  std::size_t sum = 0;
  for (const PlanItem& item : items) sum += item.bytes;
  for (const MemoryItem& item : unplanned) sum += item.bytes;
  return sum;
}

ScenePlan plan_scene(const SceneFile& scene) {
  const Problem problem = make_problem(scene);
  Simulation simulation(with_events_held_back(scene), problem);
  ScenePlan plan = Planner(scene, problem, simulation).plan();
  take_step(simulation, scene);
  add_bytes(plan, simulation.memory());
  return plan;
}

SceneFile with_events_held_back(SceneFile scene) {
  for (SceneEvent& event : scene.events) {
    if (auto* stress = std::get_if<TearWhereStressed>(&event.action)) {
      stress->threshold = std::numeric_limits<double>::max();
      event.from = 0.0;
    } else {
      event.from = event.until = scene.duration + 1e3 * scene.step;
      event.every.reset();
    }
  }
  return scene;
}

MemoryReport measured_memory(const SceneFile& scene) {
  Simulation simulation(with_events_held_back(scene));
  take_step(simulation, scene);
  return simulation.memory();
}

void add_bytes(ScenePlan& plan, const MemoryReport& found) {
  for (const MemoryItem& memory : found) {
    const auto item = std::ranges::find_if(plan.items, [&memory](const PlanItem& planned) {
      return planned.part == memory.part && planned.which == memory.which;
    });
    if (item != plan.items.end())
      item->bytes += memory.bytes;
    else if (memory.bytes > 0)
      plan.unplanned.push_back(memory);
  }
}

}  // namespace dartboard
