#pragma once
/// \file
/// Loops over columns of floats that the studies of the cost report time, compiled per instruction set: directions drawn for GGX,
/// and the split sum looked up or computed.

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace gonio {

/// Views of n samples as vectors; n is a multiple of the columns' padding.
struct VectorColumns {
  std::array<const float*, 3> view;
  std::size_t n;
};

/// Lights drawn for views, and weights f NoL / density at F = 1, whose mean is
/// E.
struct SamplingKernel {
  std::string_view id, name;
  /// \param u,w  points of the unit square   \param out  light's x, y, z and
  /// the weight
  void (*draw)(const VectorColumns& views,
               const float* u,
               const float* w,
               float alpha,
               const std::array<float*, 4>& out);
};

/// A and B in a square table, B after A, at the centres of its texels as
/// split_sum_table.h has them.
struct LookupTable {
  const float* texels;
  std::size_t size;
};
/// A and B of the split sum.
struct LookupKernel {
  std::string_view id, name;
  bool reads_table;
  /// \param table  not looked at by a formula
  void (*value)(const float* nov,
                const float* roughness,
                std::size_t n,
                const LookupTable& table,
                float* a,
                float* b);
  /// The same in double; nullptr of a table.
  std::array<double, 2> (*exact)(double nov, double roughness);
};

struct StudyKernels {
  std::span<const SamplingKernel> sampling;
  std::span<const LookupKernel> lookup;
};
/// Kernels in the named instruction set, or in the best one.
StudyKernels study_kernels(std::string_view instruction_set = {});

}  // namespace gonio
