// Motion does not depend on how points and cells are numbered.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <numeric>

#include "core/meshes/generators/mesh_generators.h"
#include "core/meshes/mesh_io.h"
#include "core/plain/random.h"
#include "tests/support/moving_box.h"

namespace dartboard::numbering_test {
namespace {

namespace fs = std::filesystem;
using namespace moving;

std::vector<std::uint32_t> shuffled(std::size_t size, std::uint64_t seed) {
  std::vector<std::uint32_t> order(size);
  std::iota(order.begin(), order.end(), 0u);
  SplitMix64 random(seed);
  for (std::size_t k = size; k > 1; --k) std::swap(order[k - 1], order[random.below(k)]);
  return order;
}

TEST(Numbering, DoesNotMatterToTheMotionButForRounding) {
  const Mesh mesh = kuhn_box(3, 3, 3, 0.1, 0.2, 5);
  const auto point_of = shuffled(mesh.points.size(), 1), cell_of = shuffled(mesh.cell_count(), 2);  // by new number
  std::vector<std::uint32_t> number(point_of.size());
  Mesh permuted;
  for (std::uint32_t k = 0; k < point_of.size(); ++k) {
    permuted.points.push_back(mesh.points[point_of[k]]);
    number[point_of[k]] = k;
  }
  for (const std::uint32_t c : cell_of) {
    std::vector<std::uint32_t> nodes;
    for (const std::uint32_t p : mesh.cell(c)) nodes.push_back(number[p]);
    permuted.add_cell(mesh.kinds[c], nodes);
  }
  const fs::path folder = fs::temp_directory_path() / ("simulation_test-" + std::to_string(getpid()));
  fs::create_directories(folder);
  write_medit(folder / "mesh.mesh", mesh);
  write_medit(folder / "permuted.mesh", permuted);

  Json json = moving_box();
  json["events"] = Json::parse(R"([{"at": 0.002, "remove": {"sphere": {"centre": [0.1, 0.1, 0.1], "radius": 0.06}}},
      {"at": 0.004, "dissociate": {"plane": {"point": [0.16, 0, 0], "normal": [1, 0.1, 0]}}}])");
  const auto simulate = [&](const char* name) {
    json["body"] = {{"mesh", name}};
    auto simulation = std::make_unique<Simulation>(parse_scene(json.dump(), name, folder));
    run(*simulation);
    return simulation;
  };
  const auto one = simulate("mesh.mesh"), other = simulate("permuted.mesh");
  fs::remove_all(folder);
  ASSERT_EQ(one->body().counts(), other->body().counts());
  ASSERT_GT(one->operations(), 10u);

  // The bound. Both runs compute the same Runge-Kutta steps of y' = f(y), y = (x, v), with other roundings. A spring
  // gets its force within 20 u k l of the exact one (l < 2 L: its strain is below 1), d < 40 of them are summed in any
  // order within 40 u of the sum of their sizes, |f| <= k l, and masses, sums of 1 ..< 40 shares, are within 40 u. So
  // accelerations differ by at most D = 2 * 100 u * max_i sum_j k_ij l_ij / m_i, and updates of the four stages round
  // by at most 20 u X, 20 u V. The Lipschitz constant of f in the norm max(|x| omega, |v|) is below L = omega + c,
  // omega^2 = 2 max_i sum_j 2 k_ij / m_i (force directions turn at most as fast as springs stretch), c the same of the
  // damping and viscosity; a step grows a difference by at most e^(h L) (its stages are the first terms of the series).
  const VertexColumns& v = one->body().vertices();
  const SpringSystem system = one->body().system();
  std::vector<double> force(v.size(), 0.0), stiffness(v.size(), 0.0), damping(v.size(), 0.0);
  double X = 0.0, V = 0.0, D = 0.0, omega2 = 0.0, c = 0.0;
  for (std::size_t e = 0; e < system.springs.size(); ++e)
    for (const std::uint32_t k : system.ends[e]) {
      force[k] += system.springs[e].stiffness * 2 * system.springs[e].rest_length;
      stiffness[k] += system.springs[e].stiffness;
      damping[k] += system.springs[e].damping;
    }
  constexpr double u = 0x1p-53;
  for (std::size_t k = 0; k < v.size(); ++k) {
    X = std::max(X, v.position[k].norm());
    V = std::max(V, v.velocity[k].norm());
    D = std::max(D, 200 * u * force[k] / v.mass[k]);
    omega2 = std::max(omega2, 4 * stiffness[k] / v.mass[k]);
    c = std::max(c, 4 * damping[k] / v.mass[k] + 0.5);
  }
  const double omega = std::sqrt(omega2), h = 0.001, steps = 10;
  const double per_step = h * D + 20 * u * (2 * V + 2 * X * omega);
  const double bound = steps * std::exp(steps * h * (omega + c)) * per_step;  // of max(|x| omega, |v|)
  ASSERT_LT(bound, 1e-6);  // it must be able to fail: motions differ by some 0.1 m/s within the body

  // parts of a vertex are distinguished by their positions
  double largest = 0.0;
  const VertexColumns& w = other->body().vertices();
  std::multimap<std::uint32_t, std::size_t> by_point;
  for (std::size_t k = 0; k < w.size(); ++k) by_point.emplace(point_of[w.point[k]], k);
  for (std::size_t k = 0; k < v.size(); ++k) {
    double least = std::numeric_limits<double>::infinity();
    const auto [begin, end] = by_point.equal_range(v.point[k]);
    for (auto at = begin; at != end; ++at)
      least = std::min(least, std::max(omega * (v.position[k] - w.position[at->second]).norm(),
                                       (v.velocity[k] - w.velocity[at->second]).norm()));
    largest = std::max(largest, least);
  }
  EXPECT_LE(largest, bound);
}

}  // namespace
}  // namespace dartboard::numbering_test
