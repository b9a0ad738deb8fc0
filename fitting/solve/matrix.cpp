#include "fitting/solve/matrix.h"

#include <Eigen/Eigenvalues>

namespace gonio {

Columns product(const Columns& a, const Columns& b) {
  return a * b;
}

Columns transposed_product(const Columns& a, const Columns& b) {
  return a.transpose() * b;
}

Columns times_transposed(const Columns& a) {
  return a * a.transpose();
}

VectorXd times(const Columns& a, const VectorXd& v) {
  return a * v;
}

VectorXd transposed_times(const Columns& a, const VectorXd& v) {
  return a.transpose() * v;
}

Columns scaled(const VectorXd& left, const Columns& a, const VectorXd& right) {
  return left.asDiagonal() * a * right.asDiagonal();
}

Eigenpairs eigenpairs(const Columns& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Columns> eigen(symmetric);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

VectorXd eigenvalues(const Columns& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Columns>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace gonio
