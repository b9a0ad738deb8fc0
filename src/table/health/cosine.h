#pragma once
/// \file
/// Cosines that values are multiplied by, and what exchanging the directions changes.

#include <array>
#include <string>
#include <vector>

#include "table/format/column_map.h"
#include "table/health/facts.h"

namespace gonio {

/// Cosines that values may be multiplied by.
struct Cosines : CosinePowers {
  const char* in_words;
};

/// The first two, and the next two, keep what exchanging the directions changes, and so do the pairs of their squares; the two
/// after these change nothing by it.
inline constexpr std::array cosines{Cosines{{0, 1}, "f cos(theta_o)"},
                                    Cosines{{-1, 0}, "f/cos(theta_i)"},
                                    Cosines{{1, 0}, "f cos(theta_i)"},
                                    Cosines{{0, -1}, "f/cos(theta_o)"},
                                    Cosines{{0, 2}, "f cos(theta_o)^2"},
                                    Cosines{{-2, 0}, "f/cos(theta_i)^2"},
                                    Cosines{{2, 0}, "f cos(theta_i)^2"},
                                    Cosines{{0, -2}, "f/cos(theta_o)^2"},
                                    Cosines{{1, 1}, "f cos(theta_i) cos(theta_o)"},
                                    Cosines{{-1, -1}, "f/(cos(theta_i) cos(theta_o))"}};

/// Command that divides by them.
std::string divided_by(const Table&, const CosinePowers&);

/// Sum of the channels' valid values.
double value_of_all(const Table&, const Angles<double>&, std::size_t sample);

/// A cosine breaks reciprocity, and what is reciprocal without it had it; of the two that do so the one that values follow
/// more nearly away from the highlight.  Both cosines keep it, and a table may hold no reciprocal pairs: only that values
/// fall by them tells.
/// \return  the cosines, where there are any
const Cosines* warn_of_cosine(TableFacts&, std::vector<std::string>& all);

/// Says that exchanging the directions changes values: what measured tables have that are f all the same.
void warn_of_reciprocity(TableFacts&, std::vector<std::string>& all);

}  // namespace gonio
