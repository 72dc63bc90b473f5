#include "benchmarks/pages/page.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/processes.h"
#include "benchmarks/harness/scratch_folder.h"
#include "core/plain/error.h"
#include "core/scene/output/atomic_file.h"

namespace dartboard {

bool is_page(const std::filesystem::path& file, std::string_view name) {
  std::ifstream in(file, std::ios::binary);
  std::string first;
  return std::getline(in, first) && first == fmt::format("<!DOCTYPE html><!-- Made by Dartboard: {}. -->", name);
}

void require_writable_page(const std::filesystem::path& file, std::string_view name, bool replace,
                           const std::filesystem::path& made_later) {
  std::error_code error;
  const auto as_folder = [](const std::filesystem::path& path) { return (path / "").lexically_normal(); };
  if (!std::filesystem::exists(file, error)) {
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    if (as_folder(folder) != as_folder(made_later) && !std::filesystem::is_directory(folder, error))
      throw IoError(
          fmt::format("{}: there is no folder {}; expected one for the page", file.string(), folder.string()));
    return;
  }
  if (!replace) throw IoError(fmt::format("{}: exists; expected a new file for the page, or --replace", file.string()));
  if (!is_page(file, name))
    throw IoError(fmt::format("{}: is no {} made by Dartboard; expected a new file, or such a page to replace",
                              file.string(), name));
}

std::string write_page(const std::string& name, const nlohmann::json& page, const std::filesystem::path& file) {
  const ScratchFolder scratch("page");
  write_whole(scratch.path() / "page.json", json_text(page, -1));
  // that of Debian's packages; another python3 of the PATH may lack them
  const char* debians = "/usr/bin/python3";
  std::string said;
  try {
    run_program(
        std::filesystem::exists(debians) ? debians : "python3",
        {"-B", (source_folder() / "benchmarks/pages/make_page.py").string(), name + ".html", "page.json", "page.html"},
        [&](std::string_view line) { said = line; }, Stderr::as_output, scratch.path());
  } catch (const ProcessError& error) {
    return fmt::format("no page {}: {}", file.string(), said.empty() ? error.what() : said);
  }
  std::ifstream in(scratch.path() / "page.html", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in || text.empty()) throw IoError(fmt::format("{}: cannot be read", (scratch.path() / "page.html").string()));
  write_whole(file, text);
  return "";
}

}  // namespace dartboard
