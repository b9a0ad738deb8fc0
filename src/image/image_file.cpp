#include "image/image_file.h"

#include "base/error.h"
#include "base/file.h"
#include "image/exr_file.h"
#include "image/npy.h"
#include "image/png_file.h"
#include "image/tiff_file.h"

#include <fmt/format.h>

namespace gonio {

std::unique_ptr<ImageFile> open_image(const std::string& path, bool linear) {
  const std::string first = InputFile(path).peek(6);
  if (first.starts_with("\x76\x2f\x31\x01")) return open_exr(path);
  if (is_npy(first)) return open_npy(path);
  if (is_png(first)) return open_png(path, linear);
  if (is_tiff(first)) return open_tiff(path, linear);
  throw bad_input(path, "byte 0", first,
                  "an image in OpenEXR, an array of NumPy's (.npy), a PNG of 16 bits or a TIFF");
}

}  // namespace gonio
