#pragma once
// A run as a page plays it: what can be seen of its bodies from any side, and its diagnostics.

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/figures/album.h"
#include "core/scene/body/diagnostics.h"
#include "core/scene/run/probes.h"

namespace dartboard {

/// The part of frames that stays until a body is changed: facets, links, and the points that these have.
struct PlayedShape {
  std::vector<std::int64_t> number;          // by point: in the file of the mesh, or -1: refinement made it
  std::vector<std::uint8_t> held;            // by point, as in a frame
  std::vector<std::uint32_t> corners;        // of the facets, one after the other
  std::vector<std::uint8_t> sides;           // by facet: the number of its corners
  std::vector<std::uint8_t> dimension;       // by facet: of its cell
  std::vector<std::uint8_t> was_inside;      // by facet
  std::vector<std::uint32_t> links;          // two points each
  std::vector<std::uint8_t> material, body;  // by facet, then by link
  std::vector<std::uint32_t> component;      // likewise: a number that lasts

  friend bool operator==(const PlayedShape&, const PlayedShape&) = default;
};

/// One picture of it.
struct PlayedFrame {
  using Arrow = std::array<Eigen::Vector3d, 2>;

  double time = 0.0;               // [s]
  std::size_t shape = 0;           // its number
  std::vector<double> places{};    // [m] three by point
  std::vector<float> values[3]{};  // by point: stress, speed, contact force; empty where the scene has none
  std::vector<Arrow> attachments{};
  std::vector<Arrow> loads{};  // place [m] and external force [N] of points, of which many have one
  Diagnostics diagnostics{};
  ProbeRow probes{};
};

/// What a page can play, for `player_page`.
class RecordedFrames : public PicturesOfRun<PlayedFrame> {
 public:
  /// pre  the steps ascend
  RecordedFrames(const Simulation& simulation, std::vector<std::uint64_t> steps, const SceneFile& scene);

  /// Frames, shapes, obstacles and curves as JSON: columns of numbers in base64, places in 16 bits of the extent over
  /// all times, values in 8 bits of the largest. Every other frame is left out until they take no more than
  /// `most_bytes`, or two are left.
  nlohmann::json json(std::size_t most_bytes) const;

 private:
  nlohmann::json diagrams() const;
  PlayedFrame picture_of(const Simulation& simulation) override;

  const SceneFile& scene_;
  int dimension_;  // of its cells
  FrameFields fields_;
  FrameFacets facets_;
  LastingComponents components_;
  std::vector<PlayedShape> shapes_;
  std::string units_[3];  // of values
};

}  // namespace dartboard
