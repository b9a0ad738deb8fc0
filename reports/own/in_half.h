#pragma once
/// \file
/// What a function keeps in half, in a sentence.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "number/parameter.h"
#include "stability/subject.h"

namespace gonio {

/// Ends of parameters, by name whatever its case.
using Domain = std::vector<std::pair<std::string, Range>>;

/// \param proves  false of a whole model, about which a proof takes long and reaches only its largest widths
std::string in_half(stability::Subject, const Domain&, bool proves = true);
/// A distribution by its cosine NoH, as shaders have it.
std::string in_half(std::size_t term, const Domain&);

}  // namespace gonio
