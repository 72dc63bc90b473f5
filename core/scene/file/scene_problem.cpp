#include "core/scene/file/scene_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "core/scene/file/load_mesh.h"
#include "core/scene/file/scene_materials.h"
#include "core/scene/file/springs_beside_edges.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;

// Errors of a mesh name the key that asked for it.
Mesh generate(const BoxMesh& box) {
  const auto [nx, ny, nz] = box.cells;
  if (box.kind == "hexahedra") return hexahedron_box(nx, ny, nz, box.spacing);
  if (box.kind == "mixed") return mixed_box(nx, ny, nz, box.spacing);
  if (box.pattern == "kuhn") return kuhn_box(nx, ny, nz, box.spacing, box.jitter, box.seed);
  return mirrored_box(nx, ny, nz, box.spacing, box.jitter, box.seed);
}
Mesh generate(const SheetMesh& sheet) {
  const auto [nx, ny] = sheet.cells;
  return sheet.kind == "triangles" ? triangle_sheet(nx, ny, sheet.spacing) : quad_sheet(nx, ny, sheet.spacing);
}
Mesh generate(const BallMesh& ball) { return tetrahedron_ball(ball.layers, ball.radius); }
Mesh generate(const ChainMesh& chain) {
  Mesh mesh;
  for (int k = 0; k <= chain.links; ++k) mesh.points.emplace_back(k * chain.spacing, 0, 0);
  for (std::uint32_t k = 0; k + 1 < mesh.points.size(); ++k) mesh.links.push_back({k, k + 1});
  return mesh;
}
/// Refuses a speed above that of light.
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
    for (const std::uint32_t p : select_points(release->vertices, points, event.action_path()))
      if (std::ranges::find(driven, p) != driven.end())
        throw InputError(fmt::format("{}: selects point {}, which /driven moves; expected fixed ones alone",
                                     event.action_path(), number_in_file(scene, p)));
  }
}

/// Refuses the touch of a body without an inside.
void require_solids_that_touch(const SceneFile& scene, const Problem& problem) {
  const auto is_solid = [&problem](std::uint32_t body) {
    const std::size_t first = problem.bodies.cell[body];
    return first < problem.bodies.cell[body + 1] && dimension(problem.mesh.kinds[first]) == 3;
  };
  for (const SceneTouch& touch : scene.touches)
    for (const std::uint32_t body : {touch.first, touch.second})
      if (!is_solid(body))
        throw InputError(fmt::format(
            "{}: {}: cannot be used with surfaces and chains, which have no inside, like {}; expected solids, only "
            "obstacles, or 'pairs' that do not touch",
            scene.file, touch.path, scene.bodies()[body].path));
}

/// Several bodies as one mesh.
struct Assembled {
  Mesh mesh;
  BodyRanges bodies;
};
Assembled assembled(const std::string& scene, std::span<const BodySource> bodies) {
  Assembled all;
  for (const BodySource& body : bodies) {
    append(all.mesh, make_mesh(scene, body));
    all.bodies.end_body_at(all.mesh.points.size(), all.mesh.cell_count(), all.mesh.links.size());
  }
  return all;
}

}  // namespace

Mesh make_mesh(const std::string& scene, const BodySource& body) {
  Mesh mesh;
  const bool from_file = std::holds_alternative<fs::path>(body.mesh);
  const std::string key = fmt::format("{}: {}/{}", scene, body.path, from_file ? "mesh" : "generate");
  try {
    mesh = std::visit(
        [&]<class Source>(const Source& source) {
          if constexpr (requires { generate(source); })
            return generate(source);
          else if constexpr (std::is_same_v<Source, BodyList>)
            return assembled(scene, source.all).mesh;
          else
            return body.loaded ? body.loaded->mesh : read_body_mesh(body).mesh;
        },
        body.mesh);
  } catch (const IoError& problem) {
    throw IoError(fmt::format("{}: {}", key, problem.what()));
  } catch (const InputError& problem) {
    if (std::holds_alternative<BodyList>(body.mesh)) throw;  // it names one of the bodies
    throw InputError(fmt::format("{}: {}", key, problem.what()));
  } catch (const std::bad_alloc&) {
    throw InputError(fmt::format("{}: there is not enough memory for so many cells; expected fewer", key));
  }
  // where nothing turns, not even a sum of zeros is added
  const bool turned = body.rotate != Eigen::Matrix3d::Identity();
  for (Eigen::Vector3d& x : mesh.points) {
    x *= body.scale;
    if (turned) x = body.rotate * x;
    x += body.translate;
  }
  return mesh;
}

Mesh make_mesh(const SceneFile& scene) { return make_mesh(scene.file, scene.body); }

Problem make_problem(const SceneFile& scene) {
  Problem problem;
  if (const auto* list = std::get_if<BodyList>(&scene.body.mesh)) {
    Assembled all = assembled(scene.file, list->all);
    problem.mesh = std::move(all.mesh);
    problem.bodies = std::move(all.bodies);
  } else {
    problem.mesh = make_mesh(scene);
    problem.bodies.end_body_at(problem.mesh.points.size(), problem.mesh.cell_count(), problem.mesh.links.size());
  }
  require_solids_that_touch(scene, problem);
  assign_materials(scene, problem);
  require_springs_beside_edges(scene, problem);
  problem.surroundings.gravity = scene.gravity;
  problem.h = scene.step;
  try {
    const std::vector<HeldAxes> held = held_axes_of(scene.fixed, problem.mesh.points);
    for (std::uint32_t p = 0; p < held.size(); ++p) {
      if (held[p] == all_axes)
        problem.fixed.push_back(p);
      else if (held[p] != 0)
        problem.held_axes.push_back({p, held[p]});
    }
    for (const SceneDrive& drive : scene.driven) {
      const auto driven = select_points(drive.vertices, problem.mesh.points, drive.path);
      for (const std::uint32_t p : driven)
        require_slower_than_light(drive.path_of_motion(),
                                  drive.largest_speed_of(problem.mesh.points[p]) * Eigen::Vector3d::UnitX());
      require_not_released(scene, driven, problem.mesh.points);
      problem.fixed.insert(problem.fixed.end(), driven.begin(), driven.end());
    }
    std::sort(problem.fixed.begin(), problem.fixed.end());
    problem.fixed.erase(std::unique(problem.fixed.begin(), problem.fixed.end()), problem.fixed.end());
    const auto bodies = scene.bodies();
    for (std::size_t p = 0, b = 0; p < problem.mesh.points.size(); ++p) {
      while (problem.bodies.point[b + 1] <= p) ++b;
      const InitialVelocity& velocity = bodies[b].velocity ? *bodies[b].velocity : scene.initial_velocity;
      problem.initial_velocity.push_back(velocity.at(problem.mesh.points[p]));
      require_slower_than_light((bodies[b].velocity ? bodies[b].path : "") + "/initial_velocity",
                                problem.initial_velocity.back());
    }
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", scene.file, error.what()));
  }
  return problem;
}

std::vector<std::uint32_t> body_of_cells(const BodyRanges& bodies) {
  std::vector<std::uint32_t> body;
  for (const auto* first : {&bodies.cell, &bodies.link}) {
    const std::size_t before = body.size();
    for (std::uint32_t b = 0; b < bodies.count(); ++b) body.resize(before + (*first)[b + 1], b);
  }
  return body;
}

}  // namespace dartboard
