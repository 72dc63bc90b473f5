#include "benchmarks/harness/scratch_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "core/plain/error.h"

namespace dartboard {

ScratchFolder::ScratchFolder(std::string_view purpose) {
  std::string name = (std::filesystem::temp_directory_path() / fmt::format("dartboard-{}-XXXXXX", purpose)).string();
  if (mkdtemp(name.data()) == nullptr)
    throw IoError(fmt::format("{}: cannot be made: {}", name, std::generic_category().message(errno)));
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace dartboard
