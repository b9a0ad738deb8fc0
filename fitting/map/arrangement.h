#pragma once
/// \file
/// Arrangements of a stack's directions and images that explain it better than the one that it has.

#include <string>

#include "fitting/map/sample.h"

namespace gonio {

/// Arrangement of a stack's directions, or of its images, under which the texels' fits leave less.
struct OtherArrangement {
  std::string what;                ///< as "the light's azimuth is negated"; empty: none leaves less
  std::string cure;                ///< what to change in the stack
  std::string measure = "an rms";  ///< of what less is left
  /// Median over texels of the rms that is left under it, over the rms that is left as given.
  double ratio = 1;
  /// Half as much or less is left, in nearly every texel: the stack is not as it says.
  bool sure = false;
};

/// The arrangement that leaves least light unexplained, if less than the given one: by the better of two fits each, that of the model asked for and that of
/// `better`, so that directions are not blamed for a model that does not fit.
/// \param better  the model that fits the given arrangement best
OtherArrangement other_arrangement(const TexelSample&, TexelOptions asked, TexelOptions better);

/// The azimuths under which refined normals belong to a surface, if they do not as given: slopes of a height have no curl, dP/dy = dQ/dx.  Of half a turn
/// nothing is known: it makes hollows of bumps.
OtherArrangement arrangement_of_normals(const TexelSample&, const TexelFit& refined);

}  // namespace gonio
