#include "brdf/catalogue/registry.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "base/error.h"
#include "brdf/catalogue/catalogue.h"
#include "brdf/catalogue/maps.h"

#include <fmt/format.h>

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

/// Throws wrong usage naming those of `ids` that are nearest.
[[noreturn]] void refuse(std::string_view id,
                         std::span<const std::string_view> ids,
                         std::string_view what) {
  std::vector<std::pair<std::size_t, std::string_view>> near;
  for (const auto known : ids) near.emplace_back(distance(id, known), known);
  std::ranges::stable_sort(near, {}, [](const auto& p) { return p.first; });
  if (near.size() > 3) near.resize(3);
  std::vector<std::string_view> names;
  for (const auto& n : near) names.push_back(n.second);
  throw wrong_usage(fmt::format("no {} '{}'; nearest: {}", what, id, fmt::join(names, ", ")));
}

template <template <class> class Map>
constexpr MapEntry map_entry() {
  static_assert(MapOver<Map<double>, double>);
  return {&Map<double>::about, Map<double>::parameters, Map<double>::outputs};
}
template <template <class> class... M>
constexpr auto map_table(MapList<M...>) {
  return std::array{map_entry<M>()...};
}
constexpr auto map_entries = map_table(Maps{});

template <template <class> class Term>
constexpr TermEntry term_entry() {
  static_assert(TermOver<Term<double>, double>);
  bool coupled = false;
  if constexpr (role_of(Term<double>::about.id) == Role::diffuse) coupled = Term<double>::coupled;
  return {&Term<double>::about,         Term<double>::parameters,    coupled,
          is_anisotropic<Term<double>>, is_as_shipped<Term<double>>, is_fraction<Term, double>};
}
template <template <class> class... Terms>
constexpr auto term_table(TermList<Terms...>) {
  return std::array{term_entry<Terms>()...};
}
constexpr auto term_entries = term_table(Catalogue{});

}  // namespace

std::span<const TermEntry> catalogue() {
  return term_entries;
}

std::span<const MapEntry> maps() {
  return map_entries;
}

std::size_t find_term(std::string_view id) {
  std::vector<std::string_view> ids;
  for (const auto& t : catalogue()) ids.push_back(t.about->id);
  if (const auto it = std::ranges::find(ids, id); it != ids.end())
    return static_cast<std::size_t>(it - ids.begin());
  for (const auto& m : maps()) ids.push_back(m.about->id);
  refuse(id, ids, "term");
}

std::size_t find_term(std::string_view id, Role role) {
  static constexpr std::string_view names[] = {"normal distribution", "masking", "Fresnel term",
                                               "diffuse term"};
  std::vector<std::string_view> ids;
  const auto terms = catalogue();
  for (std::size_t t = 0; t < terms.size(); ++t) {
    if (role_of(terms[t].about->id) != role) continue;
    ids.push_back(short_id(terms[t].about->id));
    if (ids.back() == id || terms[t].about->id == id) return t;
  }
  if (role == Role::diffuse &&
      std::ranges::any_of(terms, [&](const auto& t) { return short_id(t.about->id) == id; }))
    throw wrong_usage(
        fmt::format("'{}' alone is no diffuse term, and a lobe is NDF/MASKING/FRESNEL, as in "
                    "ggx/smith_ggx.correlated/schlick",
                    id));
  refuse(id, ids, names[static_cast<int>(role)]);
}

std::optional<std::size_t> find_map(std::string_view id) {
  const auto all = maps();
  for (std::size_t m = 0; m < all.size(); ++m)
    if (all[m].about->id == id) return m;
  return {};
}

void check_range(const Parameter& p, std::string_view name, double value) {
  if (!p.legal.holds(value))
    throw wrong_usage(
        fmt::format("{} = {} is outside [{}, {}]", name, value, p.legal.low, p.legal.high));
}

}  // namespace gonio
