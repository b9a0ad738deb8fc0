#include "table/table.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace gonio {

double Axis::angle(double i, Bins bins) const {
  const double x = i + (bins == Bins::centre ? 0.5 : 0.0), n = static_cast<double>(size);
  switch (spacing) {
    case Spacing::uniform:
      return span * x / n;
    case Spacing::quadratic:
      return span * (x / n) * (x / n);
    case Spacing::inclusive:
      return span * i / (n - 1);
    case Spacing::constant:
      break;
  }
  return span;
}

double Axis::index(double angle, Bins bins) const {
  const double offset = bins == Bins::centre ? 0.5 : 0.0, n = static_cast<double>(size);
  switch (spacing) {
    case Spacing::uniform:
      return angle / span * n - offset;
    case Spacing::quadratic:
      return std::sqrt(std::max(angle, 0.0) / span) * n - offset;
    case Spacing::inclusive:
      return angle / span * (n - 1);
    case Spacing::constant:
      break;
  }
  return 0;
}

bool Table::has_bins() const {
  return grid() && std::ranges::any_of(grid()->axes, &Axis::has_bins);
}

SampleAngles::SampleAngles(const Table& t, Bins bins) : table_(t), bins_(bins) {
  if (const Grid* g = t.grid())
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t i = 0; i < g->axes[a].size; ++i)
        axes_[a].emplace_back(g->axes[a].angle(static_cast<double>(i), bins));
}

std::size_t SampleAngles::row_size() const {
  return table_.grid() ? axes_[2].size() : 1;
}

SampleAngles::Row::Row(const SampleAngles& at, std::size_t number)
    : at_(&at), first_(number * at.row_size()) {
  const Grid* g = at.table_.grid();
  if (!g || g->kind != Grid::Kind::half_difference) return;
  theta_h_ = &at.axes_[0][number / g->axes[1].size];
  theta_d_ = &at.axes_[1][number % g->axes[1].size];
}

DirectionPair SampleAngles::directions(std::size_t i) const {
  if (const auto* l = table_.list())
    return {direction(l->theta_i_deg[i] * degree, l->phi_i_deg[i] * degree),
            direction(l->theta_o_deg[i] * degree, l->phi_o_deg[i] * degree)};
  if (table_.grid()->kind == Grid::Kind::half_difference)
    return gonio::directions(half_difference(i));
  const auto [a, b, c] = table_.grid()->unravel(i);
  const SinCos &in = axes_[0][a], &out = axes_[1][b], &phi = axes_[2][c];
  return {{in.sin, 0, in.cos}, {out.sin * phi.cos, out.sin * phi.sin, out.cos}};
}

HalfDifference SampleAngles::half_difference(std::size_t i) const {
  const Grid* g = table_.grid();
  if (!g || g->kind != Grid::Kind::half_difference) return gonio::half_difference(directions(i));
  const auto at = g->unravel(i);
  const auto angle = [&](std::size_t a) {
    return g->axes[a].angle(static_cast<double>(at[a]), bins_);
  };
  return {angle(0), 0, angle(1), angle(2)};
}

Angles<double> SampleAngles::operator()(std::size_t i) const {
  const Grid* g = table_.grid();
  if (!g || g->kind != Grid::Kind::half_difference) return angles(directions(i));
  const auto [h, d, p] = g->unravel(i);
  return angles(axes_[0][h], axes_[1][d], axes_[2][p].cos);
}

double SampleAngles::theta_i(std::size_t i) const {
  if (const auto* l = table_.list()) return l->theta_i_deg[i] * degree;
  return std::acos(std::clamp((*this)(i).nol, -1.0, 1.0));
}

double Interpolator::operator()(const DirectionPair& p, std::size_t channel) const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Grid* g = table_.grid();
  if (!g) return table_.between ? table_.between(p, channel) : none;
  std::array<double, 3> angle;
  if (g->kind == Grid::Kind::half_difference) {
    const auto a = half_difference(p);
    angle = {a.theta_h, a.theta_d, a.phi_d < 0 ? a.phi_d + g->axes[2].span : a.phi_d};
  } else {
    const double phi = std::remainder(phi_of(p.wo) - phi_of(p.wi), 2 * std::numbers::pi);
    angle = {theta_of(p.wi), theta_of(p.wo), std::abs(phi)};
  }
  std::array<std::array<std::size_t, 2>, 3> corner;
  std::array<double, 3> part;
  for (std::size_t a = 0; a < 3; ++a) {
    const Axis& axis = g->axes[a];
    const auto size = static_cast<std::ptrdiff_t>(axis.size);
    const double x = axis.index(angle[a], g->bins), last = static_cast<double>(size - 1);
    if (!(x >= -1 && x <= last + 1)) return none;
    const bool periodic = axis.name == "phi_d" && axis.has_bins();
    const double inside = periodic ? x : std::clamp(x, 0.0, last);
    const auto low = static_cast<std::ptrdiff_t>(std::floor(inside));
    part[a] = inside - static_cast<double>(low);
    for (std::ptrdiff_t up = 0; up < 2; ++up) {
      const std::ptrdiff_t i = low + up;
      corner[a][static_cast<std::size_t>(up)] =
          static_cast<std::size_t>(periodic ? (i + size) % size : std::min(i, size - 1));
    }
  }
  double sum = 0, weight = 0;
  for (unsigned bits = 0; bits < 8; ++bits) {
    double w = 1;
    std::size_t i = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const unsigned up = (bits >> a) & 1U;
      w *= up ? part[a] : 1 - part[a];
      i = i * g->axes[a].size + corner[a][up];
    }
    const double v = table_.values[channel][i];
    if (w == 0 || mask(at_(i), v) != Mask::valid) continue;
    sum += w * v;
    weight += w;
  }
  return weight > 0.5 ? sum / weight : none;
}

}  // namespace gonio
