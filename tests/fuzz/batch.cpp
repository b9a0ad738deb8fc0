// Any bytes as a document in a folder of results.
#include "fitting/batch/batch_document.h"
#include "fuzz/one_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return gonio::fuzz::read_as_file(data, size, [](const std::string& path) {
    if (const auto read = gonio::read_document(path)) gonio::batch_csv({read->row});
  });
}
