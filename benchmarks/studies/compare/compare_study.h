#pragma once
// Two runs of a study, compared: times, the bits that tasks leave, verdicts, and the settings that differ.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/studies/compare/compared_times.h"

namespace dartboard {

struct ComparePlan {
  std::filesystem::path first, second;  // folders
  double least = 0.05;                  // a change of times that counts, as a share
  double within = 0.0;                  // [edges] a distance of vertices that does not count
};

/// A value that two JSON documents do not share.
struct ComparedSetting {
  std::string path;           // "/machine/cpu"
  std::string first, second;  // as JSON; "-" where it is missing
};
/// The settings in which two manifests differ: all but the times at which the runs began and ended.
std::vector<ComparedSetting> compare_manifests(const nlohmann::json& first, const nlohmann::json& second);

Table table_of(const std::vector<ComparedSetting>& settings);
nlohmann::json to_data(const std::vector<ComparedSetting>& settings);

/// Compare two runs of one study, of other commits, options or machines.
///
/// throws  IoError where a folder is missing or damaged; InputError for runs of two studies
Report compare_study(const ComparePlan& plan);

}  // namespace dartboard
