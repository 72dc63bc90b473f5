#include "core/scene/run/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <tuple>

#include "core/base/counted.h"
#include "core/mechanics/fracture/stress.h"
#include "core/plain/error.h"
#include "core/scene/body/frame_columns.h"
#include "core/scene/file/beyond_numbers.h"
#include "core/scene/file/load_mesh.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/run/body_in_words.h"
#include "core/scene/run/sleeping.h"
#include "core/time/integrators.h"
#include "core/time/system/energy.h"

namespace dartboard {
namespace {

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

Simulation::Simulation(const SceneFile& scene) : Simulation(scene, make_problem(scene)) {}

Simulation::Simulation(const SceneFile& scene, const Problem& problem)
    : file_(scene.file),
      step_(settled_step(scene)),
      step_count_(step_of_time(scene.duration, step_)),
      guard_(scene, step_),
      fields_(scene.output.fields),
      exact_events_(scene.exact_events) {
  dimension_ = problem.mesh.highest_dimension();
  file_number_ = numbers_in_file(scene);
  if (std::holds_alternative<BodyList>(scene.body.mesh)) body_of_cell_ = body_of_cells(problem.bodies);
  const BodyNeeds needs = needs_of(scene, problem).body;
  try {
    body_ = make_simulated_body(problem, needs);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}: {}", scene.file, key_without_body(scene, problem), error.what()));
  } catch (const std::bad_alloc&) {
    throw InputError(fmt::format("{}: /body: there is not enough memory for {}; expected fewer", scene.file,
                                 counted(problem.mesh.cell_count(), "cell")));
  }
  try {
    integrator_ = make_integrator(scene.integrator, scene.solver);
    timeline_ = std::make_unique<Timeline>(scene, problem.mesh, *body_, *integrator_, step_);
    track_probes(scene.probes, *body_);
    if (scene.has_contact()) {
      contact_ = std::make_unique<SceneContact>(body_->contacts(), integrator_->scheme().implicit);
      expected_contacts_ = expect_contacts(scene, problem);
      guard_.expect_contact(expected_contacts_.share());
    }
    if (!is_finite(diagnostics())) throw InputError(key_beyond_numbers(scene, problem.mesh));
    for (const SceneEvent& event : scene.events) facets_of_events_.push_back(timeline_->schedule(event));
    counts_at_rest_ = body_->counts();
    timeline_->happen(0);
    timeline_->drive(0.0, end_of_part(0.0, step_));
    if (sums_work()) applied_ = potential_ = pull_energy(body_->system(), body_->vertices().position);
    if (contact_) contact_->start(body_->vertices().position, expected_contacts_, step_);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", scene.file, error.what()));
  }
  examine_step();
  if (const auto refusal = guard_.refusal(integrator_->scheme(), done_, time()))
    throw InputError(fmt::format("{}: {}: {}; expected {}, or another 'unstable_step'", scene.file,
                                 scene.accuracy ? "/accuracy" : "/step", refusal->why,
                                 scene.accuracy ? fmt::format("'step' in its place, at most {:.6g} s", refusal->stable)
                                                : fmt::format("at most {:.6g} s", refusal->stable)));
  watch_.start(body_->system(), body_->motion(), step_);
  if (!watch_.before().ok())
    throw InputError(fmt::format("{}: {}", scene.file, key_beyond_numbers(scene, problem.mesh)));
  if (scene.sleep) sleeping_ = std::make_unique<Sleeping>(*scene.sleep, step_, *body_);
  keep_sums();
}

Simulation::~Simulation() = default;

std::optional<EarlyEnd> Simulation::advance() {
  try {
    return take_step();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file_, error.what()));
  }
}

std::optional<EarlyEnd> Simulation::take_step() {
  if (auto refusal = guard_.refusal(integrator_->scheme(), done_, time())) return refusal;
  const std::size_t operations = this->operations();
  const auto stress_failure = [&](const SolverError& error) {
    const auto* stress = dynamic_cast<const StressError*>(&error);
    // the kept state is that of the system before the events of this step
    return diverged({"stress", stress ? stress->vertex : 0, body_->largest_stress()}, this->operations() == operations);
  };
  StepResult result = watch_.before();
  begin_work(static_cast<double>(done_) * step_);
  try {
    if (result.ok()) result = exact_events_ ? step_in_parts() : integrate(static_cast<double>(done_) * step_, step_);
  } catch (const StressError& error) {
    ++done_;
    return stress_failure(error);
  }
  ++done_;
  const bool is_last = done_ == step_count_;
  const double work = contact_ && result.ok() ? contact_->new_work() : 0.0;
  if (const auto fault = watch_.after_step(result, done_, is_last, work, stepped_system(), stepped_motion()))
    return diverged(of_body(*fault));
  if (is_last && !coarse_) coarse_ = find_coarse_coordinate();
  add_work_of_forces(static_cast<double>(done_) * step_);
  try {
    const std::size_t before = this->operations();
    timeline_->happen(done_);
    const double now = static_cast<double>(done_) * step_, end = static_cast<double>(done_ + 1) * step_;
    const Change change = go_on(this->operations() != before, now, end_of_part(now, end));
    if (change == Change::of_motion) watch_.system_changed(stepped_system(), stepped_motion());
    if (sleeping_ && sleeping_->after_step(done_)) step_another_part();
  } catch (const SolverError& error) {
    return stress_failure(error);
  }
  if (watch_.has_just_kept()) keep_sums();
  // no other step will check the state after events at the end
  if (is_last) return start_failure();
  return {};
}

std::optional<Divergence> Simulation::start_failure() {
  if (const auto fault = watch_.fault_before(stepped_system(), stepped_motion())) return diverged(of_body(*fault));
  return {};
}

/// A fault of what is stepped, by the number of its vertex in the body.
Fault Simulation::of_body(Fault fault) const {
  if (sleeping_) fault.vertex = sleeping_->whole(fault.vertex);
  return fault;
}

SpringSystem Simulation::stepped_system() const { return sleeping_ ? sleeping_->system() : body_->system(); }
Motion Simulation::stepped_motion() { return sleeping_ ? sleeping_->motion() : body_->motion(); }

// The energy of components that are woken is no growth of the motion: the watch starts anew.
void Simulation::step_another_part() {
  integrator_->restart();
  if (contact_) {
    contact_->change_part(sleeping_->contacts(), sleeping_->moved_samples(), sleeping_->vertices());
    contact_->system_changed(stepped_system(), stepped_motion().x);
  }
  watch_.start(stepped_system(), stepped_motion(), step_);
}

void Simulation::examine_step() {
  if (contact_) contact_->system_changed(stepped_system(), stepped_motion().x);
  guard_.examine(*body_, integrator_->scheme(), done_);
}

Preflight Simulation::check_before_run() const {
  SimulatedBody& body = *body_;
  return dartboard::check_before_run(body.system(), body.motion(), integrator_->scheme(),
                                     step_ / static_cast<double>(guard_.parts()), guard_.limits(), guard_.horizon());
}

std::optional<CoordinatePrecision> Simulation::find_coarse_coordinate() const {
  auto coarse = dartboard::find_coarse_coordinate(body_->system(), body_->vertices().position);
  if (coarse) coarse->vertex = file_number(coarse->vertex);
  return coarse;
}

/// Reports a fault; the body goes back to the state kept last if there is one.
Divergence Simulation::diverged(const Fault& fault, bool goes_back) {
  Divergence d{done_, time(), fault.quantity, file_number(fault.vertex), fault.value};
  if (!goes_back) return d;
  const MotionWatch::KeptState kept = watch_.go_back(done_, stepped_motion());
  d.taken_back = taken_back_ = kept.steps_before;
  taken_back_within_ = kept.later;
  if (sleeping_) sleeping_->give();
  if (contact_) contact_->go_back(time());
  applied_ = kept_applied_;
  d.stable = step_limit().stable;
  return d;
}

StepResult Simulation::integrate(double from, double duration) {
  const double parts = guard_.parts_of(duration);
  StepResult result;
  for (double part = 0.0; part < parts && result.ok(); ++part)
    result = integrate_part(from + duration * (part / parts), duration / parts);
  if (sleeping_) sleeping_->give();
  return result;
}

StepResult Simulation::integrate_part(double from, double duration) {
  if (sleeping_ && sleeping_->is_all_asleep()) {
    if (contact_) contact_->go_to(from + duration);
    return {};
  }
  return contact_ ? contact_->step(*integrator_, stepped_system(), stepped_motion(), from, duration)
                  : integrator_->step(stepped_system(), stepped_motion(), duration);
}

/// Takes a step in parts, from one change within it to the next.
StepResult Simulation::step_in_parts() {
  const double end = static_cast<double>(done_ + 1) * step_;
  double now = static_cast<double>(done_) * step_;
  StepResult result;
  for (bool whole = true;; whole = false) {
    within_step_ = !whole;
    const std::optional<double> next = timeline_->next_between(now, end);
    if (!next) return integrate(now, whole ? step_ : end - now);
    result = integrate(now, *next - now);
    if (!result.ok()) return result;
    now = *next;
    add_work_of_forces(now);
    const std::size_t operations = this->operations();
    timeline_->happen_until(now);
    const Change change = go_on(this->operations() != operations, now, end_of_part(now, end));
    begin_work(now);
    if (change == Change::none) continue;
    result = watch_.changed_within_step(stepped_system(), stepped_motion());
    if (!result.ok()) return result;
    watch_.keeps_within_step(done_, now - static_cast<double>(done_) * step_);
    keep_sums();
  }
}

/// [s] Until when loads are constant.
double Simulation::end_of_part(double now, double end) const {
  return exact_events_ ? timeline_->next_between(now, end).value_or(end) : end;
}

/// Sets the loads from now until a time, and takes up that they or, by an operation, the body have changed.
Simulation::Change Simulation::go_on(bool operated, double now, double until) {
  const LoadChange loads = timeline_->drive(now, until);
  const bool wakes = sleeping_ && (operated                    ? sleeping_->body_changed()
                                   : loads != LoadChange::none ? sleeping_->loads_changed()
                                                               : false);
  if (sums_work()) potential_ = pull_energy(body_->system(), body_->vertices().position);
  if (wakes) step_another_part();
  if (loads == LoadChange::begins_or_ends || operated) examine_step();
  if (wakes) return Change::of_what_is_stepped;
  return loads != LoadChange::none || operated ? Change::of_motion : Change::none;
}

std::span<const ContactWarning> Simulation::contact_warnings() const {
  return contact_ ? std::span<const ContactWarning>(contact_->warnings()) : std::span<const ContactWarning>();
}

std::uint32_t Simulation::file_number(std::uint32_t vertex) const {
  const std::span<const std::uint32_t> point = body_->vertices().point;
  if (vertex >= point.size() || point[vertex] == no_point) return no_point;
  return file_number_.empty() ? point[vertex] : file_number_[point[vertex]];
}

bool Simulation::sums_work() const { return timeline_->sums_work() || body_->does_work(); }

void Simulation::begin_work(double now) {
  work_from_ = now;
  body_->begin_work(body_->vertices().position);
}

// In a step, or a part of one, pulls are constant, so their work is the change of their potential; that of forces that
// have none is added.
void Simulation::add_work_of_forces(double now) {
  if (!sums_work()) return;
  const auto& x = body_->vertices().position;
  applied_ += pull_energy(body_->system(), x) - potential_ - body_->work(x, now - work_from_);
}

/// The sums of work are those of the state that the watch has kept.
void Simulation::keep_sums() {
  kept_applied_ = applied_;
  if (contact_) contact_->keep();
}

Diagnostics Simulation::diagnostics(std::optional<double> largest_stress) const {
  SpringSystem system = body_->system();
  const VertexColumns& v = body_->vertices();
  Diagnostics d;
  if (contact_) {
    d.contact = contact_->diagnostics(*body_);
    system.terms = body_->terms_but_contact(system.terms);
  }
  d.time = time();
  d.kinetic = kinetic_energy(system, v.velocity);
  d.elastic = elastic_energy(system, v.position);
  d.gravitational = gravity_energy(system, v.position);
  if (sums_work())
    d.applied = applied_;
  else if (timeline_->has_forces())
    d.applied = pull_energy(system, v.position);
  d.momentum = linear_momentum(system, v.velocity);
  d.angular_momentum = angular_momentum(system, v.position, v.velocity);
  d.mass = body_->mass();
  d.counts = body_->counts();
  d.boundary = body_->boundary();
  d.largest_stress = largest_stress ? *largest_stress : body_->largest_stress();
  d.operations = operations();
  if (sleeping_) d.sleep = sleeping_->diagnostics();
  return d;
}

MemoryReport Simulation::memory() const {
  MemoryReport report = body_->memory();
  report.push_back({Part::integrator, integrator_->bytes() - integrator_->solver_bytes()});
  report.push_back({Part::solver, integrator_->solver_bytes()});
  report.push_back({Part::detector, watch_.bytes()});
  if (contact_) report.push_back({Part::contact, contact_->bytes()});
  if (sleeping_) report.push_back({Part::sleeping, sleeping_->bytes()});
  report.push_back({Part::driven, timeline_->driven_bytes() + watch_.driven_bytes()});
  report.push_back({Part::probes, body_->tracked().size_bytes()});
  for (const MemoryItem& item : timeline_->memory()) report.push_back(item);
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
    frame.held = constraints_of(body_->vertices(), [this](std::uint32_t point) { return timeline_->moves(point); });
  if (fields.attachments) frame.attachments = body_->attachments();
  if (!body_of_cell_.empty())
    for (const std::uint32_t c : frame.mesh_cell) frame.body.push_back(body_of_cell_[c]);
  put_in_order(frame, file_number_);
  return frame;
}

}  // namespace dartboard
