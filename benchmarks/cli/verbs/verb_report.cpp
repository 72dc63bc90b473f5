#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/figures/gnuplot.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/scratch_folder.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/pages/page.h"
#include "benchmarks/report/derived.h"
#include "benchmarks/report/findings.h"
#include "benchmarks/report/report_page.h"
#include "core/base/counted.h"

namespace dartboard {
namespace {

struct ReportOptions {
  std::vector<std::string> folders;
  std::string out;
  std::string style = "screen";
  bool replace = false, json = false, check = false;
};

/// Derives every file of each folder again, and compares.
void check(const ReportOptions& options, Outcome& outcome) {
  nlohmann::json all = nlohmann::json::array();
  for (const std::string& folder : options.folders) {
    const bool is_raw = !has_findings(folder);
    if (!is_raw) read_run(folder);  // refuses another format or version in words
    tell(stderr, "{}: deriving its files again\n", folder);
    const ScratchFolder scratch("derived");
    derive_study(folder, scratch.path() / "run");
    DerivedComparison found;
    if (!is_raw) found = compare_derived(folder, scratch.path() / "run");
    if (!found.differences.empty()) outcome.exit_code = exit_disagrees;
    all.push_back({{"folder", folder}, {"same", found.same}, {"differences", found.differences}});
    if (options.json) continue;
    for (const std::string& words : found.differences) tell("{}\n", words);
    if (is_raw)
      tell("{}: its tables, claims and samples can be derived; none of them is there to be compared.\n", folder);
    else if (found.differences.empty())
      tell("{}: {} with its tables, claims and samples follow from what was measured.\n", folder,
           counted(found.same.size(), "file", "files"));
  }
  if (options.json) tell("{}\n", json_text(all, 2));
}

void report(const ReportOptions& options, Outcome& outcome) {
  const std::vector<std::filesystem::path> folders(options.folders.begin(), options.folders.end());
  for (const auto& folder : folders) restore_missing(folder);
  if (options.json) {
    nlohmann::json runs = nlohmann::json::array();
    for (const auto& folder : folders) runs.push_back(read_run(folder));
    tell("{}\n", json_text(runs, 2));
    return;
  }
  const std::filesystem::path file =
      options.out.empty() ? folders[0] / report_name : std::filesystem::path(options.out);
  // that of a folder is made from the rest of it, and can be made again
  require_writable_page(file, "report", options.replace || options.out.empty(), "");
  std::vector<std::string> troubles;
  if (options.style == "paper")
    for (const auto& folder : folders) std::ranges::move(draw_for_paper(folder), std::back_inserter(troubles));
  if (const std::string trouble = write_report(folders, file); !trouble.empty())
    troubles.push_back(trouble);
  else
    tell("{} shows {}.\n", file.string(), fmt::join(options.folders, ", "));
  for (const std::string& trouble : troubles) tell(stderr, "{}\n", trouble);
  if (!troubles.empty()) outcome.exit_code = exit_io;
}

}  // namespace

void add_report(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<ReportOptions>();
  auto* verb = app.get_subcommand("report");
  verb->add_option("DIR", options->folders,
                   "folders of studies, as --out of reproduce, extremes, tradeoff, validate and bench; files that are "
                   "missing where a study has measured in processes are derived again")
      ->required();
  auto* out =
      verb->add_option("--out", options->out, "the page, a new file [report.html in DIR, where there is one DIR]")
          ->type_name("FILE.html");
  verb->add_flag("--replace", options->replace, "write it over an earlier page")->needs(out);
  verb->add_option("--style", options->style, "screen, or paper: each diagram in the folders as a PDF, too [screen]")
      ->check(CLI::IsMember({"screen", "paper"}));
  verb->add_flag("--json", options->json, "print the findings and manifests as JSON, and make no page");
  verb->add_flag("--check", options->check,
                 "derive every table, claim and sample again from measured.jsonl.gz, and compare; makes no page")
      ->excludes(out);
  verb->callback([options, &outcome] {
    if (options->check) return check(*options, outcome);
    if (options->folders.size() > 1 && options->out.empty() && !options->json)
      throw CLI::RequiredError("--out for the page of several folders");
    report(*options, outcome);
  });
}

}  // namespace dartboard
