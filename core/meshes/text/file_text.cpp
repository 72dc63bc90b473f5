#include "core/meshes/text/file_text.h"

#include <cstdint>
#include <fstream>
#include <system_error>

#include "core/meshes/text/text_scanner.h"

namespace dartboard {
namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

std::string file_text(const fs::path& path, std::string_view wanted) {
  const std::string file = path.string();
  std::error_code error;
  if (!is_there(path)) fail_at(file, 0, "there is no such file", wanted);
  if (is_folder(path)) fail_at(file, 0, "this is a directory", wanted);
  if (!fs::is_regular_file(path, error)) fail_at(file, 0, "this is not a regular file", wanted);
  std::ifstream in(path, std::ios::binary);
  const auto size = fs::file_size(path, error);
  if (!in || error) fail_at(file, 0, "the file cannot be opened", "a file that may be read");
  std::string text(size, '\0');
  in.read(text.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(in.gcount()) != size) fail_at(file, 0, "reading stopped early", "a readable file");
  if (text.empty()) fail_at(file, 1, "the file is empty", wanted);
  return text;
}

}  // namespace dartboard
