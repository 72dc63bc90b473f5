#include "benchmarks/report/derived.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>

#include "benchmarks/harness/processes.h"
#include "benchmarks/harness/scratch_folder.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/report/findings.h"
#include "benchmarks/report/measured.h"
#include "benchmarks/report/report_page.h"
#include "core/base/counted.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;

/// The words of the command without those that say where its output goes.
std::vector<std::string> arguments_of(const fs::path& folder) {
  const fs::path file = folder / "manifest.json";
  const nlohmann::json manifest = read_json_file(file);
  std::vector<std::string> words;
  try {
    words = manifest.at("command_line").get<std::vector<std::string>>();
  } catch (const nlohmann::json::exception&) {
    throw IoError(fmt::format("{}: names no command; expected the manifest of a study", file.string()));
  }
  std::vector<std::string> arguments;
  for (std::size_t k = 1; k < words.size(); ++k) {
    const std::string option = words[k].substr(0, words[k].find('='));
    if (option == "--json") continue;
    if (option != "--out" && option != "--continue")
      arguments.push_back(words[k]);
    else if (option == words[k])
      ++k;
  }
  return arguments;
}

/// The files below a folder, by their paths in it.
std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), folder));
  std::ranges::sort(files);
  return files;
}

bool is_compared(const fs::path& file) {
  const std::string kind = file.extension().string();
  return file.filename() != "manifest.json" && file.filename() != report_name && kind != ".png" && kind != ".svg";
}

/// The first line in which two files differ.
std::optional<std::string> difference(const fs::path& there, const fs::path& derived) {
  std::ifstream a(there, std::ios::binary), b(derived, std::ios::binary);
  if (!a) return fmt::format("{}: is missing", there.string());
  std::string line, expected;
  for (std::size_t number = 1;; ++number) {
    const bool has = static_cast<bool>(std::getline(a, line)), should = static_cast<bool>(std::getline(b, expected));
    if (!has && !should) return std::nullopt;
    if (has == should && line == expected) continue;
    return fmt::format("{}:{}: has {}; derived is {}", there.string(), number,
                       has ? "'" + one_line(line, 120) + "'" : "no such line",
                       should ? "'" + one_line(expected, 120) + "'" : "none");
  }
}

}  // namespace

void derive_study(const fs::path& folder, const fs::path& into) {
  std::vector<std::string> arguments = arguments_of(folder);
  measured_file(folder);  // refuses one that has none
  arguments.insert(arguments.end(), {"--derive-from", folder.string(), "--out", into.string()});
  try {
    run_self(arguments, [](std::string_view) {});
  } catch (const ProcessError&) {  // it has said why
    throw IoError(fmt::format("{}: its files cannot be derived again", folder.string()));
  }
}

DerivedComparison compare_derived(const fs::path& folder, const fs::path& derived) {
  DerivedComparison found;
  for (const fs::path& file : files_of(derived)) {
    if (!is_compared(file)) continue;
    if (const auto differs = difference(folder / file, derived / file))
      found.differences.push_back(*differs);
    else
      found.same.push_back(file.string());
  }
  return found;
}

void restore_missing(const fs::path& folder) {
  std::error_code error;
  if (has_findings(folder) || !fs::exists(folder / packed_measured_name, error)) return;
  const ScratchFolder scratch("derived");
  const fs::path derived = scratch.path() / "run";
  derive_study(folder, derived);
  std::size_t restored = 0;
  for (const fs::path& file : files_of(derived)) {
    if (fs::exists(folder / file)) continue;
    fs::create_directories((folder / file).parent_path());
    fs::copy_file(derived / file, folder / file);
    ++restored;
  }
  tell(stderr, "{}: {} derived again\n", folder.string(), counted(restored, "file", "files"));
}

}  // namespace dartboard
