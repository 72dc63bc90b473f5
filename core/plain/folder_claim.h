#pragma once
// A folder that belongs to one run.

#include <filesystem>
#include <string>

namespace dartboard {

/// A new or empty folder for the results of one run. While this is alive nobody else can claim it, and who comes later
/// finds it not empty, as soon as something was written.
class FolderClaim {
 public:
  /// Creates the folder, and those above it. Of several that claim it at once, in whatever processes, one goes on; on
  /// file systems without locks (flock) it is only looked at.
  ///
  /// throws  IoError if it exists and is not an empty folder, is claimed, or cannot be created
  explicit FolderClaim(const std::filesystem::path& folder);
  /// The folder of a run that has ended, whatever is in it, to go on with that run.
  ///
  /// throws  IoError if there is no such folder, or it is claimed
  static FolderClaim of_ended_run(const std::filesystem::path& folder);
  ~FolderClaim();
  FolderClaim(FolderClaim&& other) noexcept;
  FolderClaim& operator=(FolderClaim&&) = delete;

 private:
  FolderClaim() = default;
  std::string lock(const std::filesystem::path& folder);

  int descriptor_ = -1;  // of the folder; the lock is let go with it
};

}  // namespace dartboard
