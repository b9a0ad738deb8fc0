#pragma once
/// \file
/// OpenEXR in and out: named float channels and string attributes.

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/names.h"

namespace gonio {

/// Row-major, top row first.
struct Image {
  std::size_t width = 0, height = 0;
  std::vector<std::string> channels;
  std::vector<std::vector<float>> planes;  ///< [channel][y * width + x]
  std::map<std::string, std::string> attributes;
};

/// Width of a channel's stored numbers: 24 bits, or 11 as a GPU's half, to the nearest.
enum class Storage { single, half };
template <>
inline constexpr std::array<std::string_view, 2> names_of<Storage>{"float", "half"};

/// Lossless compression.  A value that half cannot hold, beyond 65504, is refused.
void write_exr(const std::string& path, const Image&, Storage = Storage::single);
/// The bytes of that file.  \param name  told in errors
std::string exr_bytes(const std::string& name, const Image&, Storage = Storage::single);
/// Any single-part scan line or tiled file; half and integer channels are widened.
/// At most 16384 pixels wide or high.
/// \param most  pixels × channels; an image with more is refused before anything is allocated
/// \param only  the channels to read, in this order; empty: all.  One that the file lacks is refused
Image read_exr(const std::string& path,
               std::size_t most = std::size_t{1} << 28,
               const std::vector<std::string>& only = {});
/// Image without its planes.
Image read_exr_header(const std::string& path);
/// Attribute of an image read from a path; one that it lacks is refused.  \param expected  what would have it
std::string attribute_of(const Image&,
                         const std::string& name,
                         const std::string& path,
                         const char* expected);

}  // namespace gonio
