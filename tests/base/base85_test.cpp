#include "base/base85.h"

#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>

namespace gonio {
namespace {

/// What a page makes of such a text: missing digits are the greatest.
std::string read_by_a_page(std::string_view text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); i += 5) {
    std::uint64_t four = 0;
    for (std::size_t k = i; k < i + 5; ++k) {
      const char c = k < text.size() ? text[k] : '~';
      four = 85 * four + static_cast<std::uint64_t>((c == '!' ? '<' : c) - '*');
    }
    const std::size_t n = std::min<std::size_t>(4, text.size() - i - 1);
    for (std::size_t k = 0; k < n; ++k) bytes += static_cast<char>(four >> (24 - 8 * k) & 255);
  }
  return bytes;
}

TEST(Base85, IsFiveCharactersForFourBytesWithoutTags) {
  EXPECT_EQ(base85(""), "");
  EXPECT_EQ(base85(std::string(4, '\0')), "*****");
  EXPECT_EQ(base85(std::string_view("\0\0\0\x12", 4)), "****!") << "a '<' would begin a tag";
  EXPECT_EQ(base85(std::string_view("\0", 1)), "**");
}

TEST(Base85, GivesEveryByteBack) {
  std::string bytes;
  for (int k = 0; k < 256; ++k) bytes += static_cast<char>(k * 37);
  for (std::size_t n = 0; n < 9; ++n) {
    for (const char fill : {'\0', '\x7f', '\xff'}) {
      const std::string more = bytes + std::string(n, fill), text = base85(more);
      EXPECT_EQ(read_by_a_page(text), more);
      EXPECT_EQ(text.find('<'), text.npos);
    }
  }
}

}  // namespace
}  // namespace gonio
