#include "table/table.h"

#include <algorithm>
#include <limits>

#include "table/grid_cell.h"

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
  if (table_.grid()) return cell_around(table_, at_, p).mean_of(table_.values[channel]);
  return table_.between ? table_.between(p, channel) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace gonio
