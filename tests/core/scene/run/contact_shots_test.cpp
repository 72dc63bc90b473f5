// Bodies shot at others at random: what passes through is warned of.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/plain/random.h"
#include "core/scene/run/simulation.h"

namespace dartboard::contact_shots_test {
namespace {

using Kind = ContactWarning::Kind;
constexpr double h = 0.01;

/// A cube above a plate, both free, that flies at this speed onto some place of it.
SceneFile shot(double speed, double x, double y, double degrees) {
  return parse_scene(
      fmt::format(R"({{"name": "shot", "step": {}, "duration": {}, "integrator": "verlet", "gravity": [0, 0, 0],
        "bodies": [{{"generate": {{"box": {{"cells": [4, 4, 1], "spacing": 0.05}}}}}},
                   {{"generate": {{"box": {{"cells": [1, 1, 1], "spacing": 0.05}}}},
                    "rotate": {{"axis": [1, 2, 3], "degrees": {}}}, "translate": [{}, {}, 0.15],
                    "initial_velocity": {{"constant": [0, 0, {}]}}}}],
        "material": {{"density": 1000, "young": 1000, "poisson": 0.3, "viscosity": 0}},
        "contact": {{"pressure": 1000, "depth": 0.02, "bodies": "others"}}}})",
                  h, 0.5 / speed, degrees, x, y, -speed),
      "a shot", "");
}

struct Shots {
  int fast = 0, fast_without_warning = 0, through = 0, through_silently = 0, back = 0;
};

Shots shoot(int count) {
  Shots shots;
  SplitMix64 random(11);
  const double place = 0.03,
               least = Simulation(shot(1.0, 0, 0, 0))
                           .body()
                           .contacts()
                           .bodies->least_altitude(Simulation(shot(1.0, 0, 0, 0)).body().vertices().position);
  for (int k = 0; k < count; ++k) {
    // a step of 0.1 to 3 times half of the least altitude
    const double way = 0.1 * std::pow(30.0, 0.5 + 0.5 * random.next_signed()), speed = way * 0.5 * least / h;
    Simulation simulation(shot(speed, 0.075 + place * random.next_signed(), 0.075 + place * random.next_signed(),
                               180.0 * random.next_signed()));
    while (simulation.steps_done() < simulation.step_count())
      if (simulation.advance()) break;
    const auto warned = [&](auto&&... kinds) {
      return std::ranges::any_of(simulation.contact_warnings(),
                                 [&](const ContactWarning& w) { return ((w.kind == kinds) || ...); });
    };
    const auto& position = simulation.body().vertices().position;
    const auto& velocity = simulation.body().vertices().velocity;
    const bool behind = position.back()[2] < position.front()[2], away = velocity.back()[2] < velocity.front()[2];
    const bool through = behind && away;
    shots.back += behind ? 0 : 1;
    shots.through += through ? 1 : 0;
    shots.through_silently += through && simulation.contact_warnings().empty() ? 1 : 0;
    if (way < 1.001) continue;
    ++shots.fast;
    shots.fast_without_warning += warned(Kind::too_fast, Kind::will_be_fast) ? 0 : 1;
  }
  return shots;
}

void expect_no_silence(const Shots& shots, int count) {
  EXPECT_GT(shots.fast, count / 5);
  EXPECT_GT(shots.back, count / 5);
  EXPECT_GT(shots.through, 0);
  EXPECT_EQ(shots.fast_without_warning, 0);
  EXPECT_EQ(shots.through_silently, 0);
}

TEST(ContactShots, DoNotPassThroughSilently) { expect_no_silence(shoot(40), 40); }
TEST(LongContactShots, DoNotPassThroughSilently) { expect_no_silence(shoot(1000), 1000); }

}  // namespace
}  // namespace dartboard::contact_shots_test
