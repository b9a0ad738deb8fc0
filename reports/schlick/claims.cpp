// Claims on the Fresnel term beside its own error: what other factors get wrong, what F0 tells,
// what F is multiplied with.
#include "reports/schlick/claims.h"

#include <algorithm>
#include <array>

#include "image/display.h"
#include "integrate/albedo/directional_albedo.h"
#include "reports/finding/names.h"
#include "reports/finding/words.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr Goal shown_goal{1e-5, 200'000};  ///< of what is seen
constexpr std::string_view shipped_masking = "ue_joint";

/// Colour of GGX under a masking and the exact Fresnel term, at each of colour_mus().
std::vector<Lab> colours(std::string_view masking, const FresnelSurface& s, double roughness) {
  std::vector<Setting> settings{{"alpha", {roughness * roughness}}, {"eta", {}}};
  for (const auto& i : s.index) settings[1].values.push_back(i.n);
  if (s.kind == "metal") {
    Setting k{"k", {}};
    for (const auto& i : s.index) k.values.push_back(i.k);
    settings.push_back(std::move(k));
  }
  const auto model =
      bind_model(model_of_lobe("ggx", masking, s.kind == "metal" ? "conductor" : "dielectric"),
                 std::move(settings), s.channels());
  std::vector<Lab> out;
  for (const auto& a : directional_albedo(model, colour_mus(), 0, shown_goal))
    out.push_back(lab_of_albedo(a.value));
  return out;
}

/// Most that Schlick's form shows on a material, over roughness and views.
double shown_by_schlick(const SchlickRows& r, const std::string& material) {
  double most = 0;
  for (const auto& c : r.rough.colours)
    if (c.form == form_id::schlick && c.material == material && !c.delta_e.empty())
      most = std::max(most, std::ranges::max(c.delta_e));
  return most;
}

void smaller_than_others(Findings& to, const SchlickRows& r) {
  std::array<std::size_t, 2> smaller{}, all{};
  const MaskingColour* glass = nullptr;
  for (const auto& m : r.masked) {
    const bool of_metal = m.kind == "metal";
    smaller[of_metal] += 2 * shown_by_schlick(r, m.material) < m.delta_e;
    ++all[of_metal];
    if (m.material == "IOR 1.5") glass = &m;
  }
  if (!glass) return;
  to.judge("Schlick's error is significantly less than that of other factors",
           "Burley 2012, Physically-Based Shading at Disney",
           verdict(smaller[0] == all[0] && smaller[1] == all[1], smaller[0] + smaller[1] > 0),
           fmt::format("glass: ΔE2000 {} by Schlick, {} by masking",
                       rounded_up(shown_by_schlick(r, "IOR 1.5")), rounded_up(glass->delta_e)),
           fmt::format("The other factor is Unreal's joint masking. For {} metals and {} of the "
                       "dielectrics, Schlick's error is less than half of that masking's.",
                       of_all(smaller[1], all[1]), number_or_none(smaller[0])));
}

void means_metal(Findings& to) {
  struct Value {
    std::string_view name;
    double f0;
  };
  std::vector<Value> above;
  for (const auto& m : dielectrics())
    if (const double f0 = f0_of_index(m.at(550)); f0 > 0.04) above.push_back({m.name, f0});
  if (above.empty()) return;
  const auto most = std::ranges::max_element(above, {}, &Value::f0);
  to.judge("F0 above 0.04 means metal", "", verdict(false),
           fmt::format("{}: F0 {:.2f}", most->name, most->f0),
           fmt::format("{} measured dielectrics are above 0.04. F0 is that at 550 nm.",
                       of_all(above.size(), dielectrics().size())));
}

void colour_beside_f(Findings& to) {
  const double glass = dielectric(1.5, "glass").f0(0), twice = glass * glass;
  to.judge("f = D F G/(4 NoL NoV) · NoL · SpecularColor", "", verdict(false),
           fmt::format("glass, seen head on, reflects {} instead of {}", percent(twice, 2),
                       percent(glass, 2)),
           "F is the specular colour already.");
}

}  // namespace

std::vector<MaskingColour> masked_rows(const SchlickOptions& o,
                                       const std::function<void(double)>& done) {
  std::vector<FresnelSurface> surfaces;
  for (const double ior : {1.33, 1.5, 2.0})
    surfaces.push_back(dielectric(ior, fmt::format("IOR {:g}", ior)));
  for (const auto& m : metals()) surfaces.push_back(metal(m));
  std::vector<MaskingColour> out;
  for (const auto& s : surfaces) {
    double most = 0;
    for (const double r : o.roughness) {
      const auto exact = colours("smith_ggx.correlated", s, r),
                 with = colours(shipped_masking, s, r);
      for (std::size_t m = 0; m < exact.size(); ++m)
        most = std::max(most, delta_e_2000(with[m], exact[m]));
    }
    out.push_back({s.material, s.kind, most});
    done(static_cast<double>(out.size()) / static_cast<double>(surfaces.size()));
  }
  return out;
}

void judge_what_stands_beside_f(Findings& to, const SchlickRows& r) {
  smaller_than_others(to, r);
  means_metal(to);
  colour_beside_f(to);
}

}  // namespace gonio
