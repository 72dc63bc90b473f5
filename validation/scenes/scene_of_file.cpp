#include "validation/scenes/scene_of_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/mechanics/adapt.h"
#include "core/mechanics/fracture/seam.h"
#include "core/mechanics/fracture/tearing.h"
#include "core/operations/dissociate_all.h"
#include "core/operations/tear_fan.h"
#include "core/places/border.h"
#include "core/plain/error.h"
#include "core/scene/body/needs.h"
#include "core/scene/body/simulated_body.h"
#include "core/scene/file/scene_problem.h"
#include "core/time/explicit/dormand_prince_54.h"
#include "core/time/watch/stable_step.h"
#include "reference/spring_network.h"

namespace dartboard {
namespace {

constexpr std::size_t checkpoints = 8;
// [edges] per step, of the run that finds which faces an event takes
constexpr double tolerance = 1e-8;

bool all_tetrahedra(const Mesh& mesh) {
  return std::ranges::all_of(mesh.kinds, [](CellKind kind) { return kind == CellKind::tetrahedron; });
}

/// Why an event cannot take place alike in every run, or leaves the motion as it is; empty when it takes part.
std::string reason_to_omit(const SceneEvent& event, double duration) {
  if (event.from >= duration) return "it happens at the end, and changes no motion";
  if (std::holds_alternative<TearWhereStressed>(event.action)) return "when it happens depends on the motion";
  if (std::holds_alternative<Remove>(event.action)) return "certified trajectories do not remove cells";
  if (std::holds_alternative<Refine>(event.action)) return "certified trajectories do not refine";
  if (std::holds_alternative<Release>(event.action)) return "certified trajectories let go of nothing";
  if (event.from != event.until || event.every) return "it repeats";
  return {};
}

bool depends_on_positions(const SceneEvent& event) {
  const auto* dissociate = std::get_if<Dissociate>(&event.action);
  return dissociate == nullptr || dissociate->faces.index() != 0;
}

/// The body on its way from event to event, to find the faces that each of them takes.
class Scout {
 public:
  explicit Scout(const Problem& problem) : at_rest_(build_body<TetMap, Held::by_every_dart>(problem)), body_(at_rest_) {
    ends_.rebuild(body_);
    const reference::SpringNetwork network = reference::spring_network(problem);
    edge_ = reference::mean_rest_length(network);
    rate_ = reference::fastest_rate(network, problem.mesh.points);
  }

  void go_to(const SceneEvent& event) {
    if (event.from <= time_) return;
    // as in run_timed: the error of a velocity that belongs to one of a position
    const Tolerance allowed{tolerance * edge_, tolerance * edge_ * std::max(rate_ / 16, 1.0 / event.from)};
    const StepResult result = integrator_.advance(
        system_of(body_, ends_), {body_.vertices.position, body_.vertices.velocity}, event.from - time_, allowed);
    if (!result.ok())
      throw SolverError(fmt::format("{}: the motion up to it ends with {}", event.path, to_string(result)));
    time_ = event.from;
  }

  /// Of the action, where the body is now.
  std::vector<Dart> faces_of(const SceneEvent& event) const {
    if (const auto* tear = std::get_if<Tear>(&event.action)) {
      const auto vertex = vertex_of(*tear);
      if (!vertex) throw InputError(fmt::format("{}/tear/vertex: there is no such point of the mesh", event.path));
      const Dart start = starting_face(body_, *vertex, tear->direction);
      return start == no_dart ? std::vector<Dart>{} : fan(body_.map, start);
    }
    const auto& cut = std::get<Dissociate>(event.action);
    if (const auto* plane = std::get_if<PlaneSelection>(&cut.faces)) {
      std::vector<Dart> seam = faces_on_plane(body_, plane->point, plane->normal);
      const double thickness = border_thickness(body_.vertices.position);
      std::erase_if(seam,
                    [&](Dart d) { return cut.within && !contains(*cut.within, facet_centre(body_, d), thickness); });
      return seam;
    }
    if (const auto* blade = std::get_if<BladeSweep>(&cut.faces))
      return facets_on_sweep(body_, blade->path, blade->depth);
    std::vector<Dart> found;
    for (const auto& points : std::get<0>(cut.faces)) {
      if (points.size() != 3)
        throw InputError(fmt::format("{}/dissociate/points: has {} points; expected three points of a face", event.path,
                                     points.size()));
      const std::array<std::uint32_t, 3> one{points[0], points[1], points[2]};
      try {
        for (const Dart d : faces_of_points(at_rest_, std::span(&one, 1))) found.push_back(d);
      } catch (const InputError& error) {
        throw InputError(fmt::format("{}/dissociate/points: {}", event.path, error.what()));
      }
    }
    return found;
  }

  /// False when nothing is left to separate.
  bool pass(const std::vector<Dart>& faces) {
    const TopologyChange change = dissociate_all(body_.map, std::span<const Dart>(faces));
    if (change.empty()) return false;
    ends_.apply(body_, adapt(body_, change));
    integrator_.restart();
    return true;
  }

 private:
  /// As a Simulation chooses: the lowest of the parts of a point, or of the vertices nearest to a place.
  std::optional<std::uint32_t> vertex_of(const Tear& tear) const {
    std::optional<std::uint32_t> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t k = 0; k < body_.vertices.size(); ++k) {
      double far = 0.0;
      if (const auto* point = std::get_if<std::uint32_t>(&tear.vertex)) {
        if (body_.vertices.point[k] != *point) continue;
      } else {
        far = (body_.vertices.position[k] - std::get<Eigen::Vector3d>(tear.vertex)).squaredNorm();
      }
      if (far < least) {
        best = k;
        least = far;
      }
    }
    return best;
  }

  TetBody at_rest_, body_;
  SpringEndsView ends_;
  DormandPrince54 integrator_;
  double edge_, rate_, time_ = 0.0;
};

/// Fix the faces of all events that take part, in the order in which they happen.
std::vector<TimedCut> cuts_of(std::vector<SceneEvent> events, const Problem& problem,
                              std::vector<std::string>& omissions) {
  std::ranges::stable_sort(events, {}, &SceneEvent::from);
  std::vector<TimedCut> cuts;
  if (events.empty()) return cuts;
  Scout scout(problem);
  auto last = std::ranges::find_if(events.rbegin(), events.rend(), depends_on_positions).base();
  for (auto event = events.begin(); event != events.end(); ++event) {
    if (event < last) scout.go_to(*event);
    std::vector<Dart> faces = scout.faces_of(*event);
    if (!scout.pass(faces)) {
      omissions.push_back(fmt::format("{} is left out: it finds no face to separate.", event->path));
      continue;
    }
    if (depends_on_positions(*event) && event->from > 0.0)
      omissions.push_back(fmt::format(
          "{} takes the faces that it takes in one accurate run, wherever the vertices are in others.", event->path));
    cuts.push_back({event->from, [faces](const TetBody&) { return faces; }});
  }
  return cuts;
}

TradeoffScene network_scene(const SceneFile& file, const Problem& problem) {
  TradeoffScene made{.name = {}, .what = {}, .body = {}, .motion = {}};
  made.motion.network = reference::spring_network(problem);
  made.motion.start = {problem.mesh.points, problem.initial_velocity};
  for (const std::uint32_t p : problem.fixed) made.motion.start.v[p].setZero();
  for (std::size_t c = 1; c <= checkpoints; ++c)
    made.motion.checkpoints.push_back(file.duration * static_cast<double>(c) / static_cast<double>(checkpoints));
  made.duration = file.duration;
  made.fastest_rate = reference::fastest_rate(made.motion.network, problem.mesh.points);
  made.edge = reference::mean_rest_length(made.motion.network);
  const auto body = make_simulated_body(problem, needs_of(file, problem).body);
  made.limits = StableStepEstimate().refresh(body->system(), body->vertices().position);
  made.omissions.emplace_back("The body is not of tetrahedra alone: it is run as its springs, without a map.");
  check(made.motion);
  return made;
}

}  // namespace

TradeoffScene scene_of_file(const SceneFile& file) {
  const auto fail = [&](std::string_view path, std::string_view found, std::string_view expected) {
    throw InputError(fmt::format("{}: {}: {}; expected {}", file.file, path, found, expected));
  };
  if (!(file.duration > 0.0)) fail("/duration", "is 0 s", "a motion to study");
  if (file.material.stiffness == 0.0 && file.material.damping > 0.0)
    fail("/material/stiffness", "is 0 N/m beside a damping", "springs, or nothing between the vertices");
  // the networks of the references come from cells, and hold still what is fixed
  if (file.is_chain()) fail("/body/generate/chain", "is a chain", "a body of cells, to compare with references");
  if (file.tissues().size() > 1)
    fail(file.tissues()[1].path, "is one material of several", "a body of one, to compare with references");
  if (file.has_elements()) fail("/material/poisson", "asks for elements", "springs, to compare with references");
  if (!file.key_beside_edges().empty())
    fail(file.key_beside_edges(), "asks for springs that are no edges", "none, to compare with references");
  if (file.holds_axes())
    fail("/fixed", "holds vertices along some axes", "vertices held still, to compare with references");
  if (!file.driven.empty()) fail("/driven", "moves vertices", "none driven, to compare with references");
  if (!file.forces.empty()) fail("/forces", "pulls at vertices", "none applied, to compare with references");
  if (file.has_contact()) fail("/contact", "says what touches", "none, to compare with references");
  const Problem problem = make_problem(file);
  if (problem.mesh.points.empty()) fail("/body", "has no points", "a body that moves");

  const bool solid = all_tetrahedra(problem.mesh);
  std::vector<std::string> omissions;
  std::vector<SceneEvent> kept;
  for (const SceneEvent& event : file.events) {
    const std::string reason = solid ? reason_to_omit(event, file.duration) : "the body is not of tetrahedra alone";
    if (reason.empty())
      kept.push_back(event);
    else
      omissions.push_back(fmt::format("{} is left out: {}.", event.path, reason));
  }
  TradeoffScene made = [&] {
    if (!solid) return network_scene(file, problem);
    try {
      return tradeoff_scene(file.about, {.name = file.name,
                                         .problem = problem,
                                         .events = cuts_of(std::move(kept), problem, omissions),
                                         .duration = file.duration,
                                         .checkpoints = checkpoints});
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", file.file, error.what()));
    } catch (const SolverError& error) {
      throw SolverError(fmt::format("{}: {}", file.file, error.what()));
    }
  }();
  if (!(made.fastest_rate > 0.0)) made.fastest_rate = 1.0 / file.duration;  // nothing but flight
  // the name of the file: it names files in turn
  made.name = std::filesystem::path(file.file).stem().string();
  made.what = file.about.empty() ? file.name : file.about;
  made.omissions.insert(made.omissions.end(), omissions.begin(), omissions.end());
  return made;
}

TradeoffScene find_scene(std::string_view name_or_file, const std::filesystem::path& meshes) {
  if (name_or_file.ends_with(".json")) return scene_of_file(read_scene(std::filesystem::path(name_or_file)));
  return make_tradeoff_scene(name_or_file, meshes);
}

}  // namespace dartboard
