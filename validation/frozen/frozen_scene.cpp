#include "validation/frozen/frozen_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/overloads.h"
#include "core/plain/error.h"
#include "core/plain/nan_maximum.h"
#include "core/scene/file/step_times.h"
#include "core/scene/timeline/table_times.h"
#include "core/time/explicit/dormand_prince_54.h"
#include "core/time/watch/stable_step.h"
#include "validation/frozen/frozen_motion.h"

namespace dartboard {
namespace {

// [edges] per step, of the run that finds the cells of events
constexpr double tolerance = 1e-8;
// the same through contact: h omega_max of its equal steps
constexpr double contact_phase = 0.25;

/// The reason why an event cannot take place alike in every run, or changes no motion; empty when it takes part.
std::string reason_to_omit(const SceneEvent& event, const SceneFile& file) {
  if (event.from >= file.duration) return "it happens at the end, and changes no motion";
  if (event.from != event.until && !event.every && !(file.step > 0.0))
    return "it looks at the body in every step, and no step has been chosen";
  return {};
}

bool depends_on_positions(const CellSelection& cells) {
  return !std::holds_alternative<IdSelection>(cells) && !std::holds_alternative<RandomSelection>(cells);
}

bool depends_on_positions(const SceneEvent& event) {
  return std::visit(Overloads{[](const Dissociate& cut) { return !std::holds_alternative<FacetPoints>(cut.faces); },
                              [](const Remove& remove) { return depends_on_positions(remove.cells); },
                              [](const Refine& refine) { return depends_on_positions(refine.cells); },
                              [](const Tear&) { return true; }, [](const TearWhereStressed&) { return true; },
                              [](const Release&) { return false; }},
                    event.action);
}

/// A time at which something may change: by an event, a drive or a force.
struct Moment {
  double time;
  std::optional<std::size_t> event;
};

/// Add from, from + every, ... up to until, each a product, and before the end of the scene.
void add_times(double from, double until, double every, double duration, const std::optional<std::size_t>& event,
               std::vector<Moment>& moments) {
  for (double k = 0.0;; ++k) {
    const double time = from + k * every;
    if (!(time < duration) || time > until * (1.0 + 0x1p-51)) return;
    moments.push_back({time, event});
    if (from == until) return;
  }
}

/// The moments of a scene, ascending; at equal times events come first, in the order of the scene.
std::vector<Moment> moments_of(const SceneFile& file) {
  std::vector<Moment> moments;
  for (std::size_t e = 0; e < file.events.size(); ++e) {
    const SceneEvent& event = file.events[e];
    if (event.from == event.until || event.every) {
      add_times(event.from, event.until, event.every.value_or(0.0), file.duration, e, moments);
      continue;
    }
    for (std::uint64_t n = step_of_time(event.from, file.step); n <= step_until(event.until, file.step); ++n)
      if (const double time = static_cast<double>(n) * file.step; time < file.duration) moments.push_back({time, e});
  }
  const auto add_change = [&](double time) { add_times(time, time, 0.0, file.duration, {}, moments); };
  for (const SceneDrive& drive : file.driven) {
    const double until = drive.until.value_or(file.duration);
    add_change(drive.from);
    add_change(until);
    std::ranges::for_each(times_of(drive), add_change);
    if (drive.reverse_every) add_times(drive.from, until, *drive.reverse_every, file.duration, {}, moments);
  }
  for (const SceneForce& force : file.forces) {
    add_change(force.from);
    if (force.until) add_change(*force.until);
    std::ranges::for_each(force.factor.at, add_change);
  }
  std::ranges::stable_sort(moments, [](const Moment& a, const Moment& b) {
    return a.time != b.time ? a.time < b.time : a.event.has_value() && !b.event.has_value();
  });
  return moments;
}

}  // namespace

bool is_left_to_the_run(const SceneEvent& event) {
  if (std::holds_alternative<Release>(event.action) || event.until == 0.0) return false;
  return depends_on_positions(event) || (event.from != event.until && !event.every);
}

bool changes_in_every_step(const SceneFile& file) {
  return std::ranges::any_of(file.driven, &SceneDrive::has_table) ||
         std::ranges::any_of(file.forces, [](const SceneForce& force) { return !force.factor.empty(); });
}

/// The body on its way from change to change, to find what each of them operates on.
class FrozenBody::Scout {
 public:
  explicit Scout(const FrozenScene& scene) : scene_(scene), at_(scene), done_(scene.file.events.size(), 0) {}

  /// All changes before the end.
  std::vector<FrozenChange> changes() {
    const std::vector<Moment> moments = moments_of(scene_.file);
    const auto depends = [this](const Moment& m) {
      return m.event && depends_on_positions(scene_.file.events[*m.event]);
    };
    const auto last = std::find_if(moments.rbegin(), moments.rend(), depends).base();
    std::vector<FrozenChange> found;
    for (auto moment = moments.begin(); moment != moments.end();) {
      const double time = moment->time;
      if (moment < last) go_to(time);
      FrozenChange change{.time = time};
      bool has_load = false;
      for (; moment != moments.end() && moment->time == time; ++moment) {
        if (moment->event)
          operate(*moment->event, change);
        else
          has_load = true;
      }
      at_.drive(time);
      at_.look_at_contact();
      if (change.operations.empty() && !has_load) continue;
      integrator_.restart();
      found.push_back(std::move(change));
    }
    return found;
  }

  /// The number of operations of an event, over all its times.
  std::size_t done(std::size_t event) const { return done_[event]; }

 private:
  void operate(std::size_t event, FrozenChange& change) {
    FrozenChange::Operation operation{event, {}};
    const std::size_t made = operation.made = at_.events_[event]->apply(&operation.targets);
    done_[event] += made;
    if (made > 0) change.operations.push_back(std::move(operation));
  }

  void go_to(double time) {
    if (time <= time_) return;
    if (rate_ == 0.0) rate_ = at_.fastest_rate();
    const bool in_equal_steps = scene_.file.has_contact() || changes_in_every_step(scene_.file);
    const StepResult result = in_equal_steps ? step_to(time) : advance_to(time);
    if (!result.ok())
      throw SolverError(fmt::format("/events: the motion up to {:.6g} s ends with {}", time, to_string(result)));
    time_ = time;
  }

  StepResult advance_to(double time) {
    // as in run_timed: the velocity error that belongs to a position error
    const double position = tolerance * scene_.edge;
    const Tolerance allowed{position, position * std::max(rate_ / 16, 1.0 / scene_.file.duration)};
    return integrator_.advance(at_.body().system(), at_.body().motion(), time - time_, allowed);
  }

  /// Through contact, and under loads that change in time.
  StepResult step_to(double time) {
    const double steps = std::max(1.0, std::ceil((time - time_) * rate_ / contact_phase)), h = (time - time_) / steps;
    StepResult result;
    for (double k = 0; k < steps && result.ok(); ++k) {
      result = at_.step(integrator_, at_.body().system(), time_ + k * h, h);
    }
    return result;
  }

  const FrozenScene& scene_;
  FrozenBody at_;
  DormandPrince54 integrator_;
  double rate_ = 0.0, time_ = 0.0;  // [1/s], computed on first use
  std::vector<std::size_t> done_;
};

namespace {

/// A sentence on how a frozen event differs from the event of the scene; empty where it does not.
std::string omission_of(const SceneEvent& event, std::size_t operations) {
  if (operations == 0) return fmt::format("{} is left out: it changes nothing.", event.path);
  if (std::holds_alternative<TearWhereStressed>(event.action))
    return fmt::format("{} tears the same faces at the same times in every run, those of one accurate run.",
                       event.path);
  if (depends_on_positions(event) && event.until > 0.0)
    return fmt::format("{} operates on the same cells in every run, those of one accurate run.", event.path);
  return {};
}

}  // namespace

FrozenScene freeze(const SceneFile& file, const Problem& problem) { return freeze(file, problem, {}); }

FrozenScene freeze(const SceneFile& file, const Problem& problem, std::vector<Eigen::Vector3d> initial_position) {
  if (!initial_position.empty() && initial_position.size() != problem.mesh.points.size())
    throw InputError(
        fmt::format("{} initial positions for {} points", initial_position.size(), problem.mesh.points.size()));
  FrozenScene scene{.file = file,
                    .problem = problem,
                    .initial_position = std::move(initial_position),
                    .needs = {},
                    .changes = {},
                    .omissions = {}};
  scene.file.output = {};
  scene.file.probes.clear();
  scene.file.expect = {};
  if (scene.file.integrator.empty()) scene.file.integrator = "rk4";  // not used here
  std::erase_if(scene.file.events, [&](const SceneEvent& event) {
    const std::string reason = reason_to_omit(event, file);
    if (!reason.empty()) scene.omissions.push_back(fmt::format("{} is left out: {}.", event.path, reason));
    return !reason.empty();
  });
  scene.needs = needs_of(scene.file, problem).body;
  scene.edge = mean_edge(problem.mesh);
  if (file.has_contact()) scene.contact_share = expect_contacts(file, problem).share();
  FrozenBody::Scout scout(scene);
  scene.changes = scout.changes();
  for (std::size_t e = 0; e < scene.file.events.size(); ++e)
    if (std::string omission = omission_of(scene.file.events[e], scout.done(e)); !omission.empty())
      scene.omissions.push_back(std::move(omission));
  // runs repeat what has been found, and looking up a face takes as long as a walk through the body
  for (SceneEvent& event : scene.file.events)
    if (auto* dissociate = std::get_if<Dissociate>(&event.action);
        dissociate != nullptr && !depends_on_positions(event))
      std::get<0>(dissociate->faces).clear();
  return scene;
}

FrozenBody::FrozenBody(const FrozenScene& scene)
    : scene_(scene),
      body_(make_simulated_body(scene.problem, scene.needs)),
      driven_(scene.file, scene.problem.mesh.points),
      forces_(scene.file, scene.problem.mesh, body_->vertices()) {
  for (const SceneEvent& event : scene.file.events) events_.push_back(body_->make_ready(event));
  for (std::size_t k = 0; k < body_->vertices().size() && !scene.initial_position.empty(); ++k)
    body_->motion().x[k] = scene.initial_position[body_->vertices().point[k]];
  if (scene.file.has_contact()) {
    contact_ = std::make_unique<SceneContact>(body_->contacts(), false);
    contact_->start(body_->vertices().position, {}, 0.0);
    look_at_contact();
  }
  while (next_ < scene.changes.size() && scene.changes[next_].time == 0.0) pass();
}

void FrozenBody::pass() {
  const FrozenChange& change = scene_.changes.at(next_++);
  for (const FrozenChange::Operation& operation : change.operations)
    events_[operation.event]->repeat(operation.targets);
  drive(change.time);
  look_at_contact();
}

/// Drives and forces at a time; true where any begins, turns back or ends.
bool FrozenBody::drive(double time) {
  const double after = time + 0x1p-40 * scene_.file.duration;  // so soon that nothing else has changed
  const std::span<const std::uint32_t> point = body_->vertices().point;
  const LoadChange driven = driven_.apply(time, after, point, body_->motion().v);
  const LoadChange forces = forces_.apply(time, after, point, body_->pull(), body_->loads());
  return std::max(driven, forces) == LoadChange::begins_or_ends;
}

bool FrozenBody::load(Integrator& integrator, double time, double h) {
  const std::span<const std::uint32_t> point = body_->vertices().point;
  const bool driven = driven_.follow(time, time + h, point, body_->motion().v);
  if (driven) integrator.drives_changed();
  const bool forced = forces_.follow(time, time + h, point, body_->pull(), body_->loads());
  return driven || forced;
}

void FrozenBody::show_drives(double time, std::span<Eigen::Vector3d> velocity) {
  // a time over which places differ by enough, and turns are straight
  const double before = 0x1p-20 * scene_.file.duration;
  driven_.follow(time - before, time, body_->vertices().point, velocity);
}

void FrozenBody::look_at_contact() {
  if (contact_) contact_->system_changed(body_->system(), body_->vertices().position);
}

StepResult FrozenBody::step(Integrator& integrator, const SpringSystem& system, double time, double h) {
  load(integrator, time, h);
  return contact_ ? contact_->step(integrator, system, body_->motion(), time, h)
                  : integrator.step(system, body_->motion(), h);
}

StableStep FrozenBody::limits() const {
  const SpringSystem system = body_->system();
  const StableStep limits = StableStepEstimate().refresh(system, body_->vertices().position);
  if (!contact_) return limits;
  return with_contact(limits, contact_rate(system, body_->contacts(), scene_.contact_share));
}

double FrozenBody::fastest_rate() const {
  const StableStep found = limits();
  double rate = max_or_nan(found.upper, found.viscous_rate.upper);
  if (found.damping_rate.upper < Scheme::unlimited) rate = max_or_nan(rate, found.damping_rate.upper);
  return rate;
}

}  // namespace dartboard
