#pragma once
/// \file
/// What some texels of a stack say before a map of it is fitted: are its directions the right ones, does the model fit, and how
/// large is the noise?

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fitting/map/arrangement.h"
#include "fitting/map/images.h"
#include "fitting/map/texels.h"
#include "fitting/map/tone.h"
#include "stack/stack_reader.h"

namespace gonio {

/// Image that no fit explains together with the others.
struct OddImage {
  std::size_t image = 0;
  double ratio =
      1;  ///< median over texels of the rms of ratios that is left without it, over that with it
  double brightness = 1;  ///< median of its values over those that the others say
};

struct StackSurvey {
  std::size_t texels = 0;  ///< that were looked at and have values
  double left_out = 0;     ///< part of their values: no number, below 0, clipped or dark
  OtherArrangement arrangement;
  TexelNoise noise;
  std::string better;          ///< the model that leaves less than the one asked for; empty: none
  bool seeks_normals = false;  ///< the model asked for leaves less where normals are refined
  double better_ratio =
      1;  ///< median over texels of the rms that is left so, over that of what was asked for
  /// Part of what the best fit leaves that neighbouring texels share: the model, or the images, are off by so much.  0: it may be noise.
  double shared = 0;
  std::vector<OddImage> odd;
  std::optional<OtherExposure> exposure;  ///< looked for where something is shared
  std::optional<Exchanged> exchanged;
  std::optional<OtherTone> tone;  ///< looked for where the model asked for does not fit
  double too_bright = 0;          ///< part of the texels that reflect more than a dielectric can
  bool without_normals = false;   ///< the model is anisotropic, and the stack has no normals
};

/// Fits texels under other arrangements, by other models, judged in images that their fits have not seen, and without each image.
///
/// - Arrangements: the azimuths of light, view or both mirrored, exchanged or turned by quarters, the normals' likewise, and the
///   images in another order (reversed, one further, by the alphabet).  Where nothing changes by that, as for flat isotropic
///   surfaces seen from above, nothing is said.
/// - Noise: what the best of the models leaves, in proportion to the light or the same for all values, whichever is more alike over
///   the texels.  Fewer than 20 texels, or fewer than three values more than unknowns: unknown.
StackSurvey survey(const TexelSamples&, const TexelOptions&);
/// Of some 256 texels of a few rows spread over the map; where normals are refined or missing, the arrangement also of pieces of it, by their curl.
StackSurvey survey(const StackReader&, const TexelOptions&);

/// rms of each texel over the most that noise leaves; above 1 the model does not fit.  NaN where that is not known.
std::vector<float> misfit_of(const TexelFit&, const TexelNoise&);

/// A line each for people: what is wrong, and the cure.
std::vector<std::string> warnings_of(const StackSurvey&, const Stack&, std::string_view model);

}  // namespace gonio
