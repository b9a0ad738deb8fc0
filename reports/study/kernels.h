#pragma once
/// \file
/// Loops over columns of floats that the studies of the cost report time,
/// compiled per instruction set: fast arithmetic where models use it,
/// directions drawn for GGX, and the split sum looked up or computed.

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace gonio {

/// Light and view of n samples as vectors; n is a multiple of the columns'
/// padding.
struct VectorColumns {
  std::array<const float*, 3> light, view;
  std::size_t n;
};

/// An operation in one way, alone and in a model that it stands in.
struct FastKernel {
  std::string_view id;    ///< "fast.rsqrt.estimate.1"
  std::string_view name;  ///< "the estimate and a Newton step"
  /// What is computed: "reciprocal root", "reciprocal", "exponential", "power",
  /// "fifth power"
  std::string_view operation;
  std::string_view exact;  ///< id of the form that it stands for
  double from, to;         ///< of the operation alone
  /// out = operation of x
  void (*alone)(const float* x, std::size_t n, float* out);
  /// out = f [1/sr] of the model, with h made of light and view.  \param p
  /// alpha, F0 \param by_cosine  D of NoH alone, else of |n × h|² too
  void (*shaded)(const VectorColumns&, const float* p, bool by_cosine, float* out);
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
  std::span<const FastKernel> fast;
  std::span<const SamplingKernel> sampling;
  std::span<const LookupKernel> lookup;
};
/// Kernels in the named instruction set, or in the best one.
StudyKernels study_kernels(std::string_view instruction_set = {});

/// The operation alone, and the model in which it stands, in double without
/// anything fast.
double exact_operation(std::string_view operation, double x);
void exact_shaded(std::string_view operation,
                  const VectorColumns&,
                  const float* p,
                  std::span<double> out);

}  // namespace gonio
