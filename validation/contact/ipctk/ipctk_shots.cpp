#include "validation/contact/ipctk/ipctk_shots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/plain/random.h"
#include "core/scene/run/simulation.h"

namespace dartboard {
namespace {

constexpr double h = 0.01;  // [s]
constexpr double slowest = 0.1, ratio = 1000.0;
// Speeds are compared with the limit after they have been rounded, so that the two may differ for a way of 1.
constexpr double clearly_fast = 1.001;

/// A cube above a plate, both free, that flies onto some place of it; `travel` [m] is its way in a step.
SceneFile shot(double travel, double x, double y, double z, double degrees) {
  const double steps = std::ceil((z + 0.15) / travel) + 3.0;
  return parse_scene(
      fmt::format(R"({{"name": "shot", "step": {}, "duration": {}, "integrator": "verlet", "gravity": [0, 0, 0],
        "bodies": [{{"generate": {{"box": {{"cells": [4, 4, 1], "spacing": 0.05}}}}}},
                   {{"generate": {{"box": {{"cells": [1, 1, 1], "spacing": 0.05}}}},
                    "rotate": {{"axis": [1, 2, 3], "degrees": {}}}, "translate": [{}, {}, {}],
                    "initial_velocity": {{"constant": [0, 0, {}]}}}}],
        "material": {{"density": 1000, "young": 1000, "poisson": 0.3, "viscosity": 0}},
        "contact": {{"pressure": 1000, "depth": 0.02, "bodies": "others"}}}})",
                  h, steps * h, degrees, x, y, z, -travel / h),
      "a shot", "");
}

bool warns_of_speed(const Simulation& simulation) {
  using Kind = ContactWarning::Kind;
  return std::ranges::any_of(simulation.contact_warnings(), [](const ContactWarning& w) {
    return w.kind == Kind::too_fast || w.kind == Kind::will_be_fast;
  });
}

IpctkShot record(const SceneFile& scene, double share) {
  Simulation simulation(scene);
  const IpctkSurfaces surfaces(*simulation.body().contacts().bodies);
  IpctkShot made{.way = share, .question = surfaces.question(true)};
  std::size_t felt = 0;
  const auto look = [&] {
    made.question.places.push_back(surfaces.at(simulation.body().vertices().position));
    IpctkPlace& place = made.question.places.back();
    place.samples.clear();  // depths are compared in placements
    felt += place.felt ? 1 : 0;
    made.warned = warns_of_speed(simulation);
    if (felt == 0) made.warned_in_flight = made.warned;
  };
  look();
  while (felt < 3 && simulation.steps_done() < simulation.step_count() && !simulation.advance()) look();
  return made;
}

}  // namespace

std::vector<IpctkShot> ipctk_shots(std::size_t count, std::uint64_t seed) {
  SplitMix64 random(seed);
  const Simulation at_rest(shot(0.01, 0.0, 0.0, 0.15, 0.0));
  const double half = 0.5 * at_rest.body().contacts().bodies->least_altitude(at_rest.body().vertices().position);
  constexpr double place = 0.03;
  std::vector<IpctkShot> shots;
  for (std::size_t k = 0; k < count; ++k) {
    const double share = (static_cast<double>(k) + 0.5 + 0.5 * random.next_signed()) / static_cast<double>(count),
                 share_of_half = slowest * std::pow(ratio, share), x = 0.075 + place * random.next_signed(),
                 y = 0.075 + place * random.next_signed(),
                 z = 0.15 + half * share_of_half * 0.5 * (1.0 + random.next_signed());
    shots.push_back(record(shot(half * share_of_half, x, y, z, 180.0 * random.next_signed()), share_of_half));
  }
  return shots;
}

IpctkShotsFound found_by_ipctk(std::span<const IpctkShot> shots, std::span<const IpctkAnswer> answers) {
  IpctkShotsFound found{.shots = shots.size()};
  for (std::size_t k = 0; k < shots.size(); ++k) {
    const IpctkShot& shot = shots[k];
    const std::vector<IpctkPlace>& places = shot.question.places;
    const auto& free = answers[k].free;
    const auto collides = static_cast<std::size_t>(std::ranges::find(free, false) - free.begin());  // the first step
    const auto is_felt = [&](std::size_t place) { return place < places.size() && places[place].felt; };
    const bool slow = shot.way < 1.0, hits = collides < free.size(),
               in_time = is_felt(collides + 1) || is_felt(collides + 2);
    const bool fast = shot.way > clearly_fast;
    found.slow += slow ? 1 : 0;
    found.fast += fast ? 1 : 0;
    const auto flight = std::span(places).first(std::min(collides + 1, places.size()));
    found.early += std::ranges::any_of(flight, &IpctkPlace::felt) ? 1 : 0;
    if (slow && hits) {
      ++found.hits;
      found.at_once += is_felt(collides + 1) ? 1 : 0;
      found.late += in_time ? 0 : 1;
    }
    found.false_warnings += slow && shot.warned_in_flight ? 1 : 0;
    found.passes += fast && hits && !in_time ? 1 : 0;
    found.silent += fast && !shot.warned ? 1 : 0;
  }
  return found;
}

}  // namespace dartboard
