#pragma once
// What a study has measured: the output of its processes, and what it timed itself. All else in its folder is derived
// from that, and can be derived again. A study that is interrupted leaves it, and one that continues it does not
// measure that again.

#include <cstddef>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/harness/run_folder.h"

namespace dartboard {

/// In the folder of a study, one output per line after a line on the program; compressed once the study is complete.
inline constexpr const char *measured_name = "measured.jsonl", *packed_measured_name = "measured.jsonl.gz";

/// The lines of a process, and why it failed, if it did.
struct MeasuredOutput {
  std::vector<std::string> lines{};
  std::string failure{};
};

/// The file of a folder that has it, compressed or not.
///
/// throws  IoError where there is none
std::filesystem::path measured_file(const std::filesystem::path& folder);

/// The program and the processor that measure; `study` names the study and its options.
nlohmann::json measured_by(const nlohmann::json& study);

/// Writes it.
class MeasuredLog {
 public:
  MeasuredLog(const RunFolder& folder, const nlohmann::json& by);
  void add(const std::vector<std::string>& arguments, const MeasuredOutput& output);
  /// Compresses the file.
  /// throws  IoError if that cannot be written
  void pack() const;

 private:
  std::filesystem::path file_;
  JsonLines lines_;
};

/// Its uses: a study that goes on where another was interrupted measures what is missing, and what had failed, and has
/// to be the same in all that times depend on; one that is derived again measures nothing.
enum class MeasuredFor { going_on, deriving };

/// Reads it.
class Measured {
 public:
  /// throws  IoError where the folder has none, or it is damaged or of another study or of other options; to go on also
  ///         where it is of another build of this program, or another processor
  Measured(const std::filesystem::path& folder, const nlohmann::json& study, MeasuredFor use);

  /// The output of the first process with these arguments that has not been taken yet.
  ///
  /// throws  IoError to derive where there is none
  std::optional<MeasuredOutput> take(const std::vector<std::string>& arguments);
  const std::filesystem::path& folder() const { return folder_; }
  std::size_t taken() const { return taken_; }
  std::size_t left() const { return outputs_.size(); }
  MeasuredFor use() const { return use_; }
  /// As written by `measured_by`.
  const nlohmann::json& by() const { return by_; }

 private:
  std::filesystem::path folder_, file_;
  MeasuredFor use_;
  nlohmann::json by_;
  std::multimap<std::vector<std::string>, MeasuredOutput> outputs_;  // by arguments
  std::size_t taken_ = 0;
};

}  // namespace dartboard
