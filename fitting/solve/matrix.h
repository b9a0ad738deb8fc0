#pragma once
/// \file
/// Matrices as the sources that solve hold them.  Includes Eigen.

#include <cstddef>

#include <Eigen/Core>

namespace gonio {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

inline Eigen::Index index(std::size_t n) {
  return static_cast<Eigen::Index>(n);
}

}  // namespace gonio
