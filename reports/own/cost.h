#pragma once
/// \file
/// Operations of a person's function beside those of ours: both of one sample, in the same channels.

#include <cstddef>
#include <optional>
#include <string>

#include "foreign/function.h"

namespace gonio {

/// Channels in which a function differs: 3 where a parameter is a colour, 1 otherwise.
std::size_t channels_of(const foreign::Function&);
/// Operations of one sample of a term in so many channels: a distribution and masking are the same in all of them.
std::size_t operations_in(std::size_t term, std::size_t channels);
std::size_t operations_in(const std::string& spec, std::size_t channels);

/// A model of ours of the same kind as a function that is none of ours: a diffuse model, or a highlight with or without a diffuse part.
struct OfTheKind {
  std::string spec;  ///< or the id of a diffuse term
  std::size_t operations = 0;
};
OfTheKind model_of_the_kind(std::size_t foreign_term);
/// True where turning the view around the normal changes the value as only a highlight does.
bool has_highlight(std::size_t foreign_term);

}  // namespace gonio
