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
/// Operations of one sample of a term.  Terms are compared in one channel, since ours share nothing between channels.
std::size_t operations_in_one(std::size_t term);
std::size_t operations_in(const std::string& spec, std::size_t channels);
/// ", in 3 channels" of a function where that needs saying
std::string channels_text(const foreign::Function&, bool in_one);

/// A model of ours of the same kind as a function that is none of ours: a diffuse model, or a highlight with or without a diffuse part.
struct OfTheKind {
  std::string spec;  ///< or the id of a diffuse term
  std::size_t operations = 0,
              own_operations =
                  0;  ///< of a diffuse term in one channel, otherwise in the function's
  bool is_sheen = false;
};
OfTheKind model_of_the_kind(std::size_t foreign_term);
/// True where turning the view around the normal changes the value as only a highlight does.
bool has_highlight(std::size_t foreign_term);

}  // namespace gonio
