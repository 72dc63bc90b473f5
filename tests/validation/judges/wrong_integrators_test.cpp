#include "validation/judges/wrong_integrators.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/time/integrators.h"
#include "core/time/system/energy.h"
#include "validation/extremes/extreme_run.h"

namespace dartboard::wrong_integrators_test {
namespace {

double distance(const SpringColumns& a, const SpringColumns& b) {
  double far = 0.0;
  for (std::size_t i = 0; i < a.x.size(); ++i)
    far = std::max({far, (a.x[i] - b.x[i]).norm(), (a.v[i] - b.v[i]).norm()});
  return far;
}

SpringColumns stepped(Integrator& integrator, SpringColumns body, double h, int steps = 1) {
  for (int k = 0; k < steps; ++k) EXPECT_TRUE(integrator.step(body.system(), body.motion(), h).ok());
  return body;
}

SpringColumns damped_box() {
  SpringColumns body = moving_body("box");
  for (Spring& s : body.springs) s.damping = 1e-2 * s.stiffness;
  return body;
}

TEST(WrongIntegrators, AreEachWrongInAllMethods) {
  const SpringColumns body = damped_box();
  const double h = 0.2 / highest_frequency(body);
  for (const IntegratorEntry& entry : integrators()) {
    const SpringColumns right = stepped(*entry.make(), body, h, 2);
    for (const WrongIntegrator& wrong : wrong_integrators()) {
      if (wrong.kind == Wrong::wrong_sign && entry.name == "energy-momentum") continue;  // which finds no solution
      EXPECT_GT(distance(stepped(*make_wrong(wrong.kind, entry.name), body, h, 2), right), 1e-9)
          << entry.name << " " << wrong.name;
    }
  }
}

TEST(WrongIntegrators, DoNothingWhereTheySaySo) {
  const SpringColumns body = damped_box();
  EXPECT_EQ(distance(stepped(*make_wrong(Wrong::does_nothing, "rk4"), body, 1e-3), body), 0.0);
}

// The acceleration at rest of a spring stretched by 0.01: 1 of 100 N/m at 1 kg; half of it, or its opposite.
TEST(WrongIntegrators, PullHalfAsMuchOrTheOtherWay) {
  SpringColumns body = extreme_body("oscillator");
  body.x[1].x() += 0.01;
  const auto kick = [&](Wrong kind) { return stepped(*make_wrong(kind, "explicit-euler"), body, 1e-3).v[1].x(); };
  const double right = stepped(*make_integrator("explicit-euler"), body, 1e-3).v[1].x();
  EXPECT_NEAR(kick(Wrong::half_the_force) / right, 0.5, 1e-12);
  EXPECT_NEAR(kick(Wrong::wrong_sign) / right, -1.0, 1e-12);
}

TEST(WrongIntegrators, LoseNothingElseThanDamping) {
  const SpringColumns damped = damped_box(), undamped = moving_body("box");
  const double h = 0.2 / highest_frequency(undamped);
  EXPECT_EQ(distance(stepped(*make_wrong(Wrong::loses_damping, "rk4"), damped, h),
                     stepped(*make_integrator("rk4"), undamped, h)),
            0.0);
  EXPECT_EQ(distance(stepped(*make_wrong(Wrong::loses_damping, "rk4"), undamped, h),
                     stepped(*make_integrator("rk4"), undamped, h)),
            0.0);
}

// The error of linearised springs is of the second order in the distance of the body from rest.
TEST(WrongIntegrators, AreRightForSpringsNearRestWhereTheySaySo) {
  const auto off = [](double size) {
    const SpringColumns body = moving_body("box", size);
    const double h = 0.1 / highest_frequency(body);
    return distance(stepped(*make_wrong(Wrong::as_if_unstretched, "verlet"), body, h, 3),
                    stepped(*make_integrator("verlet"), body, h, 3));
  };
  EXPECT_NEAR(std::log2(off(2e-3) / off(1e-3)), 2.0, 0.1);
}

// The error of a step grows from h^(p+1) to h^p.
TEST(WrongIntegrators, AreOfAnOrderLessWhereTheySaySo) {
  const SpringColumns body = moving_body("box", 1e-2);
  const double omega = highest_frequency(body);
  for (const auto& [name, order] : {std::pair("verlet", 2), std::pair("rk4", 4)}) {
    const auto off = [&body, name = name](double h) {
      return distance(stepped(*make_wrong(Wrong::one_order_less, name), body, h),
                      stepped(*make_integrator(name), body, h));
    };
    EXPECT_NEAR(std::log2(off(0.04 / omega) / off(0.02 / omega)), order, 0.1) << name;
  }
}

TEST(WrongIntegrators, DriftByAMillionth) {
  const SpringColumns body = extreme_body("box");
  const SpringColumns end = stepped(*make_wrong(Wrong::drifts, "verlet"), body, 1e-3);
  for (std::size_t i = 0; i < body.x.size(); ++i)
    EXPECT_NEAR((end.x[i] - body.x[i]).norm(), 1e-6 * body.x[i].norm(), 1e-12);
}

}  // namespace
}  // namespace dartboard::wrong_integrators_test
