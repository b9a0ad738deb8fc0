#pragma once
/// \file
/// Some texels of a stack that are fitted in several ways, and what their fits leave.

#include <cstddef>
#include <limits>
#include <vector>

#include "fitting/map/task.h"
#include "fitting/map/texels.h"

namespace gonio {

/// Texels with samples of their own, which may be rearranged.
struct TexelSample {
  std::size_t texels = 0, images = 0, channels = 0;
  bool shared = true;
  bool of_light = false;  ///< values are times n·l, as a camera has them
  std::vector<float> values, light, view, normal;
  /// Texels of a piece of the map, row by row from its top left; 1: they lie anywhere.
  std::size_t block = 1;
  std::size_t block_width = 1;  ///< how many of them are side by side

  TexelSamples spans() const {
    return {texels, images, channels, values, shared, light, view, normal};
  }
};

inline constexpr std::size_t few_texels = 20;  ///< with fewer nothing is judged

double median_of(std::vector<double> of);

/// n·l of a texel in an image; NaN of a normal that is none.
double cosine_of(const TexelSample&, std::size_t image, std::size_t texel);
TexelFit fit_sample(const TexelSample&, const TexelOptions&);
/// Without the values of an image.
void leave_out(TexelSample&, std::size_t image);

/// Square of what is left of a texel by each value that is free to differ; NaN where that is too few.
double residual_variance(const TexelFit&, std::size_t texel);
/// Root of that, by texel.
std::vector<double> residual_deviations(const TexelFit&);
/// The same of a fit in the metric l2_cosine, to which light counts that directions below the surface cannot explain: a shadow is explained by them,
/// a bright value is not.  NaN where values are lost that are no light (TexelSample::of_light).
/// \param given  fit of the sample as it was read, which has its values
std::vector<double> light_residuals(const TexelSample&, const TexelFit&, const TexelFit& given);

/// How the residuals of a fit compare with those of another, over the texels.
struct ResidualRatio {
  double ratio = 1;  ///< median of the ratios of rms
  double lower =
      0;  ///< of the texels where the two differ by more than 1 %, the part where it leaves less
  std::size_t texels = 0;
  std::size_t halved = 0, doubled = 0;  ///< texels where it leaves half or less, or twice or more
};
/// A thousandth of each texel's signal: smaller residuals are not compared, for no camera resolves them.
std::vector<double> residual_floor(const TexelFit&);
/// Compares rms by texel; texels where one is NaN are left out.
ResidualRatio compare_residuals(std::vector<double> now,
                                std::vector<double> before,
                                const std::vector<double>& least);

/// f_r that a fit says, [image][channel][texel]; NaN where light or view is below the surface.  Where normals are refined it is what the light there
/// would be divided by n·l of the normal as given, as the values are.
std::vector<double> predicted(const TexelSample&, const TexelFit&, const TexelTask&);
/// Differences between an image's light and what a fit says, or between their logarithms; nothing where either is none.
std::vector<double> differences(const TexelSample&,
                                std::size_t image,
                                std::size_t texel,
                                const std::vector<double>& f_r,
                                Metric);
/// Those of all texels of an image.
std::vector<double> differences(const TexelSample&,
                                std::size_t image,
                                const std::vector<double>& f_r,
                                Metric);
double rms_of_all(const std::vector<double>&);
/// Part of the residuals' squares that texels share with those of the next block, the median; else the upper quartile of its size: near 1 where the model or
/// an image is off, 0 where chance makes as much, nothing is left that a camera resolves, or too few texels tell.
double shared_residuals(const TexelSample&, const TexelFit&, const TexelOptions&);
/// rms of each texel's differences in images that its fit has not seen, a fourth of them at a time.
std::vector<double> unseen_errors(const TexelSample&, const TexelOptions&);

}  // namespace gonio
