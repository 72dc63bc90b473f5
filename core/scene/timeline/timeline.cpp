#include "core/scene/timeline/timeline.h"

#include <algorithm>

namespace dartboard {

Timeline::Timeline(const SceneFile& scene, const Mesh& mesh, SimulatedBody& body, Integrator& integrator, double step)
    : body_(body),
      integrator_(integrator),
      step_(step),
      driven_(scene, mesh.points),
      forces_(scene, mesh, body.vertices()) {}

std::optional<std::size_t> Timeline::schedule(const SceneEvent& event) {
  events_.push_back({body_.make_ready(event), EventClock(event.from, event.until, event.every, step_),
                     dissociates(event.action), event.path});
  return events_.back().event->facets();
}

void Timeline::happen(std::uint64_t n) {
  std::vector<Scheduled*> due;
  for (Scheduled& scheduled : events_)
    if (scheduled.clock.next() <= n) due.push_back(&scheduled);
  std::ranges::stable_sort(due, {}, [](const Scheduled* one) { return one->clock.time(); });
  for (Scheduled* one : due) {
    while (one->clock.next() <= n) one->clock.advance();
    apply(*one);
  }
}

std::optional<double> Timeline::next_between(double begin, double end) const {
  std::optional<double> next;
  const auto take = [&next](const std::optional<double>& time) {
    if (time && (!next || *time < *next)) next = time;
  };
  for (const Scheduled& scheduled : events_)
    if (const auto time = scheduled.clock.time_between(); time && *time < end) take(time);
  take(driven_.next_between(begin, end));
  take(forces_.next_between(begin, end));
  return next;
}

void Timeline::happen_until(double time) {
  for (Scheduled& scheduled : events_) {
    const auto due = scheduled.clock.time_between();
    if (!due || *due > time) continue;
    scheduled.clock.advance_from_between();
    apply(scheduled);
  }
}

// The next event may throw: the integrator is restarted after each.
void Timeline::apply(Scheduled& scheduled) {
  const std::size_t made =
      watch_ && scheduled.dissociates ? apply_watched(*scheduled.event, body_, jumps_) : scheduled.event->apply();
  scheduled.was_due = true;
  scheduled.operations += made;
  operations_ += made;
  if (made > 0) integrator_.restart();
}

// No integrator keeps anything that the values of forces are in.
LoadChange Timeline::drive(double begin, double end) {
  const LoadChange driven = driven_.apply(begin, end, body_.vertices().point, body_.motion().v);
  const LoadChange forces = forces_.apply(begin, end, body_.vertices().point, body_.pull(), body_.loads());
  if (driven == LoadChange::begins_or_ends || forces == LoadChange::begins_or_ends)
    integrator_.restart();
  else if (driven == LoadChange::in_value)
    integrator_.drives_changed();
  return std::max(driven, forces);
}

std::vector<std::string> Timeline::idle_events() const {
  std::vector<std::string> paths;
  for (const Scheduled& scheduled : events_)
    if (scheduled.was_due && scheduled.operations == 0) paths.push_back(scheduled.path);
  return paths;
}

MemoryReport Timeline::memory() const {
  MemoryReport report{{Part::pull, forces_.bytes()}};
  for (std::size_t k = 0; k < events_.size(); ++k) report.push_back({Part::event, events_[k].event->bytes(), k});
  return report;
}

void Timeline::state(Archive& archive) {
  archive.part("driven vertices");
  archive(driven_, forces_);
  archive.part("events");
  archive(operations_, jumps_);
  for (Scheduled& scheduled : events_) {
    archive(scheduled.clock, scheduled.was_due, scheduled.operations);
    scheduled.event->state(archive);
  }
}

void Timeline::extend() {
  for (Scheduled& scheduled : events_) scheduled.clock.extend();
}

}  // namespace dartboard
