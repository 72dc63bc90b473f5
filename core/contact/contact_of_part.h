#pragma once
// The contact of a part of a body.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/contact/body_contact.h"
#include "core/contact/obstacle_contact.h"
#include "core/contact/skin_samples.h"
#include "core/contact/skin_solids.h"

namespace dartboard {

/// Copies of the samples at the vertices of a part, and their numbers in the whole.
struct SamplesOfPart {
  std::vector<SkinSample> samples;
  std::vector<std::uint32_t> whole;

  SamplesOfPart() = default;
  SamplesOfPart(const std::vector<SkinSample>& of_whole, const VertexSubset& part);
};

/// Contact terms over the samples, tetrahedra and triangles at the vertices of a part, by the numbers of its vertices
/// and with the laws of the whole. Samples keep their order, so contacts have the bits that they have in the whole
/// where nothing outside of the part is touched.
class ContactOfPart {
 public:
  /// Obstacles are where those of the whole are. A null pointer: there is no such contact.
  /// pre  faces and cells have all of their vertices in the part, or none
  ContactOfPart(const ObstacleContact* obstacles, const BodyContact* bodies, const VertexSubset& part);
  ContactOfPart(const ContactOfPart&) = delete;  // terms refer to columns in place
  ContactOfPart& operator=(const ContactOfPart&) = delete;

  ObstacleContact* obstacles() { return obstacles_.get(); }
  BodyContact* bodies() { return bodies_.get(); }
  /// The numbers in the whole of the samples of either.
  std::span<const std::uint32_t> samples_of_obstacles() const { return near_obstacles_.whole; }
  std::span<const std::uint32_t> samples_of_bodies() const { return near_bodies_.whole; }

  std::size_t bytes() const;

 private:
  SamplesOfPart near_obstacles_, near_bodies_;
  SkinSolids solids_;
  std::unique_ptr<ObstacleContact> obstacles_;
  std::unique_ptr<BodyContact> bodies_;
};

}  // namespace dartboard
