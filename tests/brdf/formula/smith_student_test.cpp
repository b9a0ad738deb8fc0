// Smith masking for Student's t against its ends, its closed form and the facets that it counts.
#include "brdf/formula/smith_student.h"

#include <cmath>

#include "brdf/terms.h"
#include "constants.h"
#include "integrate/rule/quadrature.h"
#include "number/wide.h"

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>

namespace gonio {
namespace {

using test::eps;
using test::pi;

constexpr double student_cosines[] = {1e-8, 1e-3, 0.05, 0.2, 0.5, 0.8, 0.99, 1 - 1e-9, 1};
constexpr double student_alphas[] = {1e-4, 0.01, 0.2, 0.6, 1};

/// V where light and view have these student_cosines.
double student_visibility(std::string_view id, const test::Parameters& p, double nol, double nov) {
  return test::value_of(find_term(id), p, {nol, nov, 0.5, 0.5, 0.75});
}

TEST(SmithStudent, IsThatOfGgxAndOfBeckmannAtItsEnds) {
  for (const std::string how : {".separable", ".correlated"})
    for (const double alpha : student_alphas)
      for (const double l : student_cosines)
        for (const double v : student_cosines) {
          const auto of = [&](std::string_view shape, const test::Parameters& p) {
            return student_visibility(std::string("masking.smith_").append(shape) + how, p, l, v);
          };
          const double ggx = of("ggx", {alpha}), beckmann = of("beckmann", {alpha});
          EXPECT_NEAR(of("student_t", {alpha, 1}), ggx, 2e-11 * ggx)
              << alpha << " " << l << " " << v;
          EXPECT_NEAR(of("student_t", {alpha, 0}), beckmann, 32 * eps * beckmann)
              << alpha << " " << l << " " << v;
        }
}

/// c Λ in closed form: both parts of K by the tail of Student's t, in fifty digits, for they cancel.
Wide c_lambda(double alpha, double tail, double c) {
  const Wide tau = tail, w = Wide(alpha) * sqrt((1 - Wide(c)) * (1 + Wide(c))), a = c / w;
  const Wide gamma = 1 + 1 / tau, grown = 1 + tau * a * a;
  const Wide k = sqrt(tau / gonio::pi<Wide>()) * boost::math::tgamma(Wide(gamma - Wide(1) / 2)) /
                 boost::math::tgamma(Wide(gamma - 1));
  const Wide first = k / (2 * tau * (gamma - Wide(3) / 2)) * pow(grown, Wide(3) / 2 - gamma);
  return w * (first - a * boost::math::ibeta(Wide(1 / tau), Wide(1) / 2, Wide(1 / grown)) / 2);
}

TEST(SmithStudent, IsItsClosedFormToTheFiguresThatItPromises) {
  for (const double tail : {0.1, 0.4, 0.9, 1.0, 1.2, 1.5})
    for (const double alpha : {0.05, 0.4, 1.0})
      for (const double c : {1e-6, 0.01, 0.1, 0.4, 0.7, 0.95}) {
        const Wide truth = c_lambda(alpha, tail, c);
        if (truth < 1e-30) continue;  // fifty digits cancelled
        const StudentCLambda<double> found{std::array{alpha, tail}};
        const auto error = static_cast<double>(abs(found(c) / truth - 1));
        EXPECT_LT(error, tail <= 1 ? 2e-11 : 2e-9) << tail << " " << alpha << " " << c;
      }
}

TEST(SmithStudent, HasSlopesByItsTailThroughBothEnds) {
  // a central difference across τ = 1, and a one-sided one at τ = 0 of two steps
  const auto at = test::framed({0.3, 0.2, 0.5, 0.5, 0.75});
  for (const auto* id :
       {"masking.smith_student_t.separable", "masking.smith_student_t.correlated"}) {
    const auto t = find_term(id);
    const auto v = [&](double tail) { return test::value_at(t, {0.5, tail}, at); };
    const auto slope = [&](double tail) {
      return test::derivatives_of(t, {0.5, tail}, {&at, 1})[2][0];
    };
    EXPECT_NEAR(slope(1), (v(1 + 1e-4) - v(1 - 1e-4)) / 2e-4, 1e-6 * std::abs(slope(1)));
    const double h = 1e-4, near = (v(h) - v(0)) / h, far = (v(2 * h) - v(0)) / (2 * h);
    EXPECT_NEAR(slope(0), 2 * near - far, 1e-5 * std::abs(slope(0)));
  }
}

TEST(SmithStudent, MasksMoreTheLongerTheTailAtGrazingAngles) {
  for (const double alpha : {0.1, 0.5})
    for (double tail = 0.1; tail < 1.55; tail += 0.1)
      EXPECT_LT(
          student_visibility("masking.smith_student_t.separable", {alpha, tail}, 1, 0.05),
          student_visibility("masking.smith_student_t.separable", {alpha, tail - 0.1}, 1, 0.05));
}

}  // namespace
}  // namespace gonio
