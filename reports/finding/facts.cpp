#include "reports/finding/facts.h"

namespace gonio {
namespace {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

void join(Facts& to, const Facts& from) {
  if (from.setting) to.setting = from.setting;
  append(to.in_cache, from.in_cache);
  append(to.streaming, from.streaming);
  append(to.masking, from.masking);
  append(to.fresnel, from.fresnel);
  append(to.scattering, from.scattering);
  append(to.compensations, from.compensations);
  append(to.diffuse, from.diffuse);
  append(to.precision, from.precision);
  append(to.tails, from.tails);
  if (from.split_sum) to.split_sum = from.split_sum;
}

}  // namespace gonio
