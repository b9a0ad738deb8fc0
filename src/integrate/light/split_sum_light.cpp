#include "integrate/light/split_sum_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "geometry/half_difference.h"
#include "geometry/sampling.h"
#include "integrate/rule/slopes.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// weight(NoL) · values(block) at each direction above the horizon of n, 0 below.
template <class Values>
Gather above_horizon(const Frame& surface, const Direction& v, Values values) {
  return [=](std::span<const Direction> at, std::span<double* const> out) {
    AngleBlock block(false);
    const auto x = block.resize(at.size());
    std::vector<double> nol(at.size());
    for (std::size_t i = 0; i < at.size(); ++i) {
      const Direction l = surface.inside(at[i]);
      nol[i] = std::max(l.z, 0.0);
      // below the horizon any angles will do
      const auto a = angles({l.z > 0 ? l : Direction{}, v});
      const double columns[] = {std::min(a.nol, 1.0), a.nov, a.noh, std::min(a.voh, 1.0),
                                a.sin2_theta_h};
      for (std::size_t k = 0; k < 5; ++k) x[k][i] = columns[k];
    }
    std::vector<double*> columns;
    for (std::size_t f = 0; f < out.size(); ++f) columns.push_back(block.extra(f));
    values(block.block(), std::span<double* const>(columns));
    for (std::size_t f = 0; f < out.size(); ++f)
      for (std::size_t i = 0; i < at.size(); ++i) out[f][i] = columns[f][i] * nol[i];
  };
}

Rgb scaled(double x, const Rgb& a) {
  return {x * a[0], x * a[1], x * a[2]};
}
Rgb mixed(double x, const Rgb& a, double y, const Rgb& b) {
  return {x * a[0] + y * b[0], x * a[1] + y * b[1], x * a[2] + y * b[2]};
}

}  // namespace

Rgb LitView::exact(double at_f0) const {
  const double part = (at_f0 - f0[0]) / (f0[1] - f0[0]);
  return mixed(1 - part, exact_at[0], part, exact_at[1]);
}
Rgb LitView::split(double at_f0) const {
  return scaled(at_f0 * a + b, prefiltered);
}

double prefilter_weight(double alpha) {
  const double a2 = alpha * alpha, q = (1 - a2) / (1 + a2);
  const double s = q > 1e-5 ? -(std::log1p(-q) + q) / (q * q) : 0.5 + q / 3;
  return (1 - (1 - q) * s) / (1 + a2);
}

std::vector<LitView> lit_views(const SummedEnvironment& light,
                               std::string_view masking,
                               double roughness,
                               double nov,
                               std::size_t views,
                               const RelativeGoal& goal) {
  const auto table = split_sum(masking, roughness, {{nov}})[0];
  const auto model = two_interfaces(masking, roughness, LitView::f0);
  const double alpha = roughness * roughness;
  const auto& ndf = model.model.lobes[0].ndf;
  const auto ndf_parameters = term_parameters(model, ndf, 0);
  const double per_weight = 1 / (4 * prefilter_weight(alpha));
  const Direction v{std::sqrt((1 - nov) * (1 + nov)), 0, nov}, mirror{-v.x, 0, nov};

  std::vector<LitView> all(views);
  tbb::parallel_for(std::size_t{0}, views, [&](std::size_t i) {
    const Frame surface(spiral_direction(i, views),
                        static_cast<double>(i) * std::numbers::phi * 2 * std::numbers::pi);
    const Direction r = surface.outside(mirror);
    const auto exact =
        gather(light,
               above_horizon(surface, v,
                             [&](const Block<double>& x, std::span<double* const> out) {
                               evaluate<double>(model.model, model.values, x, out);
                             }),
               2, {surface.z, r, alpha * nov}, goal);
    const auto prefiltered =
        gather(light,
               above_horizon(Frame(r), Direction{},
                             [&](const Block<double>& x, std::span<double* const> out) {
                               term_values(ndf.term, ndf_parameters, x, out[0]);
                               std::transform(out[0], out[0] + x.n, out[0],
                                              [&](double d) { return d * per_weight; });
                             }),
               1, {r, r, alpha}, goal);
    all[i] = {{exact.value[0], exact.value[1]},
              prefiltered.value[0],
              table.a,
              table.b,
              exact.error + prefiltered.error};
  });
  return all;
}

SplitSumLightError split_sum_light_error(std::span<const LitView> views, double f0) {
  SplitSumLightError e;
  double absolute2 = 0;
  for (const auto& v : views) {
    const Rgb exact = v.exact(f0), split = v.split(f0);
    const double of = luminance(exact), off = luminance(split) - of;
    if (!(of > 0)) continue;
    e.rms += square(off / of);
    e.bias += off / of;
    e.max = std::max(e.max, std::abs(off / of));
    absolute2 += square(off);
    e.truth = std::max(e.truth, v.error);
    e.exact = mixed(1, e.exact, 1, exact);
    e.split = mixed(1, e.split, 1, split);
    ++e.views;
  }
  if (e.views == 0) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    e.rms = e.max = e.bias = e.of_mean = e.truth = unknown;
    return e;
  }
  const auto n = static_cast<double>(e.views);
  e.rms = std::sqrt(e.rms / n);
  e.bias /= n;
  e.exact = scaled(1 / n, e.exact);
  e.split = scaled(1 / n, e.split);
  e.of_mean = std::sqrt(absolute2 / n) / luminance(e.exact);
  return e;
}

}  // namespace gonio
