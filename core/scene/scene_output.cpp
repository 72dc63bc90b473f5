#include "core/scene/scene_output.h"

#include <fmt/format.h>

#include <cerrno>

#include "core/plain/error.h"
#include "core/scene/atomic_file.h"
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

SceneOutput::SceneOutput(fs::path folder, std::span<const Probe> probes, int dimension)
    : folder_(std::move(folder)), list_(folder_ / "frames.pvd") {
  require_empty_folder(folder_);
  const auto begin = [this](std::ofstream& out, const char* name, const std::string& header) {
    errno = 0;
    out.open(folder_ / name, std::ios::binary);
    out << header << std::flush;
    if (!out) throw_not_written(folder_ / name);
  };
  begin(diagnostics_, "diagnostics.csv", diagnostics_header(dimension));
  if (!probes.empty()) begin(probes_, "probes.csv", probes_header(probes));
}

void SceneOutput::write(const Frame& frame) {
  const std::string name = fmt::format("frame_{:06}.vtu", list_.size());
  write_vtu(folder_ / name, frame);
  list_.add({frame.time, name});
}

void SceneOutput::write(const Diagnostics& diagnostics) {
  write_row(diagnostics_, "diagnostics.csv", diagnostics_row(diagnostics));
}

void SceneOutput::write(const ProbeRow& row) {
  if (probes_.is_open()) write_row(probes_, "probes.csv", probes_row(row));
}

void SceneOutput::write_row(std::ofstream& out, const char* name, const std::string& row) const {
  errno = 0;
  out << row << std::flush;
  if (!out) throw_not_written(folder_ / name);
}

}  // namespace dartboard
