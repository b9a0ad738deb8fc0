#include "base/sha256.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <fmt/format.h>
#include <nettle/sha2.h>

namespace gonio {
namespace {

/// By Nettle, which neither allocates nor initialises anything at run time: libraries that do may
/// crash where memory is short, however carefully they are called.
class Sum {
 public:
  Sum() { sha256_init(&context_); }
  void add(std::string_view bytes) {
    sha256_update(&context_, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
  }
  std::string hex() {
    std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest;
    sha256_digest(&context_, digest.size(), digest.data());
    std::string digits;
    for (const std::uint8_t byte : digest) digits += fmt::format("{:02x}", byte);
    return digits;
  }

 private:
  sha256_ctx context_;
};

}  // namespace

std::string sha256(std::string_view bytes) {
  Sum sum;
  sum.add(bytes);
  return sum.hex();
}

std::string sha256_of_file(const std::string& path) {
  return sha256_of_file(InputFile(path));
}

std::string sha256_of_file(const InputFile& in, std::uint64_t most) {
  in.expect_at_most(most);
  Sum sum;
  std::vector<char> buffer(1 << 16);  // stays in the cache between reading and summing
  for (std::uint64_t at = 0; at < in.size();) {
    const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(buffer.size(), in.size() - at));
    in.read_at(at, buffer.data(), n);
    sum.add({buffer.data(), n});
    at += n;
  }
  in.expect_unchanged();
  return sum.hex();
}

}  // namespace gonio
