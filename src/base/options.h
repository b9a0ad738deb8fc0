#pragma once
/// \file
/// Options that a call may give: the fields of a struct's description, as the command line and Python walk them.  A value is said in
/// words: one, or of a list several.

#include <map>
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
/// Words of options, by their names.
using NamedWords = std::map<std::string, std::vector<std::string>>;
/// Sets the options of a struct that are named.
/// \throws Error  wrong_usage of words that say no value, or of a name that no option has
void take_words(const RecordType&, void* to, const NamedWords&);
/// What a value has to be: "one of centre, edge", "a number in [0, 1]".
std::string expected_of(const ValueType&, const Rules&);
/// Word for a value; empty where it has none, and of a list.
std::string word_of(const ValueType&, const Rules&, const void* value);

}  // namespace gonio
