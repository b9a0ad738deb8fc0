// Every Fresnel, diffuse term and map in fifty digits, and what is asked of terms in that number
// alone.
#include "number/wide.h"

#include <cmath>

#include "brdf/catalogue/diffuse_terms.h"
#include "brdf/catalogue/fresnel_terms.h"
#include "brdf/catalogue/maps.h"
#include "brdf/in_number/conversion.h"
#include "brdf/in_number/number.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Wide)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Wide)
GONIO_MAPS_AS_FUNCTIONS(Wide)

std::vector<double> values_over_wide(std::size_t term,
                                     bool g2,
                                     std::span<const double> parameters,
                                     std::span<const FrameAngles<double>> rows) {
  return values_over<Wide>(term, g2, parameters, rows);
}
std::vector<double> map_over_wide(std::size_t map, std::span<const double> parameters) {
  return map_over<Wide>(map, parameters);
}

WideValue wide_value(std::size_t term,
                     std::span<const double> parameters,
                     const FrameAngles<double>& angles) {
  using Row = FrameAngles<Wide>;
  auto p = numbers_in<Wide>(parameters);
  Row row = angles_in<Wide>(angles);
  const auto value = [&] { return any_function<Wide>(term)(p, row).value(); };
  const Wide f = value(), step = 1e-20;
  Wide sum = 0;
  const auto move = [&](Wide& x) {
    if (x == 0) return;
    const Wide before = x;
    x *= 1 + step;
    sum += abs(value() - f);
    x = before;
  };
  for (Wide& x : p) move(x);
  for (Wide Row::*x : {&Row::nol, &Row::nov, &Row::noh, &Row::voh, &Row::sin2_theta_h})
    move(row.*x);
  if (catalogue()[term].anisotropic)
    for (Wide Row::*x : {&Row::xoh, &Row::yoh, &Row::xol, &Row::yol, &Row::xov, &Row::yov})
      move(row.*x);
  const auto nearest = static_cast<double>(f);
  return {nearest, static_cast<double>(Wide(f - nearest)),
          static_cast<double>(Wide(sum / (step * abs(f))))};
}

double WideValue::relative_error(double x) const {
  if (value == 0) return x == 0 ? 0 : 1;
  return std::abs(((x - value) - rest) / value);
}

}  // namespace gonio
