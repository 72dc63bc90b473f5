#pragma once
// The contact of a body, or of a part of it: with obstacles and between bodies, as one list of touches.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/contact/body_contact.h"
#include "core/contact/obstacle_contact.h"
#include "core/contact/skin_samples.h"
#include "core/contact/skin_solids.h"
#include "core/contact/touch.h"

namespace dartboard {

/// The contact terms of a body. Losses, friction, reports and warnings are written over their touches, once for both.
/// pre  the terms live as long as this
struct Contacts {
  ObstacleContact* obstacles;  // null without
  BodyContact* bodies;         // null without

  Contacts(ObstacleContact* of_obstacles = nullptr, BodyContact* of_bodies = nullptr)
      : obstacles(of_obstacles), bodies(of_bodies) {}

  /// The term with obstacles alone, or that between bodies.
  Contacts only(bool of_bodies) const { return {of_bodies ? nullptr : obstacles, of_bodies ? bodies : nullptr}; }
  bool any() const { return obstacles != nullptr || bodies != nullptr; }
  /// Whether a law has friction, or loses speed: then ContactImpulses are needed.
  bool has_friction() const;
  bool has_damping() const;
  /// The samples of the term with obstacles, or of that between bodies; none without it.
  const std::vector<SkinSample>& samples(bool of_bodies) const;
  const SkinSample& sample(const Touch& touch) const { return samples(touch.in_body != nullptr)[touch.sample]; }

  /// Calls visit(touch) for each sample inside an obstacle, in the order of samples and obstacles; then for each inside
  /// a body, in the order of samples. A touch is valid during the call.
  template <class F>
  void for_each_touch(const StagePlaces& at, const F& visit) const {
    if (obstacles != nullptr)
      obstacles->for_each_touch(at, [&](std::uint32_t sample, std::uint32_t o, const Penetration& in) {
        visit(Touch{.sample = sample,
                    .obstacle = o,
                    .law = &obstacles->laws()[o],
                    .area = obstacles->samples()[sample].area,
                    .depth = in.depth,
                    .normal = in.normal});
      });
    if (bodies != nullptr)
      for (const BodyTouch& t : bodies->touching(at))
        visit(Touch{.sample = t.sample,
                    .law = &bodies->laws()[t.law],
                    .area = t.area,
                    .depth = t.depth,
                    .normal = t.normal,
                    .in_body = &t});
  }
  /// The site of the force along the normal: the sample, less the nearest point of the surface of a body.
  ContactSite normal_site(const Touch& touch) const;
  /// The site of forces across the normal: the sample, less its own place in a body.
  ContactSite tangential_site(const Touch& touch) const;

  ContactState state_at(std::span<const Eigen::Vector3d> x) const;
  /// The sum of those of both terms (ObstacleContact::frequency_squared).
  double frequency_squared(std::span<const double> inverse_mass, double share_of_depth) const;
  std::size_t bytes() const;
};

/// Contact terms over the samples, tetrahedra and triangles at the vertices of a part, by the numbers of its vertices
/// and with the laws of the whole. Samples keep their order, so contacts have the bits that they have in the whole
/// where nothing outside of the part is touched.
class ContactOfPart {
 public:
  /// Obstacles are where those of the whole are.
  /// pre  faces and cells have all of their vertices in the part, or none
  ContactOfPart(const Contacts& whole, const VertexSubset& part);
  ContactOfPart(const ContactOfPart&) = delete;  // terms refer to columns in place
  ContactOfPart& operator=(const ContactOfPart&) = delete;

  Contacts contacts() { return {obstacles_.get(), bodies_.get()}; }
  /// The numbers in the whole of the samples with obstacles, and of those between bodies.
  const std::array<std::vector<std::uint32_t>, 2>& whole_samples() const { return whole_; }

  std::size_t bytes() const;

 private:
  std::array<std::vector<SkinSample>, 2> samples_;
  std::array<std::vector<std::uint32_t>, 2> whole_;
  SkinSolids solids_;
  std::unique_ptr<ObstacleContact> obstacles_;
  std::unique_ptr<BodyContact> bodies_;
};

}  // namespace dartboard
