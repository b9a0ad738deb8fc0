#pragma once
// SHA-256 [FIPS 180-4] under Nettle's names, which a page has not.
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

enum { SHA256_DIGEST_SIZE = 32 };

struct sha256_ctx {
  std::uint32_t state[8];
  std::uint64_t length;
  std::uint8_t block[64];
};

namespace sha256_detail {

/// Fractional bits of the roots of the first primes: of squares for the state, of cubes for the rounds.
struct Constants {
  std::uint32_t state[8], rounds[64];
  Constants() {
    for (std::uint32_t n = 2, found = 0; found < 64; ++n) {
      bool prime = true;
      for (std::uint32_t d = 2; d * d <= n; ++d) prime = prime && n % d != 0;
      if (!prime) continue;
      const auto bits = [](double root) {
        return static_cast<std::uint32_t>((root - std::floor(root)) * 4294967296.0);
      };
      if (found < 8) state[found] = bits(std::sqrt(static_cast<double>(n)));
      rounds[found++] = bits(std::cbrt(static_cast<double>(n)));
    }
  }
};
inline const Constants& constants() {
  static const Constants c;
  return c;
}

inline void add_block(std::uint32_t* state, const std::uint8_t* block) {
  std::uint32_t w[64], s[8];
  for (int i = 0; i < 16; ++i)
    w[i] = std::uint32_t{block[4 * i]} << 24 | std::uint32_t{block[4 * i + 1]} << 16 |
           std::uint32_t{block[4 * i + 2]} << 8 | block[4 * i + 3];
  for (int i = 16; i < 64; ++i)
    w[i] = w[i - 16] + w[i - 7] +
           (std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ w[i - 15] >> 3) +
           (std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ w[i - 2] >> 10);
  std::memcpy(s, state, sizeof s);
  for (int i = 0; i < 64; ++i) {
    const std::uint32_t a = s[7] +
                            (std::rotr(s[4], 6) ^ std::rotr(s[4], 11) ^ std::rotr(s[4], 25)) +
                            ((s[4] & s[5]) ^ (~s[4] & s[6])) + constants().rounds[i] + w[i];
    const std::uint32_t b = (std::rotr(s[0], 2) ^ std::rotr(s[0], 13) ^ std::rotr(s[0], 22)) +
                            ((s[0] & s[1]) ^ (s[0] & s[2]) ^ (s[1] & s[2]));
    std::memmove(s + 1, s, 7 * sizeof *s);
    s[4] += a, s[0] = a + b;
  }
  for (int i = 0; i < 8; ++i) state[i] += s[i];
}

}  // namespace sha256_detail

inline void sha256_init(sha256_ctx* c) {
  std::memcpy(c->state, sha256_detail::constants().state, sizeof c->state);
  c->length = 0;
}
inline void sha256_update(sha256_ctx* c, std::size_t n, const std::uint8_t* bytes) {
  while (n > 0) {
    const std::size_t at = c->length % 64, part = n < 64 - at ? n : 64 - at;
    std::memcpy(c->block + at, bytes, part);
    c->length += part, bytes += part, n -= part;
    if (c->length % 64 == 0) sha256_detail::add_block(c->state, c->block);
  }
}
inline void sha256_digest(sha256_ctx* c, std::size_t n, std::uint8_t* digest) {
  const std::uint64_t bits = 8 * c->length;
  const std::uint8_t end = 0x80, zero = 0;
  sha256_update(c, 1, &end);
  while (c->length % 64 != 56) sha256_update(c, 1, &zero);
  for (int k = 56; k >= 0; k -= 8) {
    const auto byte = static_cast<std::uint8_t>(bits >> k);
    sha256_update(c, 1, &byte);
  }
  for (std::size_t i = 0; i < n; ++i)
    digest[i] = static_cast<std::uint8_t>(c->state[i / 4] >> (24 - 8 * (i % 4)));
  sha256_init(c);
}
