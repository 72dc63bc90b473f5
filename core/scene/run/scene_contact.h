#pragma once
// The contact of a run with obstacles and between bodies: what is done around each step, and what is found out on the
// way.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/contact/body_contact.h"
#include "core/contact/contact_impulses.h"
#include "core/contact/obstacle_contact.h"
#include "core/scene/body/contact_forecast.h"
#include "core/scene/body/diagnostics.h"
#include "core/time/system/accelerations.h"
#include "core/time/system/spring_system.h"

namespace dartboard {

/// Something about a contact that a user should know. Each kind is told once, where it is found first.
struct ContactWarning {
  enum class Kind : std::uint8_t {
    starts_inside,  // value: how deep [m]; `samples` places do
    too_deep,       // value: the depth [m]; limit: that of the law
    too_fast,       // value: the way in one step relative to the obstacle [m]; limit: half of what is least thick
    will_be_fast,   // the same by the speeds that are expected, before the run; no sample
    out_of_reach,   // a sample is so far in a body that no way out is found: it feels nothing; value: a depth [m] that
                    // it had before, or 0; `samples` are
  };
  Kind kind{};
  bool of_bodies = false;      // not with an obstacle
  double time = 0.0;           // [s]
  std::uint32_t obstacle = 0;  // of the scene
  std::uint32_t from = 0;      // the body that comes in
  std::uint32_t into = 0;      // which; of what is too fast, both are 0 where that is not known
  std::uint64_t samples = 1;
  std::vector<std::uint32_t> nodes;  // of the sample: one vertex, or the corners of a face
  double value = 0.0, limit = 0.0;

  template <class Archive>
  void state(Archive& archive) {
    archive(kind, of_bodies, time, obstacle, from, into, samples, nodes, value, limit);
  }
};
/// "at t = 0.12 s: vertex 5 is 0.003 m inside /contact/obstacles/0, deeper than the 0.002 m of its law"; paths of the
/// obstacles and of the bodies.
std::string to_string(const ContactWarning& warning, std::span<const std::string> obstacles,
                      std::span<const std::string> bodies);

/// Wraps each step of any integrator: ContactImpulses::begin, the step, ContactImpulses::end.
class SceneContact {
 public:
  /// Of both terms, or of one: the other is null. `undoes`: a step may have to be taken back, for which velocities are
  /// kept.
  /// pre  the contacts live as long as this
  SceneContact(ObstacleContact* obstacles, BodyContact* bodies, bool undoes);

  /// Look for what starts inside, and for what will be too fast for steps of h [s].
  void start(std::span<const Eigen::Vector3d> x, std::span<const ContactForecast> expected,
             std::span<const TouchForecast> expected_touches, double h);
  /// The system has other parts than before, or other tetrahedra along its boundary at these places.
  void system_changed(const SpringSystem& system, std::span<const Eigen::Vector3d> x);

  /// After its state has been read, for a body at these places.
  void resume(std::span<const Eigen::Vector3d> x);

  /// Before a step from `time` [s] of length h [s]: true if the integrator has to forget what it remembers.
  bool begin(double time, double h, const SpringSystem& system, Motion motion);
  /// After it, the same.
  /// cost  O(samples), and O(vertices) beside balls, blocks and bodies until what moves too fast for them is found
  bool end(double time, double h, const SpringSystem& system, Motion motion);
  /// In place of `end`, where the step was not taken: all is as it was before `begin`.
  void undo(double time, Motion motion);
  /// Obstacles to where they are at a time, for a body that has gone back to its state there.
  void go_to(double time) {
    if (obstacles_ != nullptr) obstacles_->place_at(time);
  }

  /// Work done on the body since this was asked last [J].
  double new_work();

  ContactDiagnostics diagnostics(std::span<const Eigen::Vector3d> x) const;
  const std::vector<ContactWarning>& warnings() const { return warnings_; }
  /// Null where there is none.
  const ObstacleContact* obstacles() const { return obstacles_; }
  const BodyContact* bodies() const { return bodies_; }
  std::size_t bytes() const;

  template <class Archive>
  void state(Archive& archive) {
    archive(impulses_, warnings_, work_told_, least_altitude_);
  }

 private:
  bool has_told(ContactWarning::Kind kind, bool of_bodies = false) const;
  void look_for_depth(double time, std::span<const Eigen::Vector3d> x);
  void look_for_speed(double time, double h, std::span<const Eigen::Vector3d> v);
  void start_bodies(std::span<const Eigen::Vector3d> x, std::span<const TouchForecast> expected, double h);
  void look_for_lost(double time, std::span<const Eigen::Vector3d> x);
  void look_for_depth_of_bodies(double time, std::span<const Eigen::Vector3d> x);
  void look_for_speed_of_bodies(double time, double h, std::span<const Eigen::Vector3d> v);
  ContactWarning inside_body(ContactWarning::Kind kind, double time, const BodyTouch& touch) const;

  ObstacleContact* obstacles_;
  BodyContact* bodies_;
  ContactImpulses impulses_;
  Terms terms_;
  bool undoes_;
  std::vector<Eigen::Vector3d> kept_v_;
  std::vector<ContactWarning> warnings_;
  double work_told_ = 0.0;       // [J]
  double least_altitude_ = 0.0;  // [m] of the tetrahedra along the boundary, as the system last changed
};

}  // namespace dartboard
