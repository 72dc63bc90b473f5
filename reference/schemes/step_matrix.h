#pragma once
// The matrix of an implicit step, M + tau C + tau^2 K, dense and in extended precision.

#include <Eigen/Core>
#include <vector>

#include "reference/schemes/network_state.h"

namespace dartboard::reference {

using DenseMatrix = Eigen::Matrix<Extended, Eigen::Dynamic, Eigen::Dynamic>;
using DenseColumn = Eigen::Matrix<Extended, Eigen::Dynamic, 1>;

/// A compressed spring pushes its ends aside, and may cost the matrix its positive definiteness; `projected` leaves
/// that part out.
enum class Tangent : std::uint8_t { exact, projected };

/// The growth of the pull between two ends as they move apart: along the spring, and across it in proportion to its
/// stretch. For a spring without length, which has no direction, k in all directions.
Eigen::Matrix<Extended, 3, 3> stiffness_of(const Spring& spring, const Vector3<Extended>& line, Tangent tangent);

/// The derivative of the stress of a point of an element by F, with the places at x.
StressSlope slope_of(const ElasticPoint& point, const Extended* x, Tangent tangent);

/// Rows and columns of held points are those of the identity.
DenseMatrix step_matrix(const SpringNetwork& network, const std::vector<Vector3<Extended>>& x, Extended tau,
                        Tangent tangent);

bool is_positive_definite(const DenseMatrix& a);

/// The three numbers of each free point below each other; zeros for held ones.
DenseColumn column_of(const SpringNetwork& network, const std::vector<Vector3<Extended>>& b);

}  // namespace dartboard::reference
