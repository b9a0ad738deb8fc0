// Errors over the angle: of every form on every surface, as maps, and as curves.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "geometry/direction.h"
#include "reports/schlick/schlick.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// Wavelength at which a dielectric has one index [nm].
constexpr double middle_nm = 550;

FresnelSurface (*const sides[])(double, std::string) = {dielectric, dielectric_inside};

std::vector<FresnelSurface> named_surfaces() {
  std::vector<FresnelSurface> out;
  for (const auto& m : dielectrics())
    for (const auto side : sides) out.push_back(side(m.at(middle_nm).n, std::string(m.name)));
  for (const auto& m : metals()) out.push_back(metal(m));
  for (const auto list : {dielectrics(), metals()})
    for (const auto& m : list) out.push_back(spectral(m));
  return out;
}

}  // namespace

std::vector<FresnelRow> smooth_rows(const SchlickOptions& o,
                                    const std::function<void(double)>& done) {
  auto surfaces = named_surfaces();
  for (const double ior : o.ior)
    for (const auto side : sides) surfaces.push_back(side(ior, fmt::format("IOR {:g}", ior)));
  std::vector<std::vector<FresnelRow>> rows(surfaces.size());
  tbb::parallel_for(std::size_t{0}, surfaces.size(),
                    [&](std::size_t i) { rows[i] = fresnel_errors(surfaces[i], o.angles); });
  std::vector<FresnelRow> out;
  for (auto& of_one : rows) std::ranges::move(of_one, std::back_inserter(out));
  done(1);
  return out;
}

FresnelMaps fresnel_maps() {
  FresnelMaps out;
  constexpr double ior_step = 0.05, theta_step = 2;
  for (int i = 0; i < 40; ++i) out.ior.push_back(1 + (i + 0.5) * ior_step);
  std::vector<double> cosine;
  for (double theta = theta_step / 2; theta < 90; theta += theta_step) {
    out.theta_deg.push_back(theta);
    cosine.push_back(std::cos(theta * degree));
  }
  for (const auto side : sides) {
    std::vector<FresnelMap> maps;
    for (const double ior : out.ior) {
      const auto s = side(ior, "");
      const auto forms = forms_for(s);
      if (maps.empty()) {
        maps.push_back({"exact", s.kind, {}});
        for (const auto& f : forms) maps.push_back({f.name, s.kind, {}});
      }
      const auto exact = exact_values(s, cosine)[0];
      std::ranges::copy(exact, std::back_inserter(maps[0].error));
      for (std::size_t f = 0; f < forms.size(); ++f) {
        const auto value = form_values(forms[f], s, 0, cosine);
        for (std::size_t k = 0; k < value.size(); ++k)
          maps[f + 1].error.push_back(value[k] - exact[k]);
      }
    }
    std::ranges::move(maps, std::back_inserter(out.maps));
  }
  return out;
}

FresnelCurves fresnel_curves() {
  const auto at = angle_steps(90);
  FresnelCurves out{at.theta_deg, {}};
  for (const auto& s : named_surfaces()) {
    const auto forms = forms_for(s);
    const auto exact = exact_values(s, at.cosine);
    for (std::size_t c = 0; c < s.channels(); ++c) {
      const auto add = [&](const std::string& form, std::vector<double> value) {
        out.curves.push_back({form, s.kind, s.material, s.channel(c), std::move(value)});
      };
      add("exact", exact[c]);
      for (const auto& f : forms) add(f.name, form_values(f, s, c, at.cosine));
    }
  }
  return out;
}

}  // namespace gonio
