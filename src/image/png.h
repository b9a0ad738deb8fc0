#pragma once
/// \file
/// PNG out: eight bits of sRGB a channel.

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace gonio {

struct PngImage {
  std::size_t width = 0, height = 0;
  std::vector<std::array<unsigned char, 3>> pixels;  ///< row by row from the top, sRGB
  std::vector<std::pair<std::string, std::string>>
      text{};           ///< keyword (1 to 79 letters), text; Latin-1
  bool is_srgb = true;  ///< else they are numbers, and no colours
};

/// Bytes of that file.
std::string png_bytes(const PngImage&);

}  // namespace gonio
