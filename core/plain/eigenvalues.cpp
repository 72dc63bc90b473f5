#include "core/plain/eigenvalues.h"

template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>& Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>& matrix, int options);

template Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>&
Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>::compute(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                                                   int options);
