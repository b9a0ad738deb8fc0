// What the forms do to a rough surface: its directional albedo with each in place of the exact
// term.
#include <algorithm>
#include <array>
#include <cmath>

#include "brdf/catalogue/registry.h"
#include "image/display.h"
#include "integrate/albedo/directional_albedo.h"
#include "optics/spectrum.h"
#include "reports/schlick/schlick.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr Goal goal{1e-6, 400'000};
constexpr double rough_iors[] = {1.1, 1.33, 1.5, 2, 3};

/// Place of a cosine among colour_mus().
std::size_t place_of(double mu) {
  const auto all = colour_mus();
  return static_cast<std::size_t>(
      std::ranges::min_element(all, {}, [&](double x) { return std::abs(x - mu); }) - all.begin());
}

/// Albedo at each of colour_mus() of GGX under Smith masking, correlated.
std::vector<Albedo> albedo(std::string_view term,
                           std::vector<Setting> settings,
                           double roughness,
                           std::size_t channels) {
  settings.push_back({"alpha", {roughness * roughness}});
  return directional_albedo(bind_model(fmt::format("ggx/smith_ggx.correlated/{}", short_id(term)),
                                       std::move(settings), channels),
                            colour_mus(), 0, goal);
}

/// Exact albedo [mu], by channel: of a metal that of every wavelength, seen as linear RGB.
std::vector<Albedo> exact_albedo(const FresnelSurface& s, double roughness) {
  if (!s.spectrum)
    return albedo("fresnel.dielectric", {{"eta", {s.index[0].n}}}, roughness, s.channels());
  Setting eta{"eta", {}}, k{"k", {}};
  for (std::size_t i = 0; i < wavelengths; ++i) {
    const auto index = s.spectrum->at(first_nm + step_nm * static_cast<double>(i));
    eta.values.push_back(index.n), k.values.push_back(index.k);
  }
  auto all = albedo("fresnel.conductor", {eta, k}, roughness, wavelengths);
  for (auto& a : all) {
    Spectrum seen;
    std::ranges::copy(a.value, seen.begin());
    const auto rgb = linear_srgb(seen);
    a.value.assign(rgb.begin(), rgb.end());
  }
  return all;
}

void add_surface(RoughFresnel& to, const FresnelSurface& s) {
  const std::size_t channels = s.channels();
  std::vector<std::vector<Albedo>> exact;  // [roughness][mu]
  for (const double r : to.roughness) exact.push_back(exact_albedo(s, r));
  for (const auto& f : forms_for(s)) {
    std::vector<std::vector<Albedo>> with;
    for (const double r : to.roughness)
      with.push_back(albedo(catalogue()[f.term].about->id, f.settings, r, channels));
    for (std::size_t c = 0; c < channels; ++c)
      for (const double mu : albedo_mus) {
        const std::size_t m = place_of(mu);
        FresnelAlbedo a{f.name, s.material, s.channel(c), mu, {}, {}, 0};
        for (std::size_t r = 0; r < with.size(); ++r) {
          a.albedo.push_back(with[r][m].value[c]);
          a.exact.push_back(exact[r][m].value[c]);
          a.bound = std::max({a.bound, with[r][m].error, exact[r][m].error});
        }
        to.albedos.push_back(std::move(a));
      }
    const auto mus = colour_mus();
    for (std::size_t m = 0; m < mus.size(); ++m) {
      FresnelColour colour{f.name, s.material, mus[m], {}};
      for (std::size_t r = 0; r < with.size(); ++r)
        colour.delta_e.push_back(
            delta_e_2000(lab_of_albedo(with[r][m].value), lab_of_albedo(exact[r][m].value)));
      to.colours.push_back(std::move(colour));
    }
  }
}

}  // namespace

std::vector<double> colour_mus() {
  constexpr int first = 2, last = 20;
  std::vector<double> all;
  for (int i = first; i <= last; ++i) all.push_back(i / 20.0);
  return all;
}

RoughFresnel rough_rows(const SchlickOptions& o, const std::function<void(double)>& done) {
  RoughFresnel out{o.roughness, {}, {}};
  std::vector<FresnelSurface> surfaces;
  for (const double ior : rough_iors)
    surfaces.push_back(dielectric(ior, fmt::format("IOR {:g}", ior)));
  for (const auto& m : metals()) surfaces.push_back(spectral(m));
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    add_surface(out, surfaces[i]);
    done(static_cast<double>(i + 1) / static_cast<double>(surfaces.size()));
  }
  return out;
}

}  // namespace gonio
