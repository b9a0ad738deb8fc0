#include "brdf/cost/model_operations.h"

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/catalogue/registry.h"
#include "brdf/in_number/number.h"

namespace gonio {

Operations operations_of(const Model& m) {
  Operations sum;
  const auto add = [&](const Operations& o, std::size_t times) {
    for (std::size_t k = 0; k < times; ++k) sum += o;
  };
  const std::size_t n = m.channels;
  bool coupled = false;
  for (const auto& t : m.diffuse) {
    if (const auto* own = foreign_term(t.term))
      sum += operations_of(*own->function, n);
    else
      add(operations_of(t.term).sample, n);
    coupled |= catalogue()[t.term].coupled;
  }
  for (std::size_t l = 0; l < m.lobes.size(); ++l) {
    const auto d = operations_of(m.lobes[l].ndf.term), v = operations_of(m.lobes[l].masking.term),
               f = operations_of(m.lobes[l].fresnel.term);
    add(d.fraction, 1);
    add(v.fraction, 1);
    add(f.fraction, n);
    const bool under = coupled && l == 0;             // F (D V − diffuse) + diffuse
    const bool one_division = f.divides() && !under;  // D V F is one fraction
    const bool shared = d.divides() || v.divides();
    sum[Operation::mul] += 1 + (d.divides() && v.divides());
    sum[Operation::div] += shared && !one_division;
    sum[Operation::mul] += n * (1 + (one_division && shared));
    sum[Operation::div] += n * f.divides();
    sum[Operation::add] += under ? n : 0;
  }
  sum[Operation::add] += n * (m.diffuse.size() + m.lobes.size() - 1);
  return sum;
}

}  // namespace gonio
