#pragma once
/// \file
/// Combinations of the forms that a plan chooses among.

#include <array>
#include <vector>

#include "scene/surface/effect.h"

namespace gonio::scene {

/// Forms of each effect that are left, cheapest first and the exact one last; of none that list is empty.
using FormsLeft = std::array<std::vector<Form>, effect_count>;

/// Leaves at most so many combinations: of the effect with most forms the last but the exact one goes, as long as one has more
/// than two; then the effect that saves the least time stays exact.
void thin_out(FormsLeft&, const std::array<double, effect_count>& ns_saved, std::size_t most);

/// Every combination.
std::vector<Forms> combinations(const FormsLeft&);

}  // namespace gonio::scene
