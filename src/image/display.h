#pragma once
/// \file
/// Radiance as a display shows it: exposed, and clipped to what it can show.

#include "image/colour_difference.h"
#include "image/environment.h"

namespace gonio {

/// Linear sRGB of a display, in [0, 1].  \param exposure  what radiance is multiplied with: 1 is white then
Rgb displayed(const Rgb& radiance, double exposure);
/// Byte of one of its channels [IEC 61966-2-1]; of what is no number 255.
unsigned char srgb_byte(double linear);
/// Colour of linear sRGB under D65, beside the display's white, {1, 1, 1}.
Lab lab_of_display(const Rgb&);

}  // namespace gonio
