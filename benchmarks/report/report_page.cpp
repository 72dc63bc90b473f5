#include "benchmarks/report/report_page.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "benchmarks/pages/page.h"
#include "benchmarks/report/findings.h"

namespace dartboard {

std::string write_report(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& file) {
  nlohmann::json runs = nlohmann::json::array();
  std::string title;
  for (const std::filesystem::path& folder : folders) {
    nlohmann::json run = read_run(folder);
    // links are those of the page, wherever it is
    const std::filesystem::path page = std::filesystem::absolute(file).parent_path();
    run["link"] = std::filesystem::absolute(folder).lexically_proximate(page).generic_string();
    title += (title.empty() ? "" : ", ") + run["findings"]["label"].get<std::string>();
    runs.push_back(std::move(run));
  }
  return write_page("report", {{"title", title}, {"program", DARTBOARD_VERSION}, {"runs", std::move(runs)}}, file);
}

}  // namespace dartboard
