#include "core/scene/atomic_file.h"

#include <fmt/format.h>

#include <fstream>

#include "core/plain/error.h"

namespace dartboard {

void write_whole(const std::filesystem::path& path, std::string_view contents) {
  namespace fs = std::filesystem;
  const fs::path beside = path.parent_path() / fmt::format(".{}.part", path.filename().string());
  std::ofstream stream(beside, std::ios::binary | std::ios::trunc);
  stream.write(contents.data(), static_cast<std::streamsize>(contents.size()));
  stream.close();
  std::error_code error;
  if (stream) fs::rename(beside, path, error);
  if (stream && !error) return;
  std::error_code ignored;
  fs::remove(beside, ignored);
  throw IoError(fmt::format("{}: cannot be written{}", path.string(), error ? ": " + error.message() : ""));
}

}  // namespace dartboard
