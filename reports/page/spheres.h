#pragma once
/// \file
/// Spheres beside each other on a page, and the difference of their colours.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gonio::page {

/// Course of colours over ΔE2000: one up to a limit, another from there to the largest.
struct DifferenceScale {
  double steps;       ///< that a byte of the differences has to ΔE2000 1
  double limit, max;  ///< where the course changes; the largest that has a colour of its own
  bool hatched;       ///< 254 is a pixel that is not known
};
/// PNG in base64 of differences.  \param bytes  one a pixel, in base64; 255 is beside what is shown: black
std::string difference_png(std::string_view bytes, std::size_t pixels, const DifferenceScale&);

struct SpherePicture {
  std::string png;          ///< in base64
  std::string of;           ///< what a reader hears who does not see it
  std::string_view word{};  ///< below it
};
/// Figure of pictures beside each other.  \param whole  they show more than one sphere that fills them: to their corners
std::string sphere_figure(std::string_view caption,
                          std::size_t pixels,
                          const std::vector<SpherePicture>&,
                          bool whole = false);
/// What the colours of differences mean.
std::string sphere_keys(const DifferenceScale&);

}  // namespace gonio::page
