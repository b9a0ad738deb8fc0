#include "brdf/catalogue/registry.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "base/nearest_names.h"
#include "brdf/catalogue/catalogue.h"
#include "brdf/catalogue/foreign_terms.h"
#include "brdf/catalogue/maps.h"
#include "brdf/catalogue/registry_parts.h"

#include <fmt/format.h>

namespace gonio {
namespace {

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
constexpr auto own_entries = term_table(Catalogue{});

/// The catalogue's own entries, then foreign ones; there is room for all of these, so that nothing moves.
struct Entries {
  std::array<TermEntry, own_entries.size() + most_foreign_terms> all{};
  std::atomic<std::size_t> count = own_entries.size();
  Entries() { std::ranges::copy(own_entries, all.begin()); }
};
Entries& entries() {
  static Entries e;
  return e;
}

}  // namespace

std::span<const TermEntry> catalogue() {
  const auto& e = entries();
  return std::span(e.all).first(e.count);
}

std::size_t catalogue_size() {
  return own_entries.size();
}

void set_term(std::size_t term, const TermEntry& entry) {
  auto& e = entries();
  e.all.at(term) = entry;
  e.count = std::max(e.count.load(), term + 1);
}

std::span<const MapEntry> maps() {
  return map_entries;
}

std::size_t find_term(std::string_view id) {
  if (is_foreign(id)) return foreign_term_named(id);
  const auto& term_entries = own_entries;
  if (const auto it = std::ranges::find(term_entries, id, &TermEntry::id); it != term_entries.end())
    return static_cast<std::size_t>(it - term_entries.begin());
  std::vector<std::string_view> ids;
  for (const auto& t : term_entries) ids.push_back(t.id());
  for (const auto& m : map_entries) ids.push_back(m.about->id);
  refuse_name(id, ids, "term");
}

std::size_t find_term(std::string_view id, Role role) {
  static constexpr std::string_view names[] = {"normal distribution", "masking", "Fresnel term",
                                               "diffuse term"};
  if (is_foreign(id)) return foreign_term_named(id, role);
  const auto& term_entries = own_entries;
  std::vector<std::string_view> ids;
  for (std::size_t t = 0; t < term_entries.size(); ++t) {
    const TermEntry& entry = term_entries[t];
    if (entry.role() != role) continue;
    ids.push_back(short_id(entry.id()));
    if (ids.back() == id || entry.id() == id) return t;
  }
  if (role == Role::diffuse &&
      std::ranges::any_of(term_entries, [&](const auto& t) { return short_id(t.id()) == id; }))
    throw wrong_usage(
        fmt::format("'{}' by itself is no diffuse term, and a lobe is NDF/MASKING/FRESNEL, as in "
                    "ggx/smith_ggx.correlated/schlick",
                    id));
  refuse_name(id, ids, names[static_cast<std::size_t>(role)]);
}

std::optional<std::size_t> find_map(std::string_view id) {
  for (std::size_t m = 0; m < map_entries.size(); ++m)
    if (map_entries[m].about->id == id) return m;
  return {};
}

void check_range(const Parameter& p, std::string_view name, double value) {
  if (p.legal.holds(value)) return;
  std::string unit;
  if (const auto at = p.meaning.rfind('['); at != p.meaning.npos)
    unit = fmt::format(" {}", p.meaning.substr(at + 1, p.meaning.rfind(']') - at - 1));
  if (unit == " rad" && std::abs(value) > p.legal.high && std::abs(value) <= 360)
    unit += fmt::format(" ({:g}° would be {:.3g})", value, value * std::numbers::pi / 180);
  throw wrong_usage(
      fmt::format("{} = {} is outside [{}, {}]{}", name, value, p.legal.low, p.legal.high, unit));
}

}  // namespace gonio
