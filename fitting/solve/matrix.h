#pragma once
/// \file
/// Matrices as the sources that solve hold them, and what these ask of Eigen more than once: its templates for products and
/// eigenvalues take seconds each to compile, and are compiled in matrix.cpp.  Includes Eigen.

#include <cstddef>

#include <Eigen/Core>

namespace gonio {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Columns = Eigen::MatrixXd;
using Eigen::VectorXd;

inline Eigen::Index index(std::size_t n) {
  return static_cast<Eigen::Index>(n);
}

/// a b, aᵀ b and a aᵀ; a v and aᵀ v.
Columns product(const Columns& a, const Columns& b);
Columns transposed_product(const Columns& a, const Columns& b);
Columns times_transposed(const Columns& a);
VectorXd times(const Columns& a, const VectorXd& v);
VectorXd transposed_times(const Columns& a, const VectorXd& v);
/// diag(left) a diag(right)
Columns scaled(const VectorXd& left, const Columns& a, const VectorXd& right);

/// Eigenvalues of a symmetric matrix in ascending order, and its eigenvectors as columns.
struct Eigenpairs {
  VectorXd values;
  Columns vectors;
};
Eigenpairs eigenpairs(const Columns& symmetric);
VectorXd eigenvalues(const Columns& symmetric);

}  // namespace gonio
