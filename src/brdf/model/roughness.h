#pragma once
/// \file
/// Perceptual roughness, the second name of a lobe's width: alpha = roughness², and "roughness_2" for
/// "alpha_2".  Everything that takes or shows either goes through here.

#include <cmath>
#include <string>
#include <string_view>

namespace gonio {

/// Width of a roughness r.  A negative r, which is no roughness, stays negative: it is refused as a
/// width then.
inline double alpha_of(double roughness) {
  return roughness < 0 ? roughness : roughness * roughness;
}
inline double roughness_of(double alpha) {
  return std::sqrt(alpha);
}
/// Standard error of a roughness to first order: that of its width by dα/dr = 2r.
inline double roughness_error(double roughness, double alpha_error) {
  return alpha_error / (2 * roughness);
}

namespace roughness_detail {

inline bool is(std::string_view name, std::string_view stem) {
  return name.starts_with(stem) && (name.size() == stem.size() || name[stem.size()] == '_');
}
inline std::string other(std::string_view name, std::string_view stem, std::string_view by) {
  return std::string(by).append(name.substr(stem.size()));
}

}  // namespace roughness_detail

/// True of "alpha", "alpha_x", "alpha_2": widths, of which roughness is the root.
inline bool is_alpha(std::string_view name) {
  return roughness_detail::is(name, "alpha");
}
inline bool is_roughness(std::string_view name) {
  return roughness_detail::is(name, "roughness");
}
/// Name of a width's roughness, the lobe's ending kept.
inline std::string roughness_name(std::string_view alpha) {
  return roughness_detail::other(alpha, "alpha", "roughness");
}
inline std::string alpha_name(std::string_view roughness) {
  return roughness_detail::other(roughness, "roughness", "alpha");
}

}  // namespace gonio
