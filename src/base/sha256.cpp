#include "base/sha256.h"

#include <algorithm>
#include <array>
#include <memory>
#include <new>
#include <vector>

#include <fmt/format.h>
#include <openssl/evp.h>

namespace gonio {
namespace {

class Sum {
 public:
  Sum() : context_(EVP_MD_CTX_new()) {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1)
      throw std::bad_alloc();
  }
  void add(std::string_view bytes) { EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()); }
  std::string hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
    unsigned size = 0;
    EVP_DigestFinal_ex(context_.get(), digest.data(), &size);
    std::string digits;
    for (unsigned i = 0; i < size; ++i) digits += fmt::format("{:02x}", digest[i]);
    return digits;
  }

 private:
  struct Free {
    void operator()(EVP_MD_CTX* c) const { EVP_MD_CTX_free(c); }
  };
  std::unique_ptr<EVP_MD_CTX, Free> context_;
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

std::string sha256_of_file(const InputFile& in) {
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
