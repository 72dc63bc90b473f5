#pragma once
// Results of another code for single elements: reference/elements/values.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "benchmarks/checkout/source_folder.h"
#include "core/plain/material.h"
#include "core/plain/mesh.h"

namespace dartboard {

inline nlohmann::json reference_values() {
  std::ifstream file(source_folder() / "reference/elements/values/reference_values.json");
  return nlohmann::json::parse(file);
}

/// One cell with the nodes of that code, in its order, and its results.
struct ElementValues {
  Material material;
  Mesh mesh;  // one cell; its points are the nodes, or the corners where there are more
  std::vector<Eigen::Vector3d> nodes;
  Eigen::MatrixXd stiffness, mass;  // three unknowns to a node
};

inline ElementValues element_values(const std::string& name, CellKind kind) {
  const nlohmann::json all = reference_values(), one = all.at("elements").at(name);
  ElementValues values;
  values.material = {.density = all.at("density"),
                     .stiffness = 0.0,
                     .damping = 0.0,
                     .viscosity = 0.0,
                     .young = all.at("young"),
                     .poisson = one.at("poisson")};
  for (const auto& node : one.at("nodes")) values.nodes.emplace_back(node.at(0), node.at(1), node.at(2));
  const auto corners = static_cast<std::size_t>(node_count(kind));
  values.mesh.points.assign(values.nodes.begin(), values.nodes.begin() + static_cast<std::ptrdiff_t>(corners));
  std::vector<std::uint32_t> cell;
  for (std::uint32_t k = 0; k < corners; ++k) {
    if (kind != CellKind::hexahedron) {
      cell.push_back(k);
      continue;
    }
    // the node that was moved away from the k-th corner of the unit cube
    const Eigen::Vector3d corner(k % 4 == 1 || k % 4 == 2, k % 4 >= 2, k >= 4);
    for (std::uint32_t i = 0; i < corners; ++i)
      if ((values.nodes[i] - corner).cwiseAbs().maxCoeff() < 0.5) cell.push_back(i);
  }
  values.mesh.add_cell(kind, cell);
  const auto matrix = [](const nlohmann::json& rows) {
    Eigen::MatrixXd m(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows.size()));
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (std::size_t c = 0; c < rows.size(); ++c)
        m(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = rows.at(r).at(c);
    return m;
  };
  values.stiffness = matrix(one.at("stiffness"));
  values.mass = matrix(one.at("mass"));
  return values;
}

/// Both were summed from some hundred products, each rounded.
inline void expect_same_matrix(const Eigen::MatrixXd& ours, const Eigen::MatrixXd& theirs, std::string_view what) {
  ASSERT_EQ(ours.rows(), theirs.rows()) << what;
  EXPECT_GT(theirs.cwiseAbs().maxCoeff(), 0.0) << what;
  EXPECT_LE((ours - theirs).cwiseAbs().maxCoeff(), 1e-12 * theirs.cwiseAbs().maxCoeff()) << what;
}

}  // namespace dartboard
