// Image-based light: what the split sum's table, its samples and the split itself are off by, and
// the irradiance by the sums that renderers take.
#include <algorithm>
#include <array>
#include <numbers>

#include "integrate/light/irradiance.h"
#include "integrate/light/split_sum_light.h"
#include "integrate/light/split_sum_table.h"
#include "reports/energy/energy.h"
#include "timing/timing.h"

namespace gonio {
namespace {

constexpr std::string_view masking = "masking.smith_ggx.correlated";

void add_tables(ImageLight& to) {
  for (const std::size_t size : {16, 32, 64, 128}) {
    const auto exact = split_sum_table(masking, size, size);
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
  const auto exact = split_sum_table(masking, size, size);
  for (std::size_t n = 16; n <= 16384; n *= 4) {
    const auto off = difference(split_sum_table(masking, size, size, n), exact);
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

}  // namespace

ImageLight image_light(const EnergyOptions& o, const std::function<void(double)>& done) {
  ImageLight to;
  const double parts = 3 + 2 * static_cast<double>(o.environments.size());
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
  to.views = o.full ? 128 : 32;
  for (const auto& [name, map] : o.environments) {
    const SummedEnvironment light(map);
    for (const double roughness : {0.1, 0.25, 0.5, 0.75, 1.0})
      for (const double nov : {1.0, 0.5, 0.1}) {
        const auto views = lit_views(light, masking, roughness, nov, to.views);
        for (const double f0 : {0.04, 1.0}) {
          const auto e = split_sum_light_error(views, f0);
          const std::span all(views);
          const double half = split_sum_light_error(all.first(views.size() / 2), f0).of_mean;
          const double other = split_sum_light_error(all.subspan(views.size() / 2), f0).of_mean;
          to.lit.push_back({name, roughness, nov, f0, e.rms, e.max, e.bias, e.of_mean,
                            std::abs(half - other) / 2, e.truth});
        }
      }
    next();
    add_irradiance(
        to, name, [&](const Direction& d) { return map(d); },
        [&](const Direction& n) { return irradiance(map, n); });
    next();
  }
  return to;
}

}  // namespace gonio
