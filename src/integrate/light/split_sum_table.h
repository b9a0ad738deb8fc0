#pragma once
/// \file
/// A and B of the split sum as the table that renderers look them up in: made, written as OpenEXR, read
/// back, and how far off each step is.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "image/exr.h"
#include "integrate/light/split_sum.h"

namespace gonio {

/// Texel (i, j), row j = 0 first, holds A and B at its centre:
///
///   NoV = (i + ½)/width,   roughness = (j + ½)/height, but at least 0.01 (α = 1e-4)
///
/// so that it is looked up at texture coordinates (NoV, roughness) without offsets.
///
/// Errors at 32², 64², 128², correlated: half stores A and B to 2.4e-4, float to 3e-8; bilinear lookups of A + B are
/// off by 4.0e-3, 2.2e-3, 1.3e-3 (RMS) and 0.10, 0.098, 0.084 (most), which is where NoV is clamped; between
/// the outermost centres by 9e-4, 5e-4, 3e-4 and 0.018, 0.017, 0.014, where the surface is smooth.
struct SplitSumTable {
  std::string masking;  ///< the catalogue's id
  std::size_t width = 0, height = 0;
  std::size_t samples = 0;   ///< of each texel; 0: by quadrature
  double error = 0;          ///< of A, B and A + B in any texel; not a number by samples
  std::vector<double> a, b;  ///< [j * width + i]

  /// A and B as a GPU looks them up: bilinear between centres, clamped beyond the outermost.
  std::array<double, 2> operator()(double nov, double roughness) const;
};

/// \param width,height  1 to 4096
SplitSumTable split_sum_table(std::string_view masking,
                              std::size_t width,
                              std::size_t height,
                              std::size_t samples = 0,
                              const Goal& = {1e-7});

/// The table with what its numbers lose when they are stored.
SplitSumTable stored(SplitSumTable, Storage);

/// Channels R = A and G = B; the string attributes gonio:split_sum (how it is read), gonio:masking,
/// gonio:samples and gonio:error.
void write_split_sum_table(const std::string& path, const SplitSumTable&, Storage);
SplitSumTable read_split_sum_table(const std::string& path);

/// |found − truth|
struct Deviation {
  double max = 0, rms = 0;
};
struct SplitSumDeviation {
  Deviation a, b, e;  ///< e: of A + B, which is E at F0 = 1
  std::size_t values = 0;
};

/// Texel by texel, of two tables of one size.
SplitSumDeviation difference(const SplitSumTable& found, const SplitSumTable& truth);

/// Error of lookups against quadrature, on a grid of probes × probes from NoV 0.001 and roughness 0.01 to 1.
struct LookupError {
  SplitSumDeviation all;
  SplitSumDeviation
      between;  ///< those between the outermost texels' centres, where nothing is clamped
};
LookupError lookup_error(const SplitSumTable&, std::size_t probes = 100, const Goal& = {1e-5});

}  // namespace gonio
