#include "benchmarks/studies/tradeoff/audit_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "validation/scenes/random_scenes.h"
#include "validation/scenes/scene_of_file.h"

namespace dartboard {
namespace {

/// The numbers of audited scenes, and of errors for each.
struct Extent {
  std::uint64_t scenes, errors;
  std::uint64_t long_scenes, long_errors;
  std::uint64_t endless_scenes;  // one error each
};
// by kind: in full, and quick
constexpr Extent extents[2][2]{{{40, 2, 2, 2, 2}, {2, 2, 0, 0, 0}}, {{13, 5, 0, 0, 0}, {2, 5, 0, 0, 0}}};

const Extent& extent_of(AuditKind kind, bool quick) { return extents[kind == AuditKind::long_motions][quick]; }

/// Errors from the largest to the smallest, one in each of `count` equal parts on the logarithmic scale.
std::vector<double> draw_errors(SplitMix64& random, std::uint64_t count, double largest, double smallest) {
  std::vector<double> errors;
  for (std::uint64_t k = 0; k < count; ++k) {
    const double u = (static_cast<double>(k) + 0.5 * (random.next_signed() + 1.0)) / static_cast<double>(count);
    errors.push_back(largest * std::pow(smallest / largest, u));
  }
  return errors;
}

}  // namespace

double longest_sweep_run(double dearest_pick_s) { return std::max(2.2 * dearest_pick_s, 0.005); }

AuditCases::AuditCases(AuditKind kind, std::uint64_t seed, bool quick, std::vector<std::filesystem::path> gallery)
    : kind_(kind),
      seed_(seed),
      quick_(quick),
      random_(seed + (kind == AuditKind::long_motions ? 177 : 77)),
      gallery_(std::move(gallery)) {}

std::uint64_t AuditCases::size() const {
  const Extent& extent = extent_of(kind_, quick_);
  return extent.scenes + extent.long_scenes + extent.endless_scenes + gallery_.size();
}

AuditCase AuditCases::next() {
  if (kind_ == AuditKind::long_motions) return next_long_motion();
  const Extent& extent = extent_of(kind_, quick_);
  const std::uint64_t k = drawn_++, unseen = size() - gallery_.size();
  if (k >= unseen) return next_of_gallery(k - unseen);
  AuditCase drawn;
  drawn.check = k < extent.scenes                        ? AuditCheck::reference_and_sweep
                : k < extent.scenes + extent.long_scenes ? AuditCheck::reference
                                                         : AuditCheck::costs_only;
  RandomSceneOptions options;
  if (quick_) options = {.most_points = 400, .most_work = 5e4};
  if (drawn.check == AuditCheck::reference)
    options = {
        .least_points = 1500, .most_work = 1e9, .least_phase = 1200.0, .most_phase = 2000.0, .only_springs = true};
  if (drawn.check == AuditCheck::costs_only)
    options = {
        .least_points = 2000, .most_work = 1e9, .least_phase = 12000.0, .most_phase = 15000.0, .only_springs = true};
  drawn.scene = random_scene(seed_, k, options);
  if (drawn.check == AuditCheck::costs_only)
    drawn.errors = draw_errors(random_, 1, 1e-3, 1e-6);
  else
    drawn.errors =
        draw_errors(random_, drawn.check == AuditCheck::reference ? extent.long_errors : extent.errors, 1e-2, 1e-5);
  return drawn;
}

AuditCase AuditCases::next_of_gallery(std::uint64_t number) {
  constexpr double whole_runs_s = 40.0;  // without a budget they may take ten times as long as the run recommended
  AuditCase next{scene_of_file(read_scene(gallery_.at(number))),
                 draw_errors(random_, extent_of(kind_, quick_).errors, 1e-2, 1e-5), AuditCheck::reference};
  if (!next.scene.equal_steps().empty()) next.budget_s = whole_runs_s;
  return next;
}

AuditCase AuditCases::next_long_motion() {
  // springs times duration times omega_max: a run makes two to twenty evaluations of some nanoseconds of each
  const double work = quick_ ? 2e5 : 2e7;
  const RandomSceneOptions options{.least_points = 60,
                                   .most_points = 200,
                                   .most_work = 1.3 * work,
                                   .least_work = work,
                                   .damped_work = 2.6,
                                   .least_phase = 1e3,
                                   .most_phase = 2e6,
                                   .least_strain = 2e-4,
                                   .most_strain = 1e-3,
                                   .least_sag = 5e-4,
                                   .most_sag = 5e-3,
                                   .only_springs = true};
  AuditCase drawn;
  drawn.scene = random_scene(seed_, drawn_++, options);
  drawn.errors = draw_errors(random_, extent_of(kind_, quick_).errors, 3e-5, 3e-7);
  drawn.budget_s = 0.03;
  return drawn;
}

}  // namespace dartboard
