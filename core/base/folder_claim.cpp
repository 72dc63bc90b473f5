#include "core/base/folder_claim.h"

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
  // lock before checking for files: a previous owner may have written some
  std::string trouble = lock(folder);
  if (!trouble.empty()) fail(folder, trouble);
  if (const bool empty = fs::is_empty(folder, error); error)
    trouble = "cannot be read: " + error.message();
  else if (!empty)
    trouble = "is not empty";
  if (trouble.empty()) return;
  ::close(std::exchange(descriptor_, -1));
  fail(folder, trouble);
}

FolderClaim FolderClaim::of_ended_run(const fs::path& folder) {
  const auto refuse = [&folder](const std::string& what) {
    throw IoError(fmt::format("{}: {}; expected the folder of a run that has ended", folder.string(), what));
  };
  std::error_code error;
  if (!fs::is_directory(folder, error)) refuse(fs::exists(folder, error) ? "is a file" : "there is no such folder");
  FolderClaim claim;
  if (const std::string trouble = claim.lock(folder); !trouble.empty()) refuse(trouble);
  return claim;
}

// The reason why the lock failed; empty if it is ours now.
std::string FolderClaim::lock(const fs::path& folder) {
  // child processes must not inherit it: they would hold the lock
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0) return "cannot be read: " + reason();
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return {};
  ::close(std::exchange(descriptor_, -1));
  return "is in use by another run";
}

FolderClaim::~FolderClaim() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

FolderClaim::FolderClaim(FolderClaim&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

}  // namespace dartboard
