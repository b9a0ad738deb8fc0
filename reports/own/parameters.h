#pragma once
/// \file
/// What parameters of a person's function stand for, by their names.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "number/parameter.h"

namespace gonio {

/// A term's parameters.  The `meaning` of each is the name by which gonio knows what it stands for: its own, or the role that
/// --argument gives it.
std::vector<Parameter> known_parameters(std::size_t term);
/// A name in lower case without underscores, and without a prefix as that of uRoughness.
std::string plain_name(std::string_view);
/// "tint" of "tint_r": the channels of a colour are one.
std::string_view stem_of(std::string_view name);
/// True of a parameter that scales the light: a colour, one channel of it, or f0, kd and their like.
bool is_colour(const Parameter&);
/// Whether it is F0 by its name.
bool is_f0(const Parameter&);
/// Whether a parameter's name says roughness, whose square alpha is.
bool is_rough(const Parameter&);
/// Whether its name says that it is a square already: a2, alphaSq, roughness_squared; r4 is the square of alpha, too.
bool is_squared(const Parameter&);
/// Whether it is the reflectance at grazing angles, which is 1 of most surfaces.
bool is_f90(const Parameter&);
/// Whether it says how smooth a surface is.
bool is_gloss(const Parameter&);
/// Whether it is the exponent of a cosine.
bool is_exponent(const Parameter&);
/// Whether it stretches a lobe along the tangent or the bitangent.
bool is_anisotropy(const Parameter&);
/// Whether it is a ratio of indices of refraction.
bool is_eta(const Parameter&);
/// Whether two names say the same: F0, a diffuse colour, eta, k, or the same letters.
bool means_same(const Parameter&, const Parameter&);
/// The parameter whose name says that it is a width: alpha, roughness, m …
std::optional<std::size_t> width_of(std::span<const Parameter>);
/// That one; or where no name says so, each that may be: neither a colour nor a metallic nor eta.
std::vector<std::size_t> possible_widths(std::span<const Parameter>);
/// Two widths along the tangent and the bitangent: ax and ay, alpha_t and alpha_b …; or two of one role.
std::optional<std::array<std::size_t, 2>> two_widths(std::span<const Parameter>);
/// Whether a metallic workflow's metals are meant.
bool is_metallic(const Parameter&);

/// A parameter's low end, default and high end; of one without bounds those of its role: 0 to 1 of colours and metals, 0.05 to 1 of
/// widths, 1.1 to 2.5 of eta.
double low_of(const Parameter&);
double usual_of(const Parameter&);
double high_of(const Parameter&);
/// Values at which a function is looked at: within the parameter's bounds, or those of its role where it has none.
std::vector<double> values_between(const Parameter&, std::size_t count);

/// Maps from a file's width to the catalogue's alpha: a power; or √(2/(width + 2)) of an exponent, (1 − width)² or 1 − width of a gloss,
/// and 1/width.
inline constexpr double of_exponent = -2, of_gloss = -3, of_gloss_as_alpha = -4, of_inverse = -5;
double alpha_of(double width, double power);
/// Those that a width of that name may have, the likeliest first.
std::span<const double> powers_of(const Parameter& width);
/// These and then all others, whatever its name says.
std::vector<double> every_power(const Parameter& width);
/// Of these the ones that are conventions, not slips, the likeliest first.
std::span<const double> conventions_of(const Parameter& width);
/// True where more of the width is a narrower lobe.
bool narrows(double power);
/// "roughness²", "√(2/(n + 2))"
std::string alpha_text(const std::string& width, double power);

/// The parameters that colour the two parts of a whole model.
struct PartColours {
  std::vector<std::size_t> f0, diffuse;  ///< the same where there is a metallic
  std::vector<std::size_t> weights;      ///< of the highlight, beside F0
  std::optional<std::size_t> metallic;
  std::optional<std::size_t> eta;  ///< that stands for F0 where nothing else does
};
/// By the names f0, specular, ks …, or albedo and metallic, or eta; none where nothing has such a name.
std::optional<PartColours> part_colours(std::span<const Parameter>);
/// Those that may be: by the names, and then with each other colour as F0, whatever its name.
std::vector<PartColours> possible_colours(std::span<const Parameter>);

/// Parameters that are neither a width nor colour one of the parts.
enum class Others { low, usual };
/// Values with which only the highlight is left, of that F0, or of the largest eta; and only the diffuse part, but for a highlight of
/// the least F0.
std::vector<double> with_highlight(std::span<const Parameter>,
                                   const PartColours&,
                                   double f0,
                                   Others);
std::vector<double> with_diffuse(std::span<const Parameter>,
                                 const PartColours&,
                                 double colour,
                                 Others);

}  // namespace gonio
