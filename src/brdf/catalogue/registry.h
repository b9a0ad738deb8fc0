#pragma once
/// \file
/// The catalogue at run time: what terms and maps there are, found by id.

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "base/names.h"
#include "brdf/term/term.h"

namespace gonio {

template <>
inline constexpr std::array<std::string_view, 4> names_of<Role>{"ndf", "masking", "fresnel",
                                                                "diffuse"};

/// A term of the catalogue: what it says of itself.
struct TermEntry {
  const About* about;
  std::span<const Parameter> parameters;
  bool coupled;      ///< a diffuse term below the first lobe's interface
  bool anisotropic;  ///< reads the frame
  bool as_shipped;   ///< a shader's arithmetic: finite in double, where NoH > 0, but not in fewer
                     ///< bits
  bool fraction;     ///< is not divided by itself

  std::string_view id() const { return about->id; }
  Role role() const { return role_of(about->id); }
};
/// Every term, in the order of the catalogue; an index here is an index into Kernels::terms.
std::span<const TermEntry> catalogue();

/// \param id  with its prefix ("ndf.ggx") or, within a role, without ("ggx")
/// Throws wrong usage naming the nearest ids, those of maps among them.
std::size_t find_term(std::string_view id);
std::size_t find_term(std::string_view short_id, Role role);

/// A map of the catalogue: what it says of itself.
struct MapEntry {
  const About* about;
  std::span<const Parameter> parameters;
  std::span<const std::string_view> outputs;
};
/// Every map, in the order of maps.h.
std::span<const MapEntry> maps();
/// By id with its prefix ("clamp.alpha"); no value if there is none.
std::optional<std::size_t> find_map(std::string_view id);

/// Refuses a value outside the parameter's legal range, naming the range.
void check_range(const Parameter& p, std::string_view name, double value);

}  // namespace gonio
