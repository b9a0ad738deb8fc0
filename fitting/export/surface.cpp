#include "fitting/export/surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/catalogue/registry.h"
#include "brdf/in_number/one_term.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/reflectances.h"
#include "brdf/term/map.h"
#include "geometry/frame_of_angles.h"
#include "optics/f0.h"
#include "optics/fresnel.h"
#include "optics/fresnel_approximate.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Cosine at which F82-tint tints.
constexpr double edge_cosine = 1.0 / 7;

double schlick_at_edge(double f0) {
  return schlick<double>(f0, schlick_weight(edge_cosine));
}

double conductor_at(double cosine, double eta, double k) {
  Angles<double> a{};
  a.voh = cosine;
  return as_value<double>(Conductor<double>(std::array{eta, k})(a));
}

/// Index of a conductor that reflects f0 at normal incidence and, as near as Gulbrandsen's tint can, `edge` at 82°.
std::array<double, 2> index_of(double f0, double edge) {
  std::array<double, 2> best{};
  double least = 2;
  const double r = std::clamp(f0, 1e-6, 0.9999);
  for (int i = 0; i <= 50; ++i) {
    const auto index = mapped<IndexFromEdgeTint, double>(r, i / 50.0);
    if (const double d = std::abs(conductor_at(edge_cosine, index[0], index[1]) - edge); d < least)
      least = d, best = index;
  }
  return best;
}

/// The first guess of a whole model that is a function of a file: what it shows with light and view together, tilted away from the
/// normal.  Far out lies the diffuse base; GGX falls to half its peak 1/(4 π α²) where tan² θ = (√2 − 1) α².
Surface surface_of_function(const BoundModel& b) {
  constexpr std::size_t steps = 400;
  std::vector<FrameAngles<double>> at;
  const auto theta = [](std::size_t k) {  // finely where narrow peaks fall off
    const double part = static_cast<double>(k) / steps;
    return 0.5 * std::numbers::pi * 0.9 * part * part * part;
  };
  for (std::size_t k = 0; k <= steps; ++k) {
    const double c = std::cos(theta(k)), s = std::sin(theta(k));
    at.push_back(with_frame(Angles<double>{c, c, c, 1, s * s}));
  }
  const auto f = evaluate(b, at);
  Surface s;
  s.channels = b.model.channels;
  SurfaceLobe lobe;
  const auto mean_at = [&](std::size_t k) {
    double sum = 0;
    for (const auto& channel : f) sum += channel[k];
    return sum;
  };
  const double base = mean_at(steps), peak = mean_at(0) - base;
  std::size_t half = 1;
  while (half < steps && mean_at(half) - base > peak / 2) ++half;
  lobe.alpha_x = lobe.alpha_y =
      std::clamp(std::tan(theta(half)) / std::sqrt(std::sqrt(2.0) - 1), 1e-3, 1.0);
  for (const auto& channel : f) {
    s.kd.push_back(std::clamp(std::numbers::pi * channel[steps], 0.0, 1.0));
    const double above = std::max(channel[0] - channel[steps], 0.0);
    const double f0 =
        std::clamp(4 * std::numbers::pi * lobe.alpha_x * lobe.alpha_x * above, 0.0, 0.99);
    lobe.f0.push_back(f0);
    lobe.f82_tint.push_back(1);
    const auto [eta, k] = f0 <= 0.25 ? std::array{mapped<IorFromF0, double>(f0)[0], 0.0}
                                     : index_of(f0, schlick_at_edge(f0));
    lobe.eta.push_back(eta), lobe.k.push_back(k);
  }
  if (peak > 1e-3 * base) s.lobes.push_back(std::move(lobe));
  return s;
}

}  // namespace

double SurfaceLobe::largest_f0() const {
  return *std::ranges::max_element(f0);
}
bool SurfaceLobe::is_metal() const {
  return *std::ranges::max_element(k) > 0.1 || largest_f0() > 0.25;
}
double Surface::largest_kd() const {
  return *std::ranges::max_element(kd);
}

Surface surface_of(const BoundModel& fit) {
  if (fit.model.lobes.empty() && !fit.model.diffuse.empty() &&
      foreign_term(fit.model.diffuse[0].term))
    return surface_of_function(fit);
  const BoundModel b = in_reflectances(fit);
  Surface s;
  s.channels = b.model.channels;
  const auto value = [&](std::string_view name, std::size_t c, double otherwise) {
    const auto* p = b.model.find(name);
    return p ? b.values[p->slot(c)] : otherwise;
  };
  for (std::size_t c = 0; c < s.channels; ++c)
    s.kd.push_back(b.model.diffuse.empty() ? 0 : value("kd", c, 0));
  s.tangent_deg = value("tangent", 0, 0);
  s.diffuse_roughness = value("r", 0, value("sigma", 0, 0));
  for (std::size_t l = 0; l < b.model.lobes.size(); ++l) {
    const auto own = [&](const char* name, std::size_t c, double otherwise) {
      return value(to_text({name, l}), c, otherwise);
    };
    SurfaceLobe lobe;
    const double alpha = own("alpha", 0, 1);
    lobe.alpha_x = own("alpha_x", 0, alpha), lobe.alpha_y = own("alpha_y", 0, alpha);
    lobe.weight = own("weight", 0, 1);
    const auto& fresnel = b.model.lobes[l].fresnel;
    for (std::size_t c = 0; c < s.channels; ++c) {
      std::map<std::string, double> parameters;
      for (const std::size_t i : fresnel.parameters) {
        const auto& p = b.model.parameters[i];
        parameters[std::string(p.about->name)] = b.values[p.slot(c)];
      }
      if (parameters.contains("weight")) parameters["weight"] = 1;
      const auto f =
          evaluate_term(fresnel.term, Number::double_, parameters, {{"cos", {1.0, edge_cosine}}})
              .values;
      lobe.f0.push_back(f[0]);
      const double edge = schlick_at_edge(f[0]);
      lobe.f82_tint.push_back(edge > 0 ? f[1] / edge : 1);
      if (parameters.contains("eta")) {
        lobe.eta.push_back(parameters["eta"]);
        lobe.k.push_back(parameters.contains("k") ? parameters["k"] : 0);
      } else if (f[0] <= 0.25) {
        lobe.eta.push_back(mapped<IorFromF0, double>(f[0])[0]), lobe.k.push_back(0);
      } else {
        const auto [eta, k] = index_of(f[0], f[1]);
        lobe.eta.push_back(eta), lobe.k.push_back(k);
      }
    }
    s.lobes.push_back(std::move(lobe));
  }
  return s;
}

bool fresnel_is(const BoundModel& fit, std::initializer_list<std::string_view> names) {
  return std::ranges::all_of(fit.model.lobes, [&](const Lobe& l) {
    const auto id = short_id(catalogue()[l.fresnel.term].id());
    return std::ranges::any_of(names, [&](std::string_view n) { return id.starts_with(n); });
  });
}

bool keeps_diffuse_whole(const BoundModel& fit, const Surface& s) {
  return s.largest_kd() > 0 && !s.lobes.empty() &&
         std::ranges::none_of(fit.model.diffuse, [](const auto& d) {
           return foreign_term(d.term) || catalogue()[d.term].coupled;
         });
}

std::vector<std::string> lost_by_all(const BoundModel& fit,
                                     const std::string& whose,
                                     std::string_view masking,
                                     std::initializer_list<std::string_view> diffuse,
                                     std::string_view diffuse_name) {
  bool exponent = false, distribution = false, masked = false, shape = false;
  for (std::size_t n = 0; n < fit.model.lobes.size(); ++n) {
    const auto& l = fit.model.lobes[n];
    const auto id = short_id(catalogue()[l.ndf.term].id());
    const bool has_exponent = id == "gtr" || id == "student_t" || id == "shape_invariant";
    const auto* gamma = fit.model.find(to_text({"gamma", n}));
    exponent |= has_exponent && !(id == "gtr" && gamma && fit.values[gamma->slot(0)] == 2);
    distribution |= !has_exponent && id != "ggx" && id != "ggx_aniso";
    const auto g = short_id(catalogue()[l.masking.term].id());
    masked |= !(g.starts_with("smith_ggx") && g.ends_with(masking));
  }
  for (const auto& d : fit.model.diffuse)
    shape |= !foreign_term(d.term) && std::ranges::none_of(diffuse, [&](std::string_view name) {
      // Whether a lobe takes from it, and what its colour is made of, is no shape.
      std::string_view id = short_id(catalogue()[d.term].id());
      for (const std::string_view of_colour : {".coupled", ".metallic"})
        if (id.ends_with(of_colour)) id.remove_suffix(of_colour.size());
      return id == name;
    });
  std::vector<std::string> lost;
  for (const auto& d : fit.model.diffuse)
    if (foreign_term(d.term))
      lost.push_back("The function of the file: a diffuse term and a lobe of " +
                     whose.substr(0, whose.size() - (whose.ends_with("'s") ? 2 : 0)) +
                     " stand for it.");
  if (exponent) lost.emplace_back("The exponent of the distribution: " + whose + " is 2.");
  if (distribution) lost.emplace_back("The distribution: " + whose + " is GGX.");
  if (masked)
    lost.emplace_back(fmt::format("The masking: {} is Smith's for GGX, {}.", whose, masking));
  if (shape)
    lost.emplace_back(fmt::format("The shape of the diffuse term: {} is {}.", whose, diffuse_name));
  return lost;
}

}  // namespace gonio
