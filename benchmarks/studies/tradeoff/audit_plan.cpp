#include "benchmarks/studies/tradeoff/audit_plan.h"

#include <algorithm>
#include <cmath>

#include "validation/scenes/random_scenes.h"

namespace dartboard {
namespace {

/// How much is audited, and how many errors of each scene.
struct Extent {
  std::uint64_t scenes, errors;
  std::uint64_t long_scenes, long_errors;
  std::uint64_t endless_scenes;  // one error each
};
constexpr Extent full_extent{14, 3, 2, 2, 2}, quick_extent{2, 2, 0, 0, 0};

/// Errors between 1e-2 and 1e-8, one in each of `count` equal parts on the logarithmic scale.
std::vector<double> draw_errors(SplitMix64& random, std::uint64_t count) {
  std::vector<double> errors;
  for (std::uint64_t k = 0; k < count; ++k) {
    const double u = 0.5 * (random.next_signed() + 1.0);
    errors.push_back(std::pow(10.0, -2.0 - 6.0 * (static_cast<double>(k) + u) / static_cast<double>(count)));
  }
  return errors;
}

}  // namespace

double longest_sweep_run(double dearest_pick_s) { return std::max(2.2 * dearest_pick_s, 0.005); }

AuditCases::AuditCases(std::uint64_t seed, bool quick) : seed_(seed), quick_(quick), random_(seed + 77) {}

std::uint64_t AuditCases::size() const {
  const Extent& extent = quick_ ? quick_extent : full_extent;
  return extent.scenes + extent.long_scenes + extent.endless_scenes;
}

AuditCase AuditCases::next() {
  const Extent& extent = quick_ ? quick_extent : full_extent;
  const std::uint64_t k = drawn_++;
  AuditCase drawn;
  drawn.check = k < extent.scenes                        ? AuditCheck::reference_and_sweep
                : k < extent.scenes + extent.long_scenes ? AuditCheck::reference
                                                         : AuditCheck::costs_only;
  RandomSceneOptions options;
  if (quick_) options = {.most_points = 400, .most_work = 5e4};
  if (drawn.check == AuditCheck::reference)
    options = {.least_points = 1500, .most_work = 1e9, .least_phase = 1200.0, .most_phase = 2000.0};
  if (drawn.check == AuditCheck::costs_only)
    options = {.least_points = 2000, .most_work = 1e9, .least_phase = 12000.0, .most_phase = 15000.0};
  drawn.scene = random_scene(seed_, k, options);
  if (drawn.check == AuditCheck::costs_only)
    drawn.errors = {std::sqrt(draw_errors(random_, 1)[0] * 1e-4)};
  else
    drawn.errors = draw_errors(random_, drawn.check == AuditCheck::reference ? extent.long_errors : extent.errors);
  return drawn;
}

}  // namespace dartboard
