// Any bytes as an image that is read by parts, or as the document of a stack.
#include "stack/stack.h"

#include <vector>

#include "fuzz/one_file.h"
#include "image/image_file.h"

namespace {

using namespace gonio;

void read_image(const std::string& path) {
  const auto image = open_image(path);
  if (image->channels().empty()) return;  // of OpenEXR
  for (const std::size_t side : {std::size_t{1}, std::size_t{64}}) {
    Rectangle part{image->width() / 2, image->height() / 2, 0, 0};
    part.width = std::min(side, image->width() - part.x);
    part.height = std::min(side, image->height() - part.y);
    std::vector<float> values(part.size());
    const std::vector<std::size_t> which{image->channels().size() - 1};
    const std::vector<float*> to{values.data()};
    image->read(part, which, to);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::read_as_file(data, size, [](const std::string& path) {
#if defined(GONIO_FUZZ_stack)
    const Stack stack = read_stack(path);
    if (to_json(stack).empty()) std::abort();
#else
    read_image(path);
#endif
  });
}
