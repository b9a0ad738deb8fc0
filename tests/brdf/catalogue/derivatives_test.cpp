// Derivatives of every term by every parameter, where formulas are hardest: finite, and those of
// differences in fifty digits.
#include <cmath>
#include <limits>
#include <optional>

#include "brdf/hard_domain.h"
#include "brdf/in_number/number.h"

namespace gonio {
namespace {

using test::Parameters;
using test::Row;
using test::text;

/// ∂f/∂p by differences over few units of p's last digit, of values that have twice as many; none at an end,
/// and none for a value whose second half of digits is subnormal.
std::optional<double> slope_of_wide(std::size_t t, Parameters p, std::size_t k, const Row& row) {
  const double at = p[k];
  const auto difference = [&](int units) {
    const double h = units * std::abs(std::nextafter(at, HUGE_VAL) - at);
    const auto f = [&](double x) {
      p[k] = x;
      return wide_value(t, p, row);
    };
    const auto above = f(at + h), below = f(at - h);
    return ((above.value - below.value) + (above.rest - below.rest)) / ((at + h) - (at - h));
  };
  const auto& legal = catalogue()[t].parameters[k].legal;
  if (at <= legal.low / 1e3 || at == legal.low || at == legal.high || at == 1) return std::nullopt;
  const double near = difference(2), far = difference(4);
  // So near total reflection that a few digits reach beyond it, there is no telling.
  if (std::abs(near - far) > 1e-6 * std::abs(near)) return std::nullopt;
  return (4 * near - far) / 3;
}

constexpr double tiny = 1e-280;

/// Terms whose fifty digits cost a hundred times the others'.
bool is_dear(std::size_t t) {
  const auto id = catalogue()[t].id();
  return id.starts_with("masking.smith_gtr") || id.starts_with("masking.smith_student_t");
}

TEST(Derivatives, AreFiniteAndThoseOfDifferencesInFiftyDigitsWhereFormulasAreHardest) {
  std::size_t compared = 0;
  for (std::size_t t = 0; t < catalogue().size(); ++t) {
    const auto& term = catalogue()[t];
    test::HardDraws draws(t);
    double worst = 0;
    for (int i = 0; i < (is_dear(t) ? 4 : 60); ++i) {
      const Parameters p = draws.parameters(term.parameters);
      const Row row = draws.angles(term, p);
      const auto d = test::derivatives_of(t, p, {&row, 1});
      for (std::size_t k = 0; k < p.size(); ++k) {
        const double slope = d[1 + k][0];
        ASSERT_TRUE(std::isfinite(slope)) << term.id() << text(p) << " at " << text(row);
        if (term.as_shipped) continue;  // it may cancel all that it has
        const auto truth = slope_of_wide(t, p, k, row);
        if (!truth) continue;
        const double allowed = 1e-8 * (std::abs(*truth) + std::abs(d[0][0] / p[k]));
        ++compared;
        worst = std::max(worst, std::abs(slope - *truth) / (allowed + tiny));
        EXPECT_LE(std::abs(slope - *truth), allowed + tiny)
            << term.id() << text(p) << " by " << term.parameters[k].name << " at " << text(row)
            << ": " << slope << ", should be " << *truth;
      }
    }
    RecordProperty(std::string(term.id()), std::to_string(worst));
  }
  EXPECT_GT(compared, 1000U);
}

}  // namespace
}  // namespace gonio
