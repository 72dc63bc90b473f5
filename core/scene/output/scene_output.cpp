#include "core/scene/output/scene_output.h"

#include <fmt/format.h>

#include <cerrno>

#include "core/scene/output/atomic_file.h"
#include "core/scene/output/write_vtu.h"

namespace dartboard {
SceneOutput::SceneOutput(std::filesystem::path folder, std::span<const Probe> probes, int dimension)
    : claim_(folder), folder_(std::move(folder)), list_(folder_ / "frames.pvd") {
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
