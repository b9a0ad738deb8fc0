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

Column times(const Columns& a, const Column& v) {
  return a * v;
}

Column transposed_times(const Columns& a, const Column& v) {
  return a.transpose() * v;
}

Columns scaled(const Column& left, const Columns& a, const Column& right) {
  return left.asDiagonal() * a * right.asDiagonal();
}

Eigenpairs eigenpairs(const Columns& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Columns> eigen(symmetric);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Column eigenvalues(const Columns& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Columns>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace gonio
