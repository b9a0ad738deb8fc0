#pragma once
/// \file
/// How an instrument saw a table, in words: cones of light and detector, and the reference that values are relative to.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "geometry/aperture.h"
#include "table/sample_mask.h"
#include "table/table.h"

namespace gonio {

/// Reads "LIGHT,DETECTOR": full widths of the cones in degrees, "0.7,0.35", or their solid angles, "1.2e-4sr,0".
/// Throws wrong usage where a width is negative or 60° or more, or where both are 0.
Aperture aperture_from(std::string_view words);
/// Full width of a round cone of that solid angle:  d = 2 acos(1 − Ω/2π)  [rad]
double width_of_cone(double solid_angle);
/// Throws bad_input where a width is no number from 0 to below 60°.
void check_aperture(const std::string& path, const Aperture&);

/// Values and uncertainties times a factor.
void scale_values(Table&, double factor);

/// Values that are relative to a matte target of that reflectance become f = value R/π.
/// Throws wrong usage where R is not above 0, or above 2.
void take_reference(Table&, double reflectance);

/// Median of the values above 0; none where there are none.
std::optional<double> typical_value(const Values&);

/// Value that a relative uncertainty counts at least [1/sr]: a thousandth of the median, as what is next to nothing is not next
/// to certain.
double least_sure_value(const Values&);
/// Turns the relative uncertainties of values into those in 1/sr.
void make_absolute(Values& uncertainties, const Values& of);

/// What options say of these.
inline constexpr const char* aperture_in_words =
    "LIGHT,DETECTOR: full widths of the instrument's cones in degrees, as 0.7,0.35, or their solid "
    "angles, as "
    "1.2e-4sr,0. The model is averaged over both";
inline constexpr const char* reference_in_words =
    "reflectance of the matte target that values are relative to: f is value × R/π";

/// A channel by its name, or by a wavelength as 550nm: then the nearest band, if not nearer to where another would stand.
/// Throws wrong usage, naming those that there are.
std::size_t channel_named(const Table&, const std::string& name);
/// Keeps these channels, in that order.
void pick_channels(Table&, const std::vector<std::string>& names);
/// A spectrum's bands become linear sRGB under D65: channels r, g and b, of bands that stand for a spectrum linear between them.
/// Throws wrong usage where channels are no wavelengths that cover 400 to 700 nm by 50 nm or less.
void take_rgb(Table&);

/// What the user says of a table beside its file: of all commands that read one.
struct AsMeasured {
  std::optional<std::string> mask = {}, aperture = {};
  std::optional<double> reference = {};
  std::vector<std::string> channels = {};  ///< one or several a word, as 450nm,550nm
  bool rgb = false;

  std::vector<std::string> channel_names() const;
};
template <>
inline constexpr auto description<AsMeasured> = FieldList{
    Field{"mask", &AsMeasured::mask, mask_in_words},
    Field{"aperture", &AsMeasured::aperture, aperture_in_words},
    Field{"reference", &AsMeasured::reference, reference_in_words},
    Field{"channels", &AsMeasured::channels,
          "channels to take: their names, or wavelengths as 450nm 550nm 650nm"},
    Field{"rgb", &AsMeasured::rgb,
          "a spectrum's bands become linear sRGB under D65, where they cover 400 to 700 nm"}};
static_assert(describes_every_member<AsMeasured>());
/// Takes all of it into the table.
void take(Table&, const AsMeasured&);

}  // namespace gonio
