#pragma once
// The motions of two runs of scenes: how far apart their vertices are, and from when on.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dartboard {

/// The distance of two bodies at a time, in edge lengths.
struct FrameDistance {
  double time = 0.0;  // [s]
  double largest = 0.0, root_mean_square = 0.0;
  std::size_t vertex = 0;  // of the largest, as frames number them
};

struct ComparedMotion {
  double edge = 0.0;                       // [m] the median of the first frame of the first run
  std::vector<FrameDistance> distances{};  // at the times of frames of both, as long as they have the same cells
  std::optional<double> cells_part{};      // [s] the first of these times at which they have not
  std::size_t frames[2]{};                 // of each run

  const FrameDistance* furthest() const;
  /// [s] The first time at which some vertex is further off than so many edge lengths.
  std::optional<double> further_than(double edges) const;
};

/// Compare the frames in two folders, vertex by vertex in their order, which is the same for the same cells.
///
/// throws  IoError where the list of frames or a frame is missing or damaged
ComparedMotion compare_motion(const std::filesystem::path& first, const std::filesystem::path& second);

/// A column of diagnostics.csv or probes.csv.
struct ComparedColumn {
  std::string file, name;
  double largest = 0.0;  // difference, in its unit
  double at = 0.0;       // [s] where it is that
  double scale = 0.0;    // the largest value of the first run
};
/// The columns of both runs that differ at times of both.
///
/// throws  IoError for a damaged file; one that a run has not written is left out
std::vector<ComparedColumn> compare_columns(const std::filesystem::path& first, const std::filesystem::path& second);

}  // namespace dartboard
