// Any bytes as a choice, which names no file that is there.
#include "validate/choice.h"

#include "fuzz/one_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return gonio::fuzz::read_as_file(data, size, [](const std::string& path) {
    const auto choice = gonio::read_choice(path);
    for (const auto& s : choice.substances) gonio::bound(choice, choice.shipped, s, 0.5);
  });
}
