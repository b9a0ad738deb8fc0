#include "brdf/catalogue/registry.h"
#include "brdf/function/any_function.h"
#include "brdf/function/functions.h"
#include "brdf/in_number/number.h"
#include "number/counted.h"

namespace gonio {

TermOperations operations_of(std::size_t term) {
  using C = Counted<double>;
  // Formulas have no branches: any values are as good as these.
  std::vector<C> p;
  for (const auto& q : catalogue()[term].parameters) p.push_back(C(q.start));
  const C c(0.5);
  const FrameAngles<C> angles{{c, c, c, c, c}, c, c, c, c, c, c};
  const auto f = any_function<C>(term);
  TermOperations cost;
  cost.parameters = count_operations([&] { f.rows(p, {}, nullptr); });
  Quotient<C> q;
  cost.fraction = count_operations([&] { q = f(p, angles); });
  for (std::size_t k = 0; k < operation_names.size(); ++k)
    cost.fraction.by_kind[k] -= cost.parameters.by_kind[k];
  cost.sample = cost.fraction;
  cost.sample += count_operations([&] { q.value(); });
  return cost;
}

}  // namespace gonio
