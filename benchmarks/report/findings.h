#pragma once
// The findings of a run as data: what its tables, claims and diagrams show, for pages and for programs.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "benchmarks/report/report.h"

namespace dartboard {

/// In the folder of a run, next to its manifest.
inline constexpr const char* findings_name = "findings.json";

/// Findings without parts yet, of a study of that label.
nlohmann::json begin_findings(const std::string& label);
/// A complete part of them; `folder` is the one within that of the run which has its files, or empty.
nlohmann::json findings_of(const Report& part, const std::string& folder);

/// False where a study was interrupted early, or only what it has measured is kept.
bool has_findings(const std::filesystem::path& folder);

/// The JSON of a file of a study.
///
/// throws  IoError that names the file, and the line in it, where it is missing, cut off or damaged
nlohmann::json read_json_file(const std::filesystem::path& file);

/// The run that a folder holds: {"folder", "manifest", "findings", "files"}, with the pictures of bodies in it; the
/// files are those that all else follows from, or all of JSON. A study that was interrupted has the parts that were
/// complete.
///
/// throws  IoError that names the file, and the line in it, where one is missing, cut off or damaged, or of another version
nlohmann::json read_run(const std::filesystem::path& folder);

}  // namespace dartboard
