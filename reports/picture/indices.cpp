#include "reports/picture/indices.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace gonio {

std::string with_indices(std::string_view markup, std::string_view open, std::string_view close) {
  constexpr std::array<std::string_view, 3> angles{"θ", "φ", "ω"};
  const auto is_word = [&](std::size_t i) {
    return i < markup.size() && std::isalnum(static_cast<unsigned char>(markup[i])) != 0;
  };
  std::string out;
  for (std::size_t i = 0; i < markup.size(); ++i)
    if (markup[i] == '_' && is_word(i + 1) && !is_word(i + 2) &&
        std::ranges::any_of(angles, [&](std::string_view a) { return out.ends_with(a); }))
      out.append(open).append(1, markup[++i]).append(close);
    else
      out += markup[i];
  return out;
}

}  // namespace gonio
