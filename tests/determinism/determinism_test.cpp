// The same bits everywhere: for walks, storages, repeated runs, and every preset, because the numbers are pinned.

#include <gtest/gtest.h>

#include <cctype>
#include <ostream>
#include <string>

#include "core/base/lanes.h"
#include "core/base/thread_team.h"
#include "tests/determinism/state_hashes.h"

namespace dartboard {

void PrintTo(const HashedRun& run, std::ostream* out) { *out << run.name; }

namespace {

struct StateHash : testing::TestWithParam<HashedRun> {};

TEST_P(StateHash, IsThePinnedOneAndThatOfARepeatedRun) {
  const std::uint64_t hash = GetParam().run();
  EXPECT_EQ(hash, GetParam().pinned) << std::hex << hash;
  EXPECT_EQ(GetParam().run(), hash);
}

TEST_P(StateHash, IsThatOfOneNumberAtATimeByThreeThreads) {
  const bool lanes = use_lanes(false);
  const unsigned threads = use_threads(3);
  EXPECT_EQ(GetParam().run(), GetParam().pinned);
  use_threads(threads);
  use_lanes(lanes);
}

INSTANTIATE_TEST_SUITE_P(Of, StateHash, testing::ValuesIn(hashed_runs().begin(), hashed_runs().end()),
                         [](const auto& tested) {
                           std::string name;
                           for (const char c : tested.param.name)
                             if (std::isalnum(static_cast<unsigned char>(c))) name += c;
                           return name;
                         });

TEST(SupernodalFactor, EndsInTheSameBitsAgain) {
  EXPECT_EQ(hash_with_supernodal_factor(), hash_with_supernodal_factor());
}

}  // namespace
}  // namespace dartboard
