#include "validation/recommend/recommended_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/counted.h"
#include "core/plain/error.h"
#include "core/scene/file/load_mesh.h"
#include "core/scene/file/step_times.h"
#include "core/scene/output/atomic_file.h"
#include "core/scene/run/simulation.h"
#include "core/time/integrators.h"
#include "validation/frozen/events_by_number.h"

namespace dartboard {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr double infinity = std::numeric_limits<double>::infinity();

// ---- the step

/// [s] The longest step with which events that repeat do so at their times: they take a step that is longer for theirs.
double longest_repeating_step(const SceneFile& scene) {
  double longest = infinity;
  for (const SceneEvent& event : scene.events)
    if (event.every) longest = std::min(longest, (1.0 - 0x1p-20) * *event.every);
  return longest;
}

/// Do steps of h [s] end at all of the times?
bool ends_at_all(const std::vector<double>& times, double h) {
  return std::ranges::all_of(times, [h](double time) { return step_at(time, h).has_value(); });
}

/// Above its first limit a method may be stable again where damping helps, but not for long where events change the
/// damped parts: there a step stays a tenth below that limit. Scenes without events have no bound.
double longest_undamped_step(const SceneFile& scene, const SceneFeatures& features) {
  const Scheme& scheme = scheme_of(scene.integrator);
  double longest = infinity;
  if (scene.events.empty() || scheme.implicit || !(scheme.imaginary_limit > 0.0)) return longest;
  for (const StableStep& step : features.limits) longest = std::min(longest, 0.9 * scheme.imaginary_limit / step.upper);
  return longest;
}

// ---- the scene

/// The scene of a file that asks for an accuracy in place of its step, so that its times are in seconds.
Json without_step(const SceneFile& scene, double accuracy) {
  Json json = Json::parse(scene.text);
  if (scene.step > 0.0 && !scene.accuracy && json.contains("output"))
    for (const char* every : {"frames_every", "diagnostics_every", "probes_every"})
      if (json["output"].contains(every) && json["output"][every].is_object())
        json["output"][every] = json["output"][every].at("steps").get<double>() * scene.step;
  for (const char* replaced : {"step", "integrator", "solver", "event_times"}) json.erase(replaced);
  if (json.contains("expect")) json["expect"].erase("hash");
  json["accuracy"] = accuracy;
  return json;
}

SceneFile read(const Json& json, const SceneFile& like) {
  SceneFile scene = parse_scene(json.dump(), like.file, like.folder);
  load_mesh(scene);
  return scene;
}

Json with_setting(Json json, const SceneFile& scene) {
  json.erase("accuracy");
  json["integrator"] = scene.integrator;
  json["step"] = scene.step;
  if (scene.has_times()) json["event_times"] = "exact";
  return json;
}

/// Its members in the order in which they were given, each on a line.
std::string text_of(const Json& scene) {
  std::string text = "{";
  for (const auto& [key, value] : scene.items())
    text += fmt::format("{}\n  {}: {}", text.size() > 1 ? "," : "", Json(key).dump(), value.dump());
  return text + "\n}\n";
}

// ---- what its events choose

/// A name for each vertex that does not depend on the order in which vertices came apart: its point in the mesh, and
/// the first cell of the mesh that it belongs to.
std::vector<std::pair<std::int64_t, std::uint32_t>> names_of_vertices(const SimulatedBody& body) {
  const Frame frame = body.frame({});
  std::vector<std::pair<std::int64_t, std::uint32_t>> names(frame.mesh.points.size());
  for (std::size_t k = 0; k < names.size(); ++k)
    names[k] = {frame.mesh_point[k], std::numeric_limits<std::uint32_t>::max()};
  for (std::size_t c = 0; c < frame.mesh.cell_count(); ++c)
    for (const std::uint32_t vertex : frame.mesh.cell(c))
      names[vertex].second = std::min(names[vertex].second, frame.mesh_cell[c]);
  return names;
}

/// The vertices in the order of their names, those of one name in their own.
std::vector<std::uint32_t> in_order_of_names(const std::vector<std::pair<std::int64_t, std::uint32_t>>& names) {
  std::vector<std::uint32_t> order(names.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&names](std::uint32_t k) { return names[k]; });
  return order;
}

/// For each vertex of a body, the one of the same name in another; no value where some have none there. The other may
/// have more vertices.
std::optional<std::vector<std::uint32_t>> same_vertices(const SimulatedBody& of, const SimulatedBody& in) {
  const auto names = names_of_vertices(of), others = names_of_vertices(in);
  const auto order = in_order_of_names(names), other_order = in_order_of_names(others);
  std::vector<std::uint32_t> same(names.size());
  auto other = other_order.begin();
  for (const std::uint32_t k : order) {
    while (other != other_order.end() && others[*other] < names[k]) ++other;
    if (other == other_order.end() || others[*other] != names[k]) return {};
    same[k] = *other++;
  }
  return same;
}

/// The operations of events by a run, compared with those of the accurate run.
struct ChosenAlike {
  bool asked = false, alike = true;          // `asked`: some events choose
  std::size_t operations = 0, accurate = 0;  // until the last event that chooses
};

ChosenAlike compare_choices(const SceneFile& scene, const FrozenScene& frozen) {
  double last = 0.0;
  for (const SceneEvent& event : frozen.file.events)
    if (is_left_to_the_run(event)) last = std::max(last, std::min(event.until, scene.duration));
  ChosenAlike found;
  if (last == 0.0) return found;
  found.asked = true;
  const auto looks = [](const SceneEvent& event) { return event.from != event.until && !event.every; };
  const bool looks_in_every_step = std::ranges::any_of(scene.events, looks);
  Simulation simulation(scene);
  FrozenBody accurate(frozen);
  auto next = frozen.changes.begin();
  const auto count_until = [&](double time) {
    for (; next != frozen.changes.end() && next->time <= time * (1.0 + 0x1p-50); ++next) {
      if (next->time > 0.0) accurate.pass();
      for (const FrozenChange::Operation& operation : next->operations) {
        found.accurate += operation.made;
        if (looks_in_every_step && looks(frozen.file.events[operation.event]) && !step_at(next->time, scene.step))
          found.alike = false;
      }
    }
    found.alike = found.alike && found.accurate == simulation.operations();
  };
  count_until(0.0);
  while (simulation.steps_done() < simulation.step_count() && simulation.time() < last) {
    if (simulation.advance()) {
      found.alike = false;
      break;
    }
    // what happens at the end changes no motion, and no frozen scene has it
    if (simulation.steps_done() < simulation.step_count()) count_until(simulation.time());
  }
  found.operations = simulation.operations();
  if (simulation.steps_done() < simulation.step_count() && found.alike)
    found.alike = simulation.body().vertices().size() == accurate.body().vertices().size() &&
                  same_vertices(accurate.body(), simulation.body());
  return found;
}

/// The scene without what happens at its end, which changes no motion and has no part in a frozen scene.
SceneFile without_end(SceneFile scene) {
  std::erase_if(scene.events, [&scene](const SceneEvent& event) { return event.from >= scene.duration; });
  for (SceneEvent& event : scene.events)
    if (event.until >= scene.duration) event.until = std::max(event.from, (1.0 - 0x1p-40) * scene.duration);
  return scene;
}

std::string in_words(const ChosenAlike& found) {
  if (!found.asked) return "";
  if (found.alike)
    return fmt::format(
        "With this step, events that choose by place or stress take the cells of the accurate run: {} in all.",
        counted(found.operations, "operation"));
  return fmt::format(
      "With this step, events that choose by place or stress take other cells than in the accurate run, or at other times: "
      "{} in all, {}.",
      counted(found.operations, "operation"),
      found.operations == found.accurate ? "as many" : fmt::format("in place of {}", found.accurate));
}

}  // namespace

double step_fitting_times(const SceneFile& scene, double largest) {
  std::vector<double> times;
  for (const auto& every : {scene.output.frame_time, scene.output.diagnostic_time, scene.output.probe_time})
    if (every && *every < scene.duration) times.push_back(*every);
  const double least = std::ceil(scene.duration / largest * (1.0 - 0x1p-50));
  const auto fewest = [&](double most, double by) {
    for (double n = by * std::ceil(least / by); n <= std::min(most, least + 1e5); n += by)
      if (ends_at_all(times, scene.duration / n)) return n;
    return 0.0;
  };
  // a quarter more steps, or few enough to cost nothing; the checkpoints of studies divide the duration by eight
  double n = fewest(1.25 * least, 8.0);
  if (n == 0.0) n = fewest(std::max(1.25 * least, 128.0), 1.0);
  return scene.duration / (n > 0.0 ? n : least);
}

FittedPick fit_pick(SceneFile& scene, const Candidate& pick, const SceneFeatures& features) {
  scene.integrator = pick.contender;
  scene.step = step_fitting_times(
      scene, std::min({pick.h, longest_undamped_step(scene, features), longest_repeating_step(scene)}));
  return {.step = scene.step,
          .predicted_error = pick.error_at(scene.step),
          .predicted_s = pick.predicted_s * std::pow(pick.h / scene.step, 1.0 - pick.step_slope)};
}

RecommendedScene recommended_scene(const TradeoffScene& studied, Recommendation& recommendation) {
  const FrozenScene& frozen = *studied.frozen;
  Candidate& pick = recommendation.candidates.at(0);
  const auto make = [&](Json asked) {
    SceneFile scene = read(asked, frozen.file);
    const FittedPick fitted = fit_pick(scene, pick, recommendation.features);
    RecommendedScene made;
    made.json = with_setting(std::move(asked), scene);
    made.file = read(made.json, frozen.file);
    return std::pair(std::move(made), fitted);
  };
  const auto take = [&](std::pair<RecommendedScene, FittedPick> made) {
    const FittedPick& fitted = made.second;
    const double times = fitted.predicted_s / pick.predicted_s;
    made.first.steps_for_error = pick.steps;
    pick.steps = step_of_time(made.first.file.duration, fitted.step);
    pick.h = fitted.step;
    pick.predicted_error = fitted.predicted_error;
    pick.predicted_s = fitted.predicted_s;
    pick.predicted_cost *= times;
    pick.predicted_evaluations *= times;
    return std::move(made.first);
  };
  const Json asked = without_step(frozen.file, recommendation.error);
  auto made = make(asked);
  const ChosenAlike chosen = compare_choices(made.first.file, frozen);
  made.first.choice = in_words(chosen);
  if (chosen.alike) return take(std::move(made));
  try {
    if (auto events = events_by_number(frozen, asked.at("events"))) {
      Json naming = asked;
      naming["events"] = std::move(*events);
      auto named = make(std::move(naming));
      if (compare_choices(named.first.file, frozen).alike) {
        named.first.names_cells = true;
        named.first.choice = made.first.choice;
        return take(std::move(named));
      }
    }
  } catch (const InputError&) {  // such as numbers that no scene of several meshes may have
  }
  made.first.trouble = "No scene can name the cells of the accurate run.";
  return take(std::move(made));
}

std::string RecommendedScene::setting() const {
  return fmt::format("\"integrator\": \"{}\", \"step\": {}{}", file.integrator, Json(file.step).dump(),
                     json.contains("event_times") ? ", \"event_times\": \"exact\"" : "");
}

void require_new(const fs::path& file) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(file, error)))
    throw IoError(fmt::format("{}: exists; expected the name of a new file", file.string()));
  if (const fs::path folder = fs::absolute(file).parent_path(); !fs::is_directory(folder, error))
    throw IoError(fmt::format("{}: there is no folder {}; expected one that exists", file.string(), folder.string()));
}

void write_scene(const RecommendedScene& scene, const fs::path& file) {
  require_new(file);
  Json json = scene.json;
  const fs::path folder = fs::absolute(file).parent_path();
  const auto move = [&](Json& body) {
    if (!body.contains("mesh")) return;
    const fs::path mesh = body["mesh"].get<std::string>();
    if (mesh.is_relative()) body["mesh"] = fs::proximate(fs::absolute(scene.file.folder / mesh), folder).string();
  };
  if (json.contains("body")) move(json["body"]);
  if (json.contains("bodies"))
    for (Json& body : json["bodies"]) move(body);
  write_whole(file, text_of(json));
}

reference::MotionErrors errors_of(const RecommendedScene& scene, const TradeoffScene& studied,
                                  const SceneReference& reference) {
  const FrozenScene& frozen = *studied.frozen;
  constexpr reference::MotionErrors failed{infinity, infinity, infinity, infinity, infinity, infinity, infinity};
  Simulation simulation(without_end(scene.file));
  FrozenBody accurate(frozen);
  std::size_t passed = 0;
  while (passed < frozen.changes.size() && frozen.changes[passed].time == 0.0) ++passed;
  const std::size_t at_start = passed;
  reference::NetworkMotion motion = studied.motion;
  motion.checkpoints.clear();
  std::vector<PointState> states, exact;
  for (std::size_t c = 0; c < studied.motion.checkpoints.size(); ++c) {
    const double time = studied.motion.checkpoints[c];
    const auto step = step_at(time, simulation.step());
    if (!step) continue;
    while (simulation.steps_done() < *step)
      if (simulation.advance()) return failed;
    for (; passed < frozen.changes.size() && frozen.changes[passed].time < time; ++passed) accurate.pass();
    // a checkpoint shows the state before an event of its time, and a simulation that after it
    PointState state = reference.states[c];
    std::vector<std::uint32_t> before_event(state.x.size());
    std::iota(before_event.begin(), before_event.end(), 0u);
    if (passed < frozen.changes.size() && frozen.changes[passed].time <= time * (1.0 + 0x1p-50)) {
      before_event = studied.motion.events[passed++ - at_start].from;
      accurate.pass();
    }
    const auto same = same_vertices(accurate.body(), simulation.body());
    if (!same) return failed;
    const VertexColumns& v = simulation.body().vertices();
    // of the parts of a vertex the first: those that refinement has put between two come later
    for (std::size_t k = same->size(); k-- > 0;) {
      state.x[before_event[k]] = v.position[(*same)[k]];
      state.v[before_event[k]] = v.velocity[(*same)[k]];
    }
    motion.checkpoints.push_back(time);
    states.push_back(std::move(state));
    exact.push_back(reference.states[c]);
  }
  if (states.empty()) return failed;
  return reference::motion_errors(motion, states, exact);
}

}  // namespace dartboard
