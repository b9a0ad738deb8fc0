#pragma once
/// \file
/// Parts of reading and writing OpenEXR that its files share.

#include <exception>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "image/exr.h"
#include "image/image_file.h"

#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfHeader.h>
#include <half.h>

namespace gonio {

/// Size, channels and text attributes.
Image without_planes(const Imf::Header&);
/// Refuses what is no file, and what OpenEXR would believe: it allocates what an attribute claims to be long, 2 GB in a file of
/// 1 kB, so that each must fit in the file, and what is in it fill it; the same of tiles and lines; and sides beyond `longest_side`,
/// which it then refuses itself.
/// Returns the bytes of memory that its header takes while it is open, about.
std::size_t expect_sound_exr(const std::string& path);
/// Rows that a file in scan lines packs as one.
std::size_t packed_rows(Imf::Compression);
/// The nearest halves; a finite number that becomes infinite is refused.  \param path  told in errors
std::vector<half> in_half(const std::string& path, std::span<const float>);

/// Result of doing(); what OpenEXR throws becomes bad_input.
template <class Do>
auto with_exr_errors(const std::string& path,
                     const std::string& doing,
                     const std::string& expected,
                     Do&& run) {
  try {
    return run();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    throw bad_input(path, doing, e.what(), expected);
  }
}

}  // namespace gonio
