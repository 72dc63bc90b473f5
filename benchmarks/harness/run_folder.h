#pragma once
// The folder that each run writes: raw samples, manifest and claims.

#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "benchmarks/harness/claim.h"
#include "core/base/folder_claim.h"

namespace dartboard {

/// A file of one JSON value per line that only ever grows. Each line is flushed, so a run that dies keeps what it had
/// measured.
class JsonLines {
 public:
  /// throws  IoError if the file cannot be opened for appending
  explicit JsonLines(std::filesystem::path file);
  /// throws  IoError if the line could not be written, InputError if the value holds a number that is not finite, which
  ///         JSON cannot express
  void append(const nlohmann::json& value);

 private:
  std::filesystem::path file_;
  std::ofstream stream_;
};

/// A folder that belongs to one run. All files but JSON Lines appear whole or not at all: they are written next to
/// their final place and renamed into it.
class RunFolder {
 public:
  /// Creates the folder, and those above it.
  /// throws  IoError if it exists and is not empty, is claimed by another run, or cannot be created
  explicit RunFolder(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }

  /// throws  IoError; InputError unless `name` is a plain file name (also for the members below)
  void write(std::string_view name, std::string_view text) const;
  /// throws  InputError if a number is not finite
  void write_json(std::string_view name, const nlohmann::json& value) const;
  /// Writes manifest.json; called again at the end of the run, it replaces it.
  void write_manifest(const nlohmann::json& manifest) const;
  /// Writes claims.json.
  void write_claims(std::span<const Claim> claims) const;
  /// Opens NAME for raw results, "samples.jsonl".
  JsonLines json_lines(std::string_view name) const;

 private:
  std::filesystem::path file(std::string_view name) const;
  std::shared_ptr<const FolderClaim> claim_;
  std::filesystem::path path_;
};

/// A new folder for a run below `results`: "LABEL-20260131T120000Z", with "-2", "-3" ... where that is taken.
///
/// throws  IoError if it cannot be created
std::filesystem::path new_run_path(const std::filesystem::path& results, std::string_view label);

/// The folder for runs without --out: in the working folder.
inline constexpr const char* default_results = "dartboard-results";

/// `out`, or a new folder for a run of that label in `default_results`.
///
/// throws  IoError if it cannot be created
std::filesystem::path run_path(const std::string& out, std::string_view label);

}  // namespace dartboard
