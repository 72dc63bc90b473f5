#include "core/time/explicit/compensated_state.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

// sum + lost grows by the increment: two-sum, without a branch.
void add(const Vector3d& increment, Vector3d& sum, Vector3d& lost) {
  const Vector3d more = increment + lost;
  const Vector3d next = sum + more;
  const Vector3d added = next - sum;
  lost = (sum - (next - added)) + (more - added);
  sum = next;
}

void forget_where_changed(std::span<const Vector3d> now, const std::vector<Vector3d>& left,
                          std::vector<Vector3d>& lost) {
  const std::size_t known = left.size();
  lost.resize(now.size(), Vector3d::Zero());
  for (std::size_t i = 0; i < now.size(); ++i)
    for (int c = 0; c < 3; ++c)
      if (i >= known || !(now[i][c] == left[i][c])) lost[i][c] = 0.0;
}

}  // namespace

void CompensatedState::begin(Motion motion) {
  end_.x.assign(motion.x.begin(), motion.x.end());
  end_.v.assign(motion.v.begin(), motion.v.end());
  forget_where_changed(motion.x, left_.x, lost_.x);
  forget_where_changed(motion.v, left_.v, lost_.v);
  lost_at_end_ = lost_;
}

void CompensatedState::drift(double t) {
  for (std::size_t i = 0; i < end_.x.size(); ++i) add(t * end_.v[i], end_.x[i], lost_at_end_.x[i]);
}

void CompensatedState::kick(double t, std::span<const Vector3d> a) {
  for (std::size_t i = 0; i < end_.v.size(); ++i) add(t * a[i], end_.v[i], lost_at_end_.v[i]);
}

StepResult CompensatedState::commit(Motion motion, WorkCounters& work) {
  const StepResult result = end_.commit(motion, work);
  if (!result.ok()) return result;
  std::swap(lost_, lost_at_end_);
  std::swap(left_, end_);
  end_.x.resize(left_.x.size());
  end_.v.resize(left_.v.size());
  return result;
}

}  // namespace dartboard
