#include "core/scene/file/scene_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "core/plain/young.h"
#include "core/scene/file/load_mesh.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;

// Errors of a mesh name the key that asked for it.
Mesh generate(const BoxMesh& box) {
  const auto [nx, ny, nz] = box.cells;
  if (box.kind == "hexahedra") return hexahedron_box(nx, ny, nz, box.spacing);
  if (box.kind == "mixed") return mixed_box(nx, ny, nz, box.spacing);
  return kuhn_box(nx, ny, nz, box.spacing, box.jitter, box.seed);
}
Mesh generate(const SheetMesh& sheet) {
  const auto [nx, ny] = sheet.cells;
  return sheet.kind == "triangles" ? triangle_sheet(nx, ny, sheet.spacing) : quad_sheet(nx, ny, sheet.spacing);
}
Mesh generate(const BallMesh& ball) { return tetrahedron_ball(ball.layers, ball.radius); }
Mesh generate(const ChainMesh& chain) {
  Mesh mesh;
  for (int k = 0; k <= chain.links; ++k) mesh.points.emplace_back(k * chain.spacing, 0, 0);
  return mesh;
}
/// Nothing moves faster.
void require_slower_than_light(const std::string& path, const Eigen::Vector3d& v) {
  const double speed = v.stableNorm();
  if (speed <= speed_of_light) return;
  const std::string shown = std::isfinite(speed) ? fmt::format("{:.6g} m/s", speed) : "not finite";
  throw InputError(fmt::format("{}: is {} somewhere in the body; expected at most {:.0f} m/s, the speed of light", path,
                               shown, speed_of_light));
}

void require_not_released(const SceneFile& scene, std::span<const std::uint32_t> driven,
                          std::span<const Eigen::Vector3d> points) {
  for (const SceneEvent& event : scene.events) {
    const auto* release = std::get_if<Release>(&event.action);
    if (release == nullptr) continue;
    for (const std::uint32_t p : select_points(release->vertices, points, event.path + "/release"))
      if (std::ranges::find(driven, p) != driven.end())
        throw InputError(
            fmt::format("{}/release: selects point {}, which /driven moves; expected fixed ones alone", event.path, p));
  }
}

/// The mean stiffness that the scene's Young's modulus makes of the edges of its mesh.
double stiffness_of_young(const SceneFile& scene, const Mesh& mesh) {
  const auto fail = [&scene](std::string_view found, std::string_view expected) {
    throw InputError(fmt::format("{}: /material/young: is {} Pa, and {}; expected {}", scene.file, scene.material.young,
                                 found, expected));
  };
  if (const auto c = first_loose_cell(mesh))
    fail(fmt::format("cell {} is a {}, whose edges alone do not hold its shape", *c, name(mesh.kinds[*c])),
         "tetrahedra, triangles or a chain, or 'stiffness' in its place");
  const double mean = mean_stiffness(mesh, scene.material.young);
  if (!(mean > 0.0 && std::isfinite(mean)))
    fail(fmt::format("the stiffness of its springs has a mean of {:.6g} N/m", mean),
         "a number above 0, of edges that have a length and cells that have a volume");
  return mean;
}

/// Elements are solid.
void require_elements(const SceneFile& scene, const Mesh& mesh) {
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    if (dimension(mesh.kinds[c]) == 2)
      throw InputError(
          fmt::format("{}: /material/poisson: stands beside cell {}, a {}, which has no element; expected "
                      "solid cells, or springs",
                      scene.file, c, name(mesh.kinds[c])));
}

}  // namespace

Mesh make_mesh(const SceneFile& scene) {
  Mesh mesh;
  const bool from_file = std::holds_alternative<fs::path>(scene.body.mesh);
  try {
    mesh = std::visit(
        [&scene](const auto& source) {
          if constexpr (requires { generate(source); })
            return generate(source);
          else
            return scene.body.loaded ? scene.body.loaded->mesh : read_body_mesh(scene.body).mesh;
        },
        scene.body.mesh);
  } catch (const IoError& problem) {
    throw IoError(fmt::format("{}: /body/mesh: {}", scene.file, problem.what()));
  } catch (const InputError& problem) {
    throw InputError(fmt::format("{}: /body/{}: {}", scene.file, from_file ? "mesh" : "generate", problem.what()));
  } catch (const std::bad_alloc&) {
    throw InputError(fmt::format("{}: /body/{}: there is not enough memory for so many cells; expected fewer",
                                 scene.file, from_file ? "mesh" : "generate"));
  }
  // where nothing turns, not even a sum of zeros is added
  const bool turned = scene.body.rotate != Eigen::Matrix3d::Identity();
  for (Eigen::Vector3d& x : mesh.points) {
    x *= scene.body.scale;
    if (turned) x = scene.body.rotate * x;
    x += scene.body.translate;
  }
  return mesh;
}

Problem make_problem(const SceneFile& scene) {
  Problem problem;
  problem.mesh = make_mesh(scene);
  problem.material = scene.material;
  if (scene.material.model != Model::springs)
    require_elements(scene, problem.mesh);
  else if (scene.material.young > 0.0)
    problem.material.stiffness = stiffness_of_young(scene, problem.mesh);
  problem.surroundings.gravity = scene.gravity;
  problem.h = scene.step;
  try {
    problem.fixed = select_points(scene.fixed, problem.mesh.points);
    for (const SceneDrive& drive : scene.driven) {
      const auto driven = select_points(drive.vertices, problem.mesh.points, drive.path);
      for (const std::uint32_t p : driven)
        require_slower_than_light(drive.path + "/velocity", drive.velocity.at(problem.mesh.points[p]));
      require_not_released(scene, driven, problem.mesh.points);
      problem.fixed.insert(problem.fixed.end(), driven.begin(), driven.end());
    }
    std::sort(problem.fixed.begin(), problem.fixed.end());
    problem.fixed.erase(std::unique(problem.fixed.begin(), problem.fixed.end()), problem.fixed.end());
    for (const Eigen::Vector3d& x : problem.mesh.points) {
      problem.initial_velocity.push_back(scene.initial_velocity.at(x));
      require_slower_than_light("/initial_velocity", problem.initial_velocity.back());
    }
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", scene.file, error.what()));
  }
  return problem;
}

}  // namespace dartboard
