#pragma once
/// \file
/// PNG in: sixteen bits a channel, of light.

#include <memory>
#include <string>
#include <string_view>

#include "image/image_file.h"

namespace gonio {

/// Whether a file's first bytes are those of a PNG.
bool is_png(std::string_view first);

/// Image of grey (channel Y) or R, G, B, in [0, 1]: a sample over 65 535.  Transparency is left out.  Rows are read from the top: a part above the
/// last one begins the file anew.
///
/// Its numbers have to be light: a file says so by its gAMA chunk, 1 [PNG 1.2, 11.3.3.2].
/// \param linear  the numbers are light, whatever the file says
/// \throws Error  bad_input of eight bits, of palettes, of interlaced rows, of any other gamma
std::unique_ptr<ImageFile> open_png(const std::string& path, bool linear);

}  // namespace gonio
