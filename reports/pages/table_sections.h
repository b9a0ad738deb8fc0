#pragma once
/// \file
/// What the pages of one table share: its curves, and what it can be trusted for.

#include <string>
#include <string_view>
#include <vector>

#include "reports/page/section.h"
#include "table/cut/cuts.h"
#include "table/health/health.h"

namespace gonio {

/// Angle up to which values set a scale: those beyond would set it for all others.
inline constexpr double scale_to_deg = 85;

/// Last part of a path.
std::string file_name(std::string_view path);
/// Text whose names of angles are their signs: "θ_h" for theta_h.
std::string with_signs(std::string text);
/// "not known": how far a fitted parameter is known.
std::string_view status_words(std::string_view status);
/// Map over two angles.  Edges of theta_h grow as their square.
FigureMap angle_map(std::string family,
                    FigureChoices choices,
                    std::string_view x,
                    const std::vector<double>& x_deg,
                    std::string_view y,
                    const std::vector<double>& y_deg);
/// A limit that holds 95 % of sizes, at a round number.
double limit_of(std::vector<double> sizes);

/// What to know of a table before believing it.
/// \param fitted  warnings of its fit, which say some of that already; or none
std::vector<std::string> table_warnings(const Table&,
                                        const Health&,
                                        const std::vector<std::string>* fitted);
/// \param channels  those of the cuts
page::Section curves_section(const Table&,
                             const std::vector<std::string>& channels,
                             const std::vector<Cut>&,
                             Pictures&);
/// Noise in a few words: "about 2 % of each value, from repeated samples".
std::string noise_words(const Noise&);
/// \param part  a mask left out samples that the table had
page::Section trust_section(const Table&, const Health&, bool part = false);

}  // namespace gonio
