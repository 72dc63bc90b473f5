#include "core/scene/output/atomic_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "core/plain/error.h"

namespace dartboard {

void throw_not_written(const std::filesystem::path& path) {
  const std::string reason = errno == 0 ? "" : ": " + std::generic_category().message(errno);
  throw IoError(fmt::format("{}: cannot be written{}", path.string(), reason));
}

void write_whole(const std::filesystem::path& path, std::string_view contents) {
  write_whole(path, [contents](std::ostream& out) {
    out.write(contents.data(), static_cast<std::streamsize>(contents.size()));
  });
}

void write_whole(const std::filesystem::path& path, const std::function<void(std::ostream&)>& put) {
  namespace fs = std::filesystem;
  const fs::path beside = path.parent_path() / fmt::format(".{}.part", path.filename().string());
  errno = 0;
  std::ofstream stream(beside, std::ios::binary | std::ios::trunc);
  put(stream);
  stream.close();
  std::error_code error;
  if (stream) fs::rename(beside, path, error);
  if (stream && !error) return;
  const int reason = error ? error.value() : errno;
  std::error_code ignored;
  fs::remove(beside, ignored);
  errno = reason;
  throw_not_written(path);
}

}  // namespace dartboard
