#include "core/scene/output/write_pvd.h"

#include <fmt/format.h>

#include <cerrno>
#include <string_view>

#include "core/base/escape.h"
#include "core/scene/output/atomic_file.h"

namespace dartboard {
namespace {

constexpr std::string_view head =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
    "  <Collection>\n";
constexpr std::string_view tail = "  </Collection>\n</VTKFile>\n";

}  // namespace

PvdFile::PvdFile(std::filesystem::path path, std::size_t size, std::uint64_t entries_end)
    : path_(std::move(path)), size_(size), entries_end_(entries_end) {
  errno = 0;
  std::error_code error;
  std::filesystem::resize_file(path_, entries_end, error);
  file_.open(path_, std::ios::binary | std::ios::in | std::ios::out | std::ios::ate);
  file_ << tail << std::flush;
  if (error || !file_) throw_not_written(path_);
}

void PvdFile::add(const FrameFile& frame) {
  errno = 0;
  std::string text = fmt::format("    <DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n{}", frame.time,
                                 xml_text(frame.file), tail);
  if (!file_.is_open()) {
    file_.open(path_, std::ios::binary | std::ios::trunc);
    text.insert(0, head);
  } else {
    file_.seekp(-static_cast<std::streamoff>(tail.size()), std::ios::end);
  }
  // no longer than the buffer: one write
  file_ << text << std::flush;
  if (!file_) throw_not_written(path_);
  ++size_;
  entries_end_ = static_cast<std::uint64_t>(file_.tellp()) - tail.size();
}

}  // namespace dartboard
