#pragma once
/// \file
/// Names of models as people say them.

#include <span>
#include <string>
#include <vector>

namespace gonio {

/// Name of each model of a list, "Lambert + GGX (Schlick)" of lambert+ggx/smith_ggx.correlated/schlick: diffuse term, distribution and
/// Fresnel term; lobes that are alike once, "two GGX (Schlick)"; where names would be the same, masking too.
/// \param models  specs or presets, each of which composes
std::vector<std::string> model_names(std::span<const std::string> models);

}  // namespace gonio
