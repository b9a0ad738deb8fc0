// Every term in fifty digits.  The only source that pays for Boost.Multiprecision, and compiles
// each term once.
#include "number/wide.h"

#include <cmath>
#include <vector>

#include "brdf/in_number/terms_in.h"

namespace gonio {
namespace {

using Parameters = std::vector<Wide>;
using Row = FrameAngles<Wide>;

template <template <class> class Term>
void wide(const Parameters& p, std::span<const Row> rows, Wide* out) {
  static_assert(TermOver<Term<Wide>, Wide>);
  const Term<Wide> term{std::span<const Wide, Term<Wide>::parameters.size()>(p)};
  for (const auto& row : rows) *out++ = as_value<Wide>(term(row));
}

using WideTerm = decltype(&wide<Lambert>);

void values(WideTerm term,
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

template <template <class> class Term, bool g2>
void values(std::span<const double> parameters,
            std::span<const FrameAngles<double>> rows,
            double* out) {
  values(wide<Term>, g2, parameters, rows, out);
}
template <template <class> class... Terms>
constexpr auto values_of(TermList<Terms...>) {
  return std::array{
      TermIn{values<Terms, false>, is_masking<Terms<Wide>> ? &values<Terms, true> : nullptr}...};
}

struct Entry {
  WideTerm f;
  bool anisotropic;
};
template <template <class> class... Terms>
constexpr auto entries(TermList<Terms...>) {
  return std::array{Entry{wide<Terms>, is_anisotropic<Terms<Wide>>}...};
}

}  // namespace

template <>
CatalogueIn catalogue_in<Number::wide>() {
  static constexpr auto terms = values_of(Catalogue{});
  return {terms, maps_in<Wide>};
}

WideValue wide_value(std::size_t term,
                     std::span<const double> parameters,
                     const FrameAngles<double>& angles) {
  static constexpr auto all = entries(Catalogue{});
  const auto& t = all[term];
  Parameters p(parameters.begin(), parameters.end());
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
