#include "benchmarks/studies/topology/topology_tasks.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <tuple>

#include "benchmarks/paper/paper_bodies.h"
#include "core/mechanics/embedding.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_face.h"
#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/check.h"
#include "core/topology/facets.h"

namespace dartboard {
namespace {

Eigen::Vector3d centre(const Mesh& mesh, Dart d) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t p : mesh.cell(d.index / 24)) sum += mesh.points[p];
  return sum / 4.0;
}

/// The faces that a plane separates, in strips of about one edge's width.
std::vector<Dart> cut_faces(const Mesh& mesh, const TetMap& map, const std::vector<Dart>& inner) {
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, 3).normalized();
  const Eigen::Vector3d along = normal.unitOrthogonal(), across = normal.cross(along);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& p : mesh.points) middle += p / static_cast<double>(mesh.points.size());

  struct Placed {
    double strip, along;
    Dart dart;
  };
  std::vector<Placed> cut;
  double width = 0.0;
  for (const Dart d : inner) {
    const Eigen::Vector3d here = centre(mesh, d) - middle, there = centre(mesh, map.alpha<3>(d)) - middle;
    if ((here.dot(normal) < 0.0) == (there.dot(normal) < 0.0)) continue;
    const auto cell = mesh.cell(d.index / 24);
    width += (mesh.points[cell[1]] - mesh.points[cell[0]]).norm();
    const Eigen::Vector3d at = (here + there) / 2.0;
    cut.push_back({at.dot(across), at.dot(along), d});
  }
  width /= static_cast<double>(cut.size());
  for (Placed& p : cut) p.strip = std::floor(p.strip / width);
  std::sort(cut.begin(), cut.end(), [](const Placed& a, const Placed& b) {
    return std::tie(a.strip, a.along, a.dart) < std::tie(b.strip, b.along, b.dart);
  });
  std::vector<Dart> faces;
  for (const Placed& p : cut) faces.push_back(p.dart);
  return faces;
}

/// A map whose faces are unsewn and put back.
template <class Map>
struct Subject {
  Map map;
  Journal journal;

  explicit Subject(const Mesh& mesh) : map(build_map<Map>(mesh).map) { map.attach(&journal); }

  std::uint64_t unsew(const std::vector<Dart>& faces) {
    std::uint64_t apart = 0;
    for (const Dart d : faces) {
      const TopologyChange change = dissociate_face(map, d);
      apart += change.vertices.size() + change.edges.size();
    }
    return apart;
  }
  void restore() {
    journal.undo(map, 0);
    if (const auto violation = check(map); !violation.empty()) throw_invalid("undoing", violation);
  }
};

}  // namespace

TopologyWork topology_work(Mesh mesh, std::uint64_t seed) {
  TopologyWork work;
  work.mesh = std::move(mesh);
  const TetMap map = build_map<TetMap>(work.mesh).map;
  for_each_cell<0>(map, [&](Vertex v) { work.vertices.push_back(v.dart); });
  work.scattered = inner_facets(map);
  work.cut = cut_faces(work.mesh, map, work.scattered);
  SplitMix64 random(seed);
  for (std::size_t left = work.scattered.size(); left > 1; --left)
    std::swap(work.scattered[left - 1], work.scattered[random.next() % left]);
  work.scattered.resize(work.scattered.size() / 20);
  return work;
}

double unit_count(std::string_view figure, const TopologyWork& work) {
  const auto tetrahedra = static_cast<double>(work.mesh.cell_count());
  if (figure == "vertex-orbit" || figure == "full-check" || figure == "count-cells") return 24.0 * tetrahedra;
  if (figure == "build") return tetrahedra;
  if (figure == "vertex-to-tetrahedra") return static_cast<double>(work.vertices.size());
  if (figure == "unsew-cut") return static_cast<double>(work.cut.size());
  if (figure == "unsew-scattered" || figure == "local-check") return static_cast<double>(work.scattered.size());
  throw InputError(fmt::format("no figure of topology is called '{}'", figure));
}

template <class Map>
std::vector<TopologyTask> topology_tasks(const TopologyWork& work) {
  const auto subject = std::make_shared<Subject<Map>>(work.mesh);
  const Map& map = subject->map;
  std::vector<TopologyTask> tasks;
  const auto reads_only = [&](const char* figure, auto find) {
    const auto run = [subject, find] { return static_cast<std::uint64_t>(find()); };
    tasks.push_back({figure, run, [run] { run(); }});
  };
  reads_only("vertex-orbit", [&map, &work] {
    // the darts are read, or a compiler could count without walking
    std::uint64_t n = 0, sum = 0;
    for (const Dart v : work.vertices)
      for_each_dart_of(map, Vertex{v}, [&](Dart d) {
        ++n;
        sum += d.index;
      });
    return sum == 0 ? 0 : n;
  });
  reads_only("vertex-to-tetrahedra", [&map, &work] {
    std::size_t n = 0;
    for (const Dart v : work.vertices) n += incident_cells<3>(map, Vertex{v}).size();
    return n;
  });
  reads_only("full-check", [&map] { return check(map).empty(); });
  reads_only("count-cells",
             [&map] { return count_cells<0>(map) + count_cells<1>(map) + count_cells<2>(map) + count_cells<3>(map); });
  reads_only("local-check", [&map, &work] {
    std::size_t valid = 0;
    for (Dart d : work.scattered)
      for (int k = 0; k < 6; ++k) {
        valid += check_dart(map, d).empty() ? 1u : 0u;
        valid += check_dart(map, map.template alpha<3>(d)).empty() ? 1u : 0u;
        d = k % 2 == 0 ? map.template alpha<0>(d) : map.template alpha<1>(d);
      }
    return valid;
  });
  const auto built = std::make_shared<std::optional<BuiltMap<Map>>>();
  const auto build_anew = [built, &work] {
    *built = build_map<Map>(work.mesh);
    return std::uint64_t{(*built)->map.dart_count()};
  };
  tasks.push_back({"build", build_anew, [built] { built->reset(); }});
  const auto restore = [subject] { subject->restore(); };
  tasks.push_back({"unsew-cut", [subject, &work] { return subject->unsew(work.cut); }, restore});
  tasks.push_back({"unsew-scattered", [subject, &work] { return subject->unsew(work.scattered); }, restore});
  return tasks;
}

template <class Map>
std::size_t map_bytes(const Mesh& mesh) {
  const Map map = build_map<Map>(mesh).map;
  const Map fitted = map;  // a copy holds no reserve
  CellEmbedding<0, Map, Held::by_every_dart> vertices;
  CellEmbedding<1, Map, Held::by_every_dart> edges;
  std::uint32_t number = 0;
  for_each_cell<0>(map, [&](Vertex v) { vertices.attach(map, v, number++); });
  for_each_cell<1>(map, [&](Edge e) { edges.attach(map, e, number++); });
  return fitted.bytes() + vertices.bytes() + edges.bytes();
}

void TopologyStage::add(const std::string& name, const TopologyWork& work, std::vector<TopologyTask> tasks) {
  for (TopologyTask& task : tasks) {
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.figure == task.figure; });
    if (group == groups.end()) group = groups.insert(groups.end(), {task.figure, {}});
    group->entries.push_back({name, unit_count(task.figure, work), std::move(task)});
  }
}

Mesh topology_mesh(const std::string& body) {
  return body == "liver564" ? paper_body("liver").make().mesh : kuhn_box(20, 20, 20, 0.1);
}

TopologyStage make_topology_stage(const std::string& body, std::uint64_t seed) {
  TopologyStage stage;
  if (body == scaling) {
    for (std::size_t k = 0; k < scaling_sizes.size(); ++k) {
      constexpr int cubes[] = {7, 20, 55};  // on a side, six tetrahedra each
      const int n = cubes[k];
      const TopologyWork& work = stage.works.emplace_back(topology_work(kuhn_box(n, n, n, 0.1), seed));
      stage.add(scaling_sizes[k], work, topology_tasks<TetMap>(work));
    }
    std::erase_if(stage.groups, [](const auto& g) { return !g.figure.starts_with("unsew"); });
  } else {
    const TopologyWork& work = stage.works.emplace_back(topology_work(topology_mesh(body), seed));
    stage.add("general", work, topology_tasks<Map3>(work));
    stage.add("tetrahedral", work, topology_tasks<TetMap>(work));
    stage.add("CGAL", work, cgal_topology_tasks(work));
    stage.add("bare CGAL", work, cgal_bare_topology_tasks(work));
  }
  return stage;
}

template std::vector<TopologyTask> topology_tasks<Map3>(const TopologyWork&);
template std::vector<TopologyTask> topology_tasks<TetMap>(const TopologyWork&);
template std::size_t map_bytes<Map3>(const Mesh&);
template std::size_t map_bytes<TetMap>(const Mesh&);

}  // namespace dartboard
