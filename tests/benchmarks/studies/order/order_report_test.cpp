// The conclusions of `validate order` from its results: with one wrong figure, the claim about it falls short.

#include "benchmarks/studies/order/order_report.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/support/claims_for_tests.h"

namespace dartboard::order_report_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

OrderResults good_results() {
  OrderResults r;
  for (const OrderCase which : order_cases) {
    reference::CertifiedMotion certified;
    certified.accepted = certified.independent = true;
    certified.self_difference = certified.agreement = 1e-14;
    certified.codes = {{"one", 1e-14, 0, 0.0, ""}, {"another", 1e-13, 0, 0.0, ""}};
    r.references.push_back({which, certified});
    for (const char* name : {"verlet", "rk4"}) r.studies.push_back({name, which, 2, {}, true, 2.01, 1.98, ""});
  }
  r.discrete = {{"verlet", 0.0, 0.25, 1000, 1e-12, ""}, {"rk4", 0.0, 0.25, 1000, 1e-11, ""}};
  r.force = {.ratio = 0.3, .deviation = 3e-15, .bound = 1e-14, .largest_force = 2.0};
  r.jumps = {{.energy = 1e-16, .momentum = 2e-16, .angular = 0.0}};
  r.drift = {1000, 20.0, 27, 30, 1e-13, ""};
  r.factor = {100, 200, 2, 1e-9, 1e-3, ""};
  return r;
}

/// The claims that fall short when one thing differs from `good_results`.
std::vector<std::string> short_with(const std::function<void(OrderResults&)>& spoil) {
  OrderResults r = good_results();
  spoil(r);
  return ids_of(claims_of(r), Verdict::falls_short);
}
using Ids = std::vector<std::string>;

TEST(OrderClaims, HoldWhenEverythingIsAsPromised) {
  const auto claims = claims_of(good_results());
  EXPECT_EQ(ids_of(claims, Verdict::holds),
            (Ids{"order-undamped", "order-damped", "order-aligned-cut", "order-unaligned-cut", "oracle-agreement",
                 "discrete-exact", "force-is-gradient", "cut-jump", "energy-momentum-drift", "kept-factor"}));
}

TEST(OrderClaims, FallShortOfTheSceneInWhichOneIntegratorMissesItsOrderAndNameIt) {
  const char* ids[]{"order-undamped", "order-damped", "order-aligned-cut", "order-unaligned-cut"};
  for (std::size_t k = 0; k < std::size(order_cases); ++k) {
    OrderResults r = good_results();
    OrderStudy& missed = r.studies[2 * k + 1];
    missed.holds = false;
    missed.reason = "order 1.00 in x";
    const auto claims = claims_of(r);
    EXPECT_EQ(ids_of(claims, Verdict::falls_short), Ids{ids[k]});
    EXPECT_EQ(find_claim(claims, ids[k]).reason, "rk4: order 1.00 in x");
    EXPECT_TRUE(find_claim(claims, ids[k]).measured.starts_with("1 of 2 integrators"));
  }
}

TEST(OrderClaims, AreNotTestedWhereNothingWasStudied) {
  OrderResults r = good_results();
  r.studies.clear();
  r.references.clear();
  r.discrete.clear();
  EXPECT_EQ(ids_of(claims_of(r), Verdict::not_tested),
            (Ids{"order-undamped", "order-damped", "order-aligned-cut", "order-unaligned-cut", "oracle-agreement",
                 "discrete-exact"}));
}

TEST(OrderClaims, FallShortOfTheReferencesWhenACodeIsFarFromOneOfThem) {
  EXPECT_EQ(short_with([](auto& r) { r.references[2].certified.codes[1].distance = 3e-12; }), Ids{"oracle-agreement"});
  EXPECT_EQ(short_with([](auto& r) { r.references[1].certified.codes[0].distance = nan; }), Ids{"oracle-agreement"});
}

TEST(OrderClaims, FallShortOfTheReferencesWhenOneIsNotAccepted) {
  for (const std::size_t k : {0u, 3u})
    EXPECT_EQ(short_with([k](auto& r) { r.references[k].certified.accepted = false; }), Ids{"oracle-agreement"}) << k;
}

TEST(OrderClaims, SayOfWhomTheReferencesAreConfirmed) {
  OrderResults r = good_results();
  EXPECT_EQ(references_heading(r), "by independent codes");
  r.references[0].certified.independent = false;
  EXPECT_EQ(references_heading(r), "by two methods of one library");
}

TEST(OrderClaims, FallShortOfTheDiscreteMapByTheFarthestIntegrator) {
  EXPECT_EQ(short_with([](auto& r) { r.discrete[0].deviation = 2e-10; }), Ids{"discrete-exact"});
  EXPECT_EQ(short_with([](auto& r) { r.discrete[0].deviation = nan; }), Ids{"discrete-exact"});
  OrderResults r = good_results();
  EXPECT_EQ(find_claim(claims_of(r), "discrete-exact").bound_or_interval, "after 1000 steps, the farthest: rk4");
}

TEST(OrderClaims, FallShortOfTheGradientBeyondTheRoundingBound) {
  EXPECT_EQ(short_with([](auto& r) { r.force.ratio = 1.01; }), Ids{"force-is-gradient"});
  EXPECT_EQ(short_with([](auto& r) { r.force.ratio = nan; }), Ids{"force-is-gradient"});
}

TEST(OrderClaims, FallShortOfACutThatChangesEnergyMomentumOrAngularMomentum) {
  EXPECT_EQ(short_with([](auto& r) { r.jumps.push_back({.energy = 2e-14}); }), Ids{"cut-jump"});
  EXPECT_EQ(short_with([](auto& r) { r.jumps.push_back({.momentum = 2e-14}); }), Ids{"cut-jump"});
  EXPECT_EQ(short_with([](auto& r) { r.jumps.push_back({.angular = 2e-14}); }), Ids{"cut-jump"});
  EXPECT_EQ(short_with([](auto& r) { r.jumps.push_back({.energy = nan}); }), Ids{"cut-jump"});
}

TEST(OrderClaims, FallShortOfAnEnergyThatDriftsAndOfARunThatEnds) {
  EXPECT_EQ(short_with([](auto& r) { r.drift.drift = 2e-11; }), Ids{"energy-momentum-drift"});
  EXPECT_EQ(short_with([](auto& r) { r.drift.diagnosis = "no solution"; }), Ids{"energy-momentum-drift"});
}

TEST(OrderClaims, FallShortOfAFactorThatIsNotKept) {
  EXPECT_EQ(short_with([](auto& r) { r.factor.kept = 21; }), Ids{"kept-factor"});
}

TEST(OrderClaims, FallShortOfAKeptFactorWithAnotherMotion) {
  EXPECT_EQ(short_with([](auto& r) { r.factor.difference = 2e-6; }), Ids{"kept-factor"});
  EXPECT_EQ(short_with([](auto& r) { r.factor.diagnosis = "not converged"; }), Ids{"kept-factor"});
}

}  // namespace
}  // namespace dartboard::order_report_test
