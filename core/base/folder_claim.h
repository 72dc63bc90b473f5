#pragma once
// A folder that belongs to one run.

#include <filesystem>
#include <string>

namespace dartboard {

/// A new or empty folder for the results of one run. While this object exists no other run can claim the folder, and a
/// later run finds it not empty, as soon as a file was written.
class FolderClaim {
 public:
  /// Creates the folder, and those above it. If several claim it at once, in any processes, one succeeds; on file
  /// systems without locks (flock) the folder is only checked to be empty.
  ///
  /// throws  IoError if it exists and is not an empty folder, is claimed, or cannot be created
  explicit FolderClaim(const std::filesystem::path& folder);
  /// Claims the folder of a run that has ended, whatever is in it, to continue that run.
  ///
  /// throws  IoError if there is no such folder, or it is claimed
  static FolderClaim of_ended_run(const std::filesystem::path& folder);
  ~FolderClaim();
  FolderClaim(FolderClaim&& other) noexcept;
  FolderClaim& operator=(FolderClaim&&) = delete;

 private:
  FolderClaim() = default;
  std::string lock(const std::filesystem::path& folder);

  int descriptor_ = -1;  // of the folder; closing it releases the lock
};

}  // namespace dartboard
