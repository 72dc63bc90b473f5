#include "benchmarks/report/study_log.h"

#include <nlohmann/json.hpp>

namespace dartboard {

void StudyLog::run(const std::vector<std::string>& arguments, const LineSink& on_line) { run_self(arguments, on_line); }

nlohmann::json StudyLog::once(const std::string& /*what*/, const std::function<nlohmann::json()>& find) {
  return find();
}

void StudyLog::measure(const std::vector<std::string>& arguments,
                       const std::function<void(const nlohmann::json&)>& take, const std::string& folder) {
  run(arguments, [&](std::string_view line) {
    const auto json = nlohmann::json::parse(line);
    sample(json, "samples.jsonl", folder);
    take(json);
  });
}

}  // namespace dartboard
