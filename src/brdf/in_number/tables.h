#pragma once
/// \file
/// Tables of one role's terms, each defined in the file of that role; those of fifty digits in wide*.cpp.

#include "brdf/in_number/number.h"
#include "brdf/term/term.h"

namespace gonio {

template <Role role>
std::span<const TermIn> terms_in(Number number);
template <Role role>
std::span<const TermIn> terms_in_wide();
template <Role role>
std::span<TermOperations (*const)()> operations_in();

std::span<const MapIn> maps_in(Number number);
std::span<const MapIn> maps_in_wide();

}  // namespace gonio
