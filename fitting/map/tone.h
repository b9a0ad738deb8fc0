#pragma once
/// \file
/// Photographs whose numbers are not the light of their lamps: a tone curve, light of the room, another scale.

#include <optional>

#include "fitting/map/sample.h"

namespace gonio {

/// What the numbers of all photographs have to become.
struct OtherTone {
  double power = 1;      ///< of the light, a white tile that faces the lamp staying as it is
  double room = 0;       ///< part of each texel's mean light that all its images have more
  double scale = 1;      ///< factor
  bool shadows = false;  ///< no change: values far below their texel's mean are left out
  double ratio = 1;      ///< median over texels of the rms that is left then over that of `before`,
                         ///< each beside its signal
};

/// The change of all numbers that explains them, where one leaves far less than any model without it.
/// \param before  the best fit of the numbers as they are
std::optional<OtherTone> other_tone(const TexelSample&,
                                    const TexelOptions&,
                                    const TexelFit& before);

}  // namespace gonio
