#include "reports/finding/facts.h"

namespace gonio {
namespace {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

std::optional<double> nearer_from(const Facts::Scattering& way, const Facts::Scattering& other) {
  std::optional<double> from;
  // delta_e is an upper end: that of the other has to be above it by its lower one.
  const auto least = [&](std::size_t i) {
    return other.delta_e[i] - (other.error.empty() ? 0 : 2 * other.error[i]);
  };
  for (std::size_t i = way.roughness.size(); i-- > 0 && way.delta_e[i] < least(i);)
    from = way.roughness[i];
  return from;
}

void join(Facts& to, const Facts& from) {
  if (from.setting) to.setting = from.setting;
  append(to.in_cache, from.in_cache);
  append(to.whole, from.whole);
  append(to.masking, from.masking);
  append(to.fresnel, from.fresnel);
  append(to.scattering, from.scattering);
  append(to.compensations, from.compensations);
  append(to.diffuse, from.diffuse);
  append(to.precision, from.precision);
  if (from.tails) to.tails = from.tails;
  if (from.split_sum) to.split_sum = from.split_sum;
}

}  // namespace gonio
