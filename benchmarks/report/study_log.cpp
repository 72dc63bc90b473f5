#include "benchmarks/report/study_log.h"

#include <nlohmann/json.hpp>

namespace dartboard {

void StudyLog::run(const std::vector<std::string>& arguments, const LineSink& on_line,
                   const std::vector<std::string>& places) {
  std::vector<std::string> all = arguments;
  all.insert(all.end(), places.begin(), places.end());
  run_self(all, on_line);
}

nlohmann::json StudyLog::once(const std::string& /*what*/, const std::function<nlohmann::json()>& find) {
  return find();
}

void StudyLog::measure(const std::vector<std::string>& arguments,
                       const std::function<void(const nlohmann::json&)>& take, const std::string& folder,
                       const std::vector<std::string>& places) {
  const auto on_line = [&](std::string_view line) {
    const auto json = nlohmann::json::parse(line);
    sample(json, "samples.jsonl", folder);
    take(json);
  };
  run(arguments, on_line, places);
}

}  // namespace dartboard
