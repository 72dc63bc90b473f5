#pragma once
// The contact of a run with obstacles and between bodies: the work around each step, and the warnings found on the
// way.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/contact/contact_impulses.h"
#include "core/contact/contacts.h"
#include "core/scene/body/contact_forecast.h"
#include "core/scene/body/diagnostics.h"
#include "core/scene/body/simulated_body.h"
#include "core/time/method/integrator.h"
#include "core/time/system/accelerations.h"
#include "core/time/system/spring_system.h"

namespace dartboard {

/// Something about a contact that a user should know. Each kind is reported once, where it is found first.
struct ContactWarning {
  enum class Kind : std::uint8_t {
    starts_inside,  // value: how deep [m]; `samples` places are inside
    too_deep,       // value: the depth [m]; limit: that of the law
    too_fast,       // value: the way in one step relative to the obstacle [m]; limit: half of the least thickness
    will_be_fast,   // the same for the expected speeds, before the run; without a sample
    too_thin,   // value: the depth expected [m], before the run; limit: half of the least thickness of an obstacle or
                // body
    too_small,  // an obstacle may come in between samples; value: how far [m], perhaps infinite; limit: the largest
                // distance [m] of a place on the boundary from a sample
    soft_body,  // before the run; value: ContactForecast::stiffness_ratio; limit: the restitution that is not kept
    out_of_reach,   // no exit from a body within reach of a sample, so no force; value: its last known depth [m], or
                    // 0; `samples` places are so deep
    comes_through,  // a sample is driven out on the other side than in the step before; value: its depth [m]
  };
  Kind kind{};
  bool of_bodies = false;      // not with an obstacle
  double time = 0.0;           // [s]
  std::uint32_t obstacle = 0;  // of the scene
  std::uint32_t from = 0;      // the body that enters
  std::uint32_t into = 0;      // the body that is entered; for too_fast, both are 0 where they are not known
  std::uint64_t samples = 1;
  std::vector<std::uint32_t> nodes{};  // of the sample: one vertex, or the corners of a face
  double value = 0.0, limit = 0.0;

  template <class Archive>
  void state(Archive& archive) {
    archive(kind, of_bodies, time, obstacle, from, into, samples, nodes, value, limit);
  }
};
/// "at t = 0.12 s: vertex 5 is 0.003 m inside /contact/obstacles/0, deeper than the 0.002 m of its law"; `obstacles`
/// and `bodies` are their paths.
std::string to_string(const ContactWarning& warning, std::span<const std::string> obstacles,
                      std::span<const std::string> bodies);

/// Steps of any integrator with the work of contact around them, ContactImpulses, and what they find to warn of.
class SceneContact {
 public:
  /// `undoes`: a step may fail, or be stopped, and has to be taken back, for which velocities are kept.
  SceneContact(const Contacts& contacts, bool undoes);

  /// Find samples that start inside, and speeds that will be too high for steps of h [s].
  void start(std::span<const Eigen::Vector3d> x, const ExpectedContacts& expected, double h);
  /// The system has other parts than before, or other tetrahedra along its boundary at these places.
  void system_changed(const SpringSystem& system, std::span<const Eigen::Vector3d> x);

  /// Continue with another part of the body, or with the whole, as ContactImpulses::change_part. `vertices` are the
  /// numbers of its vertices in the whole, by which warnings name them; empty for the whole.
  /// pre  system_changed follows
  void change_part(const Contacts& contacts, const ContactImpulses::MovedSamples& moved_to,
                   std::span<const std::uint32_t> vertices);

  /// Continue after the state has been read, for a body at these places.
  void resume(std::span<const Eigen::Vector3d> x);

  /// One step from `time` [s] of length h [s]. One that fails or is stopped leaves the velocities, the losses and the
  /// obstacles as they were.
  /// throws  Stopped
  /// cost    besides the step O(samples), and with balls, blocks or bodies O(vertices) until a vertex that is too fast
  ///         for them is found
  StepResult step(Integrator& integrator, const SpringSystem& system, Motion motion, double time, double h);
  /// The present sums are those of the state that the body may go back to.
  void keep() { kept_ = {impulses_.losses(), work_reported_}; }
  /// Continue from that state, which is of `time` [s]; warnings stay.
  void go_back(double time);
  /// Move obstacles to their places at a time, for a body that is not stepped until then.
  void go_to(double time) {
    if (contacts_.obstacles != nullptr) contacts_.obstacles->place_at(time);
  }

  const ContactLosses& losses() const { return impulses_.losses(); }
  /// Work done on the body since the last call [J].
  double new_work();

  /// Of all contacts of a body at these places.
  ContactDiagnostics diagnostics(const SimulatedBody& body) const;
  const std::vector<ContactWarning>& warnings() const { return warnings_; }
  std::size_t bytes() const;

  template <class Archive>
  void state(Archive& archive) {
    archive(impulses_, warnings_, work_reported_, least_altitude_, kept_.losses, kept_.work_reported);
  }

 private:
  /// The way out of a sample, from an obstacle or from a body.
  struct Way {
    std::uint32_t sample, other;
    double depth;
    double allowed = 0.0;  // [m] by its law
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  };

  void look_after_step(double time, double h, Motion motion);
  void undo(double time, Motion motion);
  bool has_warned(ContactWarning::Kind kind, bool of_bodies = false) const;
  std::vector<std::uint32_t> nodes_of(const SkinSample& sample) const;
  std::uint32_t whole(std::uint32_t vertex) const { return vertices_.empty() ? vertex : vertices_[vertex]; }
  void warn(ContactWarning warning);
  void look_ahead(ContactWarning at, const ContactForecast& expected, const ContactLaw& law, double half, double h);
  void look_at_thickness(ContactWarning at, double deepest, double half);
  void look_inside(bool of_bodies, std::span<const Eigen::Vector3d> x);
  void look_for_speed(double time, double h, std::span<const Eigen::Vector3d> v);
  void look_for_lost(double time, std::span<const Eigen::Vector3d> x);
  void start_ways(std::span<const Eigen::Vector3d> x);
  void find_ways(bool of_bodies, std::span<const Eigen::Vector3d> x);
  bool may_warn_of_passages(bool of_bodies) const;
  void look_at_ways(bool of_bodies, double time);
  void look_for_speed_of_bodies(double time, double h, std::span<const Eigen::Vector3d> v);
  ContactWarning warning_of(ContactWarning::Kind kind, bool of_bodies, double time, const Way& way) const;

  Contacts contacts_;
  std::span<const std::uint32_t> vertices_;  // of the part, in the whole; empty: all
  ContactImpulses impulses_;
  Terms terms_;
  bool undoes_;
  std::vector<Eigen::Vector3d> kept_v_;
  std::vector<ContactWarning> warnings_;
  /// After the last two steps: from obstacles, and from bodies.
  struct Ways {
    std::vector<Way> now, before;
  };
  std::array<Ways, 2> ways_;
  double work_reported_ = 0.0;  // [J]
  struct {
    ContactLosses losses;
    double work_reported = 0.0;  // [J]
  } kept_;
  double least_altitude_ = 0.0;  // [m] of the tetrahedra along the boundary, as the system last changed
};

}  // namespace dartboard
