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
Json measured_by(const Json& study) {
  return {
      {"study", study}, {"program", file_hash("/proc/self/exe")}, {"cpu", begin_manifest({}).at("machine").at("cpu")}};
}

}  // namespace

ChildrenLog::ChildrenLog(const RunFolder& folder, const Json& study) : lines_(folder.json_lines(file_name)) {
  lines_.append(measured_by(study));
}

void ChildrenLog::add(const std::vector<std::string>& arguments, const std::vector<std::string>& lines) {
  lines_.append({{"arguments", arguments}, {"lines", lines}});
}

FinishedChildren::FinishedChildren(const std::filesystem::path& folder, const Json& study) : folder_(folder) {
  const std::filesystem::path file = folder / ChildrenLog::file_name;
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line))
    throw IoError(fmt::format(
        "{}: {}; expected the folder of a study that was interrupted", folder.string(),
        std::filesystem::is_directory(folder)
            ? fmt::format("holds no {}, which only a study that was interrupted leaves", ChildrenLog::file_name)
            : "there is no such folder"));
  const Json found = Json::parse(line, nullptr, false), expected = measured_by(study);
  for (const auto& [key, what] : {std::pair("study", "another study, or of other options"),
                                  {"program", "another build of this program"},
                                  {"cpu", "another processor"}})
    if (!found.is_object() || !found.contains(key) || found.at(key) != expected.at(key))
      throw IoError(
          fmt::format("{}: is that of {}; expected {} {}", folder.string(), what, key, json_text(expected.at(key))));
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
