#include "benchmarks/studies/operations/operation_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>

#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/json_fields.h"
#include "benchmarks/paper/paper_bodies.h"
#include "benchmarks/studies/topology/topology_tasks.h"
#include "core/mechanics/adapt.h"
#include "core/mechanics/refine.h"
#include "core/mechanics/split_off.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_face.h"
#include "core/operations/remove_volume.h"
#include "core/operations/tear_fan.h"
#include "core/plain/error.h"
#include "core/topology/storage/journal.h"
#include "core/views/views.h"
#include "core/walks/runge_kutta_4.h"

namespace dartboard {
namespace {

using Body = MassSpringBody<TetMap, Held::by_every_dart>;

/// Time stamps of one operation: one at its start and one at the end of each phase.
class Laps {
 public:
  void start() {
    at_.clear();
    at_.push_back(steady_wall_ns());
  }
  void lap() { at_.push_back(steady_wall_ns()); }
  /// Add the laps to a sample, phase by phase; phases that were not run took no time.
  void add_to(OperationSample& sample) const {
    sample.ns.resize(operation_phases().size());
    for (std::size_t k = 0; k < sample.ns.size(); ++k)
      sample.ns[k].push_back(k + 1 < at_.size() ? at_[k + 1] - at_[k] : 0);
  }

 private:
  std::vector<std::int64_t> at_;
};

/// A body with all its views, on which operations are timed.
struct Subject {
  Body body;
  Views views;

  void follow(const TopologyChange& change, const ChangedEmbeddings& changed, Laps& laps) {
    Views::for_each(views, [&](const char*, auto& view) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(view)>, ComponentLabels>)
        view.apply(body, change, changed);
      else
        view.apply(body, changed);
      laps.lap();
    });
  }
};

/// Places on the fresh body for the operations.
struct Places {
  TopologyWork work;                        // faces along a cut, faces at random
  std::vector<Dart> cells, inside;          // at random: a dart of a tetrahedron; of an inner face, for a fan
  std::vector<std::vector<Dart>> clusters;  // of tetrahedra that will come loose together

  Places(const Body& body, Mesh mesh, std::uint64_t seed) : work(topology_work(std::move(mesh), seed)) {
    SplitMix64 random(seed);
    cells = body.cell_dart;
    shuffle(cells, random);
    inside = work.scattered;
    shuffle(inside, random);
    // Grown from tetrahedra drawn at random, neighbour by neighbour, as long as no cell has been taken before.
    std::vector<bool> taken(body.cell_dart.size(), false);
    for (std::size_t k = 0; k < cells.size() && clusters.size() < 20; ++k) grow(body, cells[k], taken);
  }

 private:
  static void shuffle(std::vector<Dart>& darts, SplitMix64& random) {
    for (std::size_t left = darts.size(); left > 1; --left) std::swap(darts[left - 1], darts[random.below(left)]);
  }
  void grow(const Body& body, Dart first, std::vector<bool>& taken) {
    constexpr std::size_t wanted = 96;
    const auto number = [&body](Dart d) { return body.cell(body.map, d); };
    std::vector<Dart> cluster;
    const auto add = [&](Dart d) {
      if (taken[number(d)]) return;
      taken[number(d)] = true;
      cluster.push_back(d);
    };
    add(first);
    for (std::size_t k = 0; k < cluster.size() && cluster.size() < wanted; ++k)
      for (const Face f : incident_cells<2>(body.map, Volume{cluster[k]}))
        if (cluster.size() < wanted) add(body.map.alpha<3>(f.dart));
    if (cluster.size() == wanted) clusters.push_back(cluster);
  }
};

/// Dissociate all faces between a cluster and the rest.
TopologyChange loosen(Body& body, const std::vector<Dart>& cluster) {
  std::vector<std::uint32_t> members;
  for (const Dart d : cluster) members.push_back(body.cell(body.map, d));
  std::sort(members.begin(), members.end());
  TopologyChange change;
  for (const Dart d : cluster)
    for (const Face f : incident_cells<2>(body.map, Volume{d})) {
      const std::uint32_t across = body.cell(body.map, body.map.alpha<3>(f.dart));
      if (!std::binary_search(members.begin(), members.end(), across)) change.append(dissociate_face(body.map, f.dart));
    }
  return change;
}

/// One kind of operation, at the k-th place; nothing if there is no such place, or it is gone.
using Operation = std::function<std::optional<Laps>(Subject&, const Places&, std::size_t k)>;

/// An operation on the map at a dart, that `adapt` follows.
template <class Operate>
Operation at_darts(std::vector<Dart> Places::*darts, Operate operate) {
  return [darts, operate](Subject& s, const Places& places, std::size_t k) -> std::optional<Laps> {
    const auto& all = places.*darts;
    if (k >= all.size() || !s.body.map.is_live(all[k])) return std::nullopt;
    Laps laps;
    laps.start();
    const TopologyChange change = operate(s.body.map, all[k]);
    laps.lap();
    const ChangedEmbeddings changed = adapt(s.body, change);
    laps.lap();
    s.follow(change, changed, laps);
    return laps;
  };
}

Operation dissociate(std::vector<Dart> TopologyWork::*faces) {
  return [faces](Subject& s, const Places& places, std::size_t k) -> std::optional<Laps> {
    const auto& all = places.work.*faces;
    if (k >= all.size()) return std::nullopt;
    Laps laps;
    laps.start();
    const TopologyChange change = dissociate_face(s.body.map, all[k]);
    laps.lap();
    const ChangedEmbeddings changed = adapt(s.body, change);
    laps.lap();
    s.follow(change, changed, laps);
    return laps;
  };
}

template <int i>
std::optional<Laps> refine_at(Subject& s, const Places& places, std::size_t k) {
  if (k >= places.cells.size() || !s.body.map.is_live(places.cells[k])) return std::nullopt;
  Laps laps;
  laps.start();
  const Subdivision subdivision = subdivide(s.body.map, Cell<i>{places.cells[k]});
  laps.lap();
  const ChangedEmbeddings changed = adapt(s.body, subdivision, 1.0);
  laps.lap();
  s.follow({}, changed, laps);
  return laps;
}

std::optional<Laps> split_off_at(Subject& s, const Places& places, std::size_t k) {
  if (k >= places.clusters.size()) return std::nullopt;
  const auto& cluster = places.clusters[k];
  const TopologyChange loose = loosen(s.body, cluster);
  s.views.apply(s.body, loose, adapt(s.body, loose));
  Laps laps;
  laps.start();
  const auto split = split_off(s.body, cluster[0]);
  laps.lap();  // map and embeddings together
  laps.lap();
  s.follow(split.change, split.changed, laps);
  return laps;
}

std::optional<Laps> undo_at(Subject& s, const Places& places, std::size_t k) {
  if (k >= places.work.scattered.size()) return std::nullopt;
  Journal journal;
  s.body.map.attach(&journal);
  dissociate_face(s.body.map, places.work.scattered[k]);
  Laps laps;
  laps.start();
  journal.undo(s.body.map, 0);
  laps.lap();
  s.body.map.attach(nullptr);
  return laps;
}

Operation operation_of(const std::string& name) {
  if (name == "dissociate, cut") return dissociate(&TopologyWork::cut);
  if (name == "dissociate, random") return dissociate(&TopologyWork::scattered);
  if (name == "remove") return at_darts(&Places::cells, [](TetMap& map, Dart d) { return remove_volume(map, d); });
  if (name == "tear fan") return at_darts(&Places::inside, [](TetMap& map, Dart d) { return tear_fan(map, d); });
  if (name == "refine edge") return refine_at<1>;
  if (name == "refine tetrahedron") return refine_at<3>;
  if (name == "split off") return split_off_at;
  if (name == "undo") return undo_at;
  throw InputError(fmt::format("no operation is called '{}'", name));
}

BodySample measure_body(const std::string& name, const Subject& fresh, const Places& places, double h,
                        const OperationStudyOptions& options) {
  BodySample sample{name, options.process, {}, {}, {}};
  Subject s = fresh;
  Views::for_each(s.views, [&](const char*, auto& view) {
    auto& times = sample.rebuild_ns.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const std::int64_t begin = steady_wall_ns();
      view.rebuild(s.body);
      times.push_back(steady_wall_ns() - begin);
    }
  });
  RungeKutta4 integrator;
  const std::size_t turns =
      std::min<std::size_t>(places.work.scattered.size(), s.body.cell_dart.size() > 200'000 ? 6 : 40);
  for (std::size_t k = 0; k < 2 * turns; ++k) {
    const bool eventful = k % 2 != 0;
    const std::int64_t begin = steady_wall_ns();
    if (eventful) {
      const TopologyChange change = dissociate_face(s.body.map, places.work.scattered[k / 2]);
      s.views.apply(s.body, change, adapt(s.body, change));
    }
    integrator.step(s.views.cells, s.body, h);
    (eventful ? sample.eventful_step_ns : sample.step_ns).push_back(steady_wall_ns() - begin);
  }
  return sample;
}

}  // namespace

const std::vector<std::string>& operation_phases() {
  static const std::vector<std::string> phases = [] {
    std::vector<std::string> names{"map", "embeddings"};
    Views views;
    Views::for_each(views, [&names](const char* name, auto&) { names.emplace_back(name); });
    return names;
  }();
  return phases;
}

const std::vector<std::string>& operations() {
  static const std::vector<std::string> names{"dissociate, cut", "dissociate, random", "remove",    "tear fan",
                                              "refine edge",     "refine tetrahedron", "split off", "undo"};
  return names;
}

const std::vector<std::string>& operation_bodies() {
  static const std::vector<std::string> names{"liver564", "kuhn-2058", "kuhn-48000", "kuhn-105456", "kuhn-998250"};
  return names;
}

Problem operation_problem(const std::string& body) {
  if (body == "liver564") return paper_body("liver").make();
  const auto tetrahedra = std::strtod(body.c_str() + std::string("kuhn-").size(), nullptr);
  const int n = static_cast<int>(std::lround(std::cbrt(tetrahedra / 6.0)));
  Problem problem;
  problem.mesh = kuhn_box(n, n, n, 0.1, 0.2, 1);
  problem.h = 1e-4;
  return problem;
}

void study_operations(const std::string& body, const OperationStudyOptions& options,
                      const std::function<void(const OperationSample&)>& operation_sink,
                      const std::function<void(const BodySample&)>& body_sink) {
  const Problem problem = operation_problem(body);
  Subject fresh{build_body<TetMap, Held::by_every_dart>(problem), {}};
  fresh.views.rebuild(fresh.body);
  const Places places(fresh.body, problem.mesh, options.seed);
  for (const std::string& name : operations()) {
    const Operation operation = operation_of(name);
    Subject s = fresh;
    OperationSample sample{body, name, options.process, {}, 0};
    constexpr std::size_t warm_up = 5;
    for (std::size_t k = 0; k < static_cast<std::size_t>(options.times) + warm_up; ++k) {
      const std::int64_t begin = thread_cpu_ns();
      const auto laps = operation(s, places, k);
      const std::int64_t end = thread_cpu_ns();
      if (!laps || k < warm_up) continue;
      laps->add_to(sample);
      sample.cpu_ns += end - begin;
    }
    if (!sample.ns.empty()) operation_sink(sample);
  }
  body_sink(measure_body(body, fresh, places, problem.h, options));
}

SeriesTime time_series_of_removals(const Problem& problem, int count, std::uint64_t seed) {
  SeriesTime time;
  auto body = build_body<TetMap, Held::by_every_dart>(problem);
  CellArrays arrays;
  arrays.rebuild(body);
  SplitMix64 random(seed);
  std::vector<Dart> cells;
  for (int k = 0; k < count; ++k) cells.push_back(body.cell_dart[random.below(body.cell_dart.size())]);
  const std::int64_t begin = thread_cpu_ns();
  for (const Dart d : cells)
    if (body.map.is_live(d)) adapt(body, remove_volume(body.map, d));
  const std::int64_t middle = thread_cpu_ns();
  arrays.rebuild(body);
  time.rebuild_ns = thread_cpu_ns() - middle;
  time.changes_ns = middle - begin;
  return time;
}

DARTBOARD_JSON_FIELDS(OperationSample, body, operation, process, ns, cpu_ns)
DARTBOARD_JSON_FIELDS(BodySample, body, process, rebuild_ns, step_ns, eventful_step_ns)
DARTBOARD_JSON_FIELDS(SeriesTime, changes_ns, rebuild_ns)

}  // namespace dartboard
