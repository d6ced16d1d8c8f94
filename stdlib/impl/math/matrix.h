#pragma once
// Solvers that several files need. Decompositions of Eigen take seconds to compile, so each is used in one file.

#include <Eigen/Core>

namespace rt::lib {

/// x with the least |A x - b|. False when the columns of A are linearly dependent; `threshold`: relative size of a pivot that
/// counts as 0.
bool leastSquares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double threshold, Eigen::VectorXd& x);

} // namespace rt::lib
