#pragma once
// The files of a study, derived again from what it had measured.

#include <filesystem>
#include <string>
#include <vector>

namespace dartboard {

/// Derive them, and the pictures, in a new folder `into`, by this program: the study is run again, with the options
/// that its manifest names, and takes every output of a process and every time from its measured.jsonl.gz.
///
/// throws  IoError where it has measured nothing in processes, or that is damaged or not what this program asks for
void derive_study(const std::filesystem::path& folder, const std::filesystem::path& into);

/// The files of a study compared with those derived again, all but manifest, page and pictures.
struct DerivedComparison {
  std::vector<std::string> same{};         // names
  std::vector<std::string> differences{};  // each in words: file, line, what is there and what was derived
};
DerivedComparison compare_derived(const std::filesystem::path& folder, const std::filesystem::path& derived);

/// Derives the files again that are missing from the folder of a study without findings, and says so on standard error.
/// Any other folder is left as it is.
void restore_missing(const std::filesystem::path& folder);

}  // namespace dartboard
