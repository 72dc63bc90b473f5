// Scenes of contact that are drawn at random: the same for a seed, of all kinds, and right as far as a few can tell.

#include "validation/contact/drawn_contacts.h"

#include <gtest/gtest.h>

#include <set>

namespace dartboard::drawn_contacts_test {
namespace {

TEST(DrawnContacts, AreOfAllKindsAndTheSameForASeed) {
  std::set<std::pair<DrawnKind, bool>> kinds;
  std::set<std::string> integrators;
  for (std::uint64_t k = 0; k < 200; ++k) {
    const DrawnContact one = draw_contact(3, k);
    EXPECT_EQ(one.scene, draw_contact(3, k).scene);
    kinds.insert({one.kind, one.with_bodies});
    integrators.insert(one.integrator);
  }
  EXPECT_EQ(kinds.size(), 6u);
  EXPECT_EQ(integrators.size(), 16u);
  EXPECT_NE(draw_contact(3, 1).scene, draw_contact(4, 1).scene);
}

TEST(DrawnContacts, AreNeitherPulledNorCaughtNorLostInSilence) {
  std::size_t touched = 0;
  for (std::uint64_t k = 0; k < 30; ++k) {
    const DrawnContact one = draw_contact(3, k);
    const DrawnContactFound found = run_drawn_contact(one);
    EXPECT_LE(found.pulled, one.with_bodies ? 1e-3 : 1e-9) << one.about;
    EXPECT_LE(found.caught, 1e-6) << one.about;
    EXPECT_TRUE(!found.lost || found.warned) << one.about;
    touched += found.touched ? 1 : 0;
  }
  EXPECT_GE(touched, 27u);
}

}  // namespace
}  // namespace dartboard::drawn_contacts_test
