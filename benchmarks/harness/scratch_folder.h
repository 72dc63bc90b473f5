#pragma once
// A folder for the files of another program.

#include <filesystem>
#include <string_view>

namespace dartboard {

/// A new folder among the temporary ones, gone with its files when it goes out of scope.
class ScratchFolder {
 public:
  /// `purpose` is a part of its name: "dartboard-calculix-k2XcP1".
  /// throws  IoError if it cannot be made
  explicit ScratchFolder(std::string_view purpose);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace dartboard
