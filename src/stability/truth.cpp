// A subject in fifty digits, its angles from its inputs in as many.
#include "number/wide.h"
#include "stability/evaluate.h"
#include "stability/value_over.h"

namespace gonio::stability {

WideValue truth_of(const Subject& s, std::span<const double> inputs, bool condition) {
  std::vector<Wide> in(inputs.begin(), inputs.end());
  const auto value = [&] { return value_over<Wide>(s, in); };
  const Wide f = value(), step = 1e-20;
  const auto nearest = static_cast<double>(f);
  const auto rest = static_cast<double>(Wide(f - nearest));
  if (!condition) return {nearest, rest, 1};
  Wide sum = 0;
  for (auto& x : in) {
    if (x == 0) continue;
    const Wide before = x;
    x *= 1 - step;  // downwards: a cosine may be 1
    sum += abs(value() - f);
    x = before;
  }
  return {nearest, rest, static_cast<double>(Wide(sum / (step * abs(f))))};
}

}  // namespace gonio::stability
