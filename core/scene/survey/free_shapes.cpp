#include "core/scene/survey/free_shapes.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <array>
#include <set>
#include <vector>

namespace dartboard {
namespace {

// A cell of each kind in general position, in the node order of faces_of: its result holds for almost all cells.
std::vector<Eigen::Vector3d> sample(CellKind kind) {
  std::vector<Eigen::Vector3d> nodes;
  for (const auto& [x, y, z] : std::array<std::array<double, 3>, 8>{{{0, 0, 0},
                                                                     {1.1, 0.1, 0.05},
                                                                     {1.2, 1.05, -0.1},
                                                                     {0.1, 0.9, 0.15},
                                                                     {0.05, -0.1, 1},
                                                                     {0.95, 0.15, 1.1},
                                                                     {1.15, 1.2, 0.9},
                                                                     {-0.1, 1.1, 1.05}}})
    nodes.emplace_back(x, y, z);
  nodes.resize(static_cast<std::size_t>(node_count(kind)));
  return nodes;
}

}  // namespace

std::size_t free_shapes(CellKind kind, Diagonals diagonals) {
  const auto x = sample(kind);
  std::vector<CornerSpring> springs;
  for (const CornerSpring& edge : edges_beside(kind, diagonals)) springs.push_back(edge);
  for (const CornerSpring& diagonal : diagonals_of(kind, diagonals)) springs.push_back(diagonal);
  const auto columns = static_cast<Eigen::Index>(3 * x.size());
  Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(springs.size()), columns);
  Eigen::Index row = 0;
  for (const auto& [a, b, weight] : springs) {
    const Eigen::Vector3d along = x[static_cast<std::size_t>(b)] - x[static_cast<std::size_t>(a)];
    directions.block<1, 3>(row, 3 * a) = -along.transpose();
    directions.block<1, 3>(row, 3 * b) = along.transpose();
    ++row;
  }
  return static_cast<std::size_t>(columns - Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(directions).rank() - 6);
}

std::string free_shapes_of(const std::map<CellKind, std::size_t>& counts, Diagonals diagonals) {
  std::string cells;
  for (const auto& [kind, count] : counts) {
    if (count == 0 || node_count(kind) < 5) continue;
    const std::size_t ways = free_shapes(kind, diagonals);
    if (ways == 0) continue;
    cells += fmt::format("{}{} of kind {} in {} ways", cells.empty() ? "" : ", ", count, name(kind), ways);
  }
  if (cells.empty()) return "";
  return fmt::format(
      "{} alone carry springs, so some cells can change their shape without a force ({}): the body may shear "
      "and fall like a chain; where that matters take elements (/material/young and /material/poisson), /diagonals "
      "\"faces\", or tetrahedra (/body/generate/box/kind, or another mesh)",
      diagonals == Diagonals::none ? "edges of cells" : "edges of cells and diagonals through their volumes", cells);
}

}  // namespace dartboard
