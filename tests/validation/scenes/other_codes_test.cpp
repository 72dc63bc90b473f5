// A motion that is known exactly, found by codes that share nothing with ours.

#include "validation/scenes/other_codes.h"

#include <gtest/gtest.h>

#include "reference/error_norms.h"

namespace dartboard::other_codes_test {
namespace {

TEST(OtherCodes, FindAMotionThatIsKnownExactly) {
  const TradeoffScene chain = chain_scene(6, 300.0);
  const SceneReference found = reference_by_other_codes(chain, 1e-8);
  EXPECT_EQ(found.kind, ReferenceKind::other_codes);
  ASSERT_EQ(found.states.size(), chain.motion.checkpoints.size());
  EXPECT_LE(found.agreement, 1e-8);
  EXPECT_DOUBLE_EQ(found.floor, 10.0 * found.agreement);
  // ten times their distance is their resolution
  EXPECT_LE(reference::motion_errors(chain.motion, found.states, chain.closed_form()).x, found.floor);
}

TEST(OtherCodes, AreMadeFinerUntilTheyAgree) {
  const TradeoffScene chain = chain_scene(6, 300.0);
  const SceneReference coarse = reference_by_other_codes(chain, 1.0), fine = reference_by_other_codes(chain, 1e-9);
  EXPECT_LT(fine.agreement, 0.1 * coarse.agreement);
  EXPECT_NE(coarse.what, fine.what);
}

}  // namespace
}  // namespace dartboard::other_codes_test
