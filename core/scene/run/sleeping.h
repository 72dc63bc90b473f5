#pragma once
// The components of a body that have come to rest and are no longer stepped, until something wakes them.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/archive.h"
#include "core/contact/box_around.h"
#include "core/contact/contacts.h"
#include "core/scene/body/simulated_body.h"
#include "core/scene/file/scene_file.h"
#include "core/time/system/system_part.h"

namespace dartboard {

/// A component is what springs, elements and attachments hold together. Where no vertex of it has been faster than the
/// speed of the rule for its time, it keeps its places, its velocities become zero, and only the rest of the body is
/// stepped: as a system of its own, with contact of its own. Where nothing sleeps, the body itself is stepped.
///
/// **It falls asleep** together with all components that its box, the least along the axes, comes near to, if these may
/// touch it: all of them have to be at rest, or none sleeps. Not at rest are components with a driven vertex that
/// moves, and those near to an obstacle that moves. After an event that changes the body the time is counted anew.
///
/// **It is woken** by an awake component whose box comes near, at once with all sleepers that are near to each other;
/// by a load on it that changes, a drive that begins; by an obstacle that moves near to it; and every event that
/// changes the body wakes all components, whatever they rested on. It goes on from the places that it has kept, bit for
/// bit. Near means closer than an eighth of about the distance of vertices (the diagonal of the box over the cube root
/// of their number), and twice the way of the boxes in a step.
///
/// Boxes are coarse: a body within the hollow of another keeps it awake while it moves.
/// cost  of a step: O(awake vertices) and, for a component that has come nearer to a sleeper, O(components); where
///       something falls asleep or is woken, and after an event while something sleeps, O(body)
class Sleeping {
 public:
  /// pre  the body outlives this
  Sleeping(const SceneSleep& rule, double step, SimulatedBody& body);

  // ---- what is stepped

  SpringSystem system() const { return part_ ? part_->system() : body_.system(); }
  Motion motion() { return part_ ? part_->motion() : body_.motion(); }
  Contacts contacts() { return part_contact_ ? part_contact_->contacts() : body_.contacts(); }
  /// Its vertices in the body; empty for all.
  std::span<const std::uint32_t> vertices() const {
    return part_ ? part_->vertices() : std::span<const std::uint32_t>();
  }
  /// The number in the body of one of its vertices.
  std::uint32_t whole(std::uint32_t vertex) const { return vertex < vertices().size() ? vertices()[vertex] : vertex; }
  /// After the last change of what is stepped: the number now of each sample before, as ContactImpulses::MovedSamples.
  const std::array<std::vector<std::uint32_t>, 2>& moved_samples() const { return moved_samples_; }
  bool is_all_asleep() const { return done_.asleep == components_.size(); }

  // ---- a step

  /// Put the motion of what is stepped into the columns of the body.
  void give();
  /// The body has changed: everything is awake.
  /// returns  whether what is stepped is another part now
  bool body_changed();
  /// The loads of the body have changed, or the velocities of driven vertices.
  bool loads_changed();
  /// Find what falls asleep and what is woken after n steps of the run.
  bool after_step(std::uint64_t n);

  /// What it has done so far, and what sleeps now.
  const SleepDiagnostics& diagnostics() const { return done_; }
  /// Bytes of what is kept by vertex, and of copies.
  std::size_t bytes() const;

  /// Writes it, or reads it into one made of the same scene, whose body has been read.
  void state(Archive& archive);

 private:
  static constexpr std::uint32_t none = VertexSubset::none;
  struct Component {
    std::uint32_t first = 0, count = 0;  // in ordered_
    std::optional<std::uint32_t> group;  // of its skin, where bodies may touch
    double size = 0.0;                   // [m] about the distance of vertices, when it was found
    std::uint64_t slow = 0;              // steps, the last included, after which it was slow
    bool asleep = false;
    std::uint32_t first_in_part = none;   // where something sleeps, of one that is awake
    BoxAround box{{0, 0, 0}, {0, 0, 0}};  // at the last look; of a sleeper always that of its places
    double near = 0.0;                    // [m]
    double free_way = 0.0;                // [m] that its box can move before it may be near to a sleeper
  };

  void find_components();
  std::span<const std::uint32_t> vertices_of(const Component& c) const {
    return std::span(ordered_).subspan(c.first, c.count);
  }
  bool is_slow(const Component& c);
  bool is_driven(const Component& c) const;
  double look_at_box(Component& c);
  bool may_touch(const Component& a, const Component& b) const;
  bool are_near(const Component& a, const Component& b) const;
  bool wake_near_awake();
  bool wake_near_moving_obstacles();
  bool put_to_sleep();
  void put_to_sleep(Component& c);
  void wake(Component& c);
  std::array<std::vector<std::uint32_t>, 2> samples_in_whole();
  void make_part();

  SceneSleep rule_;
  std::uint64_t slow_steps_;  // needed
  SimulatedBody& body_;
  std::vector<std::uint32_t> component_;  // by vertex
  std::vector<std::uint32_t> ordered_;    // vertices, by component
  std::vector<Component> components_;
  std::vector<std::uint32_t> awake_;               // of them, as the part was made
  std::vector<Eigen::Vector3d> pull_, obstacles_;  // at the last look, of all vertices and obstacles
  std::vector<double> pressures_;
  std::unique_ptr<SystemPart> part_;
  std::unique_ptr<ContactOfPart> part_contact_;
  std::array<std::vector<std::uint32_t>, 2> moved_samples_;  // those that obstacles and bodies touch
  SleepDiagnostics done_;
};

}  // namespace dartboard
