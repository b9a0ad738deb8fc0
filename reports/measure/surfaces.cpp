// The forms in place of the exact Fresnel term, with the parameters that suit a surface best.
#include "reports/measure/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "brdf/catalogue/registry.h"
#include "brdf/in_number/one_term.h"
#include "integrate/rule/slopes.h"
#include "optics/f0.h"
#include "optics/spectrum.h"

namespace gonio {
namespace {

constexpr double cos_82 = 1 / 7.0;  // where F82 has its tint

std::vector<double> at_cosines(std::size_t term,
                               std::span<const double> parameters,
                               std::span<const double> cosine) {
  AngleBlock x(false);
  const auto columns = x.resize(cosine.size());
  for (auto* c : columns) std::fill_n(c, cosine.size(), 0.5);
  std::ranges::copy(cosine, columns[3]);
  term_values(term, parameters, x.block(), x.extra(0));
  return {x.extra(0), x.extra(0) + cosine.size()};
}

std::vector<double> parameters_of(const FresnelForm& f, std::size_t channel) {
  std::vector<double> p;
  for (const auto& about : catalogue()[f.term].parameters) {
    const auto s = std::ranges::find(f.settings, about.name, &Setting::name);
    p.push_back(s == f.settings.end() ? about.start
                                      : s->values[s->values.size() > 1 ? channel : 0]);
  }
  return p;
}

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}
std::vector<double> minus(std::vector<double> a, std::span<const double> b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

struct Fitting {
  const FresnelSurface& surface;
  std::vector<double> f0{};
  AngleSteps at = angle_steps(90);
  std::vector<std::vector<double>> exact{};  ///< [channel]
};

FresnelForm of_f0(std::string name, const Fitting& s) {
  return {name, find_term(name), {{"f0", s.f0}}};
}

/// F is linear in f90, of which there is one for all channels.
FresnelForm f90_form(const Fitting& s) {
  auto f = of_f0("fresnel.schlick.f90", s);
  double along = 0, length2 = 0;
  f.settings.push_back({"f90", {0}});
  for (std::size_t c = 0; c < s.f0.size(); ++c) {
    f.settings[1].values = {0};
    const auto none = form_values(f, s.surface, c, s.at.cosine);
    f.settings[1].values = {1};
    const auto slope = minus(form_values(f, s.surface, c, s.at.cosine), none);
    along += dot(minus(s.exact[c], none), slope);
    length2 += dot(slope, slope);
  }
  f.settings[1].values = {std::clamp(along / length2, 0.0, 1.0)};
  return f;
}

/// The tint is what the edge reflects as a part of what Schlick would.
FresnelForm f82_form(const Fitting& s) {
  auto f = of_f0("fresnel.f82", s);
  Setting tint{"f82_tint", {}};
  const auto edges = exact_values(s.surface, {&cos_82, 1});
  for (std::size_t c = 0; c < s.f0.size(); ++c) {
    const double schlick = form_values(of_f0("fresnel.schlick", s), s.surface, c, {&cos_82, 1})[0];
    tint.values.push_back(std::clamp(edges[c][0] / schlick, 0.0, 1.0));
  }
  f.settings.push_back(tint);
  return f;
}

FresnelForm of_index(std::string name, std::span<const Index> index, bool k) {
  FresnelForm f{name, find_term(name), {{"eta", {}}}};
  if (k) f.settings.push_back({"k", {}});
  for (const auto& i : index) {
    f.settings[0].values.push_back(i.n);
    if (k) f.settings[1].values.push_back(i.k);
  }
  return f;
}

/// Index of each channel with the surface's F0: of a spectrum n is that of the channel's wavelength, and k makes its colour.
std::vector<Index> index_of_f0(const Fitting& s) {
  auto index = s.surface.index;
  if (!s.surface.spectrum) return index;
  constexpr double most = 0.999;  // from there on k grows without end
  for (std::size_t c = 0; c < index.size(); ++c) {
    auto& [n, k] = index[c];
    const double f0 = std::min(s.f0[c], most), k2 = f0 * (n + 1) * (n + 1) - (n - 1) * (n - 1);
    k = std::sqrt(std::max(k2, 0.0) / (1 - f0));
  }
  return index;
}

/// The correction is linear in its height: by least squares, exponent by exponent.
FresnelForm lazanyi_corrected(const Fitting& s) {
  const auto plain = of_index("fresnel.lazanyi", index_of_f0(s), true);
  auto f = plain;
  f.name += ", corrected";
  Setting height{"correction", {}}, exponent{"correction_exponent", {}};
  const auto& about = catalogue()[f.term].parameters[3];
  for (std::size_t c = 0; c < s.f0.size(); ++c) {
    const auto missing =
        minus(form_values(plain, s.surface, c, s.at.cosine), s.exact[c]);  // what it takes away
    double best = 0, best_height = 0, best_exponent = about.start;
    for (double x = about.fit.low; x <= about.fit.high; x += 0.02) {
      // of a mirror, so that the hump leaves it above 0
      const std::array<double, 4> mirror{1, 1000, 0, x}, less{1, 1000, 1, x};
      const auto hump =
          minus(at_cosines(f.term, mirror, s.at.cosine), at_cosines(f.term, less, s.at.cosine));
      const double along = dot(missing, hump), length2 = dot(hump, hump);
      if (along > 0 && along * along / length2 > best)
        best = along * along / length2, best_height = along / length2, best_exponent = x;
    }
    height.values.push_back(best_height);
    exponent.values.push_back(best_exponent);
  }
  f.settings.insert(f.settings.end(), {height, exponent});
  return f;
}

/// Its parameters are the index in other words.
FresnelForm gulbrandsen(const Fitting& s) {
  FresnelForm f{"fresnel.gulbrandsen", find_term("fresnel.gulbrandsen"), {{"f0", {}}, {"g", {}}}};
  const auto map = *find_map("f0.from_index");
  for (const auto& i : index_of_f0(s)) {
    const auto v = evaluate_map(map, Number::double_, {}, {{"eta", {i.n}}, {"k", {i.k}}}).values[0];
    f.settings[0].values.push_back(std::clamp(v[0], 0.0, 1.0));
    f.settings[1].values.push_back(std::clamp(v[1], 0.0, 1.0));
  }
  return f;
}

/// Unreal Engine's, whose edge is decided by green, or by the only channel.
FresnelForm ue_form(const Fitting& s) {
  auto f = of_f0("fresnel.schlick.ue", s);
  f.settings.push_back({"f0_green", {s.f0[s.f0.size() / 2]}});
  return f;
}

}  // namespace

std::string FresnelSurface::channel(std::size_t c) const {
  static constexpr std::array names{"red", "green", "blue"};
  return channels() > 1 ? names[c] : "";
}

double f0_of_index(const Index& i) {
  return EdgeTintFromIndex<double>::apply(std::array{i.n, i.k})[0];
}
double FresnelSurface::f0(std::size_t c) const {
  return f0_of_index(index[c]);
}

FresnelSurface dielectric(double ior, std::string name) {
  return {"dielectric", std::move(name), {{ior, 0}}};
}
FresnelSurface dielectric_inside(double ior, std::string name) {
  return {"dielectric_inside", std::move(name), {{1 / ior, 0}}};
}
FresnelSurface metal(const Material& m) {
  const auto rgb = m.rgb();
  return {"metal", std::string(m.name), {rgb.begin(), rgb.end()}};
}
FresnelSurface spectral(const Material& m) {
  const auto rgb = m.rgb();
  return {"spectral", std::string(m.name), {rgb.begin(), rgb.end()}, &m};
}

AngleSteps angle_steps(std::size_t steps) {
  AngleSteps a;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(steps);
    a.theta_deg.push_back(90 * part);
    a.cosine.push_back(i == steps ? 0 : std::cos(part * std::numbers::pi / 2));
  }
  return a;
}

std::vector<std::vector<double>> exact_values(const FresnelSurface& s,
                                              std::span<const double> cosine) {
  std::vector<std::vector<double>> out(s.channels());
  if (s.spectrum) {
    for (const double c : cosine) {
      const auto rgb = reflectance_rgb(*s.spectrum, c);
      for (std::size_t k = 0; k < out.size(); ++k) out[k].push_back(rgb[k]);
    }
    return out;
  }
  for (std::size_t k = 0; k < out.size(); ++k) {
    const std::array p{s.index[k].n, s.index[k].k};
    out[k] = s.kind == "metal" ? at_cosines(find_term("fresnel.conductor"), p, cosine)
                               : at_cosines(find_term("fresnel.dielectric"), {p.data(), 1}, cosine);
  }
  return out;
}

std::vector<double> form_values(const FresnelForm& f,
                                const FresnelSurface& s,
                                std::size_t channel,
                                std::span<const double> cosine) {
  const auto parameters = parameters_of(f, channel);
  if (!f.outer_angle) return at_cosines(f.term, parameters, cosine);
  std::vector<double> outer;
  for (const double c : cosine) {
    const double sine = std::sqrt((1 - c) * (1 + c)) / s.index[channel].n;  // Snell
    outer.push_back(sine < 1 ? std::sqrt((1 - sine) * (1 + sine)) : 0);
  }
  return at_cosines(f.term, parameters, outer);
}

std::vector<FresnelForm> forms_for(const FresnelSurface& surface) {
  Fitting s{surface};
  s.exact = exact_values(surface, s.at.cosine);
  for (const auto& of_channel : s.exact)  // a colour beyond the gamut is cut
    s.f0.push_back(std::clamp(of_channel[0], 0.0, 1.0));
  std::vector<FresnelForm> out{of_f0("fresnel.schlick", s),
                               f90_form(s),
                               f82_form(s),
                               of_index("fresnel.lazanyi", index_of_f0(s), true),
                               ue_form(s),
                               of_f0("fresnel.schlick.spherical_gaussian", s),
                               of_f0("fresnel.linear.as_written", s)};
  if (surface.spectrum) {
    out.push_back(of_index("fresnel.conductor", surface.index, true));
    out.back().name += ", three wavelengths";
  }
  if (surface.spectrum || surface.kind == "metal")
    out.push_back(lazanyi_corrected(s));
  else
    out.push_back(of_index("fresnel.disney2015", surface.index, false));
  if (surface.kind != "dielectric_inside") {
    out.push_back(gulbrandsen(s));
    return out;
  }
  // Gulbrandsen's indices lie above 1, or absorb: none of them is seen from inside
  auto outer = of_f0("fresnel.schlick", s);
  outer.name += ", outer angle";
  outer.outer_angle = true;
  out.push_back(outer);
  return out;
}

}  // namespace gonio
