#pragma once
/// \file
/// TIFF in: sixteen bits a channel, or floats, of light.

#include <memory>
#include <string>
#include <string_view>

#include "image/image_file.h"

namespace gonio {

/// Whether a file's first four bytes are those of a TIFF, or a BigTIFF.
bool is_tiff(std::string_view first);

/// First image of a file, grey (channel Y) or R, G, B: sixteen bits in [0, 1], a sample over 65 535; floats of 32 bits as they are.  Further channels are
/// left out.  Strips and tiles are read one by one; the last one stays unpacked in memory.
///
/// Its numbers have to be light: floats are, and sixteen bits whose TransferFunction is a line [TIFF 6.0, section 20].
/// \param linear  the numbers are light, whatever the file says
/// \throws Error  bad_input of eight bits, of other colours and packings than the message names, of an image that is not upright; of every TIFF
///                where gonio was built without libtiff
std::unique_ptr<ImageFile> open_tiff(const std::string& path, bool linear);

}  // namespace gonio
