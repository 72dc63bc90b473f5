#pragma once
// The output of the child processes of a study that have come to their end. A study that is interrupted leaves it in
// its folder, and one that continues it does not run them again.

#include <cstddef>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/harness/run_folder.h"

namespace dartboard {

/// Writes them.
class ChildrenLog {
 public:
  static constexpr const char* file_name = "children.jsonl";

  /// `study` names the study and its options.
  ChildrenLog(const RunFolder& folder, const nlohmann::json& study);
  void add(const std::vector<std::string>& arguments, const std::vector<std::string>& lines);

 private:
  JsonLines lines_;
};

/// Those of a study that was interrupted.
class FinishedChildren {
 public:
  /// throws  IoError where the folder has none, or they are of another study, of other options, of another build of this
  ///         program, or another processor
  FinishedChildren(const std::filesystem::path& folder, const nlohmann::json& study);

  /// The lines of the first child with these arguments that has not been taken yet.
  std::optional<std::vector<std::string>> take(const std::vector<std::string>& arguments);
  const std::filesystem::path& folder() const { return folder_; }
  std::size_t taken() const { return taken_; }

 private:
  std::filesystem::path folder_;
  std::multimap<std::vector<std::string>, std::vector<std::string>> lines_;  // by arguments
  std::size_t taken_ = 0;
};

}  // namespace dartboard
