#include "base/nearest.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace gonio {
namespace {

/// Levenshtein distance: how many letters a typing error changed.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({change, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::vector<std::string_view> nearest(std::string_view name,
                                      std::span<const std::string_view> known) {
  // Of a text that is no name at all a beginning decides: whatever is nearest to it, it is far.
  constexpr std::size_t most = 200;
  constexpr std::size_t telling = 3;  // letters of a beginning that somebody left it at
  struct Near {
    bool other;
    std::size_t changed;
    std::string_view name;
  };
  std::vector<Near> near;
  for (const auto n : known)
    near.push_back({name.size() < telling || !n.starts_with(name),
                    distance(name.substr(0, most), n.substr(0, most)), n});
  std::ranges::stable_sort(near, {}, [](const Near& n) { return std::pair(n.other, n.changed); });
  if (near.size() > 3) near.resize(3);
  std::vector<std::string_view> names;
  for (const auto& n : near) names.push_back(n.name);
  return names;
}

}  // namespace gonio
