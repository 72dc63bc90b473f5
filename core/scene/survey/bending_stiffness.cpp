#include "core/scene/survey/bending_stiffness.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <variant>

#include "core/scene/file/scene_materials.h"

namespace dartboard {
namespace {

constexpr double worth_a_warning = 1.25;       // times too stiff
constexpr double slender = 3.0;                // length over thickness from which on a body bends; a block does not
constexpr double nearly_incompressible = 0.4;  // above this ratio any change of shape is too stiff

CellPattern pattern_of(CellKind kind, bool mirrored) {
  switch (kind) {
    case CellKind::pyramid: return CellPattern::pyramids;
    case CellKind::prism: return CellPattern::prisms;
    case CellKind::hexahedron: return CellPattern::hexahedra;
    default: return mirrored ? CellPattern::mirrored_tetrahedra : CellPattern::tetrahedra;
  }
}

/// The sizes of a body and of its cells.
struct Size {
  double extent;  // [m] the smallest of a block with the cells' principal moments
  double length;  // [m] the largest
  double cube;    // [m] the edge of the cube that a cell is cut from, in the mean
};
Size size_of(const Mesh& mesh, std::size_t first, std::size_t end) {
  double volume = 0.0, cubes = 0.0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t c = first; c < end; ++c) {
    const CellKind kind = mesh.kinds[c];
    const double v = std::abs(signed_measure(mesh, c));
    volume += v;
    cubes += kind == CellKind::hexahedron ? 1.0 : kind == CellKind::prism ? 1.0 / 2.0 : 1.0 / 6.0;
    mean += v * centroid(mesh, c);
  }
  mean /= volume;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (std::size_t c = first; c < end; ++c) {
    const Eigen::Vector3d centre = centroid(mesh, c);
    Eigen::Matrix3d corners = Eigen::Matrix3d::Zero();
    for (const std::uint32_t p : mesh.cell(c))
      corners += (mesh.points[p] - centre) * (mesh.points[p] - centre).transpose();
    // the moments of a solid over those of its corners: exact for tetrahedra and parallelepipeds
    corners /= static_cast<double>(mesh.cell(c).size()) * (mesh.kinds[c] == CellKind::tetrahedron ? 5.0 : 3.0);
    moments += std::abs(signed_measure(mesh, c)) * ((centre - mean) * (centre - mean).transpose() + corners);
  }
  const Eigen::Vector3d principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments / volume).eigenvalues();
  const auto extent = [](double moment) { return std::sqrt(12.0 * std::max(0.0, moment)); };
  return {extent(principal[0]), extent(principal[2]), std::cbrt(volume / cubes)};
}

}  // namespace

std::string_view name(CellPattern pattern) {
  constexpr std::array<std::string_view, 5> names{"tetrahedra", "mirrored tetrahedra", "pyramids", "prisms",
                                                  "hexahedra"};
  return names[static_cast<std::size_t>(pattern)];
}

double bending_stiffness(CellPattern pattern, double poisson, double across) {
  // linear elements follow bending by shear, and by a change of volume that each resists with lambda
  struct Fit {
    double shear, volume, power, thin;
  };
  constexpr std::array<Fit, 5> fits{{{1.6, 0.45, 0.7, 1.0},
                                     {2.8, 0.02, 0.1, 0.0},
                                     {0.6, 0.09, 0.83, 0.0},
                                     {0.1, 0.25, 0.34, 0.0},
                                     {0.2, 0.05, 0.5, 8.0}}};
  const Fit& fit = fits[static_cast<std::size_t>(pattern)];
  const double lambda_over_mu = 2.0 * poisson / (1.0 - 2.0 * poisson);
  const double in_each = 1.0 / across + fit.thin / (across * across);
  return 1.0 + fit.shear / (across * across) + fit.volume * in_each * std::pow(lambda_over_mu, fit.power);
}

std::string to_string(const StiffBody& body) {
  const auto expected = [&](CellPattern pattern, double across) {
    return bending_stiffness(pattern, body.poisson, across);
  };
  std::string text = fmt::format(
      "{}: linear {} at Poisson's ratio {:.6g}, some {:.2g} across the thinnest part, are expected to be {:.2g} times "
      "too stiff in bending (deflections {:.2g} of the right ones",
      body.path, name(body.pattern), body.poisson, body.across, body.stiffness, 1.0 / body.stiffness);
  text += fmt::format("); {:.2g} times with twice as many across", expected(body.pattern, 2.0 * body.across));
  for (const CellPattern better : {CellPattern::mirrored_tetrahedra, CellPattern::hexahedra})
    if (expected(better, body.across) < 0.8 * body.stiffness)
      text += fmt::format(", {:.2g} with {}", expected(better, body.across), name(better));
  return text;
}

std::vector<StiffBody> find_stiff_bodies(const SceneFile& scene, const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  const CellMaterials materials = problem.cell_materials();
  std::vector<StiffBody> found;
  if (mesh.highest_dimension() != 3 || !materials.has_elements()) return found;
  const auto bodies = scene.bodies();
  const std::vector<std::size_t>& first = problem.bodies.cell;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const std::size_t end = first[b + 1];
    if (first[b] == end || dimension(mesh.kinds[first[b]]) != 3) continue;
    const auto* box = std::get_if<BoxMesh>(&bodies[b].mesh);
    const bool mirrored = box != nullptr && box->pattern == "mirrored" && box->jitter == 0.0;
    const Size size = size_of(mesh, first[b], end);
    const double across = std::max(1.0, size.extent / size.cube);
    StiffBody worst{bodies[b].path, CellPattern::hexahedra, 0.0, across, 0.0};
    double volume = 0.0, stiffness = 0.0;
    for (std::size_t c = first[b]; c < end; ++c) {
      const Material& material = materials[c];
      if (material.model == Model::springs) continue;
      const double v = std::abs(signed_measure(mesh, c));
      const CellPattern pattern = pattern_of(mesh.kinds[c], mirrored);
      const double one = bending_stiffness(pattern, std::max(0.0, material.poisson), across);
      volume += v;
      stiffness += v * one;
      if (one > worst.stiffness) worst = {bodies[b].path, pattern, material.poisson, across, one};
    }
    if (!(volume > 0.0)) continue;
    worst.stiffness = stiffness / volume;
    const bool bends = size.length >= slender * size.extent;
    if (worst.stiffness >= worth_a_warning && (bends || worst.poisson > nearly_incompressible)) found.push_back(worst);
  }
  return found;
}

}  // namespace dartboard
