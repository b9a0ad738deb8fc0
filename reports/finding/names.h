#pragma once
/// \file
/// Names of forms as people say them: the one list, for tables and sentences of reports alike.

#include <string>
#include <string_view>

namespace gonio {

/// Ids of forms that reports look at by name.
namespace form_id {
inline constexpr std::string_view schlick = "fresnel.schlick",
                                  smith = "masking.smith_ggx.correlated",
                                  separable_smith = "masking.smith_ggx.separable",
                                  direct_k = "masking.schlick_ggx.direct",
                                  image_k = "masking.schlick_ggx.half_alpha";
}  // namespace form_id

/// Name of a form that stands alone: "Height-correlated Smith"; of others the catalogue's title.
/// \param form  id, with what tells a variant from it
std::string name_of_form(std::string_view form);
/// The same within a sentence: "height-correlated Smith".
std::string in_text(std::string_view form);
/// Name for a picture, where there is little room: the same where it is short, else the id without its role.
std::string brief_name(std::string_view form);
/// The text as a sentence begins: its first letter large, if it is one of ASCII.
std::string capital(std::string text);

}  // namespace gonio
