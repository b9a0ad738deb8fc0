#pragma once
/// \file
/// Cells of CSV, RFC 4180.

#include <string>
#include <string_view>

namespace gonio {

/// Text in quotes, those within it doubled.
std::string csv_quoted(std::string_view);
/// Cell of text, printable (base/text.h) and quoted where it must be.  Text that a spreadsheet would take for a formula, as it begins
/// with = + - or @, is quoted and begins with an apostrophe, which spreadsheets take for "this is text".
std::string csv_text(std::string_view);
/// Cell of a number: the digits that tell it from its neighbours; empty where it is not finite.
std::string csv_number(double);

}  // namespace gonio
