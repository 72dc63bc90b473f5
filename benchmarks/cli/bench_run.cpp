#include "benchmarks/cli/bench_run.h"

#include <fmt/format.h>

#include <filesystem>

#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/tell.h"

namespace dartboard {

std::shared_ptr<BenchOptions> add_bench_options(CLI::App& verb, const std::string& quick, const std::string& seed) {
  auto options = std::make_shared<BenchOptions>();
  verb.add_flag("--quick", options->quick, quick);
  verb.add_option("--out", options->out,
                  fmt::format("folder to write to, new or empty [dartboard-results/{}-TIME]", verb.get_name()));
  verb.add_option("--seed", options->seed, fmt::format("of {} [1]", seed));
  verb.add_flag("--json", options->json,
                "print claims and manifest as JSON on standard output, the rest on standard error");
  return options;
}

BenchRun::BenchRun(const BenchOptions& options, const std::string& label, const RunFacts& facts)
    : options_(options), folder_(run_path(options.out, label)), manifest_(begin_manifest(facts)) {
  manifest_["quick"] = options.quick;
  folder_.write_manifest(manifest_);
}

void BenchRun::say(const std::string& text) const { tell(options_.json ? stderr : stdout, "{}\n", text); }

void BenchRun::finish(std::span<const Claim> claims, const std::string& first) {
  finish_manifest(manifest_);
  folder_.write_manifest(manifest_);
  if (options_.json)
    tell("{}\n",
         json_text(nlohmann::json{{"claims", std::vector(claims.begin(), claims.end())}, {"manifest", manifest_}}, 2));
  say(fmt::format("{}{}{}\nWritten to {}: claims.md, tables, and all samples.",
                  options_.quick ? "This was a quick run. " : "", first, in_words(claims), folder_.path().string()));
}

}  // namespace dartboard
