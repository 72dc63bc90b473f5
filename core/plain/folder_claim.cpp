#include "core/plain/folder_claim.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "core/plain/error.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& folder, const std::string& what) {
  throw IoError(fmt::format("{}: {}; expected a new or empty folder for the results", folder.string(), what));
}

std::string reason() { return std::generic_category().message(errno); }

}  // namespace

FolderClaim::FolderClaim(const fs::path& folder) {
  if (folder.empty()) fail(folder, "is no name");
  std::error_code error;
  fs::create_directories(folder, error);
  if (const std::string why = error.message(); !fs::is_directory(folder, error))
    fail(folder, fs::exists(folder, error) ? "is a file" : "cannot be created: " + why);
  // children must not inherit it: they would hold the lock
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0) fail(folder, "cannot be read: " + reason());
  // first the lock, then the look: whoever had it before has written something, or gone
  std::string trouble;
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    trouble = "is in use by another run";
  else if (const bool empty = fs::is_empty(folder, error); error)
    trouble = "cannot be read: " + error.message();
  else if (!empty)
    trouble = "is not empty";
  if (trouble.empty()) return;
  ::close(std::exchange(descriptor_, -1));
  fail(folder, trouble);
}

FolderClaim::~FolderClaim() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

FolderClaim::FolderClaim(FolderClaim&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

}  // namespace dartboard
