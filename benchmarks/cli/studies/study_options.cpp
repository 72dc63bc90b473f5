#include "benchmarks/cli/studies/study_options.h"

#include <fmt/format.h>

#include <utility>

namespace dartboard {

void add_study_options(CLI::App& verb, StudyOptions& options, const StudyTexts& texts) {
  if (!texts.quick.empty()) verb.add_flag("--quick", options.quick, texts.quick);
  const std::string otherwise =
      texts.keeps_folder ? fmt::format("dartboard-results/{}-TIME", verb.get_name()) : "nothing is written";
  verb.add_option("--out", options.out,
                  texts.out.empty() ? fmt::format("folder to write to, new or empty [{}]", otherwise) : texts.out);
  if (texts.goes_on) {
    verb.add_option("--derive-from", options.derives, "")->group("");  // for `report`
    verb.add_option(
        "--continue", options.continues,
        "the folder of the same study, with the same options, when it was interrupted: what its processes had "
        "measured is taken from there. All is written to --out, a folder of its own");
  }
  if (!texts.seed.empty()) verb.add_option("--seed", options.seed, fmt::format("seed of {} [1]", texts.seed));
  verb.add_flag("--json", options.json, "print JSON on standard output, and all else on standard error");
}

void run_study(const StudyOptions& options, Publication how, const std::function<Report(StudyLog&)>& study,
               Outcome& outcome) {
  how.json = options.json;
  how.quick = options.quick;
  how.out = options.out;
  how.continues = options.continues;
  how.derives = options.derives;
  how.facts.command_line = outcome.command_line;
  outcome.exit_code = publish(how, study);
}

}  // namespace dartboard
