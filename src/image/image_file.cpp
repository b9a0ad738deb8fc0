#include "image/image_file.h"

#include "base/error.h"
#include "base/file.h"
#include "image/exr_file.h"
#include "image/npy.h"

#include <fmt/format.h>

namespace gonio {

std::unique_ptr<ImageFile> open_image(const std::string& path) {
  const std::string first = InputFile(path).peek(6);
  if (first.starts_with("\x76\x2f\x31\x01")) return open_exr(path);
  if (is_npy(first)) return open_npy(path);
  throw bad_input(path, "byte 0", first, "an image in OpenEXR, or an array of NumPy's (.npy)");
}

}  // namespace gonio
