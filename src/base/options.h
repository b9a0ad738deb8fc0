#pragma once
/// \file
/// Options that a call may give: the fields of a struct's description, as the command line and Python walk them.

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
/// Its meaning, with the unit in brackets.
std::string help_of(const RecordField&);

}  // namespace gonio
