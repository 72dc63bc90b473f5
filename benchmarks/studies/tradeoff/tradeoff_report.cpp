#include "benchmarks/studies/tradeoff/tradeoff_report.h"

#include <fmt/format.h>

#include <algorithm>

namespace dartboard {

std::string trouble_of(const WorkPrecision& study) {
  constexpr double largest_floor = 1e-2;  // [edges]
  if (!(study.reference.floor <= largest_floor))
    return fmt::format("{}: nothing can be concluded, the reference is uncertain by {:.1e} edges: {}", study.scene,
                       study.reference.floor, study.reference.what);
  const auto ended = std::ranges::count_if(study.points, [](const WorkPoint& p) { return !p.failed(); });
  const auto useless = std::ranges::count(study.points, Standing::useless, &WorkPoint::standing);
  if (ended > 0 && ended == useless)
    return fmt::format("{}: none of {} runs follows the motion of the reference", study.scene, ended);
  return "";
}

}  // namespace dartboard
