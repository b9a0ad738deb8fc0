#include "base/base85.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace gonio {

std::string base85(std::string_view bytes) {
  std::string out;
  out.reserve(5 * (bytes.size() / 4 + 1));
  for (std::size_t i = 0; i < bytes.size(); i += 4) {
    std::uint32_t four = 0;
    const std::size_t n = std::min<std::size_t>(4, bytes.size() - i);
    for (std::size_t k = 0; k < 4; ++k)
      four = four << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    std::array<char, 5> digits{};
    for (std::size_t k = 5; k-- > 0; four /= 85) {
      const char c = static_cast<char>('*' + four % 85);
      digits[k] = c == '<' ? '!' : c;
    }
    out.append(digits.data(), n + 1);
  }
  return out;
}

}  // namespace gonio
