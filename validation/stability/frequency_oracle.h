#pragma once
// The highest frequency of a spring system by a slow way that is certain: a matrix, Lanczos, and a proof.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "validation/scenes/extreme_bodies.h"

namespace dartboard {

/// M^-1/2 K M^-1/2 at the state of the body, entry by entry from the springs' exact tangents; rows and columns of fixed
/// vertices are zero.
Eigen::SparseMatrix<double> scaled_stiffness(const SpringColumns& body);

/// The largest eigenvalue of a symmetric matrix.
struct LargestEigenvalue {
  double value = 0.0;
  double residual = 0.0;   // |A v - value v| for the unit vector: an eigenvalue lies within it
  bool proven = false;     // value + residual times the identity, minus A, has a Cholesky factor: no other is larger
  Eigen::VectorXd vector;  // of unit length
  int steps = 0;           // of Lanczos
};

/// Lanczos' iteration with full reorthogonalisation until the residual is below `tolerance` times the value.
///
/// cost    steps^2 n operations and a sparse factorisation
/// returns proven = false where 800 steps, or rounding, do not reach it
LargestEigenvalue largest_eigenvalue(const Eigen::SparseMatrix<double>& a, double tolerance = 1e-9);

/// The fastest oscillation of a body.
struct FastestMode {
  double omega = 0.0;  // [1/s]
  double error = 0.0;  // [1/s] at most, where proven
  bool proven = false;
  std::vector<Eigen::Vector3d> shape;  // displacements by vertex, the largest coordinate 1
};
FastestMode fastest_mode(const SpringColumns& body);

}  // namespace dartboard
