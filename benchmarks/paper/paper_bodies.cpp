#include "benchmarks/paper/paper_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "benchmarks/checkout/source_folder.h"
#include "core/meshes/mesh_io.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

const std::filesystem::path meshes = source_folder() / "benchmarks" / "meshes";

// The stiffness makes the body sag by about a millimetre and h omega_max about 0.3, well inside the 2.83 of RK4.
Problem liver() {
  Problem problem;
  problem.mesh = read_mesh(meshes / "liver564.mesh");
  problem.material = {.density = 1000.0, .stiffness = 5.0, .damping = 0.005, .viscosity = 0.5};
  problem.h = 1e-3;
  double low = problem.mesh.points[0].z(), high = low;
  for (const auto& p : problem.mesh.points) {
    low = std::min(low, p.z());
    high = std::max(high, p.z());
  }
  for (std::uint32_t i = 0; i < problem.mesh.points.size(); ++i)
    if (problem.mesh.points[i].z() > high - 0.1 * (high - low)) problem.fixed.push_back(i);
  return problem;
}

}  // namespace

std::span<const PaperBody> paper_bodies() {
  static const std::array<PaperBody, 1> table{{
      {"liver",
       "a body of the paper's size under gravity, the top tenth of its height held, damped, in a viscous medium",
       meshes / "liver564.mesh", liver},
  }};
  return table;
}

const PaperBody& paper_body(std::string_view name) {
  const auto all = paper_bodies();
  const auto found = std::find_if(all.begin(), all.end(), [&](const PaperBody& s) { return s.name == name; });
  if (found != all.end()) return *found;
  std::string known;
  for (const PaperBody& s : all) known += (known.empty() ? "" : ", ") + s.name;
  throw InputError(fmt::format("no body is called '{}'; there are {}", name, known));
}

}  // namespace dartboard
