#pragma once
/// \file
/// UTIA's BRDF database of 150 materials (Filip and Vávra 2014, Computer Graphics Forum 33(7), doi:10.1111/cgf.12477): 3 × 288 × 288
/// little-endian doubles and nothing else, 1,990,656 bytes.
///
/// Planes are red, green, blue; rows are directions to the light, columns to the viewer, both as 48 θ/15° + φ/7.5° with θ = 0, 15 … 75°
/// and φ = 0, 7.5 … 352.5° from the surface's tangent, so anisotropic.  No cosine is in them.  No real file was at hand: layout as
/// read by ALTA (belcour/alta, 7c54015), dj_brdf (jdupuy/dj_brdf, 94cb16a) and A. Fichet's utia.py, which agree.
///
/// What the numbers are they do not agree on, and the files do not say: see UtiaValues.  "values" in the side file says it.

#include <array>
#include <cstdint>
#include <string_view>

#include "base/file.h"
#include "base/names.h"
#include "table/table.h"

namespace gonio {

/// Meaning of the numbers in a file.
enum class UtiaValues {
  f_r,      ///< f_r [1/sr], as ALTA takes them; what gonio writes, and assumes with a warning where
            ///< nothing is said
  srgb,     ///< f_r through sRGB's transfer function, as utia.py takes them
  dj_brdf,  ///< 140 times that of f_r/100, as dj_brdf takes them
  xyz       ///< f_r as X, Y and Z
};
template <>
inline constexpr std::array<std::string_view, 4> names_of<UtiaValues>{"f_r", "srgb", "dj_brdf",
                                                                      "xyz"};

/// Directions of the samples of a table: each pair once, though a file names the pole 48 times; the viewer's fastest.
DirectionList utia_directions();
/// True where a table is a list of these, to 1e-9°.
bool has_utia_directions(const Table&);

/// \param size  of the file [bytes]; nothing else tells it
bool is_utia(std::uint64_t size);
/// f_r as the file has it.  A direction's value is the mean of those that the file has for it.
Table read_utia(InputFile&);
/// Turns the file's numbers into f_r, or its channels into X, Y, Z.  Negative ones stay negative, and are masked.
void interpret_utia(Table&, UtiaValues);
/// Linear between the four angles, φ over the turn; NaN beyond 75°, where other readers extrapolate, and where valid values
/// carry half of the weight or less.
/// \param step  2: between every other angle, to see what the distance of the angles does
void interpolate_utia(Table&, std::size_t step = 1);
/// f_r; a table with one channel is written as grey.
void write_utia(const Table&, OutputFile&, const std::string& path);

}  // namespace gonio
