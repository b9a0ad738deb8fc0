#include "image/colour_difference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/direction.h"

namespace gonio {
namespace {

constexpr double pi = std::numbers::pi, turn = 2 * pi;

double power_7(double x) {
  const double x2 = x * x, x3 = x2 * x;
  return x3 * x3 * x;
}
/// √(c⁷/(c⁷ + 25⁷))
double of_25(double c) {
  return std::sqrt(power_7(c) / (power_7(c) + power_7(25)));
}
/// In [0, 2π); of grey 0.
double hue(double b, double a) {
  const double h = std::atan2(b, a);
  return h < 0 ? h + turn : h;
}

}  // namespace

Lab lab(const std::array<double, 3>& xyz, const std::array<double, 3>& white) {
  std::array<double, 3> f{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = xyz[i] / white[i];
    constexpr double part = 6.0 / 29;
    f[i] = t > part * part * part ? std::cbrt(t) : t / (3 * part * part) + 4.0 / 29;
  }
  return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

double delta_e_2000(const Lab& x, const Lab& y) {
  const double g = (1 - of_25((std::hypot(x.a, x.b) + std::hypot(y.a, y.b)) / 2)) / 2;
  const double ax = (1 + g) * x.a, ay = (1 + g) * y.a;
  const double cx = std::hypot(ax, x.b), cy = std::hypot(ay, y.b);
  const double hx = hue(x.b, ax), hy = hue(y.b, ay);

  const bool grey = cx * cy == 0;
  double dh = grey ? 0 : hy - hx;
  if (dh > pi) dh -= turn;
  if (dh < -pi) dh += turn;
  double h = hx + hy;  // the mean, across red where that is nearer; of grey the other's
  if (!grey) {
    if (std::abs(hx - hy) > pi) h += h < turn ? turn : -turn;
    h /= 2;
  }
  const double l = (x.l + y.l) / 2, c = (cx + cy) / 2;

  const double t = 1 - 0.17 * std::cos(h - 30 * degree) + 0.24 * std::cos(2 * h) +
                   0.32 * std::cos(3 * h + 6 * degree) - 0.20 * std::cos(4 * h - 63 * degree);
  const double from_50 = (l - 50) * (l - 50);
  const double blue = (h / degree - 275) / 25;
  const double turned = -std::sin(60 * degree * std::exp(-blue * blue)) * 2 * of_25(c);
  const double dl = (y.l - x.l) / (1 + 0.015 * from_50 / std::sqrt(20 + from_50));
  const double dc = (cy - cx) / (1 + 0.045 * c);
  const double dhue = 2 * std::sqrt(cx * cy) * std::sin(dh / 2) / (1 + 0.015 * c * t);
  return std::sqrt(dl * dl + dc * dc + dhue * dhue + turned * dc * dhue);
}

namespace {

using Triple = std::array<double, 3>;
Triple product(const std::array<Triple, 3>& rows, const Triple& v) {
  Triple out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) out[i] += rows[i][k] * v[k];
  return out;
}

/// Signal of the perceptual quantiser, the inverse of the display's curve [BT.2100-2, table 4].
double quantised(double light) {
  constexpr double m1 = 2610.0 / 16384, m2 = 2523.0 / 4096 * 128, c1 = 3424.0 / 4096,
                   c2 = 2413.0 / 4096 * 32, c3 = 2392.0 / 4096 * 32, most = 10'000;
  const double y = std::pow(std::clamp(light / most, 0.0, 1.0), m1);
  return std::pow((c1 + c2 * y) / (1 + c3 * y), m2);
}

}  // namespace

Itp itp(const std::array<double, 3>& rgb) {
  constexpr std::array<Triple, 3> to_2020{Triple{0.6274, 0.3293, 0.0433},  // BT.2087-0
                                          Triple{0.0691, 0.9195, 0.0114},
                                          Triple{0.0164, 0.0880, 0.8956}};
  constexpr std::array<Triple, 3> to_lms{Triple{1688, 2146, 262}, Triple{683, 2951, 462},
                                         Triple{99, 309, 3688}};
  Triple cones = product(to_lms, product(to_2020, rgb));
  for (double& v : cones) v = quantised(v / 4096);
  const auto [l, m, s] = cones;
  return {(l + m) / 2, (6610 * l - 13613 * m + 7003 * s) / 4096 / 2,
          (17933 * l - 17390 * m - 543 * s) / 4096};
}

double delta_e_itp(const Itp& a, const Itp& b) {
  return 720 * std::hypot(a.i - b.i, a.t - b.t, a.p - b.p);
}

}  // namespace gonio
