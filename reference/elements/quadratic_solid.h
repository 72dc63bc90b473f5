#pragma once
// A linearly elastic solid of quadratic tetrahedra, with which linear elements and springs are compared.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/plain/mesh.h"
#include "reference/elements/held_solid.h"

namespace dartboard::reference {

/// Young's modulus [Pa], Poisson's ratio and density [kg/m^3].
struct ElasticSolid {
  double young, poisson, density;
};

/// The tetrahedra of a mesh with a node in the middle of each edge. Displacements are quadratic in each, so that
/// bending is exact where the sides are straight; every integral is exact.
///
/// Unknowns are the three displacements [m] of each node in turn: the points of the mesh first, then the edges.
class QuadraticSolid {
 public:
  /// throws  InputError for a cell that is no tetrahedron, or has no volume
  QuadraticSolid(const Mesh& mesh, const ElasticSolid& material);

  std::span<const Eigen::Vector3d> nodes() const { return nodes_; }
  const Eigen::SparseMatrix<double>& stiffness() const { return stiffness_; }  // [N/m]
  const Eigen::SparseMatrix<double>& mass() const { return mass_; }            // [kg], consistent

  /// Forces [N] of a traction, an affine function of the place [Pa], on the faces of the boundary for all of whose
  /// corners `on` is true.
  template <class On, class Traction>
  Eigen::VectorXd load(On&& on, Traction&& traction) const {
    Eigen::VectorXd force = Eigen::VectorXd::Zero(stiffness_.rows());
    for (const Face& face : boundary_) {
      const auto corner = [&](std::size_t k) -> const Eigen::Vector3d& { return nodes_[face[k]]; };
      if (!on(corner(0)) || !on(corner(1)) || !on(corner(2))) continue;
      add_face(face, {traction(corner(0)), traction(corner(1)), traction(corner(2))}, force);
    }
    return force;
  }

  /// The solid with some nodes held.
  HeldSolid held_at(std::vector<std::uint32_t> nodes) const { return {stiffness_, mass_, std::move(nodes)}; }

  /// The nodes for which `on` is true.
  template <class On>
  std::vector<std::uint32_t> nodes_where(On&& on) const {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i)
      if (on(nodes_[i])) found.push_back(i);
    return found;
  }

 private:
  using Face = std::array<std::uint32_t, 6>;  // corners, then the middles of 01, 12, 20
  void add_face(const Face& face, const std::array<Eigen::Vector3d, 3>& traction, Eigen::VectorXd& force) const;

  std::vector<Eigen::Vector3d> nodes_;
  std::vector<Face> boundary_;
  Eigen::SparseMatrix<double> stiffness_, mass_;
};

}  // namespace dartboard::reference
