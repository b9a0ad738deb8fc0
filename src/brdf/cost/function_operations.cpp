#include <algorithm>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/cost/model_operations.h"
#include "foreign/interpret.h"

namespace gonio {

namespace {

Operations operations_of(const foreign::Program& p) {
  using C = Counted<double>;
  foreign::Interpreter<C> run(p);
  std::size_t count = 0;
  for (const auto& i : p.inputs)
    if (!i.of_sample) count = std::max(count, i.index + 1);
  run.set(std::vector<C>(count, C(0.5)));
  return count_operations([&] {
    run.run(
        1, [](std::size_t, std::size_t) { return C(0.5); },
        [](std::size_t, std::size_t, const C&) {});
  });
}

}  // namespace

Operations operations_of(const foreign::Function& f, std::size_t channels) {
  std::vector<const foreign::Program*> all;
  for (std::size_t c = 0; c < channels; ++c)
    all.push_back(&f.programs[f.programs.size() > 1 ? c : 0]);
  return operations_of(foreign::merged(all, [&](std::size_t channel, std::size_t k) {
    return k + (f.parameters[k].per_channel ? foreign_stride * channel : 0);
  }));
}

}  // namespace gonio
