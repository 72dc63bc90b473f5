#pragma once
// Code shared by the verbs that run a study: options, and the way from a study to an exit status.

#include <CLI/App.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "benchmarks/cli/cli.h"
#include "benchmarks/report/publish.h"

namespace dartboard {

struct StudyOptions {
  bool json = false, quick = false;
  std::string out, continues, derives;
  std::uint64_t seed = 1;
};

/// Help texts of the options; an option without a text does not exist.
struct StudyTexts {
  std::string quick{};       // what --quick leaves out
  std::string seed{};        // what --seed is the seed of
  bool keeps_folder = true;  // a folder is written even without --out
  std::string out{};         // replaces the usual text of --out
  bool goes_on = false;      // after an interruption, and is derived again: it measures in processes of their own
};
void add_study_options(CLI::App& verb, StudyOptions& options, const StudyTexts& texts);

/// Adds options with more members than those.
template <class Options = StudyOptions>
std::shared_ptr<Options> study_options(CLI::App& verb, const StudyTexts& texts) {
  auto options = std::make_shared<Options>();
  add_study_options(verb, *options, texts);
  return options;
}

/// Run a study and publish its report; `how` is complete but for the options and the command line.
void run_study(const StudyOptions& options, Publication how, const std::function<Report(StudyLog&)>& study,
               Outcome& outcome);

}  // namespace dartboard
