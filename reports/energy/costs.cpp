// What a compensation costs where a shader evaluates it: operations, table bytes and time.
#include <cmath>

#include "base/random.h"
#include "brdf/catalogue/distributions.h"
#include "brdf/catalogue/masking_terms.h"
#include "brdf/formula/scattering.h"
#include "integrate/albedo/ggx_albedo.h"
#include "integrate/light/split_sum_table.h"
#include "number/counted.h"
#include "optics/fresnel_approximate.h"
#include "reports/energy/energy.h"
#include "timing/timing.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Texture as a texture unit reads it: bilinear between texels' centres, the edges repeated, in float.
class Texture {
 public:
  static constexpr std::size_t size = 32;
  explicit Texture(float first) {
    for (std::size_t i = 0; i < size * size; ++i)
      texels_.push_back(first + 0.5F * static_cast<float>(i) / (size * size));
  }
  /// Value of the first row alone.
  float along(float x) const {
    const auto [i, u] = place(x);
    return texels_[i] + u * (texels_[i + 1] - texels_[i]);
  }
  float operator()(float x, float y) const {
    const auto [i, u] = place(x);
    const auto [j, v] = place(y);
    const float* const t = texels_.data() + j * size + i;
    const float top = t[0] + u * (t[1] - t[0]), below = t[size] + u * (t[size + 1] - t[size]);
    return top + v * (below - top);
  }

 private:
  struct Place {
    std::size_t first;
    float part;
  };
  static Place place(float x) {
    const float at = std::clamp(x * size - 0.5F, 0.0F, size - 1.0F);
    const float first = std::min(std::floor(at), size - 2.0F);
    return {static_cast<std::size_t>(first), at - first};
  }
  std::vector<float> texels_;
};
constexpr std::size_t texture_bytes = Texture::size * Texture::size * 2,
                      line_bytes = Texture::size * 2;

/// A light and a view.
struct Point {
  float alpha, nol, nov, f0;
  Angles<float> angles;
};

std::vector<Point> points() {
  std::vector<Point> all;
  for (std::size_t i = 0; i < 1024; ++i) {
    Draws draw(1, i);
    const auto in = [&](double low) {
      return static_cast<float>(low + (1 - low) * draw.uniform());
    };
    Point p{in(0.05), in(0.05), in(0.05), in(0.04), {}};
    const float noh = in(0.3);
    p.angles = {p.nol, p.nov, noh, in(0.3), 1 - noh * noh};
    all.push_back(p);
  }
  return all;
}

/// One evaluation at each point [ns].
template <class F>
Timing per_point(const F& f) {
  static const auto all = points();
  volatile float kept = 0;
  auto t = time_of([&] {
    float sum = 0;
    for (const auto& p : all) sum += f(p);
    kept = sum;
  });
  const auto n = static_cast<double>(all.size());
  return {t.ns / n, t.spread_ns / n};
}

template <class Work>
std::size_t operations(const Work& work) {
  return count_operations(work).total();
}
/// Operations of a map, at any values: formulas have no branches.
template <template <class> class Map>
std::size_t operations() {
  using C = Counted<double>;
  constexpr std::size_t n = Map<C>::parameters.size();
  std::array<C, n> p;
  for (std::size_t k = 0; k < n; ++k) p[k] = C(Map<C>::parameters[k].start);
  return operations([&] { Map<C>::apply(p); });
}

float single(const Point& p) {
  const std::array alpha{p.alpha};
  const auto d = Ggx<float>(alpha)(p.angles), v = SmithGgxCorrelated<float>(alpha)(p.angles);
  return d.num * v.num / (d.den * v.den) * Schlick<float>(std::array{p.f0})(p.angles);
}

/// Time of a light and view, as it is and compensated.
struct CompensationTime {
  std::string_view id;
  Timing without, with;
};
std::vector<CompensationTime> measured_times() {
  const Texture e(0.3F), b(0.01F), average(0.3F);
  const auto kulla_conty = [&](const Point& p) {
    return KullaContyLobe<float>::apply(std::array{
        e(p.alpha, p.nol), e(p.alpha, p.nov), average.along(p.alpha), schlick_average(p.f0)})[0];
  };
  const auto split_sum = [&](const Point& p) {
    return p.f0 * e(p.alpha, p.nov) + b(p.alpha, p.nov);
  };
  const Timing direct = per_point(single), image = per_point(split_sum);
  return {
      {"single", direct, direct},
      {"kulla_conty", direct,
       per_point([&](const Point& p) { return single(p) + kulla_conty(p); })},
      {"turquin", direct, per_point([&](const Point& p) {
         return Turquin<float>::apply(std::array{single(p), e(p.alpha, p.nov), p.f0})[0];
       })},
      {"fdez_aguera", image, per_point([&](const Point& p) {
         return FdezAguera<float>::apply(std::array{e(p.alpha, p.nov), b(p.alpha, p.nov), p.f0})[0];
       })}};
}

}  // namespace

std::vector<CompensationWork> compensation_work() {
  const auto colour = operations([] { schlick_average(Counted<double>(0.5)); });
  return {{"single", 0, 0, 0},
          {"kulla_conty", operations<KullaContyLobe>() + colour, 3, texture_bytes + line_bytes},
          {"turquin", operations<Turquin>(), 1, texture_bytes},
          // It stands on A and B, which are looked up without it too.
          {"fdez_aguera", operations<FdezAguera>(), 0, 0}};
}

std::vector<CompensationCost> compensation_costs(const std::vector<EnergyMaterial>& materials) {
  std::vector<CompensationCost> out;
  const auto errors = compensation_errors(materials);
  const auto all = compensation_work();
  // Reports that stand beside each other have the same times.
  static const auto times = measured_times();
  for (const auto& [id, without, with] : times) {
    const auto& error = *std::ranges::find(errors, id, &CompensationError::id);
    const auto& work = *std::ranges::find(all, id, &CompensationWork::id);
    out.push_back({id, work.operations, work.lookups, work.bytes, without.ns, without.spread_ns,
                   with.ns, with.spread_ns, error.worst, error.rms, error.worst_at,
                   error.gold_rms});
  }
  return out;
}

std::vector<AlbedoForm> albedo_form_errors() {
  std::vector<AlbedoForm> out;
  std::vector<double> alpha, mu;
  for (int i = 0; i <= 95; ++i) alpha.push_back(std::pow(0.05 + 0.01 * i, 2));
  for (int i = 1; i <= 200; ++i) mu.push_back(0.005 * i);
  const auto truth = ggx_albedo_table(alpha, mu);
  const auto add = [&](std::string_view id, std::size_t count, const auto& form) {
    AlbedoForm f{id, 0, 0, "", count, 0};
    for (std::size_t a = 0; a < alpha.size(); ++a)
      for (std::size_t m = 0; m < mu.size(); ++m) {
        const double off = form(alpha[a], mu[m]) - truth[a * mu.size() + m].value;
        f.rms += off * off / static_cast<double>(truth.size());
        if (std::abs(off) <= std::abs(f.worst)) continue;
        f.worst = off;
        f.worst_at = fmt::format("roughness {:.2f}, cosine {:g}", std::sqrt(alpha[a]), mu[m]);
      }
    f.rms = std::sqrt(f.rms);
    out.push_back(f);
  };
  add("scattering.albedo_fit", operations<AlbedoFit>(),
      [](double a, double m) { return mapped<AlbedoFit, double>(a, m)[0]; });
  add("scattering.albedo_fit.materialx", operations<AlbedoFitMaterialx>(),
      [](double a, double m) { return mapped<AlbedoFitMaterialx, double>(a, m)[0]; });
  const auto table = stored(
      split_sum_table("masking.smith_ggx.correlated", Texture::size, Texture::size), Storage::half);
  add("32 × 32 texels in half, bilinear", 0, [&](double a, double m) {
    const auto [first, second] = table(m, std::sqrt(a));
    return first + second;
  });
  out.back().bytes = texture_bytes;
  return out;
}

}  // namespace gonio
