#include "core/scene/scene_output.h"

#include <fmt/format.h>

#include "core/plain/error.h"
#include "core/scene/write_vtu.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;

void require_empty_folder(const fs::path& folder) {
  std::error_code error;
  const auto fail = [&folder](const std::string& what) {
    throw IoError(fmt::format("{}: {}; expected a new or empty folder for the results", folder.string(), what));
  };
  if (folder.empty()) fail("is no name");
  const bool exists = fs::exists(folder, error);
  if (error) fail(error.message());
  if (!exists) {
    fs::create_directories(folder, error);
    if (error) fail("cannot be created: " + error.message());
    return;
  }
  if (!fs::is_directory(folder, error)) fail("is a file");
  const bool empty = fs::is_empty(folder, error);
  if (error) fail("cannot be read: " + error.message());
  if (!empty) fail("is not empty");
}

}  // namespace

SceneOutput::SceneOutput(fs::path folder) : folder_(std::move(folder)) {
  require_empty_folder(folder_);
  const fs::path file = folder_ / "diagnostics.csv";
  diagnostics_.open(file, std::ios::binary);
  diagnostics_ << diagnostics_header() << std::flush;
  if (!diagnostics_) throw IoError(fmt::format("{}: cannot be written", file.string()));
}

void SceneOutput::write(const Frame& frame) {
  const std::string name = fmt::format("frame_{:06}.vtu", frames_.size());
  write_vtu(folder_ / name, frame);
  frames_.push_back({frame.time, name});
  write_pvd(folder_ / "frames.pvd", frames_);
}

void SceneOutput::write(const Diagnostics& diagnostics) {
  diagnostics_ << diagnostics_row(diagnostics) << std::flush;
  if (!diagnostics_)
    throw IoError(
        fmt::format("{}: a row could not be written; is the disk full?", (folder_ / "diagnostics.csv").string()));
}

}  // namespace dartboard
