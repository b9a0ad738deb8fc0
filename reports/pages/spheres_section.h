#pragma once
/// \file
/// The same sphere as the table has it and as models have it, on their pages.

#include <string_view>

#include "reports/page/section.h"
#include "reports/pages/spheres.h"

namespace gonio {

/// "0.31"
std::string delta_e_text(double);

/// \param name     what the page calls the model: "fit"; empty: of several, by their own names, numbered
/// \param at_once  of several, those that are shown before a reader asks for more
page::Section spheres_section(const Spheres&, std::string_view name, std::size_t at_once = 1);

}  // namespace gonio
