#include <fmt/format.h>

#include <algorithm>

#include "core/base/counted.h"
#include "core/forces/face_pressure.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/forces/body_force.h"
#include "core/scene/forces/corners_of_cells.h"
#include "core/scene/forces/faces_under_pressure.h"
#include "core/scene/forces/kinds.h"
#include "core/views/pressed_faces.h"

namespace dartboard {
namespace {

/// Pressures that follow their faces. Their values [Pa] are by number of the scene's force.
class PressuresForce final : public ViewedForce<PressedFacesView> {
 public:
  PressuresForce(std::vector<PressedFace> of_mesh, std::size_t forces, const ForceSite& site)
      : of_mesh_(std::move(of_mesh)), mesh_cell_(site.mesh_cell), pressure_(forces, 0.0) {}

  const ForceTerm& term() const override { return term_; }
  std::size_t bytes() const override { return ViewedForce::bytes() + bytes_of(of_mesh_, pressure_) + term_.bytes(); }

  void rebuild(const MapBody& body) override {
    if (!of_mesh_.empty()) view_ = PressedFacesView(std::exchange(of_mesh_, {}), mesh_cell_);
    ViewedForce::rebuild(body);
  }
  void rebuild(const BodyWithoutMap& body) override {
    on_map_ = false;
    std::vector<std::uint32_t> cells;  // of the mesh
    for (const PressedFace& face : of_mesh_) cells.push_back(face.cell);
    const CornersOfCells corners(body, std::move(cells));
    view_.rows.clear();
    for (const PressedFace& face : of_mesh_) {
      if (!corners.is_there(face.cell)) continue;
      PressedFace& row = view_.rows.emplace_back(face);
      for (std::uint32_t k = 0; k < face.count; ++k) row.corner[k] = corners.vertex_at(face.cell, face.corner[k]);
    }
  }
  void leave_map() override {
    ViewedForce::leave_map();
    of_mesh_ = {};
  }
  void state(Archive& archive) override {
    archive(pressure_);
    ViewedForce::state(archive);
  }

  std::span<double> loads() override { return pressure_; }
  bool does_work() const override { return true; }
  void begin_work(std::span<const Eigen::Vector3d> x) override { term_.begin_step(x); }
  double work(std::span<const Eigen::Vector3d> x, double) const override { return term_.work(x); }

 private:
  std::vector<PressedFace> of_mesh_;  // without a map; until the view has them
  std::function<std::uint32_t(std::uint32_t)> mesh_cell_;
  std::vector<double> pressure_;
  FacePressureTerm term_{view_.rows, pressure_};
};

std::optional<ForceNeed> pressures_need(const SceneFile& scene, const Problem& problem) {
  std::vector<PressedFace> faces = followed_faces(scene, problem.mesh);
  if (faces.empty()) return {};
  std::string why;
  for (const SceneForce& force : scene.forces)
    if (force.follows) why += fmt::format("{}{}/pressure: {}", why.empty() ? "" : "; ", force.path, *force.pressure);
  ForceNeed found{.make = {},
                  .what = counted(faces.size(), "face") + " under pressure, and their term of the force loop",
                  .why = why + "; current normals: their work is summed",
                  .over_parts = true};
  found.make = [faces = std::move(faces), forces = scene.forces.size()](const ForceSite& site) {
    return std::make_unique<PressuresForce>(faces, forces, site);
  };
  return found;
}

}  // namespace

ForceKind pressures_kind() {
  return {.name = "pressures",
          .is_in = [](const SceneFile& scene) { return std::ranges::any_of(scene.forces, &SceneForce::follows); },
          .need = pressures_need};
}

}  // namespace dartboard
