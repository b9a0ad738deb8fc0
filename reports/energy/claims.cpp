// What is said of highlights and of energy, judged by the figures of the report and by integrals of
// its own.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "brdf/catalogue/registry.h"
#include "geometry/direction.h"
#include "image/colour_difference.h"
#include "integrate/albedo/directional_albedo.h"
#include "integrate/rule/quadrature.h"
#include "integrate/rule/slopes.h"
#include "reports/energy/parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

constexpr double pi = std::numbers::pi;
using Judged = Claim::Judged;

/// E of a model at a cosine, to 1e-6.
double reflected(std::string_view spec, double roughness, double f0, double mu) {
  const auto b = bind_model(spec, {{"alpha", {roughness * roughness}}, {"f0", {f0}}}, 1);
  return directional_albedo(b, {&mu, 1}, 0, {1e-6, 400'000})[0].value[0];
}

void no_light_is_made(EnergyReport& r) {
  if (r.forms.empty()) return;
  std::vector<std::pair<double, std::string>> makers;
  double largest = 0;  // of those that do not
  for (const auto& f : r.forms) {
    const auto& at = brightest(f);
    if (makes_light(f))
      makers.emplace_back(at.albedo, fmt::format("{} {:.3g} times at roughness {:g}, mu {:g}",
                                                 f.name, at.albedo, at.roughness, at.mu));
    else
      largest = std::max(largest, at.albedo);
  }
  std::ranges::sort(makers, std::greater{});
  std::vector<std::string> words;
  for (const auto& [value, text] : makers)
    if (words.size() < 3) words.push_back(text);
  judge(r, "reflected energy never exceeds incoming", "seeds 000 and 001, conservation of energy",
        makers.empty() ? Judged::holds : Judged::partly,
        fmt::format("at F = 1, {} of {} forms reflect more than comes in somewhere{}{}; the "
                    "others reflect {:.4f} of it at most.",
                    makers.empty() ? "none" : fmt::format("{}", makers.size()), r.forms.size(),
                    words.empty() ? "" : ", most ", fmt::join(words, ", "), largest));
}

void energy_does_not_stay(EnergyReport& r) {
  const auto* f = find_form(r, "masking.smith_ggx.correlated");
  if (!f || f->averages.empty()) return;
  const auto &smooth = f->averages.front(), &rough = f->averages.back();
  judge(r, "as roughness grows the highlight widens and dims so that energy stays",
        "seed 001, conservation of energy", rough.albedo > 0.99 ? Judged::holds : Judged::fails,
        fmt::format("it widens and dims more than that. With nothing absorbed (GGX, Smith "
                    "correlated, F = 1, one bounce, average over the hemisphere) {} of the light "
                    "leaves at roughness {:g} and {} at roughness {:g}; what is missing met a "
                    "second facet.",
                    percent(smooth.albedo), smooth.roughness, percent(rough.albedo),
                    rough.roughness));
}

void fixed_coat(EnergyReport& r) {
  const auto *coat = find_form(r, "masking.disney_coat, gamma 1"),
             *smith = find_form(r, "masking.smith_gtr.separable, gamma 1");
  if (!coat || !smith) return;
  double most = 0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < coat->rows.size(); ++i) {  // the same rows, as far as the coat's go
    const double off = std::abs(coat->rows[i].albedo - smith->rows[i].albedo);
    if (coat->rows[i].mu >= 0.1 && off > most) most = off, at = i;
  }
  const auto& row = coat->rows[at];
  judge(r, "the coat needs only a fixed 0.25 G", "seed 001, Disney's secondary lobe",
        most < 0.01  ? Judged::holds
        : most < 0.1 ? Judged::partly
                     : Judged::fails,
        fmt::format("as it ships (GTR of gamma 1, alpha up to 0.1) it is, from mu = 0.1 on, "
                    "furthest from its own Smith masking at roughness {:g}, mu {:g}: before "
                    "Fresnel it reflects {} instead of {}.",
                    row.roughness, row.mu, percent(row.albedo), percent(smith->rows[at].albedo)));
}

void clamped_at_2048(EnergyReport& r) {
  // D without 1/π is 1/α² at its peak.
  const double reached = std::pow(2048.0, -0.25);
  std::vector<std::string> words;
  double most = 0;
  for (const double roughness : {0.14, 0.1, 0.07, 0.045}) {
    const auto shipped = reflected("ggx.ue_mobile/smith_ggx.correlated/constant", roughness, 1, 1);
    const auto whole = reflected("ggx/smith_ggx.correlated/constant", roughness, 1, 1);
    const double lost = 1 - shipped / pi / whole;
    most = std::max(most, lost);
    words.push_back(fmt::format("{} at {:g} (the peak to {})", percent(lost), roughness,
                                percent(2048 * std::pow(roughness, 4))));
  }
  judge(r, "the clamp at 2048 hardly shows", "seed 004, D_GGX_R2",
        most < 0.01  ? Judged::holds
        : most < 0.1 ? Judged::partly
                     : Judged::fails,
        fmt::format("it is reached below roughness {:.3f} alone. There it takes light from the "
                    "highlight, at normal incidence {}.",
                    reached, fmt::join(words, ", ")));
}

/// Of a reflectance under even light.
Lab grey(double y) {
  constexpr std::array white{1.0, 1.0, 1.0};
  return lab({y, y, y}, white);
}

/// Where its clamp at 2048 is not reached.
void look_of_the_simple_form(EnergyReport& r) {
  const auto* simple = find_form(r, "model.ue_mobile_simple");
  if (!simple) return;
  constexpr double least_roughness = 0.15;
  std::vector<std::string> words;
  bool seen = false;
  for (const double f0 : {0.04, 0.9})
    for (const double mu : {1.0, 0.1}) {
      double most = -1;
      std::string text;
      for (const auto& at : simple->rows) {
        if (at.mu != mu || at.roughness < least_roughness - 1e-9) continue;
        const double shipped = f0 * at.albedo;
        const double exact = reflected("ggx/smith_ggx.correlated/schlick", at.roughness, f0, mu);
        const double d = delta_e_2000(grey(shipped), grey(exact));
        if (d <= most) continue;
        most = d;
        text = fmt::format("F0 {:g} and mu {:g} by {:.3g} (roughness {:g}: {} reflected for {})",
                           f0, mu, d, at.roughness, percent(shipped), percent(exact));
      }
      seen |= most > 1;
      if (most >= 0) words.push_back(text);
    }
  judge(r, "the simple mobile form keeps the look", "seed 004, SpecularGGXSimple",
        seen ? Judged::fails : Judged::holds,
        fmt::format("from roughness {:g} on (below, its clamp takes over) its ΔE2000 under even "
                    "light from GGX with Smith, correlated, and Schlick is at most, for {}. It has "
                    "no Fresnel, and no angles in its visibility.",
                    least_roughness, fmt::join(words, ", for ")));
}

/// The standard deviation along an axis, over α, of slopes up to `most` times α: of p = D cos⁴θ,
/// σ² = ½ ∫ t² p 2πt dt, where ∫ p 2πt dt = 1 over all slopes.
double deviation(std::string_view ndf, double alpha, double most) {
  constexpr int decades_of_nodes = 40;
  const double low = std::log(1e-4 * alpha), high = std::log(most * alpha);
  const auto nodes = gauss_legendre(decades_of_nodes * 4);
  AngleBlock block(false);
  const auto x = block.resize(nodes.size());
  std::vector<double> weight(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double t = std::exp(low + nodes[i].x * (high - low)), c2 = 1 / (1 + t * t);
    for (const std::size_t k : {0U, 1U, 3U}) x[k][i] = 1;
    x[2][i] = std::sqrt(c2);
    x[4][i] = t * t * c2;
    weight[i] = nodes[i].weight * (high - low) * pi * std::pow(t, 4) * c2 * c2;
  }
  double* const d = block.extra(0);
  term_values(find_term(ndf), std::array{alpha}, block.block(), d);
  double sum = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) sum += weight[i] * d[i];
  return std::sqrt(sum) / alpha;
}

void deviation_of_slopes(EnergyReport& r) {
  std::vector<std::string> words;
  double last = 0, growth = 0;
  for (const double most : {10.0, 100.0, 1000.0}) {
    const double d = deviation("ndf.ggx", 0.3, most);
    growth = d - last, last = d;
    words.push_back(fmt::format("{:.3g} α", d));
  }
  const double beckmann = deviation("ndf.beckmann", 0.3, 100);
  judge(r, "alpha is the standard deviation of the slopes", "seed 000, definition of alpha",
        growth < 1e-3 && std::abs(last - 1) < 1e-3 ? Judged::holds : Judged::fails,
        fmt::format("along an axis it is {:.4f} α for Beckmann, α/√2. GGX has none: of its slopes "
                    "up to 10, 100 and 1000 α it is {}, and it goes on growing.",
                    beckmann, fmt::join(words, ", ")));
}

/// The half vector of l + step·e and v, minus that of l − step·e.
Direction moved(const Direction& l, const Direction& v, const Direction& e, double step) {
  const auto half = [&](double s) {
    Direction h{l.x + s * e.x, l.y + s * e.y, l.z + s * e.z};
    const double length = std::sqrt(dot(h, h));
    h = {h.x / length + v.x, h.y / length + v.y, h.z / length + v.z};
    const double half_length = std::sqrt(dot(h, h));
    return Direction{h.x / half_length, h.y / half_length, h.z / half_length};
  };
  const auto a = half(step), b = half(-step);
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Direction cross(const Direction& a, const Direction& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

void solid_angle_of_half(EnergyReport& r) {
  constexpr std::size_t pairs = 1000;
  constexpr double step = 1e-4;
  double most = 0;
  for (std::size_t i = 0; i < pairs; ++i) {
    Draws draw(1, i);
    const auto upper = [&] {
      return direction(std::acos(draw.uniform()), 2 * pi * draw.uniform());
    };
    const Direction l = upper(), v = upper();
    const double voh = std::sqrt((1 + dot(l, v)) / 2);
    const double theta = std::acos(l.z), phi = std::atan2(l.y, l.x);
    const Direction along = direction(theta + pi / 2, phi),
                    across{-std::sin(phi), std::cos(phi), 0};
    const auto area = cross(moved(l, v, along, step), moved(l, v, across, step));
    const double ratio = std::sqrt(dot(area, area)) / (4 * step * step);
    most = std::max(most, std::abs(ratio * 4 * voh - 1));
  }
  judge(r, "dω_h = dω_l/(4 VoH)", "seed 000, the factor 4 of the BRDF",
        most < 1e-5 ? Judged::holds : Judged::fails,
        fmt::format("for {} pairs of directions the solid angle of the half vector, by differences "
                    "of {:g} rad in l, is that to {:.1g} of itself.",
                    pairs, step, most));
}

}  // namespace

void judge_claims(EnergyReport& r) {
  no_light_is_made(r);
  energy_does_not_stay(r);
  fixed_coat(r);
  clamped_at_2048(r);
  look_of_the_simple_form(r);
  deviation_of_slopes(r);
  solid_angle_of_half(r);
}

}  // namespace gonio
