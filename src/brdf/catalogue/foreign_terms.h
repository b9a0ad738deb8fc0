#pragma once
/// \file
/// Functions of people's own files as further terms of the catalogue.
///
/// They stand behind the catalogue's own.  A function whose channels differ by more than their parameters has three terms, one a
/// channel; a model names the first of them.  Where there is no room, the one that was named longest ago gives its place away, unless
/// someone holds it: a program that runs for days sees any number of files.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/catalogue/registry.h"
#include "foreign/function.h"

namespace gonio {

/// The most of them at one time.
inline constexpr std::size_t most_foreign_terms = 96;

struct ForeignTerm {
  const foreign::Function* function;
  std::size_t channel;  ///< of the function's programs
  foreign::Program
      derivatives;  ///< value, by each parameter, and by the frame's turn where it is anisotropic
  /// Three channels in one: of a colour's parameter k the channel c is parameter k + 16 c.
  foreign::Program channels;
  std::size_t value_count;  ///< of parameters
  std::uint64_t id;         ///< another for each that this place has had

  const foreign::Program& program() const { return function->programs[channel]; }
};

/// Number of the catalogue's own terms: what comes behind them is foreign.
std::size_t catalogue_size();
/// nullptr of a term of the catalogue
const ForeignTerm* foreign_term(std::size_t term);
/// The term of channel c of a model.
std::size_t term_of_channel(std::size_t term, std::size_t channel);
/// A function as a term in a role, read where it was not yet.  \throws Error  as read_function(), or wrong usage of more than 96 held
std::size_t foreign_term_named(std::string_view name, std::optional<Role> role = {});
/// Keeps a foreign term in its place as long as a copy lives; nothing for a term of the catalogue.
std::shared_ptr<const void> hold_foreign(std::size_t term);
/// Takes what was guessed of the functions named since the last call, where it changes values or is not clear: a sentence each.
std::vector<std::string> take_foreign_guesses();
/// True where an id or a part of a spec names a function of a file.
bool is_foreign(std::string_view name);

inline constexpr std::size_t foreign_stride = 16;  ///< as ForeignTerm::channels

}  // namespace gonio
