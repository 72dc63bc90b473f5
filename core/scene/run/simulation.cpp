#include "core/scene/run/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <tuple>

#include "core/mechanics/fracture/stress.h"
#include "core/plain/counted.h"
#include "core/plain/error.h"
#include "core/scene/body/frame_columns.h"
#include "core/scene/file/beyond_numbers.h"
#include "core/scene/file/load_mesh.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/run/body_in_words.h"
#include "core/scene/survey/cut_counts.h"
#include "core/time/integrators.h"
#include "core/time/solve/stop_request.h"
#include "core/time/system/energy.h"
#include "core/time/watch/preflight.h"

namespace dartboard {
namespace {

// More parts of a step than this are a mistake in a unit.
constexpr double most_parts = 1e6;

double settled_step(const SceneFile& scene) {
  if (scene.accuracy && (!(scene.step > 0.0) || scene.integrator.empty()))
    throw InputError(fmt::format(
        "{}: /accuracy: is {} mean edge lengths, and no {} has been chosen for it; expected 'step' in its place",
        scene.file, *scene.accuracy, scene.step > 0.0 ? "integrator" : "step"));
  return scene.step;
}

/// The key because of which a body cannot be made: with its default it could be.
std::string key_without_body(const SceneFile& scene, const Problem& problem) {
  SceneFile unmoved = scene, unscaled = scene, ordinary = scene;
  unmoved.body.translate.setZero();
  unscaled.body.scale = 1.0;
  ordinary.material.density = Material{}.density;
  const Eigen::Vector3d& t = scene.body.translate;
  const std::tuple<bool, std::string, const SceneFile&> others[] = {
      {!t.isZero(0.0), fmt::format("/body/translate: is [{}, {}, {}]", t.x(), t.y(), t.z()), unmoved},
      {scene.body.scale != 1.0, fmt::format("/body/scale: is {}", scene.body.scale), unscaled},
      {scene.material.density != ordinary.material.density,
       fmt::format("/material/density: is {}", scene.material.density), ordinary}};
  for (const auto& [differs, key, other] : others) {
    if (!differs) continue;
    try {
      Problem changed = problem;
      changed.mesh = make_mesh(other);
      changed.material = other.material;
      make_simulated_body(changed, needs_of(other, changed).body);
      return key;
    } catch (const InputError&) {
    }
  }
  const std::string size = size_beyond_numbers(scene, problem.mesh);
  return size.empty() ? scene.body.path : size;
}

}  // namespace

bool all_slower(std::span<const Eigen::Vector3d> velocity, double speed) {
  return sum_of_squares(velocity) <= speed * speed;
}

std::string to_string(const StepWarning& w, double step, std::string_view integrator) {
  std::string text =
      fmt::format("{}: a step of {:.6g} s is too long for {}; {:.6g} s is stable",
                  w.step == 0 ? "at the start" : "after " + counted(w.step, "step"), step, integrator, w.stable);
  if (w.by_contact) text += " where contacts are as deep as is expected";
  if (w.parts > 1) text += fmt::format(", so each is taken in {} parts", w.parts);
  return text;
}

std::string to_string(const Divergence& d) {
  if (d.predicted)
    return fmt::format("stopped before step {}, t = {:.6g} s: {}; at most {:.6g} s is stable", d.step, d.time,
                       d.quantity, d.value);
  return fmt::format("diverged at step {}, t = {:.6g} s: {} of {} is {:.6g}", d.step, d.time, d.quantity,
                     vertex_in_words(d.vertex), d.value);
}

Simulation::Simulation(const SceneFile& scene)
    : step_(settled_step(scene)),
      step_count_(step_of_time(scene.duration, step_)),
      horizon_(horizon_of(scene.duration)),
      fields_(scene.output.fields),
      exact_events_(scene.exact_events),
      unstable_step_(scene.unstable_step) {
  const Problem problem = make_problem(scene);
  dimension_ = problem.mesh.dimension();
  file_number_ = numbers_in_file(scene);
  const CellMaterials materials = problem.cell_materials();
  for (std::size_t c = 0; c < problem.mesh.cell_count(); ++c)
    if (materials[c].model == Model::springs) ++cells_of_springs_[problem.mesh.kinds[c]];
  try {
    body_ = make_simulated_body(problem, needs_of(scene, problem).body);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}: {}", scene.file, key_without_body(scene, problem), error.what()));
  } catch (const std::bad_alloc&) {
    throw InputError(fmt::format("{}: /body: there is not enough memory for {}; expected fewer", scene.file,
                                 counted(problem.mesh.cell_count(), "cell")));
  }
  std::vector<ContactForecast> expected;
  std::vector<TouchForecast> expected_touches;
  try {
    driven_ = DrivenVertices(scene, problem.mesh.points, step_);
    forces_ = AppliedForces(scene, problem.mesh, body_->vertices(), step_);
    track_probes(scene.probes, *body_);
    integrator_ = make_integrator(scene.integrator, scene.solver);
    if (scene.has_contact()) {
      contact_ =
          std::make_unique<SceneContact>(body_->contact(), body_->body_contact(), integrator_->scheme().implicit);
      expected = forecast_contacts(scene, problem);
      expected_touches = forecast_touches(scene, problem);
      expected_share_ = std::max(largest_share(expected), largest_share(expected_touches));
    }
    if (!is_finite(diagnostics())) throw InputError(key_beyond_numbers(scene, problem.mesh));
    selections_ = count_selections(scene, problem.mesh);
    stiff_bodies_ = find_stiff_bodies(scene, problem);
    for (const SceneEvent& event : scene.events) {
      events_.push_back({body_->make_ready(event), EventClock(event.from, event.until, event.every, step_),
                         changes_topology(event.action) && !std::holds_alternative<Remove>(event.action) &&
                             !std::holds_alternative<Refine>(event.action),
                         event.path});
      count_cut(event, problem.mesh);
    }
    happen();
    drive();
    if (contact_) contact_->start(body_->vertices().position, expected, expected_touches, step_);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", scene.file, error.what()));
  }
  look_at_step();
  if (const auto refusal = refused())
    throw InputError(fmt::format("{}: {}: {}; expected {}, or another 'unstable_step'", scene.file,
                                 scene.accuracy ? "/accuracy" : "/step", refusal->quantity,
                                 scene.accuracy ? fmt::format("'step' in its place, at most {:.6g} s", refusal->value)
                                                : fmt::format("at most {:.6g} s", refusal->value)));
  look_before_run();
  start_ = detector_.start(body_->system(), body_->motion(), step_);
  if (!start_.ok()) throw InputError(fmt::format("{}: {}", scene.file, key_beyond_numbers(scene, problem.mesh)));
}

void Simulation::count_cut(const SceneEvent& event, const Mesh& mesh) {
  const std::optional<std::size_t> facets = events_.back().event->facets();
  if (!facets) return;
  std::size_t facets_of_cells = 0;
  for (const CellKind kind : mesh.kinds)
    facets_of_cells += dimension_ == 3 ? faces_of(kind).size() : static_cast<std::size_t>(node_count(kind));
  const CellCounts counts = body_->counts();
  selections_.push_back(
      dartboard::count_cut(event, mesh, *facets, facets_of_cells - (dimension_ == 3 ? counts.faces : counts.edges)));
}

Simulation::~Simulation() = default;

std::optional<Divergence> Simulation::advance() {
  if (auto refusal = refused()) return refusal;
  const std::size_t operations = operations_;
  const auto stress_failure = [&](const SolverError& error) {
    const auto* stress = dynamic_cast<const StressError*>(&error);
    Divergence d = failure("stress", stress ? stress->vertex : 0, body_->largest_stress());
    // the kept state is that of the system before the events of this step
    if (operations_ == operations) d.taken_back = go_back();
    return d;
  };
  StepResult result = start_;
  try {
    if (result.ok())
      result = exact_events_ ? step_through_events() : integrate(static_cast<double>(done_) * step_, step_);
  } catch (const StressError& error) {
    ++done_;
    return stress_failure(error);
  }
  ++done_;
  const std::uint64_t checks = detector_.checks();
  if (result.ok()) {
    watched_ = done_;
    if (contact_) detector_.add_work(contact_->new_work());
    result = detector_.after_step(body_->system(), body_->motion());
  }
  if (result.ok() && done_ == step_count_) result = detector_.check_all(body_->system(), body_->motion());
  if (!result.ok()) return failure(detector_.with_witness(result, body_->system(), body_->motion()));
  // a speed above that of light is finite: it is checked whenever the energy is
  if (detector_.checks() != checks)
    if (auto found = diverged()) {
      found->taken_back = go_back();
      return found;
    }
  if (done_ == step_count_) look_at_coordinates();
  const std::size_t before = operations_;
  try {
    happen();
    if (drive() || operations_ != before) {
      look_at_step();
      start_ = detector_.system_changed(body_->system(), body_->motion());
    }
  } catch (const SolverError& error) {
    return stress_failure(error);
  }
  // no other step will check the state after events at the end
  if (done_ == step_count_) return start_failure();
  return {};
}

std::optional<Divergence> Simulation::start_failure() {
  if (start_.ok()) return {};
  return failure(detector_.with_witness(start_, body_->system(), body_->motion()));
}

// The memory of the close estimate is freed: it is made at the start and after events only.
StableStep Simulation::look_closely() const {
  const StableStep limits = StableStepEstimate().refresh(body_->system(), body_->vertices().position);
  if (!contact_) return limits;
  return with_contact(limits,
                      contact_rate(body_->system(), contact_->obstacles(), contact_->bodies(), expected_share_));
}

StepLimit Simulation::step_limit() const { return look_closely().limit(integrator_->scheme(), horizon_); }

void Simulation::look_at_step() {
  const Scheme& scheme = integrator_->scheme();
  if (contact_) contact_->system_changed(body_->system(), body_->vertices().position);
  limits_ = quick_stable_step(body_->system());
  too_long_ = false;
  parts_ = 1;
  if (limits_.is_stable(scheme, step_, horizon_)) return;
  limits_ = look_closely();
  if (limits_.is_stable(scheme, step_, horizon_)) return;
  stable_ = limits_.safe_step(scheme, horizon_);
  too_long_ = true;
  if (unstable_step_ == UnstableStep::substep) {
    parts_wanted_ = std::ceil(step_ / stable_);
    too_long_ = !(parts_wanted_ <= most_parts);
    if (!too_long_) parts_ = static_cast<std::uint64_t>(parts_wanted_);
  }
  if (!warning_) warning_ = StepWarning{done_, stable_, parts_, is_limited_by_contact()};
}

// Contact contributes more than half of the squares that add up to that of the highest frequency.
bool Simulation::is_limited_by_contact() const {
  if (!contact_) return false;
  const double rate = contact_rate(body_->system(), contact_->obstacles(), contact_->bodies(), expected_share_);
  return rate * rate > 0.5 * limits_.upper * limits_.upper;
}

// Steps too long and coordinates too large have warnings of their own, which a run may add to.
void Simulation::look_before_run() {
  const Preflight found = check_before_run(body_->system(), body_->motion(), integrator_->scheme(),
                                           step_ / static_cast<double>(parts_), limits_, horizon_);
  if (found.warns_of(StepCode::coordinate_precision)) look_at_coordinates();
  warnings_ = found.warnings;
  std::erase_if(warnings_, [](const StepResult& w) {
    return w.code == StepCode::unstable_step || w.code == StepCode::coordinate_precision ||
           w.quantity == step_times_frequency;
  });
  for (StepResult& warning : warnings_)
    if (warning.witness == Witness::vertex) warning.number = file_number(warning.number);
}

void Simulation::look_at_coordinates() {
  if (coarse_) return;
  coarse_ = find_coarse_coordinate(body_->system(), body_->vertices().position);
  if (coarse_) coarse_->vertex = file_number(coarse_->vertex);
}

// A step that cannot be divided is refused too.
std::optional<Divergence> Simulation::refused() const {
  if (!too_long_ || unstable_step_ == UnstableStep::warn) return {};
  Divergence d;
  d.step = done_ + 1;
  d.time = time();
  d.quantity = fmt::format("a step of {:.6g} s is too long for {}", step_, integrator_->scheme().name);
  if (unstable_step_ == UnstableStep::substep)
    d.quantity += fmt::format(" and would be divided into {:.3g} parts, more than {:.0f}", parts_wanted_, most_parts);
  d.value = stable_;
  d.predicted = true;
  return d;
}

Divergence Simulation::failure(const StepResult& result) {
  Divergence d = failure(fmt::format("{} ({})", result.quantity, to_string(result.code)), result.number, result.value);
  d.taken_back = go_back();
  return d;
}

// Go back to the state kept last; the detector has not checked a step that the integrator could not take.
std::uint64_t Simulation::go_back() {
  taken_back_ = done_ - watched_ + detector_.restore(body_->motion());
  if (contact_) contact_->go_to(time());
  return taken_back_;
}

/// Integrates in parts that are not longer than those of a whole step, to rounding.
StepResult Simulation::integrate(double from, double duration) {
  double parts = static_cast<double>(parts_);
  if (duration != step_) parts = std::max(1.0, std::ceil(parts * (duration / step_) * (1.0 - 0x1p-50)));
  StepResult result;
  for (double part = 0.0; part < parts && result.ok(); ++part)
    result = contact_ ? step_with_contact(from + duration * (part / parts), duration / parts)
                      : integrator_->step(body_->system(), body_->motion(), duration / parts);
  return result;
}

StepResult Simulation::step_with_contact(double from, double duration) {
  const SpringSystem system = body_->system();
  const Motion motion = body_->motion();
  if (contact_->begin(from, duration, system, motion)) integrator_->restart();
  StepResult result;
  try {
    result = integrator_->step(system, motion, duration);
  } catch (const Stopped&) {
    contact_->undo(from, motion);
    throw;
  }
  if (!result.ok()) {
    contact_->undo(from, motion);
    return result;
  }
  if (contact_->end(from, duration, system, motion)) integrator_->restart();
  return result;
}

/// Takes a step in parts, from one event within it to the next.
StepResult Simulation::step_through_events() {
  const double end = static_cast<double>(done_ + 1) * step_;
  double now = static_cast<double>(done_) * step_;
  StepResult result;
  for (bool whole = true;; whole = false) {
    within_step_ = !whole;
    std::optional<double> next;
    for (const Scheduled& scheduled : events_)
      if (const auto time = scheduled.clock.time_between(); time && *time < end && (!next || *time < *next))
        next = time;
    if (!next) return integrate(now, whole ? step_ : end - now);
    result = integrate(now, *next - now);
    if (!result.ok()) return result;
    now = *next;
    const std::size_t operations = operations_;
    happen_until(now);
    if (operations_ == operations) continue;
    look_at_step();
    result = detector_.system_changed(body_->system(), body_->motion());
    if (!result.ok()) return result;
  }
}

void Simulation::happen() {
  for (Scheduled& scheduled : events_) {
    if (scheduled.clock.next() > done_) continue;
    while (scheduled.clock.next() <= done_) scheduled.clock.advance();
    apply(scheduled);
  }
}

/// Applies the events between two boundaries.
void Simulation::happen_until(double time) {
  for (Scheduled& scheduled : events_) {
    const auto due = scheduled.clock.time_between();
    if (!due || *due > time) continue;
    scheduled.clock.advance_from_between();
    apply(scheduled);
  }
}

// An event may throw: the changes by earlier events count, and the integrator has to be restarted.
void Simulation::apply(Scheduled& scheduled) {
  const std::size_t made =
      watch_ && scheduled.dissociates ? apply_watched(*scheduled.event, *body_, jumps_) : scheduled.event->apply();
  scheduled.was_due = true;
  scheduled.operations += made;
  operations_ += made;
  if (made > 0) integrator_->restart();
}

std::span<const ContactWarning> Simulation::contact_warnings() const {
  return contact_ ? std::span<const ContactWarning>(contact_->warnings()) : std::span<const ContactWarning>();
}

std::vector<std::string> Simulation::idle_events() const {
  std::vector<std::string> paths;
  for (const Scheduled& scheduled : events_)
    if (scheduled.was_due && scheduled.operations == 0) paths.push_back(scheduled.path);
  return paths;
}

bool Simulation::drive() {
  bool changed = driven_.apply(done_, body_->vertices().point, body_->motion().v);
  if (forces_.apply(done_, body_->vertices().point, body_->pull())) changed = true;
  if (changed) integrator_->restart();
  return changed;
}

std::optional<Divergence> Simulation::diverged() const {
  const VertexColumns& v = body_->vertices();
  if (all_slower(v.velocity, speed_of_light)) return {};
  for (std::uint32_t k = 0; k < v.size(); ++k) {
    // NaN and infinity fail this comparison
    if (v.velocity[k].squaredNorm() <= speed_of_light * speed_of_light) continue;
    for (int i = 0; i < 3; ++i)
      if (!std::isfinite(v.velocity[k][i])) return failure("velocity", k, v.velocity[k][i]);
    return failure("speed", k, v.velocity[k].stableNorm());
  }
  return {};
}

Divergence Simulation::failure(std::string quantity, std::uint32_t vertex, double value) const {
  return {
      .step = done_, .time = time(), .quantity = std::move(quantity), .vertex = file_number(vertex), .value = value};
}

std::uint32_t Simulation::file_number(std::uint32_t vertex) const {
  const std::span<const std::uint32_t> point = body_->vertices().point;
  if (vertex >= point.size() || point[vertex] == no_point) return no_point;
  return file_number_.empty() ? point[vertex] : file_number_[point[vertex]];
}

Diagnostics Simulation::diagnostics() const {
  SpringSystem system = body_->system();
  const VertexColumns& v = body_->vertices();
  Diagnostics d;
  if (contact_) {
    d.contact = contact_->diagnostics(v.position);
    system.terms = body_->terms_but_contact(system.terms);
  }
  d.time = time();
  d.kinetic = kinetic_energy(system, v.velocity);
  d.elastic = elastic_energy(system, v.position);
  d.gravitational = gravity_energy(system, v.position);
  if (forces_.size() > 0) d.applied = pull_energy(system, v.position);
  d.momentum = linear_momentum(system, v.velocity);
  d.angular_momentum = angular_momentum(system, v.position, v.velocity);
  d.mass = body_->mass();
  d.counts = body_->counts();
  d.boundary = body_->boundary();
  d.largest_stress = body_->largest_stress();
  d.operations = operations_;
  return d;
}

MemoryReport Simulation::memory() const {
  MemoryReport report = body_->memory();
  report.push_back({Part::integrator, integrator_->bytes() - integrator_->solver_bytes()});
  report.push_back({Part::solver, integrator_->solver_bytes()});
  report.push_back({Part::detector, detector_.bytes()});
  report.push_back({Part::pull, forces_.bytes()});
  if (contact_) report.push_back({Part::contact, contact_->bytes()});
  report.push_back({Part::driven, driven_.bytes() + detector_.driven_bytes()});
  report.push_back({Part::probes, body_->tracked().size_bytes()});
  for (std::size_t k = 0; k < events_.size(); ++k) report.push_back({Part::event, events_[k].event->bytes(), k});
  return report;
}

ProbeRow Simulation::probes() const {
  const VertexColumns& v = body_->vertices();
  ProbeRow row{time(), {}};
  for (const std::uint32_t k : body_->tracked())
    row.probes.push_back(k == SimulatedBody::no_vertex ? std::nullopt
                                                       : std::optional(VertexMotion{v.position[k], v.velocity[k]}));
  return row;
}

Frame Simulation::frame(const FrameFields& fields) const {
  Frame frame = body_->frame(fields);
  frame.time = time();
  if (fields.held)
    frame.held = constraints_of(body_->vertices(), [this](std::uint32_t point) { return driven_.moves(point); });
  put_in_order(frame, file_number_);
  return frame;
}

}  // namespace dartboard
