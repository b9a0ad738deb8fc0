#include "reports/finding/report.h"

#include <array>

#include <fmt/format.h>

namespace gonio {

std::string_view word(Claim::Judged judged) {
  static constexpr std::array<std::string_view, 3> words{"holds", "holds in part", "does not hold"};
  return words[static_cast<std::size_t>(judged)];
}

std::string sentence(const Claim& c) {
  return fmt::format("“{}” {}: {}", c.claim, word(c.judged), c.verdict);
}

void Findings::judge(std::string_view claim,
                     std::string_view source,
                     Claim::Judged judged,
                     std::string verdict) {
  claims.push_back({std::string(claim), std::string(source), judged, std::move(verdict)});
  say(sentence(claims.back()));
}

}  // namespace gonio
