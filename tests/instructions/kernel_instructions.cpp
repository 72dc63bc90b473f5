// kernel_instructions SECTION: one piece of work of the core on a small body, for callgrind to count.
//
// Every section builds the same body first; callgrind collects from the section alone (--collect-atstart=no), so that
// neither the start of the program nor its surroundings, which move it by tens of thousands of instructions, are in a
// count.

#include <valgrind/callgrind.h>

#include <array>
#include <cstdio>
#include <memory>
#include <string_view>

#include "core/elements/tetrahedra.h"
#include "core/mechanics/mass_spring_body.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_face.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/check.h"
#include "core/views/element_nodes_view.h"

using namespace dartboard;

namespace {

/// The elements of a mesh, stretched. Built within the section that needs them, so that others count their own work.
struct Elements {
  MassSpringBody<TetMap, Held::by_every_dart> body;
  TetrahedronNodesView view;
  std::unique_ptr<ForceTerm> term;

  Elements(const Mesh& mesh, Model model) : body(build_body<TetMap, Held::by_every_dart>(problem_of(mesh, model))) {
    view.rebuild(body);
    term = make_tetrahedra(body.material, {view.nodes, body.cell_shape, body.cell_mass});
    for (Eigen::Vector3d& x : body.vertices.position) x.x() *= 1.1;
  }
  static Problem problem_of(const Mesh& mesh, Model model) {
    Problem problem;
    problem.mesh = mesh;
    problem.material = {.density = 1000.0,
                        .stiffness = 0.0,
                        .damping = 0.0,
                        .viscosity = 0.0,
                        .young = 1e4,
                        .poisson = 0.3,
                        .model = model};
    return problem;
  }
  std::size_t hundred_forces() {
    for (int k = 0; k < 100; ++k) term->add_forces({body.vertices.position}, body.vertices.force);
    return body.vertices.force.front() != body.vertices.force.back();
  }
};

struct Body {
  Mesh mesh = kuhn_box(6, 6, 6, 0.1);  // 1296 tetrahedra
  TetMap tetrahedral = build_map<TetMap>(mesh).map;
  Map3 general = build_map<Map3>(mesh).map;
};

template <class Map>
std::size_t vertex_orbits(const Map& map) {
  std::size_t sum = 0;
  for_each_cell<0>(map, [&](Vertex v) { for_each_dart_of(map, v, [&](Dart d) { sum += d.index; }); });
  return sum;
}

template <class Map>
std::size_t edges(const Map& map) {
  return count_cells<1>(map);
}

template <class Map>
std::size_t full_check(const Map& map) {
  return check(map).size() + 1;
}

template <class Map>
std::size_t dissociate(Map& map) {
  std::size_t apart = 0;
  for (std::uint32_t d = 0; d < map.capacity(); d += 6 * 7) {  // every seventh face
    const TopologyChange change = dissociate_face(map, Dart{d});
    apart += change.faces.size() + change.edges.size() + change.vertices.size();
  }
  return apart;
}

struct Section {
  std::string_view name;
  std::size_t (*run)(Body&);
};
constexpr std::array<Section, 12> sections{{
    {"build-general", [](Body& b) { return build_map<Map3>(b.mesh).map.dart_count(); }},
    {"build-tetrahedral", [](Body& b) { return build_map<TetMap>(b.mesh).map.dart_count(); }},
    {"dissociate-general", [](Body& b) { return dissociate(b.general); }},
    {"dissociate-tetrahedral", [](Body& b) { return dissociate(b.tetrahedral); }},
    {"edges-general", [](Body& b) { return edges(b.general); }},
    {"edges-tetrahedral", [](Body& b) { return edges(b.tetrahedral); }},
    {"forces-corotational", [](Body& b) { return Elements(b.mesh, Model::corotational).hundred_forces(); }},
    {"forces-neo-hookean", [](Body& b) { return Elements(b.mesh, Model::neo_hookean).hundred_forces(); }},
    {"full-check-general", [](Body& b) { return full_check(b.general); }},
    {"full-check-tetrahedral", [](Body& b) { return full_check(b.tetrahedral); }},
    {"vertex-orbits-general", [](Body& b) { return vertex_orbits(b.general); }},
    {"vertex-orbits-tetrahedral", [](Body& b) { return vertex_orbits(b.tetrahedral); }},
}};

}  // namespace

int main(int argc, char** argv) {
  const std::string_view wanted = argc == 2 ? argv[1] : "";
  for (const Section& section : sections) {
    if (wanted == "--list") std::printf("%s\n", section.name.data());
    if (wanted != section.name) continue;
    Body body;
    CALLGRIND_TOGGLE_COLLECT;
    const std::size_t answer = section.run(body);
    CALLGRIND_TOGGLE_COLLECT;
    return answer == 0 ? 1 : 0;  // the answer is used, so the work cannot be left out
  }
  if (wanted == "--list") return 0;
  std::fprintf(stderr, "kernel_instructions SECTION, one of those that --list lists\n");
  return 2;
}
