#pragma once
/// \file
/// Options that a call may give: the fields of a struct's description, as the command line and Python walk them.  A value is said in
/// words: one, or of a list several.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/record.h"

namespace gonio {

/// Hands each option of a struct and the place of its value, those of inlined structs in their place.
void for_each_option(const RecordType&,
                     void* at,
                     FunctionRef<void(const RecordField&, void* value)> take);
/// Names that a value is one of; none where it is of another kind.
std::vector<std::string_view> choices_of(const ValueType&, const Rules&);
/// True of what is given by its name: false or true, without words of its own.
bool is_flag(const RecordField&);
/// Its meaning, with the unit in brackets.
std::string help_of(const RecordField&);

/// Sets a value to what words say.  \return  false where they say none, or one that the rules do not take
bool set_from_words(const ValueType&, const Rules&, void* value, std::span<const std::string>);
/// Word for a value; empty where it has none, and of a list.
std::string word_of(const ValueType&, const Rules&, const void* value);

}  // namespace gonio
