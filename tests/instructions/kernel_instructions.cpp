// kernel_instructions SECTION: one piece of work of the core on a small body, for callgrind to count.
//
// Every section builds the same body first; callgrind collects from the section alone (--collect-atstart=no), so that
// neither the start of the program nor its surroundings, which move it by tens of thousands of instructions, are in a
// count.

#include <valgrind/callgrind.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <string_view>

#include "core/base/lanes.h"
#include "core/contact/body_contact.h"
#include "core/elements/solids.h"
#include "core/elements/spring_pieces.h"
#include "core/elements/tetrahedra.h"
#include "core/mechanics/mass_spring_body.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_face.h"
#include "core/time/integrators.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/check.h"
#include "core/views/element_nodes_view.h"
#include "core/views/skin.h"
#include "core/views/skin_solids_view.h"
#include "core/views/spring_ends.h"

using namespace dartboard;

namespace {

enum class Added { one_by_one, in_lanes };

/// The elements of a mesh, stretched. Built within the section that needs them, so that others count their own work.
struct Elements {
  MassSpringBody<TetMap, Held::by_every_dart> body;
  TetrahedronNodesView view;
  std::unique_ptr<ForceTerm> term;

  Elements(const Mesh& mesh, Model model) : body(build_body<TetMap, Held::by_every_dart>(problem_of(mesh, model))) {
    view.rebuild(body);
    term = make_tetrahedra(body.material, {view.nodes, shapes_of<RestShape>(body.elements), body.cell_mass});
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
  std::size_t hundred_forces(Added added = Added::one_by_one) {
    use_lanes(added == Added::in_lanes);
    for (int k = 0; k < 100; ++k) term->add_forces({body.vertices.position}, body.vertices.force);
    return body.vertices.force.front() != body.vertices.force.back();
  }
};

/// A stretched box of 64 hexahedra.
std::size_t hundred_forces_of_hexahedra(Added added) {
  Mesh mesh = hexahedron_box(4, 4, 4, 0.1);
  std::vector<SolidNodes> nodes;
  std::vector<SolidShape> shapes;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    SolidNodes n;
    std::array<Eigen::Vector3d, 8> corners;
    for (const std::uint32_t p : mesh.cell(c)) {
      corners[n.count] = mesh.points[p];
      n.at[n.count++] = p;
    }
    nodes.push_back(n);
    shapes.push_back(solid_shape_of(CellKind::hexahedron, corners));
  }
  for (Eigen::Vector3d& x : mesh.points) x.x() *= 1.1;
  const Material material = Elements::problem_of(mesh, Model::neo_hookean).material;
  const auto term = make_solids(material, {nodes, shapes});
  std::vector<Eigen::Vector3d> force(mesh.points.size(), Eigen::Vector3d(0, 0, 0));
  use_lanes(added == Added::in_lanes);
  for (int k = 0; k < 100; ++k) term->add_forces({mesh.points}, force);
  return force.front() != force.back();
}

/// Two boxes of 192 tetrahedra, the upper one pressed into the lower one while it slides.
class PressedBoxes {
 public:
  PressedBoxes() {
    Problem problem = Elements::problem_of(kuhn_box(4, 4, 2, 0.1), Model::neo_hookean);
    Mesh& mesh = problem.mesh;
    const auto cells = static_cast<std::uint32_t>(mesh.cell_count()),
               points = static_cast<std::uint32_t>(mesh.points.size());
    for (std::uint32_t p = 0; p < points; ++p)
      mesh.points.emplace_back(mesh.points[p] + Eigen::Vector3d(0.03, 0.04, 0.2));
    for (std::uint32_t c = 0; c < cells; ++c) {
      std::array<std::uint32_t, 4> corners;
      std::ranges::transform(mesh.cell(c), corners.begin(), [points](std::uint32_t p) { return p + points; });
      mesh.add_cell(CellKind::tetrahedron, corners);
    }
    body_ = build_body<TetMap, Held::by_every_dart>(problem);
    body_.vertices.keep_rest();
    skin_.rebuild(body_);
    solids_ = SkinSolidsView([cells](std::uint32_t c) { return c < cells ? 0u : 1u; });
    solids_.rebuild(body_);
    upper_ = points;
  }

  std::size_t hundred_forces() {
    const BodyContact contact(skin_.samples(), solids_.solids(), {{0, 1, {.pressure = 1e4, .depth = 0.01}}});
    VertexColumns& v = body_.vertices;
    for (int k = 0; k < 100; ++k) {
      for (std::uint32_t i = 0; i < v.size(); ++i)
        if (v.point[i] >= upper_) v.position[i] += Eigen::Vector3d(2e-4, 1e-4, k < 60 ? -4e-4 : 4e-4);
      contact.add_forces({v.position}, v.force);
    }
    return contact.touching({v.position}).size();
  }

 private:
  MassSpringBody<TetMap, Held::by_every_dart> body_;
  Skin skin_;
  SkinSolidsView solids_;
  std::uint32_t upper_ = 0;
};

/// The edges of tetrahedra as springs, in the columns of a system or as pieces of one of its force terms.
class Springs {
 public:
  enum class As { columns, pieces };

  Springs(const Mesh& mesh, As as, double damping = 0.0)
      : body_(build_body<TetMap, Held::by_every_dart>(problem_of(mesh, damping))) {
    view_.rebuild(body_);
    const VertexColumns& v = body_.vertices;
    system_ = {view_.ends, body_.springs, v.mass, v.inverse_mass, v.viscosity, v.fixed, {0, 0, -9.81}};
    if (as == As::columns) return;
    system_.ends = {};
    system_.springs = {};
    system_.terms = terms_;
  }

  std::size_t steps(const char* integrator, int count, double h, Added added = Added::one_by_one) {
    use_lanes(added == Added::in_lanes);
    const auto method = make_integrator(integrator);
    for (int k = 0; k < count; ++k)
      if (!method->step(system_, {body_.vertices.position, body_.vertices.velocity}, h).ok()) return 0;
    return count;
  }

 private:
  /// As core/elements/spring_pieces.h asks for them.
  struct Edges {
    const MassSpringBody<TetMap, Held::by_every_dart>& body;
    const SpringEndsView& view;
    static std::string_view name() { return "springs"; }
    std::size_t size() const { return view.ends.size(); }
    ForceTerm::Nodes nodes(std::size_t k) const { return view.ends[k]; }
    template <class F>
    void for_each(std::size_t k, const F& f) const {
      const Spring spring = body.springs[k];
      f(PieceSpring{0, 1, spring.rest_length, spring.stiffness});
    }
  };
  static Problem problem_of(const Mesh& mesh, double damping) {
    Problem problem;
    problem.mesh = mesh;
    problem.material = {.density = 1000.0, .stiffness = 3e4, .damping = damping, .viscosity = 0.0};
    for (std::uint32_t k = 0; k < mesh.points.size(); ++k)
      if (mesh.points[k].x() == 0.0) problem.fixed.push_back(k);
    return problem;
  }

  MassSpringBody<TetMap, Held::by_every_dart> body_;
  SpringEndsView view_;
  SpringPieces<Edges> pieces_{Edges{body_, view_}};
  std::array<const ForceTerm*, 1> terms_{&pieces_};
  SpringSystem system_;
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
constexpr std::array<Section, 25> sections{{
    {"backward-euler-springs",
     [](Body& b) { return Springs(b.mesh, Springs::As::columns).steps("backward-euler", 40, 1e-2); }},
    {"backward-euler-springs-as-pieces",
     [](Body& b) { return Springs(b.mesh, Springs::As::pieces).steps("backward-euler", 40, 1e-2); }},
    {"build-general", [](Body& b) { return build_map<Map3>(b.mesh).map.dart_count(); }},
    {"build-tetrahedral", [](Body& b) { return build_map<TetMap>(b.mesh).map.dart_count(); }},
    {"contact-of-bodies", [](Body&) { return PressedBoxes().hundred_forces(); }},
    {"dissociate-general", [](Body& b) { return dissociate(b.general); }},
    {"dissociate-tetrahedral", [](Body& b) { return dissociate(b.tetrahedral); }},
    {"edges-general", [](Body& b) { return edges(b.general); }},
    {"edges-tetrahedral", [](Body& b) { return edges(b.tetrahedral); }},
    {"forces-corotational", [](Body& b) { return Elements(b.mesh, Model::corotational).hundred_forces(); }},
    {"forces-corotational-in-lanes",
     [](Body& b) { return Elements(b.mesh, Model::corotational).hundred_forces(Added::in_lanes); }},
    {"forces-neo-hookean", [](Body& b) { return Elements(b.mesh, Model::neo_hookean).hundred_forces(); }},
    {"forces-neo-hookean-in-lanes",
     [](Body& b) { return Elements(b.mesh, Model::neo_hookean).hundred_forces(Added::in_lanes); }},
    {"forces-of-hexahedra", [](Body&) { return hundred_forces_of_hexahedra(Added::one_by_one); }},
    {"forces-of-hexahedra-in-lanes", [](Body&) { return hundred_forces_of_hexahedra(Added::in_lanes); }},
    {"forces-stvk-in-lanes", [](Body& b) { return Elements(b.mesh, Model::stvk).hundred_forces(Added::in_lanes); }},
    {"full-check-general", [](Body& b) { return full_check(b.general); }},
    {"full-check-tetrahedral", [](Body& b) { return full_check(b.tetrahedral); }},
    {"rk4-springs", [](Body& b) { return Springs(b.mesh, Springs::As::columns).steps("rk4", 200, 1e-3); }},
    {"rk4-springs-in-lanes",
     [](Body& b) { return Springs(b.mesh, Springs::As::columns).steps("rk4", 200, 1e-3, Added::in_lanes); }},
    {"rk4-springs-as-pieces", [](Body& b) { return Springs(b.mesh, Springs::As::pieces).steps("rk4", 200, 1e-3); }},
    {"verlet-dampers", [](Body& b) { return Springs(b.mesh, Springs::As::columns, 10.0).steps("verlet", 200, 1e-3); }},
    {"verlet-dampers-in-lanes",
     [](Body& b) { return Springs(b.mesh, Springs::As::columns, 10.0).steps("verlet", 200, 1e-3, Added::in_lanes); }},
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
