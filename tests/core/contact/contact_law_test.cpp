#include "core/contact/contact_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/plain/error.h"

namespace dartboard::contact_law_test {
namespace {

ContactLaw law_of(int exponent, double restitution = 1.0) {
  ContactLaw law;
  law.pressure = 2000.0;
  law.depth = 0.002;
  law.exponent = exponent;
  law.restitution = restitution;
  return law;
}
constexpr double area = 0.03;

TEST(ContactLaw, CarriesItsPressureAtItsDepth) {
  for (const int p : {2, 3, 4}) {
    const ContactLaw law = law_of(p);
    EXPECT_EQ(law.force(area, law.depth), area * law.pressure);
    EXPECT_EQ(law.force(area, 2 * law.depth), area * law.pressure * (1 << (p - 1)));
    // E = a P0 delta / p there, K = (p - 1) a P0 / delta: three roundings each
    EXPECT_NEAR(law.energy(area, law.depth), area * 2000.0 * 0.002 / p, 1e-15 * area * 4.0);
    EXPECT_NEAR(law.stiffness(area, law.depth), (p - 1) * area * 1e6, 1e-15 * area * 3e6);
  }
}

// Two Gauss points are exact for a cubic, the steepest force there is.
TEST(ContactLaw, IsTheSlopeOfItsEnergyAndItsStiffnessThatOfItsForce) {
  for (const int p : {2, 3, 4}) {
    const ContactLaw law = law_of(p);
    for (const double d : {1e-6, 0.0007, 0.002, 0.005}) {
      double energy = 0.0, force = 0.0;
      for (const double at : {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)}) {
        energy += 0.5 * d * law.force(area, at * d);
        force += 0.5 * d * law.stiffness(area, at * d);
      }
      EXPECT_NEAR(law.energy(area, d), energy, 1e-15 * 8 * energy) << p << ' ' << d;
      EXPECT_NEAR(law.force(area, d), force, 1e-15 * 8 * force) << p << ' ' << d;
    }
  }
}

TEST(ContactLaw, IsNothingOutside) {
  for (const int p : {2, 3, 4})
    for (const double d : {0.0, -1e-9, -3.0}) {
      const ContactLaw law = law_of(p, 0.5);
      EXPECT_EQ(law.energy(area, d), 0.0);
      EXPECT_EQ(law.force(area, d), 0.0);
      EXPECT_EQ(law.stiffness(area, d), 0.0);
      EXPECT_EQ(law.mean_force(area, d, -1e-3), 0.0);
    }
}

// However near both depths are, also on both sides of the surface: energies themselves are right to some roundings of
// the larger one, and the quotient to some of itself.
TEST(ContactLaw, HasAMeanForceWhoseWorkIsTheChangeOfEnergy) {
  for (const int p : {2, 3, 4}) {
    const ContactLaw law = law_of(p);
    const double depths[] = {-0.001, -1e-12, 1e-12, 0.0005, 0.0015, 0.0015000001, 0.004};
    for (const double d0 : depths)
      for (const double d1 : depths) {
        const double mean = law.mean_force(area, d0, d1), before = law.energy(area, d0), after = law.energy(area, d1);
        EXPECT_NEAR(mean, law.mean_force(area, d1, d0), 1e-15 * mean) << p << ' ' << d0 << ' ' << d1;
        EXPECT_NEAR(mean * (d1 - d0), after - before, 2e-15 * (before + after)) << p << ' ' << d0 << ' ' << d1;
      }
    // by long double, where differences of doubles would cancel: u differs by 5e-9, and powers are right to 1e-19
    const double d0 = 0.0015, d1 = 0.0015 + 1e-11;
    const long double u0 = d0 / 0.002L, u1 = d1 / 0.002L;
    const double exact = static_cast<double>(0.03L * 2000.0L / p * (std::pow(u1, p) - std::pow(u0, p)) / (u1 - u0));
    EXPECT_NEAR(law.mean_force(area, d0, d1), exact, 1e-10 * exact);
    EXPECT_NEAR(law.mean_force(area, 0.0015, 0.0015), law.force(area, 0.0015), 1e-15 * 8 * law.force(area, 0.0015));
  }
}

TEST(ContactLaw, TellsWhereABodyRestsAndHowFarAnImpactComes) {
  for (const int p : {2, 3, 4}) {
    const ContactLaw law = law_of(p);
    for (const double load : {3.0, 2000.0, 9000.0}) {
      EXPECT_NEAR(law.force(1.0, law.depth_at_rest(load)), load, 1e-14 * load);
      EXPECT_NEAR(law.energy(1.0, law.depth_at_impact(load)), load, 1e-14 * load);
    }
  }
}

// The terms of the equation cancel to the order of s^2: in long double their roundings are below 1e-19 of s. A rounding
// of s changes them by that over 1 - s e.
TEST(ContactLaw, LosesByTheRootOfItsEquation) {
  EXPECT_EQ(law_of(3).loss(), 0.0);
  for (const double e : {0.99, 0.9, 0.8, 0.7, 0.5, 0.49, 0.25, 0.1}) {
    const long double s = law_of(3, e).loss(), k = e;
    EXPECT_NEAR(static_cast<double>((s - std::log1p(s) + s * k + std::log1p(-s * k)) / (s * s)), 0.0,
                1e-15 + 0x1p-52 * static_cast<double>(k / (s * (1.0L - s * k))))
        << e;
  }
  EXPECT_NEAR(law_of(3, 0.5).loss(), 1.432751, 5e-7);
  EXPECT_NEAR(law_of(3, 0.05).loss(), 20.0, 1e-6);
  // s = 3/2 (1 - e^2) / (1 + e^3) and terms of (1 - e)^2
  EXPECT_NEAR(law_of(3, 1.0 - 1e-9).loss(), 1.5e-9, 1e-16);
  // 1 - s e = exp(- s - 1 + ln(1 + s)) and less
  for (const double e : {1e-3, 1e-9}) EXPECT_NEAR(law_of(3, e).loss() * e, 1.0, 4e-16) << e;
}

// A mass that runs into it alone, as an ordinary differential equation that knows the law's force and loss only. The
// fourth order leaves nothing of a step of 1e-5 of the time that it takes, but for the last, which ends outside and is
// interpolated.
TEST(ContactLaw, HasTheSameRestitutionAtEverySpeedExponentAndMassAndOnlyPushes) {
  for (const int p : {2, 3, 4})
    for (const double e : {0.8, 0.3})
      for (const double speed : {0.1, 10.0}) {
        const ContactLaw law = law_of(p, e);
        const double mass = speed < 1.0 ? 0.25 : 3.0, s = law.loss();
        const auto acceleration = [&](double d, double v) {
          return -law.force(area, d) * (1.0 + s * v / speed) / mass;
        };
        const double deepest = law.depth_at_impact(0.5 * mass * speed * speed / area), h = 1e-5 * deepest / speed;
        double d = 0.0, v = speed;
        for (int k = 0; k < 10000000; ++k) {
          const double a1 = acceleration(d, v), v2 = v + h / 2 * a1, a2 = acceleration(d + h / 2 * v, v2),
                       v3 = v + h / 2 * a2, a3 = acceleration(d + h / 2 * v2, v3), v4 = v + h * a3,
                       a4 = acceleration(d + h * v3, v4);
          ASSERT_LE(a1, 0.0);
          const double d_next = d + h / 6 * (v + 2 * v2 + 2 * v3 + v4),
                       v_next = v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
          if (d_next < 0.0) {
            v += (v_next - v) * d / (d - d_next);
            break;
          }
          d = d_next;
          v = v_next;
        }
        EXPECT_NEAR(-v / speed, e, 1e-6) << p << ' ' << speed;
      }
}

TEST(ContactLaw, IsRefusedWhereANumberMakesNoSense) {
  const auto message = [](auto&& change) {
    ContactLaw law = law_of(3);
    change(law);
    try {
      law.require_valid();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message([](ContactLaw&) {}), "");
  EXPECT_EQ(message([](ContactLaw& l) { l.pressure = 0.0; }), "pressure of a contact is 0, expected more than 0");
  EXPECT_EQ(message([](ContactLaw& l) { l.depth = -1.0; }), "depth of a contact is -1, expected more than 0");
  EXPECT_EQ(message([](ContactLaw& l) { l.exponent = 5; }), "exponent of a contact is 5, expected 2, 3 or 4");
  EXPECT_EQ(message([](ContactLaw& l) { l.exponent = 1; }), "exponent of a contact is 1, expected 2, 3 or 4");
  EXPECT_EQ(message([](ContactLaw& l) { l.restitution = 0.0; }),
            "restitution of a contact is 0, expected more than 0 and at most 1");
  EXPECT_EQ(message([](ContactLaw& l) { l.restitution = 1.5; }),
            "restitution of a contact is 1.5, expected more than 0 and at most 1");
  EXPECT_EQ(message([](ContactLaw& l) { l.friction = -0.1; }), "friction of a contact is -0.1, expected at least 0");
  EXPECT_NE(message([](ContactLaw& l) { l.pressure = INFINITY; }), "");
}

}  // namespace
}  // namespace dartboard::contact_law_test
