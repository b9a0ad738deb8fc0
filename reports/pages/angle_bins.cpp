#include "reports/pages/angle_bins.h"

#include <algorithm>
#include <cmath>

namespace gonio {
namespace {

std::vector<double> edges(std::size_t bins, bool quadratic) {
  std::vector<double> out;
  for (std::size_t i = 0; i <= bins; ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(bins);
    out.push_back(90 * (quadratic ? x * x : x));
  }
  return out;
}

std::size_t bin(double x, std::size_t bins) {
  const double i = std::floor(x * static_cast<double>(bins) + 1e-9);
  return static_cast<std::size_t>(std::clamp(i, 0.0, static_cast<double>(bins - 1)));
}

}  // namespace

std::vector<double> AngleBins::x_deg() const {
  return edges(x, kind == Grid::Kind::half_difference);
}
std::vector<double> AngleBins::y_deg() const {
  return edges(y, false);
}

std::size_t AngleBins::cell(const Angles<double>& a) const {
  const auto zenith = [](double cosine) {
    return std::acos(std::clamp(cosine, -1.0, 1.0)) / (90 * degree);
  };
  if (kind == Grid::Kind::in_out) return bin(zenith(a.nol), x) * y + bin(zenith(a.nov), y);
  const double theta_h = std::atan2(std::sqrt(a.sin2_theta_h), a.noh) / (90 * degree);
  return bin(std::sqrt(theta_h), x) * y + bin(zenith(a.voh), y);
}

}  // namespace gonio
