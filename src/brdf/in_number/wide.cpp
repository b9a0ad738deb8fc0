// Every Fresnel, diffuse term and map in fifty digits, and what is asked of terms in that number
// alone.
#include "brdf/in_number/wide.h"

#include <cmath>

#include "brdf/catalogue/diffuse_terms.h"
#include "brdf/catalogue/fresnel_terms.h"
#include "brdf/catalogue/maps.h"
#include "brdf/function/functions.h"

namespace gonio {

GONIO_TERMS_IN_WIDE(Role::fresnel, FresnelTerms)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Wide)
GONIO_TERMS_IN_WIDE(Role::diffuse, DiffuseTerms)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Wide)

std::span<const MapIn> maps_in_wide() {
  static constexpr auto all = table_in<Wide>(Maps{});
  return all;
}

namespace {

using Row = FrameAngles<Wide>;

const WideEntry& wide_term(std::size_t term) {
  static const auto all = [] {
    std::vector<WideEntry> terms;
    for (const auto role : {wide_terms<Role::ndf>(), wide_terms<Role::masking>(),
                            wide_terms<Role::fresnel>(), wide_terms<Role::diffuse>()})
      terms.insert(terms.end(), role.begin(), role.end());
    return terms;
  }();
  return all[term];
}

}  // namespace

void wide_values(WideTerm term,
                 bool g2,
                 std::span<const double> parameters,
                 std::span<const FrameAngles<double>> rows,
                 double* out) {
  std::vector<Row> wide_rows;
  for (const auto& row : rows) wide_rows.push_back(angles_in<Wide>(row));
  std::vector<Wide> f(rows.size());
  term({parameters.begin(), parameters.end()}, wide_rows, f.data());
  for (std::size_t i = 0; i < rows.size(); ++i)
    out[i] = static_cast<double>(g2 ? g2_of<Wide>(f[i], wide_rows[i]) : f[i]);
}

WideValue wide_value(std::size_t term,
                     std::span<const double> parameters,
                     const FrameAngles<double>& angles) {
  const auto& t = wide_term(term);
  std::vector<Wide> p(parameters.begin(), parameters.end());
  Row row = angles_in<Wide>(angles);
  const auto value = [&] {
    Wide f;
    t.f(p, {&row, 1}, &f);
    return f;
  };
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
  if (t.anisotropic)
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
