#pragma once
// The files that a run leaves in its folder: frames, their list, and diagnostics.

#include <filesystem>
#include <fstream>
#include <span>
#include <string>

#include "core/plain/folder_claim.h"
#include "core/scene/body/diagnostics.h"
#include "core/scene/body/frame.h"
#include "core/scene/output/write_pvd.h"
#include "core/scene/run/probes.h"

namespace dartboard {

/// frame_000000.vtu, frame_000001.vtu ..., frames.pvd and diagnostics.csv; probes.csv where there are probes. All of
/// them are valid at any moment: frames appear whole, the list names only those that are there, rows are flushed one by
/// one.
class SceneOutput {
 public:
  /// Creates the folder, and those above it, for a body of cells of a dimension.
  /// throws  IoError if it exists and is not an empty folder, is claimed by another run, or cannot be created
  explicit SceneOutput(std::filesystem::path folder, std::span<const Probe> probes = {}, int dimension = 3);

  /// throws  IoError if a file cannot be written (below too)
  void write(const Frame& frame);
  void write(const Diagnostics& diagnostics);
  void write(const ProbeRow& row);

  const std::filesystem::path& folder() const { return folder_; }
  std::size_t frame_count() const { return list_.size(); }

 private:
  void write_row(std::ofstream& out, const char* name, const std::string& row) const;

  FolderClaim claim_;
  std::filesystem::path folder_;
  PvdFile list_;
  std::ofstream diagnostics_, probes_;
};

}  // namespace dartboard
