// What a compensation costs where a shader evaluates it: operations, table bytes and time.
#include <cmath>

#include "base/random.h"
#include "brdf/distributions.h"
#include "brdf/masking_terms.h"
#include "brdf/scattering.h"
#include "number/counted.h"
#include "optics/fresnel_approximate.h"
#include "reports/energy_parts.h"
#include "reports/timing.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// As a texture unit reads it: bilinear between texels' centres, the edges repeated, in float.
class Texture {
 public:
  static constexpr std::size_t size = 32;
  explicit Texture(float first) {
    for (std::size_t i = 0; i < size * size; ++i)
      texels_.push_back(first + 0.5F * static_cast<float>(i) / (size * size));
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

template <template <class> class Map>
std::size_t operations() {
  using C = Counted<double>;
  constexpr std::size_t n = Map<C>::parameters.size();
  std::array<C, n> p;
  for (std::size_t k = 0; k < n; ++k) p[k] = C(Map<C>::parameters[k].start);
  std::size_t sum = 0;
  for (const auto count : count_operations([&] { Map<C>::apply(p); }).by_kind) sum += count;
  return sum;
}

float single(const Point& p) {
  const std::array alpha{p.alpha};
  const auto d = Ggx<float>(alpha)(p.angles), v = SmithGgxCorrelated<float>(alpha)(p.angles);
  return d.num * v.num / (d.den * v.den) * Schlick<float>(std::array{p.f0})(p.angles);
}

}  // namespace

void add_costs(EnergyReport& report) {
  const Texture e(0.3F), average(0.3F), b(0.01F);
  const auto add = [&](std::string_view id, std::size_t count, std::size_t lookups,
                       std::size_t bytes, const Timing& without, const Timing& with) {
    CompensationCost c{id, count, lookups, bytes, without.ns, with.ns, with.spread_ns, 0, 0, ""};
    double squares = 0;
    std::size_t n = 0;
    for (const auto& m : report.materials)
      for (const auto& at : m.rows)
        for (const auto& s : at.scattering) {
          if (s.id != id) continue;
          const double off = s.albedo - at.truth;
          squares += off * off;
          ++n;
          if (std::abs(off) <= std::abs(c.worst)) continue;
          c.worst = off;
          c.worst_at = fmt::format("{}, roughness {:g}, {}", m.name, at.roughness,
                                   at.mu == 0 ? "on average" : fmt::format("mu {:g}", at.mu));
        }
    c.rms = n > 0 ? std::sqrt(squares / static_cast<double>(n)) : 0;
    report.compensations.push_back(c);
  };
  const auto kulla_conty = [&](const Point& p) {
    return KullaContyLobe<float>::apply(
        std::array{e(p.alpha, p.nol), e(p.alpha, p.nov), average(p.alpha, 0.5F), p.f0})[0];
  };
  const auto split_sum = [&](const Point& p) {
    return p.f0 * e(p.alpha, p.nov) + b(p.alpha, p.nov);
  };
  const Timing direct = per_point(single), image = per_point(split_sum);
  add("single", 0, 0, 0, direct, direct);
  for (const auto id : {"kulla_conty", "kulla_conty.linear"})
    add(id, operations<KullaContyLobe>(), 3, texture_bytes + line_bytes, direct,
        per_point([&](const Point& p) { return single(p) + kulla_conty(p); }));
  add("turquin", operations<Turquin>(), 1, texture_bytes, direct, per_point([&](const Point& p) {
        return Turquin<float>::apply(std::array{single(p), e(p.alpha, p.nov), p.f0})[0];
      }));
  // It stands on A and B, which are looked up without it too.
  add("fdez_aguera", operations<FdezAguera>(), 0, 0, image, per_point([&](const Point& p) {
        return FdezAguera<float>::apply(std::array{e(p.alpha, p.nov), b(p.alpha, p.nov), p.f0})[0];
      }));
}

}  // namespace gonio
