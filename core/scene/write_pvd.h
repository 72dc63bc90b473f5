#pragma once
// The list of the frames of a run with their times, which ParaView plays.

#include <filesystem>
#include <span>
#include <string>

namespace dartboard {

struct FrameFile {
  double time;       // [s]
  std::string file;  // relative to the .pvd
};

/// The text of a .pvd file.
std::string to_pvd(std::span<const FrameFile> frames);

/// Replaces the file, so that it is valid after every frame, however the run ends.
///
/// throws  IoError if it cannot be written
void write_pvd(const std::filesystem::path& path, std::span<const FrameFile> frames);

}  // namespace dartboard
