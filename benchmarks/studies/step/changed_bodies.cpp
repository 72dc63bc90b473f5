#include "benchmarks/studies/step/changed_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "benchmarks/harness/json_fields.h"
#include "benchmarks/studies/step/scene_columns.h"
#include "benchmarks/studies/step/step_bodies.h"
#include "core/mechanics/adapt.h"
#include "core/mechanics/cell_nodes.h"
#include "core/mechanics/fracture/seam.h"
#include "core/mechanics/numbering.h"
#include "core/operations/dissociate_all.h"
#include "core/operations/remove_volume.h"
#include "core/plain/error.h"
#include "core/scene/body/simulated_body.h"
#include "core/views/spring_ends.h"

namespace dartboard {
namespace {

constexpr double amounts_of_change[] = {0.01, 0.10, 0.50};
constexpr const char *random_faces = "random faces dissociated", *planar_cuts = "planar cuts",
                     *random_removals = "random tetrahedra removed";
constexpr int planes = 60;  // more than half of the springs of a million tetrahedra need
/// Changes are made in so many batches at least, as in a run that changes again and again.
constexpr std::size_t batches = 2'000;

/// The faces between cells on different sides of planes, plane after plane. Each goes through a cell drawn at random.
std::vector<Dart> faces_on_planes(const MassSpringBody<TetMap, Held::by_every_dart>& body, const Mesh& mesh,
                                  SplitMix64& random) {
  std::vector<Eigen::Vector3d> centre(mesh.cell_count(), Eigen::Vector3d::Zero());
  for (std::size_t c = 0; c < centre.size(); ++c)
    for (const std::uint32_t p : mesh.cell(c)) centre[c] += mesh.points[p] / 4.0;
  std::vector<Dart> faces;
  for (int k = 0; k < planes; ++k) {
    const Eigen::Vector3d at = centre[random.below(centre.size())], normal = random.next_in_ball();
    const auto in_front = [&](std::uint32_t c) { return (centre[c] - at).dot(normal) >= 0.0; };
    std::ranges::copy(
        facets_between(body, [&](std::uint32_t a, std::uint32_t b) { return in_front(a) != in_front(b); }),
        std::back_inserter(faces));
  }
  return faces;
}

/// The places of changes of a kind, in their order.
std::vector<Dart> places_of_change(const MassSpringBody<TetMap, Held::by_every_dart>& body, const Mesh& mesh,
                                   const std::string& kind, std::uint64_t seed) {
  SplitMix64 random(seed);
  if (kind == planar_cuts) return faces_on_planes(body, mesh, random);
  std::vector<Dart> places = kind == random_removals ? body.cell_dart : inner_facets(body.map);
  if (kind != random_removals && kind != random_faces)
    throw InputError(fmt::format("no kind of change is called '{}'", kind));
  shuffle(places, random);
  return places;
}

TopologyChange remove_all(TetMap& map, std::span<const Dart> cells) {
  TopologyChange change;
  for (const Dart d : cells) change.append(remove_volume(map, d));
  return change;
}

std::filesystem::path columns_file(const ChangedPlan& plan, std::size_t amount, const char* task) {
  return plan.folder / fmt::format("{}{}", amount, task + 2);
}

std::string case_name(const ChangedPlan& plan, double asked) {
  return fmt::format("{}, {:g} % {}", plan.body, 100.0 * asked, plan.kind);
}

int steps_in_sample(const KeptColumns& columns) {
  return static_cast<int>(std::max<std::size_t>(1, springs_in_sample / columns.springs.size()));
}

}  // namespace

const std::vector<std::string>& kinds_of_change() {
  static const std::vector<std::string> kinds{random_faces, planar_cuts, random_removals};
  return kinds;
}

void change_body(const Problem& problem, const std::string& kind, std::span<const double> amounts, std::uint64_t seed,
                 const std::function<void(ChangedBody&&)>& sink) {
  auto body = build_body<TetMap, Held::by_every_dart>(problem);
  SpringEndsView ends;
  ends.rebuild(body);
  Numbering numbering(body);
  const std::vector<Dart> places = places_of_change(body, problem.mesh, kind, seed);
  const bool removes = kind == random_removals;
  const auto count = [&] { return static_cast<double>(removes ? body.cell_dart.size() : body.springs.size()); };
  const double start = count();
  const auto reached = [&] { return std::abs(count() - start) / start; };
  const std::size_t batch = std::max<std::size_t>(1, places.size() / batches);
  std::span<const Dart> left = places;
  for (const double asked : amounts) {
    while (reached() < asked && !left.empty()) {
      // no more than are certainly needed: a face has three edges
      const double needed = std::ceil((asked - reached()) * start / (removes ? 1.0 : 3.0));
      const std::size_t next = std::min({batch, left.size(), static_cast<std::size_t>(needed)});
      const auto now = left.first(next);
      const ChangedEmbeddings changed =
          adapt(body, removes ? remove_all(body.map, now) : dissociate_all(body.map, now));
      ends.apply(body, changed);
      if (!numbering.follow(body, changed).empty()) ends.rebuild(body);
      left = left.subspan(next);
    }
    Mesh mesh;
    mesh.points = body.vertices.position;
    for (std::uint32_t c = 0; c < body.cell_dart.size(); ++c) add_cell_of(body, c, mesh);
    const SpringSystem system = system_of(body.vertices, ends.ends, body.springs, body.surroundings.gravity, {});
    sink({.asked = asked,
          .reached = reached(),
          .present = present_problem(std::move(mesh), body.vertices, problem),
          .columns = kept_columns(body.vertices, system, problem.h)});
  }
}

std::size_t count_differing(const ChangedBody& changed, const FreshBody& fresh) {
  SceneColumns in_scene(fresh.scene, changed.columns.h, {"scene"}),
      stepped(std::make_shared<KeptColumns>(fresh.columns), changed.columns.h, {changed_task::fresh});
  return count_differing(changed.columns, std::vector<ContenderBody*>{&in_scene, &stepped});
}

void compare_changed(const ChangedPlan& plan, const std::function<void(const ChangedCase&)>& sink) {
  const Problem problem = find_step_body(plan.body, plan.seed).make();
  std::size_t k = 0;
  change_body(problem, plan.kind, amounts_of_change, plan.seed, [&](ChangedBody&& one) {
    FreshBody fresh(one.present, one.columns);
    write_columns(columns_file(plan, k, changed_task::changed), one.columns);
    write_columns(columns_file(plan, k++, changed_task::fresh), fresh.columns);
    sink({.changed = case_name(plan, one.asked),
          .body = plan.body,
          .kind = plan.kind,
          .asked = one.asked,
          .reached = one.reached,
          .tetrahedra = one.present.mesh.cell_count(),
          .vertices = one.columns.at.size(),
          .springs = one.columns.springs.size(),
          .steps = steps_in_sample(one.columns),
          .differing = count_differing(one, fresh)});
  });
}

void measure_changed(const ChangedPlan& plan, const std::function<void(const Sample&)>& sink) {
  // a study that goes on has the comparison, but not its files
  if (!std::filesystem::exists(columns_file(plan, 0, changed_task::changed)))
    compare_changed(plan, [](const ChangedCase&) {});
  const MannerBefore before;
  for (std::size_t k = 0; k < std::size(amounts_of_change); ++k) {
    std::vector<TimedTask> tasks;
    PointState start;
    std::size_t springs = 0;
    for (const char* task : {changed_task::changed, changed_task::fresh}) {
      const auto kept = std::make_shared<KeptColumns>(read_columns(columns_file(plan, k, task)));
      const auto columns = std::make_shared<SceneColumns>(kept, kept->h, Manner{task});
      springs = kept->springs.size();
      if (tasks.empty()) {  // in motion, and with the damping at work
        columns->choose();
        columns->step(steps_to_start);
        start = columns->state();
      }
      tasks.push_back({case_name(plan, amounts_of_change[k]) + task, [columns, &start] { columns->set_state(start); },
                       [columns, n = steps_in_sample(*kept)] { columns->step(n); },
                       [columns] { return state_hash(columns->state()); }});
    }
    const int rounds = springs < 500'000 ? plan.rounds : std::max(1, plan.rounds / 5);
    run_rounds(tasks, {.rounds = rounds, .warmup = 1, .process = plan.process, .seed = plan.seed}, sink);
  }
}

DARTBOARD_JSON_FIELDS(ChangedCase, changed, body, kind, asked, reached, tetrahedra, vertices, springs, steps, differing)

}  // namespace dartboard
