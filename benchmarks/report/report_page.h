#pragma once
// The findings of runs as one page, without a network.

#include <filesystem>
#include <string>
#include <vector>

namespace dartboard {

/// In the folder of a run.
inline constexpr const char* report_name = "report.html";

/// Make the page of the runs that some folders hold.
///
/// returns  a sentence on what went wrong, as `write_page` does
/// throws   IoError as `read_run`, and where the file cannot be written
std::string write_report(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& file);

}  // namespace dartboard
