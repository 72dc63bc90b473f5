#include "benchmarks/studies/contact/ipctk_study.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string_view>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/harness/processes.h"
#include "benchmarks/harness/scratch_folder.h"
#include "benchmarks/studies/contact/contact_report.h"
#include "core/base/counted.h"
#include "core/plain/error.h"
#include "core/plain/nan_maximum.h"

namespace dartboard {
namespace {

// Both take differences of coordinates, and their product with a normal of length 1, whose direction the cross product
// of two edges leaves uncertain by some 3 eps over the sine of their angle, 1/5 at least in these bodies. With the mean
// of a sample's corners, each has some 20 eps of the size.
constexpr double most_apart = 40 * 0x1p-52;

std::string script() { return (source_folder() / "reference/ipctk/certify.py").string(); }

Claim claim_on_depths(const IpctkResults& results) {
  double apart = results.placements.empty() ? NAN : 0.0;
  std::size_t shallow = 0;
  for (const IpctkPlacementsFound& found : results.placements) {
    apart = max_or_nan(apart, found.apart);
    shallow += found.shallow;
  }
  Claim claim{
      .id = "contact-ipctk-depths",
      .text = "contacts are as deep as the nearest triangle of the body is far, by ipctk",
      .paper_value = fmt::format("<= {:.1e} of the size", most_apart),
      .measured = fmt::format("{:.1e}", apart),
      .bound_or_interval = fmt::format("{} nearer to it than the width of a cell", counted(shallow, "contact"))};
  judge(claim, met(shallow > 0 && apart <= most_apart));
  return claim;
}

Claim claim_on_crossings(const IpctkResults& results) {
  double quiet = 0.0;
  std::size_t placements = 0, crossing = 0, disputed = 0, false_felt = 0;
  for (const IpctkPlacementsFound& found : results.placements) {
    quiet = max_or_nan(quiet, found.deepest_quiet);
    placements += found.placements;
    crossing += found.crossing;
    disputed += found.disputed;
    false_felt += found.false_felt;
  }
  Claim claim{
      .id = "contact-ipctk-crossings",
      .text =
          "bodies are felt only where surfaces cross, by ipctk, and wherever they do by more than 3/4 of an altitude",
      .paper_value = fmt::format("<= {:g} altitudes", most_unfelt),
      .measured = fmt::format("{:.2g} altitudes", quiet),
      .bound_or_interval = fmt::format("in {} of {} placements they cross", crossing, placements)};
  const bool both = crossing > 0 && crossing < placements;
  judge(claim, met(both && false_felt == 0 && disputed == 0 && quiet <= most_unfelt));
  if (!both) claim.reason = "surfaces cross everywhere or nowhere";
  if (false_felt > 0) claim.reason = fmt::format("{} felt where no surfaces cross", counted(false_felt, "placement"));
  if (disputed > 0) claim.reason = fmt::format("ipctk and CGAL disagree on {}", counted(disputed, "placement"));
  return claim;
}

Claim claim_on_steps(const IpctkShotsFound& shots) {
  Claim claim{.id = "contact-ipctk-steps",
              .text =
                  "slow shots are felt with the first collision by ipctk or a step later, none sooner; runs warn of "
                  "fast ones",
              .paper_value = "0 otherwise",
              .measured = fmt::format("{} otherwise", shots.wrong()),
              .bound_or_interval = fmt::format("of {}, {} of them slow; {} fast ones pass unfelt",
                                               counted(shots.shots, "shot"), shots.slow, shots.passes)};
  const bool hit = shots.hits > 0 && shots.hits == shots.slow, passed = shots.passes > 0;
  judge(claim, met(hit && passed && shots.wrong() == 0));
  if (!hit) claim.reason = fmt::format("by ipctk, {} of {} slow shots collide", shots.hits, shots.slow);
  if (!passed) claim.reason = "no shot passes unfelt, so that no warning is needed";
  return claim;
}

}  // namespace

std::vector<Claim> claims_of(const IpctkResults& results) {
  return {claim_on_depths(results), claim_on_crossings(results), claim_on_steps(results.shots)};
}

Table ipctk_table(const IpctkResults& results) {
  Table table({{"bodies"},
               {"placements", Align::right},
               {"cross", Align::right},
               {"unfelt", Align::right},
               {"deepest unfelt", Align::right},
               {"contacts", Align::right},
               {"apart", Align::right},
               {"within a width", Align::right},
               {"longer ways", Align::right},
               {"longest", Align::right}});
  for (const IpctkPlacementsFound& f : results.placements)
    table.add_row({f.bodies, std::to_string(f.placements), std::to_string(f.crossing), std::to_string(f.quiet),
                   fmt::format("{:.2g}", f.deepest_quiet), std::to_string(f.contacts), fmt::format("{:.1e}", f.apart),
                   std::to_string(f.shallow), std::to_string(f.longer), fmt::format("{:.3g}", f.longest)});
  return table;
}

Table ipctk_shots_table(const IpctkShotsFound& shots) {
  Table table({{"shots"}, {"found", Align::right}, {"expected", Align::right}});
  const auto add = [&table](const char* what, std::size_t found, const std::string& expected) {
    table.add_row({what, std::to_string(found), expected});
  };
  add("slow: below half a least altitude a step", shots.slow, "");
  add("slow, and a step collides", shots.hits, std::to_string(shots.slow));
  add("of these, felt after that step", shots.at_once, "");
  add("of these, felt after the next", shots.hits - shots.at_once - shots.late, "");
  add("of these, felt later or not at all", shots.late, "0");
  add("slow, with a warning of the speed in flight", shots.false_warnings, "0");
  add("fast", shots.fast, "");
  add("fast, and unfelt after two steps", shots.passes, "> 0");
  add("fast, without a warning", shots.silent, "0");
  add("felt before a step collides", shots.early, "0");
  return table;
}

IpctkPlacementsFound certified(const IpctkPlacements& placements, const AskIpctk& ask) {
  const std::span questions(&placements.question, 1);
  return found_by_ipctk(placements, answers_of(ask(text_of(questions)), questions).front());
}

IpctkShotsFound certified(std::span<const IpctkShot> shots, const AskIpctk& ask) {
  std::vector<IpctkQuestion> questions;
  for (const IpctkShot& shot : shots) questions.push_back(shot.question);
  return found_by_ipctk(shots, answers_of(ask(text_of(questions)), questions));
}

std::string ipctk_version() {
  std::string version, last, trouble;
  try {
    run_program(
        "python3", {"-B", script(), "--version"},
        [&](std::string_view line) {
          constexpr std::string_view before = "ipctk ";
          if (line.starts_with(before)) version = line.substr(before.size());
          if (!line.empty()) last = line;
        },
        Stderr::as_output);
  } catch (const ProcessError& error) {
    version.clear();
    trouble = error.what();
  }
  if (version.empty())
    throw IoError(
        fmt::format("--with ipctk: no `python3` answers with its version ({}{}{}); expected one on the PATH that "
                    "imports ipctk (pip install ipctk)",
                    trouble, trouble.empty() || last.empty() ? "" : ": ", last));
  return version;
}

std::string run_ipctk(const std::string& questions) {
  const ScratchFolder folder("ipctk");
  {
    std::ofstream file(folder.path() / "questions.json", std::ios::binary);
    file << questions;
    file.close();
    if (!file) throw IoError(fmt::format("{}: cannot be written", (folder.path() / "questions.json").string()));
  }
  std::string last;  // its message at the end
  try {
    run_program(
        "python3", {"-B", script(), "questions.json", "answers.json"},
        [&](std::string_view line) {
          if (!line.empty()) last = line;
        },
        Stderr::as_output, folder.path());
  } catch (const ProcessError& error) {
    throw IoError(fmt::format("ipctk: {}{}{}", error.what(), last.empty() ? "" : ": ", last));
  }
  std::ifstream answers(folder.path() / "answers.json", std::ios::binary);
  if (!answers) throw IoError(fmt::format("ipctk: it wrote no answers: {}", last));
  return {std::istreambuf_iterator<char>(answers), {}};
}

}  // namespace dartboard
