#include "benchmarks/studies/step/kept_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "benchmarks/studies/step/scene_columns.h"
#include "core/base/archive.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

SpringEnds ascending(SpringEnds ends) {
  if (ends[0] > ends[1]) std::swap(ends[0], ends[1]);
  return ends;
}

/// For each point a bound of the difference between two sums of its forces [N]. Lengths, directions and speeds are the
/// same bits in both, since these are of the same points. Sums differ in order, by parallel springs that are one
/// spring, and by masses that are sums over cells: with n springs at a vertex there are at most 2 n - 4 cells around
/// it, and each of some 3 n + 16 operations rounds by 2^-53 of the sum of sizes, in either body.
std::vector<double> rounding_of_forces(const KeptColumns& columns, const PointState& state) {
  const std::size_t size = columns.at.size();
  std::vector<double> sizes(size, 0.0), count(size, 0.0), bound(size);
  for (std::size_t k = 0; k < columns.ends.size(); ++k) {
    const auto [a, b] = columns.ends[k];
    const Spring spring = columns.springs[k];
    const std::uint32_t p = columns.at.point[a], q = columns.at.point[b];
    const double of_spring = spring.stiffness * std::abs((state.x[q] - state.x[p]).norm() - spring.rest_length) +
                             spring.damping * (state.v[q] - state.v[p]).norm();
    for (const std::uint32_t end : {p, q}) {
      sizes[end] += of_spring;
      ++count[end];
    }
  }
  for (std::size_t k = 0; k < size; ++k) {
    const std::uint32_t p = columns.at.point[k];
    if (!columns.at.viscosity.empty()) sizes[p] += columns.at.viscosity[k] * state.v[p].norm();
    bound[p] = 2.0 * 0x1p-53 * (3.0 * count[p] + 16.0) * sizes[p];
  }
  return bound;
}

}  // namespace

void write_columns(const std::filesystem::path& file, KeptColumns& columns) {
  Archive archive;
  archive(columns);
  std::ofstream out(file, std::ios::binary);
  out.write(archive.written().data(), static_cast<std::streamsize>(archive.written().size()));
  if (!out.flush()) throw IoError(fmt::format("{}: cannot be written", file.string()));
}

KeptColumns read_columns(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::error_code unknown;
  std::string bytes(in ? std::filesystem::file_size(file, unknown) : 0, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in) throw IoError(fmt::format("{}: cannot be read", file.string()));
  KeptColumns columns;
  Archive archive(bytes, file.string());
  archive(columns);
  archive.require_end();
  return columns;
}

Problem present_problem(Mesh mesh, const VertexColumns& vertices, const Problem& start) {
  Problem present = start;
  present.mesh = std::move(mesh);
  present.initial_velocity = vertices.velocity;
  present.fixed.clear();
  for (std::uint32_t k = 0; k < vertices.fixed.size(); ++k)
    if (vertices.fixed[k] != 0) present.fixed.push_back(k);
  return present;
}

KeptColumns kept_columns(const VertexColumns& vertices, const SpringSystem& system, double h) {
  KeptColumns kept{.at = vertices,
                   .springs = {},
                   .ends = {system.ends.begin(), system.ends.end()},
                   .gravity = system.gravity,
                   .h = h};
  for (std::uint32_t k = 0; k < kept.at.size(); ++k) kept.at.point[k] = k;
  for (const Spring& spring : system.springs) kept.springs.push_back(spring);
  return kept;
}

FreshBody::FreshBody(const Problem& present, const KeptColumns& changed)
    : scene(make_simulated_body(present, false)), columns(kept_columns(scene->vertices(), scene->system(), changed.h)) {
  KeptColumns& fresh = columns;
  fresh.at.point = scene->vertices().point;
  std::vector<std::uint32_t> number(fresh.at.size());
  for (std::uint32_t k = 0; k < fresh.at.size(); ++k) number[fresh.at.point[k]] = k;
  // the springs of the changed body by their ends, in the numbers of the fresh one
  std::vector<std::pair<SpringEnds, std::uint32_t>> by_ends;
  for (std::uint32_t k = 0; k < changed.ends.size(); ++k) {
    const auto [a, b] = changed.ends[k];
    by_ends.push_back({ascending({number[a], number[b]}), k});
  }
  std::ranges::sort(by_ends);

  const std::vector<SpringEnds> places = std::move(fresh.ends);
  fresh.ends.clear();
  fresh.springs = {};
  std::vector<bool> taken(changed.ends.size(), false);
  for (const SpringEnds& ends : places) {
    const SpringEnds sorted = ascending(ends);
    auto parallel = std::ranges::lower_bound(by_ends, std::pair{sorted, 0u});
    if (parallel == by_ends.end() || parallel->first != sorted)
      throw SolverError("a fresh body has a spring between vertices that the changed one has not");
    for (; parallel != by_ends.end() && parallel->first == sorted; ++parallel) {
      const std::uint32_t k = parallel->second;
      if (taken[k]) continue;
      taken[k] = true;
      fresh.ends.push_back(ends);
      fresh.springs.push_back(changed.springs[k]);
    }
  }
  if (fresh.ends.size() != changed.ends.size())
    throw SolverError(
        fmt::format("a fresh body has {} springs, the changed one {}", fresh.ends.size(), changed.ends.size()));
}

std::size_t count_differing(const KeptColumns& changed, std::span<ContenderBody* const> others) {
  const MannerBefore before;
  SceneColumns columns(std::make_shared<KeptColumns>(changed), changed.h, Manner{"changed"});
  columns.choose();
  columns.step(steps_to_start);  // in motion, and with the damping at work
  const PointState start = columns.state();
  const auto forces = columns.forces();
  const std::vector<double> bound = rounding_of_forces(changed, start);
  return static_cast<std::size_t>(std::ranges::count_if(others, [&](ContenderBody* other) {
    other->set_state(start);
    const auto of_other = other->forces();
    if (of_other.size() != forces.size()) return true;
    for (std::size_t p = 0; p < forces.size(); ++p)
      for (int axis = 0; axis < 3; ++axis)  // not the largest: Eigen's loses a NaN
        if (!(std::abs(of_other[p][axis] - forces[p][axis]) <= bound[p])) return true;
    return false;
  }));
}

}  // namespace dartboard
