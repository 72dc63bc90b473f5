#include "core/scene/output/scene_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "core/plain/error.h"
#include "core/scene/output/atomic_file.h"
#include "core/scene/output/write_vtu.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;

fs::path frame_name(std::size_t number) { return fmt::format("frame_{:06}.vtu", number); }

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw IoError(fmt::format("{}: {}; expected what the run left, so nothing has been changed", file.string(), what));
}

std::uint64_t size_of(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) fail(file, fs::exists(file, error) ? "cannot be read" : "is missing");
  return size;
}

void require_text(const fs::path& file, const TextSoFar& expected) {
  if (const std::uint64_t size = size_of(file); size < expected.bytes)
    fail(file, fmt::format("has been shortened to {} of {} bytes", size, expected.bytes));
  TextSoFar found;
  found.extend(file, expected.bytes);
  if (found != expected) fail(file, "has been changed");
}

void require_whole(const fs::path& folder, const OutputSoFar& so_far, bool has_probes) {
  for (std::size_t k = 0; k < so_far.frame_bytes.size(); ++k)
    if (const fs::path file = folder / frame_name(k); size_of(file) != so_far.frame_bytes[k])
      fail(file, fmt::format("has {} bytes, not {}", size_of(file), so_far.frame_bytes[k]));
  require_text(folder / "frames.pvd", so_far.list);
  require_text(folder / "diagnostics.csv", so_far.diagnostics);
  if (has_probes) require_text(folder / "probes.csv", so_far.probes);
}

// The list is the first of the files to be changed.
PvdFile continued_list(const fs::path& folder, const OutputSoFar& so_far, bool has_probes) {
  require_whole(folder, so_far, has_probes);
  return {folder / "frames.pvd", so_far.frame_bytes.size(), so_far.list.bytes};
}

/// A table cut off at a byte, to be written on.
void cut(const fs::path& file, std::uint64_t bytes, std::ofstream& out) {
  errno = 0;
  std::error_code error;
  fs::resize_file(file, bytes, error);
  out.open(file, std::ios::binary | std::ios::in | std::ios::out | std::ios::ate);
  if (error || !out) throw_not_written(file);
}

}  // namespace

void TextSoFar::extend(const fs::path& file, std::uint64_t to) {
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(bytes));
  std::string block(std::min<std::uint64_t>(to - bytes, 65536), '\0');
  while (bytes < to) {
    const auto wanted = static_cast<std::streamsize>(std::min<std::uint64_t>(to - bytes, block.size()));
    if (!in.read(block.data(), wanted)) throw IoError(fmt::format("{}: cannot be read", file.string()));
    // FNV-1a byte by byte: the sizes of the pieces read have no effect
    for (std::streamsize k = 0; k < wanted; ++k)
      hash = (hash ^ static_cast<unsigned char>(block[static_cast<std::size_t>(k)])) * 0x100000001b3u;
    bytes += static_cast<std::uint64_t>(wanted);
  }
}

SceneOutput::SceneOutput(FolderClaim claim, fs::path folder, OutputSoFar so_far, std::span<const Probe> probes)
    : claim_(std::move(claim)),
      folder_(std::move(folder)),
      frames_(std::make_unique<Frames>(Frames{folder_, continued_list(folder_, so_far, !probes.empty())})),
      frame_count_(so_far.frame_bytes.size()),
      so_far_(std::move(so_far)) {
  frames_->bytes = so_far_.frame_bytes;
  cut(folder_ / "diagnostics.csv", so_far_.diagnostics.bytes, diagnostics_);
  if (!probes.empty()) cut(folder_ / "probes.csv", so_far_.probes.bytes, probes_);
  std::error_code ignored;  // frames left over are written again, or stay unlisted
  for (std::size_t k = frame_count_; fs::remove(folder_ / frame_name(k), ignored); ++k) {
  }
}

const OutputSoFar& SceneOutput::so_far() {
  finish();
  so_far_.frame_bytes = frames_->bytes;
  so_far_.list.extend(folder_ / "frames.pvd", frames_->list.entries_end());
  so_far_.diagnostics.extend(folder_ / "diagnostics.csv", static_cast<std::uint64_t>(diagnostics_.tellp()));
  if (probes_.is_open()) so_far_.probes.extend(folder_ / "probes.csv", static_cast<std::uint64_t>(probes_.tellp()));
  return so_far_;
}

SceneOutput::SceneOutput(std::filesystem::path folder, std::span<const Probe> probes, int dimension, bool with_applied,
                         bool with_contact, bool with_sleep)
    : claim_(folder),
      folder_(std::move(folder)),
      frames_(std::make_unique<Frames>(Frames{folder_, PvdFile(folder_ / "frames.pvd")})) {
  const auto begin = [this](std::ofstream& out, const char* name, const std::string& header) {
    errno = 0;
    out.open(folder_ / name, std::ios::binary);
    out << header << std::flush;
    if (!out) throw_not_written(folder_ / name);
  };
  begin(diagnostics_, "diagnostics.csv", diagnostics_header(dimension, with_applied, with_contact, with_sleep));
  if (!probes.empty()) begin(probes_, "probes.csv", probes_header(probes));
}

void SceneOutput::Frames::write(const Frame& frame) {
  const std::string name = frame_name(list.size()).string();
  const std::uint64_t size = write_vtu(folder / name, frame, compressor);
  list.add({frame.time, name});
  bytes.push_back(size);
}

void SceneOutput::write(const Frame& frame) {
  finish();
  frames_->write(frame);
  ++frame_count_;
}

void SceneOutput::write_later(const Frame& frame) {
  finish();
  writing_ = std::async(std::launch::async, [frames = frames_.get(), copy = frame] { frames->write(copy); });
  ++frame_count_;
}

void SceneOutput::finish() {
  if (writing_.valid()) writing_.get();
}

bool SceneOutput::writes(std::string_view name) {
  return name == "frames.pvd" || name == "diagnostics.csv" || name == "probes.csv" ||
         (name.starts_with("frame_") && name.ends_with(".vtu"));
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
