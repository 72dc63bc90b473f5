#pragma once
// A scene that runs: body, integrator and events, one step at a time.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/diagnostics.h"
#include "core/scene/event_clock.h"
#include "core/scene/frame.h"
#include "core/scene/scene_file.h"
#include "core/scene/simulated_body.h"
#include "core/time/integrator.h"

namespace dartboard {

/// Why a run had to stop: the motion is no longer one.
struct Divergence {
  std::uint64_t step = 0;  // the one that failed
  double time = 0.0;       // [s] at its end
  std::string quantity;    // "position", "speed", "stress", or what the integrator reports
  std::uint32_t vertex = 0;
  double value = 0.0;
};
/// "diverged at step 12, t = 0.012 s: speed of vertex 3 is 4.1e+08"
std::string to_string(const Divergence& divergence);

/// How much dissociations changed what they must not change: the largest over all events that only dissociate.
struct EventJumps {
  std::uint64_t events = 0;  // that dissociated
  double mass = 0.0;         // relative to the mass before
  double momentum = 0.0;     // relative to the sum of m |v|
  double energy = 0.0;       // kinetic and elastic, relative to their sum before
};

/// What is due at a step boundary happens before the state there is looked at: at the start by the constructor, then at
/// the end of each step.
class Simulation {
 public:
  /// throws  InputError naming the path of the key for a scene that its mesh does not fit; IoError for a mesh that
  ///         cannot be read
  explicit Simulation(const SceneFile& scene);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Steps in all: the run is over at the first multiple of the step that is not before the duration.
  std::uint64_t step_count() const { return step_count_; }
  std::uint64_t steps_done() const { return done_; }
  /// [s] steps_done() * step
  double time() const { return static_cast<double>(done_) * step_; }

  /// One step, then the events due at its end.
  ///
  /// The motion has diverged when a position or velocity is not finite or a vertex moves faster than light, whose speed
  /// no energy of the scene allows; the body is as it was then, of no further use.
  std::optional<Divergence> advance();

  const SimulatedBody& body() const { return *body_; }
  std::size_t operations() const { return operations_; }
  Diagnostics diagnostics() const;
  Frame frame() const;

  /// Measure momentum and energy on both sides of events from now on. It reads and changes nothing.
  void watch_events(bool watch) { watch_ = watch; }
  const EventJumps& jumps() const { return jumps_; }
  const WorkCounters& work() const { return integrator_->work(); }

 private:
  struct Scheduled {
    std::unique_ptr<ReadyEvent> event;
    EventClock clock;
    bool dissociates;  // and does nothing else
  };
  struct Sums;
  Sums sums() const;
  void happen();
  void compare(const Sums& before);
  std::optional<Divergence> diverged() const;
  Divergence failure(std::string quantity, std::uint32_t vertex, double value) const;

  double step_;
  std::uint64_t step_count_, done_ = 0;
  std::unique_ptr<SimulatedBody> body_;
  std::unique_ptr<Integrator> integrator_;
  std::vector<Scheduled> events_;
  std::size_t operations_ = 0;
  bool watch_ = false;
  EventJumps jumps_;
};

}  // namespace dartboard
