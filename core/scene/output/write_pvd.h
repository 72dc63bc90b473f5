#pragma once
// The list of the frames of a run with their times, for ParaView.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

namespace dartboard {

struct FrameFile {
  double time;       // [s]
  std::string file;  // relative to the .pvd
};

/// A .pvd file that grows: each entry is written over the end of the file, together with a new end, so that the file is
/// valid after every frame, however the run ends.
class PvdFile {
 public:
  explicit PvdFile(std::filesystem::path path) : path_(std::move(path)) {}
  /// Go on with a list after `size` entries, which end at byte `entries_end`: the rest of the file is cut off.
  /// throws  IoError if it cannot be written
  PvdFile(std::filesystem::path path, std::size_t size, std::uint64_t entries_end);

  /// throws  IoError if it cannot be written
  /// cost    that of the entry
  void add(const FrameFile& frame);
  std::size_t size() const { return size_; }
  /// Where the last entry ends, in bytes.
  std::uint64_t entries_end() const { return entries_end_; }

 private:
  std::filesystem::path path_;
  std::ofstream file_;  // from the first frame on
  std::size_t size_ = 0;
  std::uint64_t entries_end_ = 0;
};

}  // namespace dartboard
