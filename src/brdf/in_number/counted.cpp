// What every term costs.
#include <optional>

#include "brdf/in_number/terms_in.h"

namespace gonio {
namespace {

using C = Counted<double>;

template <template <class> class Term>
TermOperations cost() {
  // Formulas have no branches: any values are as good as these.
  constexpr std::size_t n = Term<C>::parameters.size();
  std::array<C, n> p;
  for (std::size_t k = 0; k < n; ++k) p[k] = C(Term<C>::parameters[k].start);
  const C c(0.5);
  const FrameAngles<C> angles{{c, c, c, c, c}, c, c, c, c, c, c};
  std::optional<Term<C>> term;
  TermOperations cost;
  cost.parameters = count_operations([&] { term.emplace(std::span<const C, n>(p)); });
  cost.sample = count_operations([&] { as_value<C>((*term)(angles)); });
  cost.fraction = count_operations([&] { as_quotient<C>((*term)(angles)); });
  return cost;
}
template <template <class> class... Terms>
constexpr auto costs(TermList<Terms...>) {
  return std::array{&cost<Terms>...};
}

}  // namespace

TermOperations operations_of(std::size_t term) {
  static constexpr auto all = costs(Catalogue{});
  return all[term]();
}

}  // namespace gonio
