#pragma once
// Eigen's solvers for symmetric matrices of any size, compiled once: a source that instantiates one takes seconds
// longer.

#include <Eigen/Eigenvalues>

extern template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>& Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>& matrix, int options);

extern template Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>&
Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>::compute(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                                                   int options);
