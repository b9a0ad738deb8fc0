#include "reports/finding/report.h"

#include "reports/finding/names.h"

#include <fmt/format.h>

namespace gonio {

std::string sentence(const Claim& c) {
  return fmt::format("“{}” {}. {}.{}{}", c.claim, name_of(c.judged), capital(c.figure),
                     c.verdict.empty() ? "" : " ", capital(c.verdict));
}

void Findings::judge(std::string_view claim,
                     std::string_view source,
                     Claim::Judged judged,
                     std::string figure,
                     std::string verdict) {
  claims.push_back(
      {std::string(claim), std::string(source), judged, std::move(figure), std::move(verdict)});
  say(sentence(claims.back()));
}

}  // namespace gonio
