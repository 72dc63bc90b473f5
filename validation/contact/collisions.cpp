#include "validation/contact/collisions.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/counted.h"
#include "validation/contact/contact_run.h"

namespace dartboard {
namespace {

// sums of some hundred forces in each of some hundred steps, by their roundings
constexpr double most_momentum = 1e-12;

}  // namespace

ClaimAnswer try_collision(const SceneFile& scene, std::size_t looks) {
  const ContactRun run = judge_run(scene, looks);
  const double changed = std::max(run.momentum, run.angular);
  return {run.ended && run.contacts > 0 && run.deepest <= run.allowed && run.alone && changed <= most_momentum,
          fmt::format("up to {}; overlaps up to {:.2g} of the depth allowed; momentum kept to {:.1e}",
                      counted(run.contacts, "contact"), run.deepest / run.allowed, changed)};
}

}  // namespace dartboard
