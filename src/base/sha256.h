#pragma once
/// \file
/// SHA-256 [FIPS 180-4]: names the bytes that a result was made from.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace gonio {

class Sha256 {
 public:
  void add(std::string_view bytes);
  /// 64 lower-case hexadecimal digits of all that was added; ends the object's use.
  std::string hex();

 private:
  void block(const unsigned char*);
  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> pending_{};
  std::uint64_t length_ = 0;  ///< [bytes]
};

/// Of a whole file; what cannot be read is Error(bad_input).
std::string sha256_of_file(const std::string& path);

}  // namespace gonio
