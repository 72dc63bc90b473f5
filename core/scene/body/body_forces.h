#pragma once
// All forces of a body but those of its springs: their terms, in the order in which they are added.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/contact/contacts.h"
#include "core/scene/body/memory.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/forces/body_force.h"

namespace dartboard {

/// Elements and springs within cells, whose rows are columns of the body; the kinds of core/scene/forces, which follow
/// it by themselves; contact, last.
class BodyForces {
 public:
  /// A term that the body or a part of it owns, before those of the other forces; null: none.
  void add(const ForceTerm* term) {
    if (term != nullptr) terms_.insert(terms_.begin() + own_terms_++, term);
  }
  /// Those of the needs that a body at this site has.
  void make(std::span<const ForceNeed> needs, const ForceSite& site);
  /// Contact of these samples, which outlive it, with obstacles.
  void touch_obstacles(const std::vector<SceneObstacle>& obstacles, const std::vector<SkinSample>& samples);
  /// Contact between bodies, of this one or of its part.
  void touch_bodies(std::unique_ptr<BodyContact> contact);
  void touch_bodies(BodyContact* of_part);

  ForceTerms terms() const { return terms_; }
  /// The terms of a list of them without those of contact.
  ForceTerms terms_but_contact(ForceTerms terms) const {
    return terms.first(terms.size() - (obstacles_ ? 1 : 0) - (bodies_ != nullptr ? 1 : 0));
  }
  Contacts contacts() const { return {obstacles_.get(), bodies_}; }

  /// Call f(force) for each of the kinds of core/scene/forces.
  template <class F>
  void for_each(const F& f) const {
    for (const Kept& kept : kept_) f(*kept.force);
  }
  /// The force whose values a timeline sets; null without one.
  BodyForce* with_loads() const;

  bool do_work() const;
  void begin_work(std::span<const Eigen::Vector3d> x) const;
  /// [J] of all that do work.
  double work(std::span<const Eigen::Vector3d> x, double h) const;

  void state(Archive& archive);
  /// The bytes of the kinds of core/scene/forces.
  void report(MemoryReport& report) const;

 private:
  struct Kept {
    std::size_t kind;
    std::unique_ptr<BodyForce> force;
  };

  std::vector<Kept> kept_;
  std::unique_ptr<ObstacleContact> obstacles_;
  std::unique_ptr<BodyContact> own_bodies_;
  BodyContact* bodies_ = nullptr;
  std::vector<const ForceTerm*> terms_;
  std::ptrdiff_t own_terms_ = 0;
};

}  // namespace dartboard
