#pragma once
/// \file
/// OpenEXR in and out: named float channels and string attributes, nothing lost in between.

#include <map>
#include <string>
#include <vector>

namespace gonio {

/// Row-major, top row first.
struct Image {
  std::size_t width = 0, height = 0;
  std::vector<std::string> channels;
  std::vector<std::vector<float>> planes;  ///< [channel][y * width + x]
  std::map<std::string, std::string> attributes;
};

/// Channels are stored as 32-bit float, lossless compression.
void write_exr(const std::string& path, const Image&);
/// Any single-part scan line or tiled file; half and integer channels are widened.
/// Refuses images of more than 2^26 pixels.
Image read_exr(const std::string& path);

}  // namespace gonio
