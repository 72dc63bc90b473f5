#include "benchmarks/studies/contact/contact_factors.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "benchmarks/checkout/source_folder.h"
#include "core/plain/error.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/run/simulation.h"

namespace dartboard {
namespace {

constexpr double step_of_backward_euler = 0.002;  // [s]

/// Every sample that is inside something, and what that is: an obstacle, or the way out of a body. In order.
using TouchList = std::vector<std::pair<std::uint32_t, std::size_t>>;

TouchList touches_of(const SimulatedBody& body) {
  const Contacts contacts = body.contacts();
  const std::size_t obstacles = contacts.obstacles != nullptr ? contacts.obstacles->obstacles().size() : 0;
  TouchList touches;
  contacts.for_each_touch({.x = body.vertices().position}, [&](const Touch& touch) {
    touches.emplace_back(touch.sample, touch.in_body != nullptr ? obstacles + touch.in_body->triangle : touch.obstacle);
  });
  std::ranges::sort(touches);
  return touches;
}

double mean(std::uint64_t sum, std::size_t count) { return static_cast<double>(sum) / static_cast<double>(count); }

}  // namespace

double ContactFactors::with_changes() const { return mean(iterations_of_changing, changing); }
double ContactFactors::without_changes() const { return mean(iterations - iterations_of_changing, steps - changing); }

void to_json(nlohmann::json& json, const ContactFactors& counts) {
  json = {{"factor_scene", counts.scene},
          {"steps", counts.steps},
          {"changing", counts.changing},
          {"changes", counts.changes},
          {"factorisations", counts.factorisations},
          {"iterations", counts.iterations},
          {"iterations_of_changing", counts.iterations_of_changing}};
}

std::vector<std::string> factor_scenes() { return {"boxes_stacked", "liver_pressed", "balls_roll"}; }

ContactFactors count_factors(const std::string& scene, double duration) {
  SceneFile file = read_scene(source_folder() / "benchmarks" / "scenes" / (scene + ".json"));
  file.integrator = "backward-euler";
  file.solver = "kept-factor";
  file.step = step_of_backward_euler;
  file.duration = duration;
  file.events.clear();
  Simulation simulation(file);
  ContactFactors counts{.scene = scene};
  TouchList before = touches_of(simulation.body());
  while (simulation.steps_done() < simulation.step_count()) {
    const std::uint64_t iterations = simulation.work().linear_iterations;
    if (simulation.advance()) throw SolverError(fmt::format("{} diverged by backward Euler", scene));
    const TouchList now = touches_of(simulation.body());
    TouchList changed;
    std::ranges::set_symmetric_difference(before, now, std::back_inserter(changed));
    ++counts.steps;
    counts.changes += changed.size();
    const std::uint64_t in_step = simulation.work().linear_iterations - iterations;
    counts.iterations += in_step;
    if (!changed.empty()) {
      ++counts.changing;
      counts.iterations_of_changing += in_step;
    }
    before = now;
  }
  counts.factorisations = simulation.work().factorisations;
  return counts;
}

}  // namespace dartboard
