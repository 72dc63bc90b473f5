#pragma once
// The files that a run writes into its folder: frames, their list, and diagnostics.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/folder_claim.h"
#include "core/scene/body/diagnostics.h"
#include "core/scene/body/frame.h"
#include "core/scene/output/write_pvd.h"
#include "core/scene/run/probes.h"

namespace dartboard {

/// A text file up to a byte: this length, and a hash of the bytes until there. The file may have grown since.
struct TextSoFar {
  std::uint64_t bytes = 0, hash = 0xcbf29ce484222325u;

  /// Go on to a later byte.
  /// throws  IoError if the file cannot be read, or is shorter
  void extend(const std::filesystem::path& file, std::uint64_t to);
  friend bool operator==(const TextSoFar&, const TextSoFar&) = default;
  template <class Archive>
  void state(Archive& archive) {
    archive(bytes, hash);
  }
};

/// The output that a run has written until a checkpoint.
struct OutputSoFar {
  std::vector<std::uint64_t> frame_bytes{};   // the length of each frame
  TextSoFar list{}, diagnostics{}, probes{};  // of frames.pvd: up to the end of its last entry
  template <class Archive>
  void state(Archive& archive) {
    archive(frame_bytes, list, diagnostics, probes);
  }
};

/// frame_000000.vtu, frame_000001.vtu ..., frames.pvd and diagnostics.csv; probes.csv where there are probes. All of
/// them are valid at any moment: frames appear whole, the list names only existing frames, rows are flushed one by
/// one.
class SceneOutput {
 public:
  /// Creates the folder, and those above it, for a body of cells of a dimension.
  /// throws  IoError if it exists and is not an empty folder, is claimed by another run, or cannot be created
  explicit SceneOutput(std::filesystem::path folder, std::span<const Probe> probes = {}, int dimension = 3,
                       bool with_applied = false, bool with_contact = false, bool with_sleep = false);

  /// Go on in the folder of a run, from one of its checkpoints: rows and frames after that are dropped, since they will
  /// be written again.
  ///
  /// throws  IoError if a frame or a part of a table is missing, or has been changed, or a file cannot be written.
  ///         Everything is checked before anything is changed
  SceneOutput(FolderClaim claim, std::filesystem::path folder, OutputSoFar so_far, std::span<const Probe> probes = {});

  /// The output until now.
  /// cost  reads what the tables have gained since the last call
  const OutputSoFar& so_far();

  /// From now on the arrays of frames are compressed.
  void compress(std::optional<Compressor> compressor) { frames_->compressor = compressor; }

  /// throws  IoError if a file cannot be written (below too)
  void write(const Frame& frame);
  /// Writes by another thread, once the last frame is written: what that one has thrown is thrown here.
  void write_later(const Frame& frame);
  /// Wait for the last frame. Without it, what is thrown when it is written is lost.
  void finish();
  void write(const Diagnostics& diagnostics);
  void write(const ProbeRow& row);

  /// Is this the name of a file that it writes?
  static bool writes(std::string_view name);

  const std::filesystem::path& folder() const { return folder_; }
  /// Those that are written, or being written.
  std::size_t frame_count() const { return frame_count_; }

 private:
  void write_row(std::ofstream& out, const char* name, const std::string& row) const;

  /// What is written into while another thread writes a frame.
  struct Frames {
    std::filesystem::path folder;
    PvdFile list;
    std::optional<Compressor> compressor{};
    std::vector<std::uint64_t> bytes{};  // of each
    void write(const Frame& frame);
  };

  FolderClaim claim_;
  std::filesystem::path folder_;
  std::unique_ptr<Frames> frames_;
  std::size_t frame_count_ = 0;
  std::ofstream diagnostics_, probes_;
  OutputSoFar so_far_;
  std::future<void> writing_{};  // ends before the files are closed
};

}  // namespace dartboard
