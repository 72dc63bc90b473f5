#pragma once
// Questions to ipctk about surfaces that touch, with our own findings, and its answers; both as text.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/contact/body_contact.h"

namespace dartboard {

/// A sample in contact: a mean of vertices.
struct IpctkSample {
  std::vector<std::uint32_t> nodes;
  std::uint32_t body = 0;  // that it is inside of
  double depth = 0.0;      // [m] ours
};

/// The vertices of all surfaces at one time.
struct IpctkPlace {
  std::vector<Eigen::Vector3d> x;    // [m]
  std::vector<IpctkSample> samples;  // all contacts
  bool felt = false;                 // there is a contact of ours, or a sample out of reach
};

/// Vertices have numbers of their own: those within a body are left out.
struct IpctkQuestion {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> bodies;  // by triangle
  bool in_motion = false;             // each place follows the one before after a step
  std::vector<IpctkPlace> places;
};

struct IpctkAnswer {
  std::vector<bool> crossing;                // by place: surfaces cross
  std::vector<std::vector<double>> squares;  // [m^2] by place and sample: to the nearest triangle of the body
  std::vector<bool> free;                    // by step of a motion: nothing collides on the straight way
};

/// The boundary of the bodies of a contact.
class IpctkSurfaces {
 public:
  /// pre  the contact lives as long as this
  explicit IpctkSurfaces(const BodyContact& contact);
  /// A question without places.
  IpctkQuestion question(bool in_motion) const;
  /// The vertices of the boundary, and what the contact finds there.
  IpctkPlace at(std::span<const Eigen::Vector3d> x) const;

 private:
  const BodyContact& contact_;
  std::vector<std::uint32_t> vertices_;  // of the boundary, ascending
  std::vector<std::uint32_t> number_;    // by vertex of the bodies
};

/// JSON that reference/ipctk/certify.py reads: without our findings, and with all digits.
std::string text_of(std::span<const IpctkQuestion> questions);

/// throws  IoError where something is missing, too much, or no finite number
std::vector<IpctkAnswer> answers_of(std::string_view text, std::span<const IpctkQuestion> questions);

}  // namespace dartboard
