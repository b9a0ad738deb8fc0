#pragma once
/// \file
/// Bytes as text, RFC 4648.

#include <string>
#include <string_view>

namespace gonio {

std::string base64(std::string_view bytes);
/// Bytes of such a text, up to the first character that is none of its digits.
std::string from_base64(std::string_view text);

}  // namespace gonio
