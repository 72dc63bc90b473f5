#include "core/scene/write_pvd.h"

#include <fmt/format.h>

#include "core/scene/atomic_file.h"

namespace dartboard {

std::string to_pvd(std::span<const FrameFile> frames) {
  std::string out =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (const FrameFile& frame : frames)
    fmt::format_to(std::back_inserter(out), "    <DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n", frame.time,
                   frame.file);
  return out + "  </Collection>\n</VTKFile>\n";
}

void write_pvd(const std::filesystem::path& path, std::span<const FrameFile> frames) {
  write_whole(path, to_pvd(frames));
}

}  // namespace dartboard
