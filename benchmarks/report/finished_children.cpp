#include "benchmarks/report/finished_children.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/manifest.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

using Json = nlohmann::json;

/// What times depend on, beside the arguments.
Json measured_by() {
  return {{"program", file_hash("/proc/self/exe")}, {"cpu", begin_manifest({}).at("machine").at("cpu")}};
}

}  // namespace

ChildrenLog::ChildrenLog(const RunFolder& folder) : lines_(folder.json_lines(file_name)) {
  lines_.append(measured_by());
}

void ChildrenLog::add(const std::vector<std::string>& arguments, const std::vector<std::string>& lines) {
  lines_.append({{"arguments", arguments}, {"lines", lines}});
}

FinishedChildren::FinishedChildren(const std::filesystem::path& folder) : folder_(folder) {
  const std::filesystem::path file = folder / ChildrenLog::file_name;
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line))
    throw IoError(fmt::format("{}: is not there; expected the folder of a study that was interrupted", file.string()));
  const Json by = measured_by();
  if (Json::parse(line, nullptr, false) != by)
    throw IoError(
        fmt::format("{}: was begun by another build of the program or on another processor; expected {}, since times "
                    "are compared",
                    file.string(), json_text(by)));
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    const Json child = Json::parse(line, nullptr, false);
    if (in.eof() && child.is_discarded()) break;  // the program was ended while it wrote
    try {
      lines_.emplace(child.at("arguments"), child.at("lines"));
    } catch (const Json::exception&) {
      throw IoError(fmt::format("{}:{}: is no child with its arguments and lines", file.string(), number));
    }
  }
}

std::optional<std::vector<std::string>> FinishedChildren::take(const std::vector<std::string>& arguments) {
  const auto found = lines_.find(arguments);
  if (found == lines_.end()) return std::nullopt;
  std::vector<std::string> lines = std::move(found->second);
  lines_.erase(found);
  ++taken_;
  return lines;
}

}  // namespace dartboard
