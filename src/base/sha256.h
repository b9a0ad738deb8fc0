#pragma once
/// \file
/// SHA-256 [FIPS 180-4]: names the bytes that a result was made from.

#include <string>
#include <string_view>

#include "base/file.h"

namespace gonio {

/// 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);
/// SHA-256 of a whole file; one that cannot be read, changes meanwhile, or has more bytes than that, is Error(bad_input).
std::string sha256_of_file(const std::string& path);
/// SHA-256 of a whole file that is open, whatever was read of it; from any thread.
std::string sha256_of_file(const InputFile&, std::uint64_t most = std::uint64_t{1} << 31);

}  // namespace gonio
