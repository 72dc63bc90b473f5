#include "core/time/solve/stop_request.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <memory>
#include <stdexcept>
#include <thread>

#include "core/time/solve/cholesky.h"
#include "tests/support/step_matrices_for_tests.h"

namespace dartboard::stop_request_test {
namespace {

std::atomic<bool> wanted = false;
bool is_wanted() { return wanted; }
bool never() { return false; }

TEST(StopRequest, WithoutOneNothingMayBeStopped) {
  EXPECT_FALSE(may_be_stopped(1e9));
  EXPECT_NO_THROW(throw_if_stopped());
}

TEST(StopRequest, IsForWorkThatTakesLong) {
  const StopRequest request(never, 0.5);
  EXPECT_FALSE(may_be_stopped(0.4));
  EXPECT_TRUE(may_be_stopped(0.5));
}

TEST(StopRequest, EndsWithItsScope) {
  { const StopRequest request(never, 0.0); }
  EXPECT_FALSE(may_be_stopped(1.0));
}

TEST(StopRequest, WorkThatNobodyStopsIsDoneAndItsErrorsArrive) {
  const StopRequest request(never, 0.0);
  std::thread::id by;
  do_unless_stopped([&by] { by = std::this_thread::get_id(); });
  EXPECT_NE(by, std::thread::id());
  EXPECT_NE(by, std::this_thread::get_id());
  EXPECT_THROW(do_unless_stopped([] { throw std::runtime_error("failed"); }), std::runtime_error);
  EXPECT_FALSE(work_left_behind());
}

TEST(StopRequest, WorkIsGivenUpWhileItGoesOnWithWhatItShares) {
  wanted = false;
  const StopRequest request(is_wanted, 0.0);
  std::promise<void> begun, release;
  const auto shared = std::make_shared<std::atomic<int>>(0);
  const auto released = std::make_shared<std::future<void>>(release.get_future());
  std::thread asker([&begun] {
    begun.get_future().wait();
    wanted = true;
  });
  EXPECT_THROW(do_unless_stopped([&begun, shared, released] {
                 begun.set_value();
                 released->wait();
                 *shared = 7;
               }),
               Stopped);
  asker.join();
  EXPECT_TRUE(work_left_behind());
  release.set_value();
  while (work_left_behind()) std::this_thread::yield();
  EXPECT_EQ(*shared, 7);
}

TEST(StopRequest, NothingIsBegunAfterIt) {
  wanted = true;
  const StopRequest request(is_wanted, 0.0);
  bool begun = false;
  EXPECT_THROW(do_unless_stopped([&begun] { begun = true; }), Stopped);
  EXPECT_THROW(throw_if_stopped(), Stopped);
  EXPECT_FALSE(begun);
}

BodyMatrix large_grid() {
  SpringArrays body = spring_grid(6, 6, 6);
  body.fixed[0] = 1;
  disturb(body, 0.01, 0);
  return BodyMatrix(std::move(body));
}

std::vector<Eigen::Vector3d> solution(Cholesky& cholesky, const BlockMatrix& blocks) {
  const auto b = random_vectors(blocks.node_count(), 3);
  auto x = b;
  EXPECT_EQ(cholesky.factorise(blocks), SolveStatus::ok);
  EXPECT_EQ(cholesky.solve(b, x), SolveStatus::ok);
  return x;
}

TEST(StopRequest, AFactorMadeInAThreadHasTheSameBits) {
  const BodyMatrix body = large_grid();
  for (const FactorKind kind : {FactorKind::simplicial, FactorKind::supernodal}) {
    Cholesky here({.kind = kind}), there({.kind = kind});
    const auto expected = solution(here, body.blocks);
    const StopRequest request(never, 0.0);
    EXPECT_EQ(solution(there, body.blocks), expected);
    EXPECT_EQ(there.counters().orderings, here.counters().orderings);
    EXPECT_EQ(there.counters().factorisations, here.counters().factorisations);
  }
}

TEST(StopRequest, AFactorisationThatIsGivenUpLeavesNoFactorAndCanBeRepeated) {
  const BodyMatrix body = large_grid();
  Cholesky cholesky;
  const auto expected = solution(cholesky, body.blocks);
  {
    wanted = true;
    const StopRequest request(is_wanted, 0.0);
    EXPECT_THROW(cholesky.factorise(body.blocks), Stopped);
  }
  EXPECT_FALSE(cholesky.has_factor());
  EXPECT_EQ(solution(cholesky, body.blocks), expected);
}

}  // namespace
}  // namespace dartboard::stop_request_test
