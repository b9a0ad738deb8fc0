// Published fits of measured materials: what becomes of their highlights in the forms that are
// shipped.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>
#include <utility>

#include "base/whole_loop.h"
#include "number/real.h"
#include "reports/cross_fit/cases.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Green of a material by two of the published models:
///   f = kd/π + a F(η) G S/(π NoL NoV),  S = (1 + b (1 − NoH))^−c,  G of V-shaped grooves,
/// and the width m of Beckmann's distribution in Cook and Torrance's model.
struct Published {
  std::string_view material;
  double kd, a, b, c, eta, m;
};
// Every fifth of the 100 materials of the MERL database, by name; both models by the metric E2.
//   [Löw, Kronander, Ynnerman and Unger 2012, BRDF Models for Accurate and Efficient Rendering of
//   Glossy Surfaces,
//    supplement, doi:10.1145/2077341.2077350; materials: Matusik et al. 2003]
constexpr std::array materials{
    Published{"aluminium", 0.002, 1090.75182, 218716.59754, 1.092006, 6.28268, 0.025861},
    Published{"black-oxidized-steel", 0.0117, 1.0573, 30.661055, 1.869546, 1.66041, 0.232915},
    Published{"blue-metallic-paint", 0.001, 0.46984, 48.57206, 1.70252, 9.02458, 0.210792},
    Published{"chrome", 0.0025, 771.0355, 64661.258846, 1.90542, 99.99941, 0.011447},
    Published{"color-changing-paint3", 0.0048, 34.89535, 2193.942165, 1.442522, 1.91831, 0.044996},
    Published{"fruitwood-241", 0.0347, 5.76093, 192.19989, 1.5733, 1.48358, 0.119807},
    Published{"gray-plastic", 0.1003, 204.2308, 33710.691139, 1.023289, 1.40044, 0.031441},
    Published{"green-metallic-paint", 0.0272, 1.73123, 43.999605, 2.172307, 3.235, 0.182966},
    Published{"light-brown-fabric", 0.0195, 1.21909, 3929432.424598, 0.155265, 1.15318, 0.663278},
    Published{"nickel", 0.0067, 32.7454, 705.733868, 1.945258, 5.44188, 0.061339},
    Published{"pink-fabric", 0.1919, 0.45035, 239167.372595, 0.146117, 2.71064, 0.743165},
    Published{"polyethylene", 0.202, 0.74059, 3082110.956789, 0.118759, 3.01091, 0.842102},
    Published{"red-fabric", 0.02, 0.31463, 130451.18419, 0.287254, 3.33506, 0.418454},
    Published{"red-specular-plastic", 0.0357, 2449.90884, 215481.90854, 1.26853, 1.32219, 0.008954},
    Published{"special-walnut-224", 0.0048, 0.69349, 15.779606, 2.668091, 1.88315, 0.249713},
    Published{"specular-orange-phenolic", 0.0514, 2678.2286, 462668.990302, 1.185505, 1.43905,
              0.004988},
    Published{"ss440", 0.0043, 613.78529, 96436.516086, 1.55024, 99.99933, 0.013553},
    Published{"two-layer-silver", 0, 121.56168, 1048834.817041, 0.598443, 8.71843, 0.13918},
    Published{"white-fabric", 0.2339, 3.58726, 18457.024148, 0.103981, 1.03943, 0.700484},
    Published{"yellow-paint", 0.1964, 0.44668, 12.881507, 2.137449, 1.82265, 0.318087}};

const FittedParameter& parameter(const FitDocument& d, std::string_view name) {
  return *std::ranges::find(d.parameters, name, &FittedParameter::name);
}

/// Fresnel term of an index, and its parameter: no term takes an index so large that F is its F0 at all angles but the last.
std::pair<std::string_view, Setting> fresnel_of(double eta) {
  constexpr double largest = 10;
  if (eta > largest) return {"schlick", {"f0", {f0_of_index({eta, 0})}}};
  return {"dielectric", {"eta", {eta}}};
}

PublishedFit fitted(const Published& p, std::size_t bins) {
  const Table slice = published_slice(p.kd, p.a, p.b, p.c, p.eta, bins);
  const auto [fresnel, index] = fresnel_of(p.eta);
  FitOptions o;
  o.metric = Metric::log;
  o.intervals = Intervals::independent;
  o.bin_sensitivity = false;
  o.fixed = {index};
  const auto with = [&](std::string_view ndf) {  // and its own Smith, as it is shipped
    auto spec = model_of_lobe(ndf, fmt::format("smith_{}.correlated", ndf),
                              std::string(fresnel) + ".weighted");
    spec.diffuse = "lambert";
    o.model = to_text(spec);
    return fit(slice, o).document;
  };
  const auto ggx = with("ggx"), gtr = with("gtr");
  const auto& gamma = parameter(gtr, "gamma");
  return {std::string(p.material),
          std::pow(2 / p.b, 0.25),
          p.c,
          std::sqrt(p.m),
          parameter(ggx, "roughness").value[0],
          ggx.residuals.log_rms,
          parameter(gtr, "roughness").value[0],
          gamma.value[0],
          gamma.status[0] == ParameterStatus::free,
          gtr.residuals.log_rms};
}

}  // namespace

Table published_slice(double kd, double a, double b, double c, double eta, std::size_t bins) {
  // GGX of width 1 is 1/π: what is left is V F/π
  const auto [fresnel, index] = fresnel_of(eta);
  const auto rest =
      bind_model(fmt::format("ggx/cook_torrance/{}", fresnel), {{"alpha", {1}}, index}, 1);
  SynthOptions synth;
  synth.layout = Layout::image_slice;
  synth.slice = bins;
  Table t = synthesize(rest, synth);
  const SampleAngles at(t);
  const double least = std::cos(cross_layouts[0].reach_deg * degree);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto x = at(i);
    auto& f = t.values[0][i];
    if (std::min(x.nol, x.nov) <= least) {
      f = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    const double height = x.sin2_theta_h / (1 + x.noh);  // 1 − NoH
    f = kd / std::numbers::pi + 4 * a * std::pow(1 + b * height, -c) * f;
  }
  return t;
}

std::vector<PublishedFit> published_fits(std::size_t bins) {
  std::vector<PublishedFit> out(materials.size());
  for_each_whole(out.size(), [&](std::size_t i) { out[i] = fitted(materials[i], bins); });
  return out;
}

}  // namespace gonio
