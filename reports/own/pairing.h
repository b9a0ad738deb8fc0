#pragma once
/// \file
/// Which parameters of a person's function stand for which of another's, and by which maps.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "number/parameter.h"

namespace gonio {

/// A parameter of the other by those of one's own.
struct StandsFor {
  std::function<double(std::span<const double> own)> value;
  std::string text;  ///< "roughness²"
};
/// One for each parameter of the other; none where nothing stands for it.
using Pairs = std::vector<std::optional<StandsFor>>;

/// All that the names allow, the likeliest first: a width by each map that is a convention, and two widths along the tangent and the
/// bitangent in either order.
/// \param own    with their known names
/// \param other  likewise
std::vector<Pairs> possible_pairs(std::span<const Parameter> own, std::span<const Parameter> other);
/// Those of one's own that stand for nothing.
std::vector<std::size_t> unpaired(const Pairs&, std::span<const Parameter> own);
/// "kd = albedo, alpha = roughness²"
std::string text_of(const Pairs&, std::span<const Parameter> other);

}  // namespace gonio
