// Image-based light: what the split sum's table, its samples and the split itself are off by, and
// the irradiance by the sums that renderers take.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/sampling.h"
#include "image/display.h"
#include "integrate/light/irradiance.h"
#include "integrate/light/prefiltered.h"
#include "integrate/light/split_sum_light.h"
#include "integrate/light/split_sum_table.h"
#include "reports/energy/energy.h"
#include "reports/energy/skies.h"
#include "reports/finding/names.h"
#include "timing/timing.h"

#include <tbb/task_arena.h>

namespace gonio {
namespace {

void add_tables(ImageLight& to) {
  for (const std::size_t size : {16, 32, 64, 128}) {
    const auto exact = split_sum_table(form_id::smith, size, size);
    for (const auto& [storage, name] :
         {std::pair{Storage::single, "float"}, {Storage::half, "half"}}) {
      const auto written = stored(exact, storage);
      const auto lookup = lookup_error(written, 101);
      to.tables.push_back({size, name, exact.error, difference(written, exact).e.max,
                           lookup.all.e.max, lookup.all.e.rms, lookup.between.e.max});
    }
  }
}

void add_samples(ImageLight& to) {
  constexpr std::size_t size = 16;
  const auto exact = split_sum_table(form_id::smith, size, size);
  for (std::size_t n = 16; n <= 16384; n *= 4) {
    const auto off = difference(split_sum_table(form_id::smith, size, size, n), exact);
    to.table_samples.push_back({n, off.a.max, off.a.rms, off.b.max, off.b.rms});
  }
}

void add_irradiance(ImageLight& to,
                    const std::string& light,
                    const Radiance& radiance,
                    const std::function<Rgb(const Direction&)>& exact) {
  static constexpr std::array<std::size_t, 5> counts{64, 256, 1024, 4096, 16384};
  for (const auto& e : irradiance_errors(radiance, exact, counts)) {
    const auto t = time_of([&] { sampled_irradiance(radiance, {0.6, 0, 0.8}, e.rule, e.samples); });
    to.irradiance.push_back(
        {light, name_of(e.rule), e.samples, e.rms, e.max, e.bias, t.ns, t.spread_ns});
  }
}

constexpr std::array roughnesses{0.1, 0.25, 0.5, 0.75, 1.0};
constexpr std::array cosines{1.0, 0.5, 0.1};

/// \param error  of each integral, relative
void add_lit(ImageLight& to, const ReportOptions::Light& light, double error) {
  const SummedEnvironment summed(light.map);
  const double exposure = exposure_for(light.map);
  for (const double roughness : roughnesses)
    for (const double nov : cosines) {
      const auto views = lit_views(summed, form_id::smith, roughness, nov, to.views, {error});
      for (const double f0 : {0.04, 1.0}) {
        const auto e = split_sum_light_error(views, f0);
        const std::span all(views);
        const double half = split_sum_light_error(all.first(views.size() / 2), f0).of_mean;
        const double other = split_sum_light_error(all.subspan(views.size() / 2), f0).of_mean;
        LitError row{light.name, roughness, nov,
                     f0,         e.rms,     e.max,
                     e.bias,     e.of_mean, std::abs(half - other) / 2,
                     e.truth,    0,         0};
        for (const auto& v : views) {
          const double d = displayed_difference(v.split(f0), v.exact(f0), exposure);
          row.delta_e += d / static_cast<double>(views.size());
          row.delta_e_max = std::max(row.delta_e_max, d);
        }
        to.lit.push_back(std::move(row));
      }
    }
}

/// Times of a pixel at roughness 0.5 and NoV 0.5: P, A and B looked up, and the integral itself, to 1 %.
std::vector<LightCost> light_costs(const Environment& map) {
  constexpr double roughness = 0.5, nov = 0.5;
  constexpr std::size_t pixels = 256;
  const auto table = split_sum_table(form_id::smith, 32, 32, 0, {1e-5});
  const auto light = prefiltered(LightPyramid(map), roughness * roughness);
  volatile double kept = 0;
  const auto looked_up = time_of([&] {
    double sum = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
      const auto [a, b] = table(nov, roughness);
      sum += light(spiral_direction(i, pixels))[1] * (0.04 * a + b);
    }
    kept = sum;
  });
  const SummedEnvironment summed(map);
  tbb::task_arena one_thread(1);
  const auto integrated = time_of([&] {
    one_thread.execute([&] {
      kept = lit_views(summed, form_id::smith, roughness, nov, 1, {1e-2})[0].exact_at[0][1];
    });
  });
  constexpr auto n = static_cast<double>(pixels);
  return {{"split sum", looked_up.ns / n, looked_up.spread_ns / n},
          {"quadrature", integrated.ns, integrated.spread_ns}};
}

}  // namespace

ImageLight image_light(const EnergyOptions& o, const std::function<void(double)>& done) {
  ImageLight to;
  const auto skies = synthetic_skies();
  const double parts = static_cast<double>(4 + skies.size() + 2 * o.environments.size());
  double finished = 0;
  const auto next = [&] { done(++finished / parts); };
  add_tables(to);
  next();
  add_samples(to);
  next();
  // A sky that grows brighter towards the zenith: E(n) = π + 2π n_z/3
  add_irradiance(
      to, "L = 1 + cos theta",
      [](const Direction& d) {
        const double l = 1 + d.z;
        return Rgb{l, l, l};
      },
      [](const Direction& n) {
        const double e = std::numbers::pi * (1 + 2 * n.z / 3);
        return Rgb{e, e, e};
      });
  next();
  to.views = o.views;
  for (const auto& light : skies) {
    add_lit(to, light, o.full ? 1e-3 : 5e-3);
    next();
  }
  to.costs = light_costs(skies.back().map);
  next();
  for (const auto& light : o.environments) {
    add_lit(to, light, 1e-3);
    next();
    add_irradiance(
        to, light.name, [&](const Direction& d) { return light.map(d); },
        [&](const Direction& n) { return irradiance(light.map, n); });
    next();
  }
  return to;
}

}  // namespace gonio
