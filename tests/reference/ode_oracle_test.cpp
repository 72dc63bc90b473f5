// The codes of the ODE oracle compared with motions in closed form, with each other, and across events.

#include "reference/ode_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/plain/error.h"
#include "core/plain/random.h"
#include "reference/closed_form.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::reference::ode_oracle_test {
namespace {

struct Code {
  const char* name;
  CodeRun (*run)(const NetworkMotion&);
  // What may be off. Steps of h omega = 0.05 of order 8 err by some 1e-8 (h omega)^8 per radian, 40 radians at most,
  // and extrapolation by less; the closed forms in double round such phases to 40 * 2^-53 = 4e-15, of coordinates up
  // to 5. The codes of SUNDIALS keep the error of each of some hundred steps below 1e-13 of the state.
  double tolerance;
};

const Code codes[]{
    {"OdeintFehlberg", [](const NetworkMotion& m) { return run_odeint_fehlberg(m, 0.05); }, 2e-14},
    {"OdeintBulirschStoer", [](const NetworkMotion& m) { return run_odeint_bulirsch_stoer(m, 1e-17); }, 2e-14},
    {"CvodeAdams", [](const NetworkMotion& m) { return run_cvode_adams(m, 1e-13); }, 2e-11},
    {"ArkodeFehlberg", [](const NetworkMotion& m) { return run_arkode_fehlberg(m, 1e-13); }, 2e-11},
};

// With those of SUNDIALS if it is installed.
std::vector<Code> codes_there_are() {
  std::vector<Code> there;
  for (const Code& code : codes)
    if (have_sundials() || std::string_view(code.name).starts_with("Odeint")) there.push_back(code);
  return there;
}

void PrintTo(const Code& code, std::ostream* out) { *out << code.name; }

struct OdeCode : testing::TestWithParam<Code> {
  // The states at the checkpoints; empty, and the test has failed, when the code gave up.
  std::vector<std::vector<long double>> run(const NetworkMotion& motion) {
    const CodeRun result = GetParam().run(motion);
    EXPECT_EQ(result.failure, "");
    EXPECT_EQ(result.states.size(), motion.checkpoints.size());
    EXPECT_GT(result.evaluations, 0u);
    return result.states;
  }
  void expect_near(long double actual, double expected, const char* what) {
    EXPECT_NEAR(static_cast<double>(actual), expected, GetParam().tolerance) << what;
  }
};

NetworkMotion one_spring(double m1, double m2, double stiffness, double damping, double rest_length) {
  NetworkMotion motion;
  motion.network.mass = {m1, m2};
  motion.network.fixed = {0, 0};
  motion.network.springs = {{0, 1, stiffness, damping, rest_length}};
  motion.start.x = {{0, 0, 0}, {rest_length + 0.25, 0, 0}};
  motion.start.v = {{0.5, 0, 0}, {0.25, 0, 0}};
  motion.checkpoints = {1.0, 2.5, 8.0};
  return motion;
}

// Of n points, coordinate x of point i, and its velocity.
long double x_of(const std::vector<long double>& y, std::size_t i) { return y[3 * i]; }
long double v_of(const std::vector<long double>& y, std::size_t i) { return y[y.size() / 2 + 3 * i]; }

TEST_P(OdeCode, SwingsTwoMassesOnASpring) {
  for (const double damping : {0.0, 0.25}) {
    NetworkMotion motion = one_spring(1.0, 0.5, 8.0, damping, 1.0);
    motion.network.viscosity = damping / 4;
    const auto states = run(motion);
    const Dumbbell body{1.0, 0.5, 8.0, damping, 1.0, damping / 4};
    for (std::size_t c = 0; c < states.size(); ++c) {
      const DumbbellState exact = swing(body, {0.0, 1.25, 0.5, 0.25}, motion.checkpoints[c]);
      expect_near(x_of(states[c], 0), exact.x1, "x1");
      expect_near(x_of(states[c], 1), exact.x2, "x2");
      expect_near(v_of(states[c], 0), exact.v1, "v1");
      expect_near(v_of(states[c], 1), exact.v2, "v2");
    }
  }
}

TEST_P(OdeCode, RefusesAMotionThatGoesBackInTime) {
  NetworkMotion motion = one_spring(1.0, 0.5, 8.0, 0.0, 1.0);
  motion.checkpoints = {2.0, 1.0};
  EXPECT_THROW(GetParam().run(motion), InputError);
}

// A thread has no more processor time than wall time; a millisecond for the resolution of its clock.
TEST_P(OdeCode, TakesNoMoreTimeThanHasGoneBy) {
  const auto begin = std::chrono::steady_clock::now();
  const CodeRun result = GetParam().run(one_spring(1.0, 0.5, 8.0, 0.0, 1.0));
  const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - begin;
  EXPECT_GT(result.cpu_s, 0.0);
  EXPECT_LE(result.cpu_s, gone.count() + 1e-3);
}

TEST_P(OdeCode, DampsAMassAtAWallUnderCriticallyAndOver) {
  for (const double damping : {1.0, 4.0, 6.0}) {  // omega = 2, m = 1: critical is 4
    NetworkMotion motion = one_spring(1.0, 1.0, 4.0, damping, 1.0);
    motion.network.fixed = {1, 0};
    motion.start.v[0].setZero();
    const auto states = run(motion);
    for (std::size_t c = 0; c < states.size(); ++c) {
      const Swing exact = oscillate(4.0, damping, {0.25, 0.25}, motion.checkpoints[c]);
      expect_near(x_of(states[c], 1) - 1.0L, exact.q, "q");
      expect_near(v_of(states[c], 1), exact.v, "v");
      expect_near(x_of(states[c], 0), 0.0, "wall");
    }
  }
}

TEST_P(OdeCode, LetsAPointFallThroughAMedium) {
  NetworkMotion motion;
  motion.network.mass = {2.0, 0.5};
  motion.network.fixed = {0, 1};
  motion.network.viscosity = 0.25;
  motion.network.gravity = {0.5, 0, -1.0};
  motion.start = {{{1, 0, 0}, {5, 0, 0}}, {{-1, 0.5, 2}, {0.125, 0, 0}}};
  motion.checkpoints = {0.5, 3.0};
  const auto states = run(motion);
  for (std::size_t c = 0; c < states.size(); ++c) {
    const Flight exact = free_fall({{1, 0, 0}, {-1, 0.5, 2}}, motion.network.gravity, 0.25, motion.checkpoints[c]);
    for (std::size_t k = 0; k < 3; ++k) {
      expect_near(states[c][k], exact.x[static_cast<Eigen::Index>(k)], "x");
      expect_near(states[c][6 + k], exact.v[static_cast<Eigen::Index>(k)], "v");
    }
    // a fixed point keeps the velocity it has
    expect_near(x_of(states[c], 1), 5.0 + 0.125 * motion.checkpoints[c], "driven");
  }
}

TEST_P(OdeCode, FollowsEachModeOfAChain) {
  const int n = 5;
  for (const int j : {1, 3, 5}) {
    NetworkMotion motion;
    motion.network.mass.assign(n + 2, 0.25);
    motion.network.fixed.assign(n + 2, 0);
    motion.network.fixed.front() = motion.network.fixed.back() = 1;
    const double a = 0x1p-5;
    for (int i = 0; i <= n + 1; ++i) {
      const double shape = i == 0 || i == n + 1 ? 0.0 : chain_shape_fixed(n, j, i);
      motion.start.x.emplace_back(i + a * shape, 0, 0);
      motion.start.v.emplace_back(0, 0, 0);
      if (i > 0)
        motion.network.springs.push_back(
            {static_cast<std::uint32_t>(i - 1), static_cast<std::uint32_t>(i), 4.0, 0.0, 1.0});
    }
    const double omega = chain_omega_fixed(n, 4.0, 0.25, j);
    motion.checkpoints = {1.0, 5.0};  // up to 40 radians
    const auto states = run(motion);
    for (std::size_t c = 0; c < states.size(); ++c)
      for (int i = 1; i <= n; ++i)
        expect_near(x_of(states[c], static_cast<std::size_t>(i)) - i,
                    a * chain_shape_fixed(n, j, i) * std::cos(omega * motion.checkpoints[c]), "displacement");
  }
}

// A spring snaps; the points are renumbered, and one becomes two.
TEST_P(OdeCode, ContinuesExactlyFromAnEvent) {
  NetworkMotion motion = one_spring(1.0, 0.5, 8.0, 0.0, 1.0);
  SpringNetwork snapped;
  snapped.mass = {0.25, 1.0, 0.25};
  snapped.fixed = {0, 0, 0};
  motion.events.push_back({2.5, snapped, {1, 0, 1}});
  EXPECT_EQ(motion.interval_at(1), 0u);  // the checkpoint of the same time comes first
  EXPECT_EQ(motion.interval_at(2), 1u);
  const auto states = run(motion);
  ASSERT_EQ(states.size(), 3u);
  ASSERT_EQ(states[1].size(), 12u);
  ASSERT_EQ(states[2].size(), 18u);
  const DumbbellState cut = swing({1.0, 0.5, 8.0, 0.0, 1.0, 0.0}, {0.0, 1.25, 0.5, 0.25}, 2.5);
  expect_near(x_of(states[1], 1), cut.x2, "x2 at the event");
  for (const std::size_t i : {0u, 2u}) expect_near(x_of(states[2], i), cut.x2 + 5.5 * cut.v2, "x2 after it");
  expect_near(x_of(states[2], 1), cut.x1 + 5.5 * cut.v1, "x1 after it");
}

INSTANTIATE_TEST_SUITE_P(All, OdeCode, testing::ValuesIn(codes_there_are()),
                         [](const auto& tested) { return std::string(tested.param.name); });

NetworkMotion moving_grid() {
  Problem problem;
  problem.mesh = kuhn_grid(2, 2, 2, 0.5, 0.1, 2);
  problem.material = {.density = 1000.0, .stiffness = 50.0, .damping = 0.5, .viscosity = 0.125};
  problem.surroundings.gravity = {0, 0.25, -0.5};
  problem.fixed = {0, 1};
  NetworkMotion motion;
  motion.network = spring_network(problem);
  SplitMix64 random(3);
  for (std::size_t i = 0; i < problem.mesh.points.size(); ++i) {
    motion.start.x.push_back(problem.mesh.points[i] + 0.05 * random.next_in_ball());
    motion.start.v.emplace_back(motion.network.fixed[i] ? Eigen::Vector3d(0, 0, 0)
                                                        : Eigen::Vector3d(0.05 * random.next_in_ball()));
  }
  motion.checkpoints = {0.5, 1.0};
  return motion;
}

TEST(OdeOracle, IsCertifiedByCodesThatAgree) {
  const NetworkMotion motion = moving_grid();
  CertifyOptions options;
  options.extrapolation = true;
  const CertifiedMotion certified = certify(motion, options);
  EXPECT_TRUE(certified.accepted);
  EXPECT_EQ(certified.independent, have_sundials());
  EXPECT_LE(certified.self_difference, 2e-13);
  EXPECT_LE(certified.agreement, 2e-13);
  EXPECT_LE(certified.floor, 2e-11);
  ASSERT_GE(certified.codes.size(), have_sundials() ? 5u : 3u);
  for (const CodeAgreement& code : certified.codes) {
    EXPECT_TRUE(code.failure.empty()) << code.code << ": " << code.failure;
    // the coarsest run of Odeint is the one that may be farther away
    if (&code == &certified.codes.front()) continue;
    EXPECT_LE(code.distance, 2e-13) << code.code;
  }
  ASSERT_EQ(certified.states.size(), 2u);
  EXPECT_EQ(certified.states[1].x.size(), motion.network.point_count());
  EXPECT_EQ(certified.states[1].x[0], motion.start.x[0]);  // fixed
}

TEST(OdeOracle, IsNotAcceptedWhenCodesAreFartherApartThanAsked) {
  CertifyOptions options;
  options.accepted = 1e-30;  // below the rounding of every code
  options.refinements = 1;
  options.gain = false;
  const CertifiedMotion certified = certify(moving_grid(), options);
  EXPECT_FALSE(certified.accepted);
  EXPECT_FALSE(certified.independent);
  EXPECT_TRUE(certified.gain.empty());
  EXPECT_EQ(certified.states.size(), 2u);
}

// The number of codes that were run in addition to those of the reference.
std::ptrdiff_t others_in(const CertifiedMotion& certified) {
  return std::count_if(certified.codes.begin(), certified.codes.end(),
                       [](const CodeAgreement& code) { return !code.code.starts_with("Odeint Fehlberg"); });
}

TEST(OdeOracle, AsksEveryCodeUnlessItMayStopAtTheFirstThatSuffices) {
  CertifyOptions options;
  options.gain = false;
  options.accepted = 1e-9;  // any code suffices
  const std::ptrdiff_t of_sundials = have_sundials() ? 2 : 0;
  EXPECT_EQ(others_in(certify(moving_grid(), options)), have_sundials() ? 2 : 1);
  options.extrapolation = true;
  EXPECT_EQ(others_in(certify(moving_grid(), options)), of_sundials + 1);
  options.all_codes = false;
  const CertifiedMotion at_once = certify(moving_grid(), options);
  EXPECT_EQ(others_in(at_once), 1);
  EXPECT_TRUE(at_once.accepted);
  options.accepted = 1e-30;  // no code does
  options.refinements = 0;
  EXPECT_EQ(others_in(certify(moving_grid(), options)), of_sundials + 1);
}

// Eight times as long in all lengths, the same motion: distances in edges stay, and scaling by 8 rounds nothing.
TEST(OdeOracle, TellsDistancesInEdgesOfTheStart) {
  const NetworkMotion motion = moving_grid();
  NetworkMotion long_one = motion;
  long_one.network.gravity *= 8.0;
  for (Spring& s : long_one.network.springs) s.rest_length *= 8.0;
  for (auto* column : {&long_one.start.x, &long_one.start.v})
    for (auto& p : *column) p *= 8.0;
  CertifyOptions options;
  options.accepted = 1e-30;  // so that no decision depends on the codes
  options.refinements = 2;
  const CertifiedMotion small = certify(motion, options), large = certify(long_one, options);
  EXPECT_EQ(small.edge, mean_rest_length(motion.network));
  EXPECT_LT(small.edge, 1.0);
  EXPECT_EQ(large.edge, 8.0 * small.edge);
  EXPECT_EQ(large.self_difference, small.self_difference);
  EXPECT_EQ(large.gain, small.gain);
  ASSERT_GE(large.codes.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(large.codes[k].distance, small.codes[k].distance) << k;
}

// The uncertainty of the reference is the larger of the agreement and a part of the self-difference; a hundred times
// that is the floor, unless the rounding of the states to doubles exceeds it.
TEST(OdeOracle, HasAFloorOfAHundredTimesWhatItsCodesLeaveOpen) {
  CertifyOptions options;
  options.gain = false;
  options.refinements = 0;
  options.step_times_rate = 1.0;  // so coarse that the runs are far apart
  const CertifiedMotion coarse = certify(moving_grid(), options);
  EXPECT_GT(coarse.self_difference, 1e-11);
  const double left = std::pow(0.7, 8) / (1.0 - std::pow(0.7, 8));
  EXPECT_NEAR(coarse.floor / (100.0 * std::max(left * coarse.self_difference, coarse.agreement)), 1.0, 0.01);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 2; k < coarse.codes.size(); ++k) nearest = std::min(nearest, coarse.codes[k].distance);
  EXPECT_EQ(coarse.agreement, nearest);
  EXPECT_EQ(coarse.codes[0].distance, coarse.self_difference);
  EXPECT_EQ(coarse.codes[1].distance, 0.0);  // the reference itself
}

// Springs of rest length 0 and negative stiffness push away from the wall in proportion to the distance: every
// disturbance grows like cosh(sqrt(k/m) t). Without springs it stays what it is.
TEST(OdeOracle, KnowsHowDisturbancesGrow) {
  NetworkMotion motion;
  motion.network.mass = {1.0, 1.0};
  motion.network.fixed = {1, 0};
  motion.network.springs = {{0, 1, -4.0, 0.0, 0.0}};
  motion.start = {{{0, 0, 0}, {0.125, 0, 0}}, {{0, 0, 0}, {0, 0.125, 0}}};
  motion.checkpoints = {1.0, 3.0};
  const CertifiedMotion growing = certify(motion);
  ASSERT_EQ(growing.gain.size(), 2u);
  // the disturbance of 1e-12 is rounded to doubles, and both runs err by less than 1e-18
  EXPECT_NEAR(growing.gain[0], std::cosh(2.0), 1e-4 * std::cosh(2.0));
  EXPECT_NEAR(growing.gain[1], std::cosh(6.0), 1e-4 * std::cosh(6.0));
  EXPECT_EQ(growing.largest_gain(), growing.gain[1]);

  motion.network.springs.clear();
  EXPECT_NEAR(certify(motion).gain[1], 1.0, 1e-4);
}

TEST(OdeOracle, RefusesWhatIsNoMotion) {
  const auto refused = [](const std::function<void(NetworkMotion&)>& spoil) {
    NetworkMotion motion = one_spring(1.0, 0.5, 8.0, 0.0, 1.0);
    motion.events.push_back({2.0, motion.network, {0, 1}});
    EXPECT_NO_THROW(check(motion));
    spoil(motion);
    EXPECT_THROW(certify(motion), InputError);
  };
  refused([](auto& m) { m.network.mass[0] = 0.0; });
  refused([](auto& m) { m.network.fixed.pop_back(); });
  refused([](auto& m) { m.network.springs[0].b = 2; });
  refused([](auto& m) { m.network.springs[0].b = 0; });
  refused([](auto& m) { m.network.springs[0].stiffness = std::numeric_limits<double>::quiet_NaN(); });
  refused([](auto& m) { m.start.v.pop_back(); });
  refused([](auto& m) { m.start.x[0][1] = std::numeric_limits<double>::infinity(); });
  refused([](auto& m) { m.checkpoints.clear(); });
  refused([](auto& m) { m.checkpoints[0] = 0.0; });
  refused([](auto& m) { m.checkpoints[1] = m.checkpoints[0]; });
  refused([](auto& m) { m.events[0].time = 0.0; });
  refused([](auto& m) { m.events[0].from = {0, 2}; });
  refused([](auto& m) { m.events[0].from = {0}; });
}

// The highest mode of a chain, and the decay of a damper without a spring: c (1/m1 + 1/m2).
TEST(SpringNetwork, KnowsItsFastestRate) {
  SpringNetwork network;
  std::vector<Eigen::Vector3d> x;
  const int n = 6;
  for (int i = 0; i < n; ++i) {
    network.mass.push_back(0.25);
    network.fixed.push_back(0);
    x.emplace_back(i, 0, 0);
    if (i > 0)
      network.springs.push_back({static_cast<std::uint32_t>(i - 1), static_cast<std::uint32_t>(i), 4.0, 0.0, 1.0});
  }
  // the next mode is 7 % lower, so 200 steps leave 0.87^400 = 1e-24 of it
  EXPECT_NEAR(fastest_rate(network, x), chain_omega_free(n, 4.0, 0.25, n - 1), 1e-9);
  network.mass = {0.25, 0.5};
  network.fixed = {0, 0};
  network.springs = {{0, 1, 0.0, 3.0, 1.0}};
  x.resize(2);
  EXPECT_NEAR(fastest_rate(network, x), 18.0, 1e-9);
}

// A damper without a spring in a medium: both slow its masses' relative motion. A spring that is faster counts alone.
TEST(SpringNetwork, AddsTheMediumToTheRateOfDecay) {
  SpringNetwork network;
  network.mass = {0.25, 0.5};
  network.fixed = {0, 0};
  network.springs = {{0, 1, 0.0, 3.0, 1.0}};
  network.viscosity = 100.0;
  const std::vector<Eigen::Vector3d> x{{0, 0, 0}, {1, 0, 0}};
  EXPECT_NEAR(fastest_rate(network, x), 118.0, 1e-9);
  network.springs[0] = {0, 1, 0.0, 0.0, 1.0};
  EXPECT_NEAR(fastest_rate(network, x), 100.0, 1e-9);
  network.springs[0].stiffness = 6e6;  // omega = sqrt(6 k)
  EXPECT_NEAR(fastest_rate(network, x), 6e3, 1e-6);
}

// Fixed points do not oscillate: of three in a row, one between two walls.
TEST(SpringNetwork, LeavesOutWhatIsHeld) {
  SpringNetwork network;
  network.mass = {1e-6, 2.0, 1e-6};
  network.fixed = {1, 0, 1};
  network.springs = {{0, 1, 4.0, 0.0, 1.0}, {1, 2, 4.0, 0.0, 1.0}};
  const std::vector<Eigen::Vector3d> x{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_NEAR(fastest_rate(network, x), 2.0, 1e-9);
}

TEST(SpringNetwork, HasTheMeanRestLengthAsItsUnit) {
  SpringNetwork network;
  EXPECT_EQ(mean_rest_length(network), 1.0);
  network.springs = {{0, 1, 1.0, 0.0, 1.0}, {1, 2, 1.0, 0.0, 4.0}};
  EXPECT_EQ(mean_rest_length(network), 2.5);
}

TEST(OdeOracle, MeasuresDistancesByMassInEdges) {
  SpringNetwork network;
  network.mass = {1.0, 3.0};
  network.fixed = {0, 0};
  const std::vector<long double> a(12, 0.0L);
  std::vector<long double> b = a;
  b[3] = 1e-3L;
  EXPECT_DOUBLE_EQ(position_distance(network, a, b, 0.5), std::sqrt(0.75) * 1e-3 / 0.5);
  b[3] = 0.0L;
  b[9] = 1.0L;  // a velocity is no distance
  EXPECT_EQ(position_distance(network, a, b, 0.5), 0.0);
}

}  // namespace
}  // namespace dartboard::reference::ode_oracle_test
