#pragma once
// What the verbs of `bench` share: options, the folder of the run, its manifest, and the last lines it prints.

#include <CLI/App.hpp>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "benchmarks/cli/cli.h"
#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/manifest.h"
#include "benchmarks/harness/run_folder.h"

namespace dartboard {

struct BenchOptions {
  bool json = false, quick = false;
  std::string out;
  std::uint64_t seed = 1;
};

/// Add the options to a verb; the texts say what --quick leaves out and what the seed is of.
std::shared_ptr<BenchOptions> add_bench_options(CLI::App& verb, const std::string& quick, const std::string& seed);

/// A run that has a folder, and a manifest in it from its start on.
class BenchRun {
 public:
  /// The folder is that of the options, or dartboard-results/LABEL-TIME.
  BenchRun(const BenchOptions& options, const std::string& label, const RunFacts& facts);

  const RunFolder& folder() const { return folder_; }
  /// On standard output; on standard error where that is for JSON.
  void say(const std::string& text) const;
  /// Complete the manifest, print the JSON asked for, and say what was found and where everything is; `first` before
  /// that.
  void finish(std::span<const Claim> claims, const std::string& first = "");

 private:
  BenchOptions options_;
  RunFolder folder_;
  nlohmann::json manifest_;
};

}  // namespace dartboard
