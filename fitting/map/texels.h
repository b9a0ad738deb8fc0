#pragma once
/// \file
/// Fits of many texels at once: each a small fit of its own, a register full of them side by side.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/names.h"
#include "brdf/model/model.h"
#include "fitting/result/document.h"
#include "fitting/sample/sampling.h"
#include "fitting/solve/options.h"

namespace gonio {

/// Samples of a block of texels as columns, texel fastest.
///
/// A value that is NaN, infinite or negative is masked, as in a fit of a table: that channel of that texel is not compared
/// in that image; the other channels are.  So is every channel where light or view is not above the texel's surface
/// (n·l ≤ 0 or n·v ≤ 0) or is no direction (NaN).
struct TexelSamples {
  std::size_t texels = 0, images = 0;
  std::size_t channels = 0;       ///< 1 or 3
  std::span<const float> values;  ///< f_r [1/sr], [image][channel][texel]
  bool shared = true;             ///< light and view of an image are the same for all texels
  /// Unit vectors towards the light and the viewer; z = the map's normal, x = its tangent: [image][3] or, not shared,
  /// [image][3][texel].
  std::span<const float> light, view;
  /// Unit vectors, [3][texel]; empty: (0, 0, 1).  f_r is what was measured over n·l of this normal.  The tangent of an
  /// anisotropic model is the map's x less its part along the normal.
  std::span<const float> normal;
};

/// What is fitted to each texel, and how values are compared.  Bounds, names and statuses are those of a fit of a table.
struct TexelOptions {
  std::string model = "lambert+ggx/smith_ggx.correlated/schlick";
  std::vector<Setting> fixed;
  std::vector<Setting> bounds;
  std::vector<std::string> grey;
  /// (f − y) NoL by default: what a camera records of it, whose noise is about the same at all angles.  A fit of a table
  /// compares logarithms by default, which measured maps with dark samples do not bear.
  Metric metric = Metric::l2_cosine;
  double offset = 0;
  /// The normal is fitted, too, by two further unknowns; of isotropic models alone.  A value is then compared as the
  /// light that was measured, f_r times n·l of the normal that it was divided by.
  bool refine_normals = false;
};
template <>
inline constexpr auto description<TexelOptions> =
    joined(model_fields<TexelOptions>,
           FieldList{Field{"offset", "1/sr", &TexelOptions::offset,
                           "added to all values by log and relative", Numbers{0, 1e6}},
                     Field{"refine_normals", &TexelOptions::refine_normals,
                           "fit the normals, too; of isotropic models"}});
/// Tiles of other options are told by these: none may be forgotten.
static_assert(describes_every_member<TexelOptions>());

/// 97.5 % quantile of Student's t over the normal distribution's.  \param freedom  from 1 on
double spread_of(double freedom);

/// End of a texel's fit.
enum class TexelOutcome : std::uint8_t {
  converged,
  not_converged,  ///< the steps allowed were used up, or no number came out: values are the best
                  ///< seen
  no_data         ///< no value that can be compared
};
template <>
inline constexpr std::array<std::string_view, 3> names_of<TexelOutcome>{"converged",
                                                                        "not_converged", "no_data"};

/// Parameter of every texel; of one with channels one of them.
struct TexelColumn {
  std::string parameter;
  int channel = -1;          ///< −1: one value for all channels
  std::vector<float> value;  ///< NaN where the status is not_identifiable, or there are no data
  /// Of the sandwich B⁻¹ M B⁻¹, which holds whether or not the metric whitens the noise, as a fit with independent intervals has it; times
  /// spread_of(freedom), so that ± 1.96 of it hold the truth in 95 % of texels.  NaN where the status is not free.
  std::vector<float> std_error;
  /// Degrees of freedom of that: where few values decide, their residuals are small by chance, too [Satterthwaite 1946].
  std::vector<float> freedom;
  std::vector<std::uint8_t> status;  ///< ParameterStatus: free, fixed, at_bound or not_identifiable
};

/// What noise leaves of texels' residuals, found by a survey of the stack.
struct TexelNoise {
  bool follows_light =
      true;        ///< in proportion to the rms of a texel's weighted values; else the same for all
  float dark = 0;  ///< rms of them below which it is that of this rms
  /// What a texel's rms, corrected for its unknowns, over that exceeds once in 200 texels by chance; once in four where another model is
  /// known to fit better.
  float most = std::numeric_limits<float>::quiet_NaN();
};

struct TexelFit {
  std::vector<TexelColumn>
      columns;                ///< the model's parameters in order, channels of one side by side
  std::vector<float> rms;     ///< of the metric's residuals; NaN without data
  std::vector<float> signal;  ///< rms of the values as the metric weighs them
  std::vector<float> count, freedom;  ///< values, and those beyond the unknowns
  std::vector<float> misfit;  ///< rms over the most that noise leaves; above 1 the model does not
                              ///< fit; NaN where unknown
  std::vector<float> normal;  ///< [3][texel], where refined; else empty
  std::vector<std::uint8_t> outcome;  ///< TexelOutcome
};

/// Throws wrong usage for options that no map could be fitted with.
void check(const TexelOptions&, std::size_t channels);

/// Fit of each texel, on this thread: callers share blocks among threads.  What is found of a texel depends on its own
/// samples alone: not on its neighbours, nor on how a map is cut into blocks.
/// \param instruction_set  the best that may be taken; empty: of this machine
/// \throws Error  wrong usage, for options or spans that do not fit
TexelFit fit_texels(const TexelSamples&,
                    const TexelOptions&,
                    std::string_view instruction_set = {});

}  // namespace gonio
