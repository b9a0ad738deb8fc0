#pragma once
/// \file
/// Radiance as a display shows it: exposed, and clipped to what it can show.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "image/colour_difference.h"
#include "image/environment.h"

namespace gonio {

/// Linear sRGB of a display, in [0, 1].  \param exposure  what radiance is multiplied with: 1 is white then
Rgb displayed(const Rgb& radiance, double exposure);
/// Byte of one of its channels [IEC 61966-2-1]; of what is no number 255.
unsigned char srgb_byte(double linear);
/// Those bytes of a radiance, exposed and clipped.
std::array<unsigned char, 3> displayed_bytes(const Rgb& radiance, double exposure);
/// Colour of linear sRGB under D65, beside the display's white, {1, 1, 1}.
Lab lab_of_display(const Rgb&);
/// Colour of an albedo by channel, in the light in which a perfect diffuser is white: of the first, middle and last channel; of
/// one channel grey.
Lab lab_of_albedo(std::span<const double> albedo);
/// ΔE2000 between two radiances as a display shows them; infinite where either is no number.
double displayed_difference(const Rgb& radiance, const Rgb& reference, double exposure);

/// ΔE_ITP between two radiances, exposed and not clipped, white at 203 cd/m² [ITU-R BT.2408]; infinite where either is no number.
double difference_in_light(const Rgb& radiance, const Rgb& reference, double exposure);

/// Colour of values by channel: those of r, g, b themselves, of other channels the grey of their mean.
Rgb colour_of_channels(const std::vector<std::string>& channels, std::span<const double> values);

}  // namespace gonio
