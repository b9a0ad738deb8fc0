// Mitsuba 3: rough conductors, which reflect as dielectrics where nothing is absorbed, and a
// diffuse one, blended.
//
//   f = s_0 (r/π) + Σ_l s_l w_l D V F(eta, k),   shares s of a blend add up to 1, V is Smith's,
//   separable
//
// Mitsuba takes <rgb> for a reflectance, in [0, 1] and smooth over the spectrum, which an index is
// not: in spectral variants the highlight is lost.  eta and k are written as three bands of the
// spectrum, within which they are constant:
//
//   v(λ) = v₁ below 485 nm, v₂ up to 590 nm, v₃ above,   each edge a line over 5 nm
//
// so that the conversion to linear sRGB under D65, which Mitsuba does in its RGB variants, gives
// the fit's r, g, b.  F is not linear in them: of measured metals what a spectral variant reflects
// is within 1 % of the fit's.
//
// A blend weighs its parts: r = kd/s_0, and w_l = weight/s_l, which may be above 1 and Mitsuba
// takes as it is.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/evaluate.h"
#include "fitting/export/mitsuba_parts.h"
#include "fitting/export/target.h"
#include "fitting/export/xml.h"
#include "optics/spectrum.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr std::array band_edges{485.0, 590.0};
constexpr double edge_width = 5;
using Bands = std::array<double, 3>;  ///< from blue to red

/// Share of a band's value at a wavelength.
double share_of_band(std::size_t band, double nm) {
  const auto above = [&](std::size_t edge) {
    return std::clamp((nm - band_edges[edge]) / edge_width + 0.5, 0.0, 1.0);
  };
  const double from = band == 0 ? 1 : above(band - 1), to = band == 2 ? 0 : above(band);
  return from - to;
}

/// Values of the bands whose spectrum is r, g, b as a display has it.
Bands bands_of(const std::vector<double>& rgb) {
  std::array<std::array<double, 3>, 3> m;  // what each band is, by channel
  for (std::size_t b = 0; b < 3; ++b)
    m[b] = linear_srgb(spectrum([&](double nm) { return share_of_band(b, nm); }));
  const auto determinant = [](const auto& x, const auto& y, const auto& z) {
    return x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0]) +
           x[2] * (y[0] * z[1] - y[1] * z[0]);
  };
  const double all = determinant(m[0], m[1], m[2]);
  Bands v{};
  for (std::size_t b = 0; b < 3; ++b) {  // Cramer's rule
    auto replaced = m;
    std::ranges::copy(rgb, replaced[b].begin());
    v[b] = determinant(replaced[0], replaced[1], replaced[2]) / all;
  }
  return v;
}

/// Bands of an index that is written: none is below what Mitsuba takes.
Bands written_bands(const std::string& name, const std::vector<double>& rgb) {
  Bands v = bands_of(rgb);
  for (double& x : v) x = std::max(x, name.starts_with("eta") ? 0.001 : 0.0);
  return v;
}
bool is_grey(const std::vector<double>& v) {
  return std::ranges::count(v, v[0]) == std::ssize(v);
}
bool is_index(const std::string& name) {
  const auto of_term = parse_parameter(name).name;
  return of_term == "eta" || of_term == "k";
}

std::vector<TargetForm> mitsuba_forms(const Surface& s) {
  TargetForm form;
  auto& p = form.parameters;
  const bool diffuse = s.largest_kd() > 0 || s.lobes.empty();
  if (diffuse) p.push_back({"reflectance", s.kd});
  std::vector<bool> anisotropic;
  for (std::size_t l = 0; l < s.lobes.size(); ++l) {
    const auto& lobe = s.lobes[l];
    anisotropic.push_back(lobe.alpha_x != lobe.alpha_y);
    if (anisotropic.back()) {
      p.push_back({to_text({"alpha_u", l}), {lobe.alpha_x}, mitsuba_widths});
      p.push_back({to_text({"alpha_v", l}), {lobe.alpha_y}, mitsuba_widths});
    } else {
      p.push_back({to_text({"alpha", l}), {lobe.alpha_x}, mitsuba_widths});
    }
    p.push_back({to_text({"eta", l}), lobe.eta, mitsuba_indices});
    p.push_back({to_text({"k", l}), lobe.k, mitsuba_extinctions, lobe.is_metal()});
    // Of a metal the index says how much it reflects; of a dielectric it says the angles, too.
    p.push_back({to_text({"specular_reflectance", l}), {lobe.weight}, {0, 1}, !lobe.is_metal()});
  }
  const auto evaluated = [spec = mitsuba_model(diffuse, anisotropic), tangent = s.tangent_deg,
                          channels = s.channels](const TargetParameters& now,
                                                 std::span<const FrameAngles<double>> angles) {
    std::vector<Setting> settings;
    for (const auto& x : now) settings.push_back({mitsuba_in_catalogue(x.name), x.values});
    if (compose(spec, 1).anisotropic) settings.push_back({"tangent", {tangent}});
    return evaluate(bind_model(spec, std::move(settings), channels), angles);
  };
  form.values = evaluated;
  form.variants.emplace_back("scalar_rgb", [evaluated](TargetParameters now, const auto& angles) {
    for (auto& x : now) {
      if (!is_index(x.name) || is_grey(x.values)) continue;
      const auto v = written_bands(x.name, x.values);
      const auto rgb = linear_srgb(spectrum([&](double nm) {
        return v[0] * share_of_band(0, nm) + v[1] * share_of_band(1, nm) +
               v[2] * share_of_band(2, nm);
      }));
      x.values.assign(rgb.begin(), rgb.end());
      // Bands cut at 0 may leave less, and the sum of equal ones rounds.
      for (double& part : x.values) part = std::clamp(part, x.legal.low, x.legal.high);
    }
    return evaluated(now, angles);
  });
  // f of each band and in the middle of each edge, and what light of these wavelengths adds to r, g
  // and b; the diffuse reflectance is one that Mitsuba knows how to make a spectrum of.
  form.variants.emplace_back(
      "scalar_spectral", [evaluated](const TargetParameters& now, const auto& angles) {
        TargetParameters below = now, at = now;
        for (auto& x : below)
          if (x.name.starts_with("specular_reflectance")) x.values = {0};
        for (auto& x : at)
          if (x.name == "reflectance") x.values = {0};
        auto f = evaluated(below, angles);
        for (std::size_t place = 0; place < 5; ++place) {
          const auto half = [&](std::size_t band) {  // of the band's value at this place
            const std::size_t mine = 2 * band;
            return place == mine ? 1 : place + 1 == mine || place == mine + 1 ? 0.5 : 0;
          };
          const auto weight = linear_srgb(spectrum([&](double nm) {
            const double blue = share_of_band(0, nm), red = share_of_band(2, nm);
            const bool here = std::abs(blue - half(0)) < 0.25 && std::abs(red - half(2)) < 0.25;
            return here ? 1.0 : 0.0;
          }));
          for (std::size_t i = 0; i < now.size(); ++i) {
            if (!is_index(now[i].name) || is_grey(now[i].values)) continue;
            const auto v = written_bands(now[i].name, now[i].values);
            at[i].values = {std::clamp(half(0) * v[0] + half(1) * v[1] + half(2) * v[2],
                                       now[i].legal.low, now[i].legal.high)};
          }
          const auto lobes = evaluated(at, angles);
          for (std::size_t c = 0; c < f.size(); ++c)
            for (std::size_t i = 0; i < f[c].size(); ++i) f[c][i] += weight[c] * lobes[c][i];
        }
        return f;
      });
  return {std::move(form)};
}

std::vector<std::string> mitsuba_lost(const BoundModel& fit,
                                      const Surface& s,
                                      const TargetParameters&) {
  auto all = lost_by_all(fit, "Mitsuba's", "separable");
  for (const auto& d : fit.model.diffuse)
    if (catalogue()[d.term].coupled)
      all.emplace_back(
          "The light that the highlight takes from the diffuse term: Mitsuba's blend adds both.");
  if (!fresnel_is(fit, {"conductor", "dielectric"}))
    all.emplace_back("The Fresnel curve: Mitsuba's is exact, of an index.");
  if (s.tangent_deg != 0)
    all.push_back(
        fmt::format("The tangent at {:.4g}°: Mitsuba takes it from texture coordinates, which are "
                    "to be turned.",
                    s.tangent_deg));
  return all;
}

std::string mitsuba_file(const Export& e, const std::string& fit) {
  const auto find = [&](const std::string& name) -> const std::vector<double>* {
    const auto it = std::ranges::find(
        e.parameters, name, [](const auto& p) -> auto& { return p.first; });
    return it == e.parameters.end() ? nullptr : &it->second;
  };
  const auto rgb = [](const std::string& name, std::vector<double> v, double scale) {
    for (double& x : v) x *= scale;
    v.resize(3, v[0]);
    return fmt::format("<rgb name=\"{}\" value=\"{}\"/>\n", name, xml_numbers(v));
  };
  const auto index = [](const std::string& name, const std::vector<double>& v) {
    std::string value = xml_numbers({v[0]});
    if (!is_grey(v)) {
      const auto bands = written_bands(name, v);
      constexpr double half = edge_width / 2;
      value = fmt::format("360:{0}, {3}:{0}, {4}:{1}, {5}:{1}, {6}:{2}, 830:{2}",
                          xml_numbers({bands[0]}), xml_numbers({bands[1]}), xml_numbers({bands[2]}),
                          band_edges[0] - half, band_edges[0] + half, band_edges[1] - half,
                          band_edges[1] + half);
    }
    return fmt::format("<spectrum name=\"{}\" value=\"{}\"/>\n", name, value);
  };
  const auto* reflectance = find("reflectance");
  std::size_t lobes = 0;
  while (find(to_text({"eta", lobes}))) ++lobes;
  double diffuse_share = reflectance ? 1 : 0;
  if (reflectance && lobes > 0)
    diffuse_share = mitsuba_diffuse_share(*std::ranges::max_element(*reflectance));
  std::vector<std::pair<double, std::string>> parts;
  if (reflectance)
    parts.emplace_back(diffuse_share, "<bsdf type=\"diffuse\">\n" +
                                          rgb("reflectance", *reflectance, 1 / diffuse_share) +
                                          "</bsdf>\n");
  for (std::size_t l = 0; l < lobes; ++l) {
    const double share = (1 - diffuse_share) / static_cast<double>(lobes);
    std::string one =
        "<bsdf type=\"roughconductor\">\n<string name=\"distribution\" value=\"ggx\"/>\n";
    for (const char* name : {"alpha", "alpha_u", "alpha_v"})
      if (const auto* v = find(to_text({name, l})))
        one += fmt::format("<float name=\"{}\" value=\"{}\"/>\n", name, xml_numbers(*v));
    for (const char* name : {"eta", "k"}) one += index(name, *find(to_text({name, l})));
    one += fmt::format("<spectrum name=\"specular_reflectance\" value=\"{}\"/>\n</bsdf>\n",
                       xml_numbers({(*find(to_text({"specular_reflectance", l})))[0] / share}));
    parts.emplace_back(share, std::move(one));
  }
  std::string all = mitsuba_blend(std::move(parts));
  all.insert(5, " version=\"3.0.0\" id=\"fit\"");  // of the outermost
  return xml_file(all, exported_fit, fit);
}

}  // namespace

ModelSpec mitsuba_model(bool diffuse, const std::vector<bool>& anisotropic) {
  ModelSpec spec;
  if (diffuse) spec.diffuse = "lambert";
  for (const bool is_anisotropic : anisotropic) {
    const std::string kind = is_anisotropic ? "ggx_aniso" : "ggx";
    spec.lobes.push_back({kind, "smith_" + kind + ".separable", "conductor.weighted"});
  }
  return spec;
}

std::string mitsuba_in_catalogue(const std::string& name) {
  auto p = parse_parameter(name);
  for (const auto& [ours, theirs] : {std::pair("kd", "reflectance"),
                                     {"alpha_x", "alpha_u"},
                                     {"alpha_y", "alpha_v"},
                                     {"weight", "specular_reflectance"}})
    if (p.name == theirs) p.name = ours;
  return to_text(p);
}

double mitsuba_diffuse_share(double largest_kd) {
  return std::clamp(largest_kd, 0.5, 0.99);
}

std::string mitsuba_blend(std::vector<std::pair<double, std::string>> parts) {
  auto [left, all] = parts.back();
  for (std::size_t i = parts.size() - 1; i-- > 0;) {
    const auto& [share, one] = parts[i];
    all = fmt::format(
        "<bsdf type=\"blendbsdf\">\n<float name=\"weight\" value=\"{}\"/>\n{}{}</bsdf>\n",
        xml_numbers({left / (left + share)}), one, all);
    left += share;
  }
  return all;
}

const Target mitsuba_target{"Mitsuba", mitsuba_forms, mitsuba_lost, mitsuba_file};

}  // namespace gonio
