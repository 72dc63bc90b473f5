#include "benchmarks/studies/step/step_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "benchmarks/paper/paper_bodies.h"
#include "benchmarks/studies/step/finer_mesh.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/meshes/mesh_io.h"
#include "core/meshes/touching.h"
#include "core/plain/error.h"
#include "core/scene/body/simulated_body.h"
#include "core/time/system/accelerations.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

struct Box {
  std::size_t about;
  int x, y, z;  // cubes of six tetrahedra
};
constexpr Box boxes[] = {{1'000, 5, 6, 6}, {10'000, 12, 12, 12}, {100'000, 26, 26, 25}, {1'000'000, 55, 55, 55}};
constexpr double spacing = 0.1;  // [m] the edge of a cube
const Material box_material{.density = 1000.0, .stiffness = 5.0, .damping = 0.005, .viscosity = 0.5};

/// Points and cells in an order drawn at random.
Mesh shuffled(const Mesh& mesh, std::uint64_t seed) {
  SplitMix64 random(seed);
  std::vector<std::uint32_t> number(mesh.points.size()), cells(mesh.cell_count());
  std::iota(number.begin(), number.end(), 0u);
  std::iota(cells.begin(), cells.end(), 0u);
  shuffle(number, random);
  shuffle(cells, random);
  Mesh other;
  other.points.resize(mesh.points.size());
  for (std::size_t p = 0; p < number.size(); ++p) other.points[number[p]] = mesh.points[p];
  std::vector<std::uint32_t> nodes;
  for (const std::uint32_t c : cells) {
    nodes.clear();
    for (const std::uint32_t p : mesh.cell(c)) nodes.push_back(number[p]);
    other.add_cell(mesh.kinds[c], nodes);
  }
  return other;
}

/// Cubes of a kilogramme each, the lowest layer of points held, damped, in a viscous medium; h omega is about 0.3.
Problem box_problem(const Box& box, bool in_shuffled_order, std::uint64_t seed) {
  Problem problem;
  problem.mesh = kuhn_box(box.x, box.y, box.z, spacing);
  if (in_shuffled_order) problem.mesh = shuffled(problem.mesh, seed);
  problem.material = box_material;
  problem.h = 1e-2;
  SplitMix64 random(seed);
  for (std::uint32_t i = 0; i < problem.mesh.points.size(); ++i) {
    if (problem.mesh.points[i].z() == 0.0) problem.fixed.push_back(i);
    problem.initial_velocity.push_back(0.01 * random.next_in_ball());
  }
  for (const std::uint32_t i : problem.fixed) problem.initial_velocity[i].setZero();
  return problem;
}

/// The mesh of a file, of so many tetrahedra at least, in the order of the file.
Mesh mesh_of_file(const std::filesystem::path& file, std::size_t least) {
  Mesh mesh = read_mesh(file);
  if (mesh.dimension() != 3) throw InputError(fmt::format("{}: is a surface, expected tetrahedra", file.string()));
  try {
    mesh = finer_mesh_of(std::move(mesh), least);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
  split_touching_points(mesh);  // now, as edges that touch have middles that do
  return mesh;
}

/// As heavy and as stiff as a box of as many cubes; slow enough for its worst cells.
Problem mesh_problem(const std::filesystem::path& file, std::size_t least, std::uint64_t seed) {
  Problem problem;
  problem.mesh = mesh_of_file(file, least);
  double volume = 0.0;
  for (std::size_t c = 0; c < problem.mesh.cell_count(); ++c) volume += signed_measure(problem.mesh, c);
  const double scale = spacing * std::cbrt(static_cast<double>(problem.mesh.cell_count()) / (6.0 * volume));
  for (Vector3d& point : problem.mesh.points) point *= scale;
  problem.material = box_material;
  SplitMix64 random(seed);
  for (std::size_t i = 0; i < problem.mesh.points.size(); ++i)
    problem.initial_velocity.push_back(0.01 * random.next_in_ball());
  const auto body = make_simulated_body(problem, false);
  problem.h = 0.3 / frequency_bound(body->system());
  return problem;
}

Problem paper_problem(bool damped) {
  Problem problem = paper_body("liver").make();
  if (!damped) problem.material.damping = 0.0;
  return problem;
}

}  // namespace

std::string paper_step_body(bool damped) { return damped ? "liver564, damped" : "liver564, undamped"; }

std::string step_box(std::size_t tetrahedra, bool in_shuffled_order) {
  return fmt::format("10^{:.0f} {}", std::log10(static_cast<double>(tetrahedra)),
                     in_shuffled_order ? "shuffled" : "in grid order");
}

std::vector<StepBody> make_step_bodies(std::size_t largest, std::uint64_t seed) {
  std::vector<StepBody> bodies;
  for (const bool damped : {true, false})
    bodies.push_back({paper_step_body(damped), 1856, [damped] { return paper_problem(damped); }});
  for (const Box& box : boxes)
    for (const bool in_shuffled_order : {false, true})
      if (box.about <= largest)
        bodies.push_back({step_box(box.about, in_shuffled_order), box.about,
                          [=] { return box_problem(box, in_shuffled_order, seed); }});
  return bodies;
}

std::vector<std::string> step_bodies(std::size_t largest) {
  std::vector<std::string> names;
  for (const StepBody& body : make_step_bodies(largest, 1)) names.push_back(body.name);
  return names;
}

std::vector<std::string> step_meshes(const std::vector<std::filesystem::path>& meshes) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : meshes) {
    names.push_back(file.stem().string());
    if (std::ranges::count(names, names.back()) > 1)
      throw InputError(fmt::format("two meshes are called '{}', expected different names", names.back()));
  }
  return names;
}

std::vector<StepBody> make_bodies_of_files(const std::vector<std::filesystem::path>& meshes, std::size_t least,
                                           std::uint64_t seed) {
  std::vector<StepBody> bodies;
  const std::vector<std::string> names = step_meshes(meshes);
  for (std::size_t k = 0; k < names.size(); ++k)
    bodies.push_back({names[k], least, [=, file = meshes[k]] { return mesh_problem(file, least, seed); }});
  return bodies;
}

StepBody find_step_body(const std::string& name, std::uint64_t seed) {
  for (StepBody& body : make_step_bodies(std::numeric_limits<std::size_t>::max(), seed))
    if (body.name == name) return std::move(body);
  throw InputError(fmt::format("no body is called '{}'", name));
}

}  // namespace dartboard
