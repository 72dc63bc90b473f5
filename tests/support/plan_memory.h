#pragma once
// The memory of each part of a plan, computed by hand from the mesh: the oracle of SimulatedBody::memory.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <vector>

#include "core/base/bytes.h"
#include "core/scene/forces/attached_points.h"
#include "core/scene/plan/scene_plan.h"
#include "core/scene/timeline/driven_vertices.h"
#include "core/time/watch/divergence.h"
#include "tests/support/integrator_memory.h"

namespace dartboard::memory {

/// A body that stays unchanged, and positions and velocities that may move without it.
class SystemArrays {
 public:
  /// With the needs of a scene, except for changes of topology.
  ///
  /// throws  InputError as make_simulated_body does
  SystemArrays(const Problem& problem, BodyNeeds needs) {
    needs.topology_changes = false;
    body_ = make_simulated_body(problem, needs);
    const Motion start = body_->motion();
    x.assign(start.x.begin(), start.x.end());
    v.assign(start.v.begin(), start.v.end());
  }

  const SimulatedBody& body() const { return *body_; }
  SpringSystem system() const { return body_->system(); }
  Motion motion() { return {x, v}; }

  std::vector<Eigen::Vector3d> x, v;

 private:
  std::unique_ptr<SimulatedBody> body_;
};

/// For an event: the memory of its look-ups at the start.
inline std::size_t predicted_event_bytes(const SceneEvent& e, const ScenePlan& plan) {
  const auto of_cells = [](const CellSelection& cells) -> std::size_t {
    const auto* by_id = std::get_if<IdSelection>(&cells);
    if (by_id == nullptr) return 0;
    auto once = by_id->ids;
    std::ranges::sort(once);
    once.erase(std::unique(once.begin(), once.end()), once.end());
    return bytes_of(by_id->ids, once);
  };
  if (const auto* remove = std::get_if<Remove>(&e.action)) return of_cells(remove->cells);
  if (const auto* refine = std::get_if<Refine>(&e.action)) return of_cells(refine->cells);
  if (const auto* dissociate = std::get_if<Dissociate>(&e.action)) {
    const auto* faces = std::get_if<0>(&dissociate->faces);
    return faces == nullptr ? 0 : faces->size() * sizeof(DartId);
  }
  if (const auto* stress = std::get_if<TearWhereStressed>(&e.action)) {
    const std::size_t places = plan.needs.body.storage == Storage::tetrahedra ? 4 * plan.counts.cells : plan.darts;
    return plan.counts.vertices * sizeof(Eigen::Matrix3d) + (stress->seam ? (places + 7) / 8 : 0);
  }
  return 0;
}

/// The number of faces of a solid, or edges of a surface, of one cell alone, and of their corners.
inline std::size_t boundary_size(const Mesh& mesh) {
  std::map<std::vector<std::uint32_t>, int> cells_of;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (const std::vector<int>& cycle : faces_of(mesh.kinds[c])) {
      std::vector<std::uint32_t> face;
      for (const int k : cycle) face.push_back(mesh.cell(c)[static_cast<std::size_t>(k)]);
      if (mesh.highest_dimension() == 3) {
        std::ranges::sort(face);
        ++cells_of[face];
      } else {
        for (std::size_t k = 0; k < face.size(); ++k) {
          const auto [a, b] = std::minmax(face[k], face[(k + 1) % face.size()]);
          ++cells_of[{a, b}];
        }
      }
    }
  std::size_t size = 0;
  for (const auto& [points, count] : cells_of)
    if (count == 1) size += 1 + points.size();
  return size;
}

inline std::size_t predicted_force_bytes(const SceneFile& scene, const Problem& problem, const ScenePlan& plan,
                                         const PlanItem& item) {
  constexpr std::size_t number = sizeof(std::uint32_t), real = sizeof(double);
  const CellCounts& n = plan.counts;
  const bool on_map = plan.needs.body.topology_changes;
  if (item.name() == "bending")
    return n.edges * (scene.bending.rigidity > 0.0 ? 4 * number + 3 * real : 6 * number + 2 * real);
  if (item.name() == "attachments") {  // rows; on a map their attachments, the cells attached to, and lists by number
    std::size_t rows = 0;
    std::vector<std::uint32_t> cells;
    for (const AttachedPoints& one : find_attachments(scene, problem))
      for (const Attachment& point : one.points) {
        ++rows;
        if (point.has_cell()) cells.push_back(point.cell);
      }
    const std::size_t to_cells = cells.size();
    std::ranges::sort(cells);
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    const std::size_t row = 6 * number + 4 * real + vector + real;
    if (!on_map) return rows * row;
    return rows * (row + 8 * number + 4 * real + vector + real) + rows * 5 * number + to_cells * number +
           cells.size() * 2 * number + (cells.size() + 1) * number +
           (n.vertices + (cells.empty() ? 0 : n.cells)) * number;
  }
  if (item.name() ==
      "air") {  // corners, their number and area; on a map, the face of each row and the row of each face
    const bool surface = plan.needs.body.storage == Storage::surface;
    std::size_t faces = 0, corners = 0;  // of the boundary: each is counted once, with its corners
    for (const std::vector<int>& face : faces_of(problem.mesh.kinds.front())) corners = face.size();
    faces = surface ? n.cells : boundary_size(problem.mesh) / (1 + corners);
    return faces * (6 * number + real) + n.vertices * vector +
           (on_map ? (faces + (surface ? n.cells : n.faces)) * number : 0);
  }
  ADD_FAILURE() << "no prediction for " << item.name();
  return 0;
}

inline std::size_t predicted_bytes(const SceneFile& scene, const Problem& problem, const ScenePlan& plan,
                                   const PlanItem& item) {
  constexpr std::size_t number = sizeof(std::uint32_t), real = sizeof(double);
  const CellCounts& n = plan.counts;
  const Storage storage = plan.needs.body.storage;
  const bool tetrahedra = storage == Storage::tetrahedra;
  const std::size_t dimension = storage == Storage::surface ? 2 : 3;
  SystemArrays arrays(problem, plan.needs.body);
  switch (item.part) {
    case Part::map: return tetrahedra ? n.cells * 5 * number : plan.darts * (dimension + 2) * number;
    // three are in use at once while a body is built: those of a coverage, of a cell visited by it, of the cells around
    // that: a bit for each dart, in words of two bytes, and a list of an eighth of these words and 64
    case Part::marks: {
      const std::size_t words = (plan.darts + 15) / 16;
      return 3 * (2 * words + number * (words / 8 + 64));
    }
    // places for the numbers of vertices, edges, faces and cells: for a tetrahedron 4, 6, 4 and 1
    case Part::embeddings: return tetrahedra ? n.cells * 15 * number : plan.darts * (dimension + 1) * number;
    case Part::cell_darts: return (n.vertices + n.edges + (dimension == 3 ? n.faces : 0) + n.cells) * number;
    case Part::cells:
      // for springs, corners; with a Young's modulus, a share for each of the six edges of a tetrahedron, for each dart
      // of a triangle
      return n.cells * (2 * real + 1 + number) +
             (problem.cell_materials().has_elements() ? 0
              : tetrahedra                            ? n.cells * 4 * number
              : scene.diagonals == Diagonals::none    ? n.cells * sizeof(SolidNodes)
                                                      : 0) +
             (problem.material.young > 0.0 && problem.material.model == Model::springs
                  ? (tetrahedra ? 6 * n.cells : plan.darts) * real
                  : 0);
    case Part::components: return n.cells * number + n.components * (2 * number + sizeof(std::size_t));
    case Part::vertices: return n.vertices * (2 * real + 2 * vector + number);
    case Part::viscosity: return n.vertices * real;
    case Part::fixed: return n.vertices;
    case Part::rest: return n.vertices * vector;
    case Part::pull: {  // by vertex, and for each force its points with one pull for all, or one each
      std::size_t sum = n.vertices * vector;
      for (const SceneForce& force : scene.forces) {
        const std::size_t points = select_points(force.vertices, problem.mesh.points, force.path).size();
        sum += points * number +
               ((force.force && force.shared_by == SharedBy::vertices) || force.acceleration ? 1 : points) * vector +
               2 * force.factor.at.size() * real;
      }
      return sum;
    }
    case Part::driven: {
      DrivenVertices vertices(scene, problem.mesh.points);
      vertices.apply(0.0, scene.step, arrays.body().vertices().point, arrays.v);
      DivergenceDetector detector;
      detector.start(arrays.system(), arrays.motion(), scene.step);
      return vertices.bytes() + detector.driven_bytes();
    }
    case Part::springs: return n.edges * (sizeof(UndampedSpring) + sizeof(SpringEnds));
    // for tetrahedra a matrix and four corners; for cells of any kind the data of eight corners and Gauss points; for a
    // surface of triangles three numbers and three corners, for others the numbers at four points
    case Part::elements:
      if (storage == Storage::surface)
        return n.cells * (std::ranges::find(problem.mesh.kinds, CellKind::quadrilateral) == problem.mesh.kinds.end()
                              ? 3 * real + 3 * number
                              : 12 * real + sizeof(SolidNodes));
      return n.cells * (tetrahedra ? 9 * real + 4 * number : sizeof(SolidShape) + sizeof(SolidNodes));
    case Part::cell_springs:  // kind, first and number, modulus, 16 lengths; eight corners and their count
      return n.cells * (2 * real + 16 * real) + (problem.cell_materials().has_elements() ? 0 : n.cells * 9 * number);
    case Part::force: return predicted_force_bytes(scene, problem, plan, item);
    // laws, obstacles, their displacement and loss; samples; velocities to restore, and as a step begins
    case Part::contact: {
      const std::size_t samples = arrays.body().contacts().obstacles->samples().size(),
                        faces = dimension == 3 ? n.faces : n.cells;
      // places and shapes twice: as they are, and as they are joined
      return scene.obstacles.size() *
                 (sizeof(ContactLaw) + sizeof(Obstacle) + sizeof(ObstacleShape) + 2 * vector + number + real) +
             samples * sizeof(SkinSample) + (plan.needs.solver ? n.vertices * vector : 0) +
             (arrays.body().contacts().obstacles->has_damping() ? n.vertices * vector : 0) +
             (plan.needs.body.topology_changes ? (samples + n.vertices + faces) * number : 0);
    }
    case Part::damping: return n.edges * sizeof(Spring::damping);
    case Part::integrator: return predicted_integrator_bytes(scene.integrator, counts_of(arrays.system()));
    case Part::solver: return predicted_solver_bytes(scene.integrator, arrays.system());
    case Part::detector: return n.vertices * 2 * vector;
    case Part::event: return predicted_event_bytes(scene.events.at(item.which), plan);
    case Part::output_cells:
      if (scene.is_chain()) return n.edges * real + 2 * number;
      return n.cells * (sizeof(CellKind) + number + real + number) + number + problem.mesh.nodes.size() * number +
             (1 + boundary_size(problem.mesh)) * number;
    case Part::probes: return scene.probes.size() * number;
    case Part::sleeping: return n.vertices * (2 * number + (scene.forces.empty() ? 0 : vector));
    case Part::gravity:
    case Part::cell_damping:
    case Part::speed_check:
    case Part::step_check:
    case Part::frames:
    case Part::diagnostics: return 0;
  }
  return 0;
}

}  // namespace dartboard::memory
