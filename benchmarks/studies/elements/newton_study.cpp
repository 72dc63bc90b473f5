#include "benchmarks/studies/elements/newton_study.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace dartboard {
namespace {

// Residuals of 1e-9 leave displacements that are some condition number apart, of a beam five times as long as wide.
constexpr double same_place = 1e-5;

std::string count_of(const NewtonRun& run) {
  return run.iterations ? fmt::format("{}", *run.iterations) : fmt::format("none in {}", NewtonRun::most);
}

}  // namespace

Claim claim_on(std::span<const NewtonRun> runs) {
  Claim claim{.id = "elements-newton",
              .text = "exact tangents of corotational elements take fewer iterations than warped stiffness",
              .paper_value = "fewer"};
  bool fewer = !runs.empty();
  for (const NewtonRun& exact : runs) {
    if (exact.matrix != NewtonRun::exact) continue;
    fewer = fewer && exact.iterations.has_value();
    bool has_warped = false;
    for (const NewtonRun& other : runs) {
      if (other.traction != exact.traction || other.matrix == NewtonRun::exact) continue;
      if (other.iterations)
        fewer = fewer && exact.iterations.value_or(NewtonRun::most) < *other.iterations &&
                std::abs(other.bent - exact.bent) <= same_place * exact.bent;
      if (other.matrix != NewtonRun::warped) continue;
      has_warped = true;
      claim.measured +=
          fmt::format("{}{} against {}", claim.measured.empty() ? "" : ", ", count_of(exact), count_of(other));
    }
    fewer = fewer && has_warped;
  }
  judge(claim, met(fewer && !claim.measured.empty()));
  return claim;
}

Table newton_table(std::span<const NewtonRun> runs) {
  Table table({{"load [Pa]", Align::right}, {"matrix"}, {"iterations", Align::right}, {"bent by [m]", Align::right}});
  for (const NewtonRun& run : runs)
    table.add_row({fmt::format("{:g}", run.traction), run.matrix, count_of(run),
                   run.iterations ? fmt::format("{:.4f}", run.bent) : ""});
  return table;
}

}  // namespace dartboard
