#include "benchmarks/studies/elements/calculix_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "benchmarks/harness/processes.h"
#include "benchmarks/harness/scratch_folder.h"
#include "core/plain/error.h"
#include "core/plain/nan_maximum.h"
#include "validation/statics/static_problem.h"

namespace dartboard {
namespace {

// Seven digits are printed: a number is rounded by 5e-7 of itself at most, and a displacement by as much. As much again
// is left for linear solutions; for large ones three times that, as CalculiX iterates to a residual of 1e-9 of the
// forces in it, ten times over.
constexpr double bound_small = 1e-6, bound_large = 2e-6;
constexpr double least_bend = 0.5;  // [m] counts as large

Claim claim_on(std::span<const CalculixAnswer> answers, bool large) {
  double worst = 0.0, least = INFINITY;
  std::size_t count = 0;
  for (const CalculixAnswer& a : answers) {
    if (a.large != large) continue;
    ++count;
    worst = max_or_nan(worst, a.apart);
    least = std::min(least, a.largest);
  }
  const double bound = large ? bound_large : bound_small;
  Claim claim{.id = large ? "elements-calculix-large" : "elements-calculix-small",
              .text = large ? "tetrahedra and hexahedra bent over half their length are where CalculiX has them"
                            : "under small loads linear and quadratic elements bend as those of CalculiX",
              .paper_value = fmt::format("<= {:.0e}", bound),
              .measured = fmt::format("{:.1e}", worst)};
  judge(claim, met(count > 0 && worst <= bound));
  if (large && !(least >= least_bend)) {
    claim.verdict = Verdict::falls_short;
    claim.reason = fmt::format("a beam of 1 m is bent by {:.2f} m only", least);
  }
  return claim;
}

}  // namespace

CalculixAnswer answer_to(const CalculixQuestion& question, std::string_view printed) {
  return {question.what, question.large, question.ours.size(), largest_displacement(question.ours),
          apart(question, printed)};
}

std::vector<Claim> claims_of(std::span<const CalculixAnswer> answers) {
  return {claim_on(answers, false), claim_on(answers, true)};
}

Table calculix_table(std::span<const CalculixAnswer> answers) {
  Table table({{"beam"}, {"nodes", Align::right}, {"bent by [m]", Align::right}, {"apart", Align::right}});
  for (const CalculixAnswer& a : answers)
    table.add_row(
        {a.what, fmt::format("{}", a.nodes), fmt::format("{:.3g}", a.largest), fmt::format("{:.1e}", a.apart)});
  return table;
}

std::string calculix_version() {
  std::string version, trouble;
  try {
    run_program("ccx", {"-v"}, [&](std::string_view line) {
      constexpr std::string_view before = "Version ";
      if (const auto at = line.find(before); at != line.npos) version = line.substr(at + before.size());
    });
  } catch (const ProcessError& error) {  // its exit status is not 0 even when it succeeds
    trouble = error.what();
  }
  if (version.empty())
    throw IoError(
        fmt::format("--with calculix: no `ccx` answers with its version ({}); expected that of the Debian "
                    "package calculix-ccx on the PATH",
                    trouble));
  return version;
}

std::string run_calculix(const std::string& deck) {
  const ScratchFolder folder("calculix");
  {
    std::ofstream file(folder.path() / "beam.inp", std::ios::binary);
    file << deck;
    file.close();
    if (!file) throw IoError(fmt::format("{}: cannot be written", (folder.path() / "beam.inp").string()));
  }
  std::string last;  // its message at the end
  try {
    run_program(
        "ccx", {"beam"},
        [&](std::string_view line) {
          if (line.find_first_not_of(" \r_") != line.npos) last = line;
        },
        Stderr::shown, folder.path());
  } catch (const ProcessError& error) {
    throw IoError(fmt::format("calculix: {}: {}", error.what(), last));
  }
  std::ifstream printed(folder.path() / "beam.dat", std::ios::binary);
  if (!printed) throw IoError(fmt::format("calculix: it printed no displacements: {}", last));
  return {std::istreambuf_iterator<char>(printed), {}};
}

}  // namespace dartboard
