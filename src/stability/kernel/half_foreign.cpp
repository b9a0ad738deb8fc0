// Compiled once per instruction set (GONIO_ARCH): people's own functions over columns of halves.
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/kernel/lane.h"
#include "foreign/interpret.h"
#include "number/half_lanes.h"
#include "stability/kernel/half_columns.h"

namespace gonio::stability {
inline namespace GONIO_ARCH {
namespace {

template <HalfRules rules>
void half_values_of(std::size_t slot, const Block<float>& x, const float* p, float* out) {
  using R = Lane<float>;
  using T = HalfOver<R, rules>;
  const ForeignTerm& t = *foreign_term(catalogue_size() + slot);
  thread_local std::array<std::pair<std::uint64_t, std::unique_ptr<foreign::Interpreter<T>>>,
                          most_foreign_terms>
      runs;
  auto& [id, run] = runs[slot];
  if (id != t.id) run = std::make_unique<foreign::Interpreter<T>>(t.program(), 512 / lanes<R>);
  id = t.id;
  std::vector<T> parameters;
  for (std::size_t k = 0; k < t.value_count; ++k) parameters.push_back(T(R(p[k])));
  run->set(parameters);
  const std::array<const float*, 5> own{x.nol, x.nov, x.noh, x.voh, x.sin2_theta_h};
  run->run(
      x.n / lanes<R>,
      [&](std::size_t k, std::size_t j) {
        const float* const column = k < own.size() ? own[k] : x.frame[k - own.size()];
        return T(load<R>(column + j * lanes<R>));
      },
      [&](std::size_t, std::size_t j, const T& v) { store<R>(out + j * lanes<R>, v.as_floats()); });
}

template <std::size_t slot, HalfRules rules>
void foreign_half_values(const Block<float>& x, const float* p, float* out) {
  half_values_of<rules>(slot, x, p, out);
}

template <std::size_t slot>
constexpr HalfByRules by_rules() {
  return []<std::size_t... k>(std::index_sequence<k...>) {
    return HalfByRules{foreign_half_values<slot, all_rules[k]>...};
  }
  (std::make_index_sequence<all_rules.size()>{});
}

}  // namespace

std::span<const HalfByRules> foreign_half_terms() {
  static constexpr auto table = []<std::size_t... slot>(std::index_sequence<slot...>) {
    return std::array{by_rules<slot>()...};
  }
  (std::make_index_sequence<most_foreign_terms>{});
  return table;
}

}  // namespace GONIO_ARCH
}  // namespace gonio::stability
