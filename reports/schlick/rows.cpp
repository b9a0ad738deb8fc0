// Errors over the angle: of every form on every surface, as maps, and as curves.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/direction.h"
#include "reports/schlick/parts.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// Where a dielectric has one index [nm].
constexpr double middle_nm = 550;
constexpr double one_percent = 0.01;

/// Steps of θ, and where total reflection begins: there F has a corner, between any steps.
struct Angles {
  AngleSteps at;
  std::size_t even;  ///< so many are steps

  Angles(const FresnelSurface& s, std::size_t steps) : at(angle_steps(steps)), even(steps + 1) {
    const double eta = s.index[0].n;
    if (s.kind != "dielectric_inside") return;
    at.theta_deg.push_back(std::asin(eta) / degree);
    at.cosine.push_back(std::sqrt((1 - eta) * (1 + eta)) * (1 - 1e-14));
  }
};

FresnelRow row_of(const std::string& form,
                  const FresnelSurface& s,
                  std::size_t channel,
                  const Angles& angles,
                  const std::vector<double>& exact,
                  const std::vector<double>& value) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const auto& i = s.index[channel];
  const std::string of = s.channel(channel);
  FresnelRow r{form,
               s.kind,
               of.empty() ? s.material : s.material + ", " + of,
               s.material,
               of,
               s.spectrum ? unknown : i.n,
               s.spectrum ? unknown : i.k,
               0,
               0,
               0,
               0,
               0,
               0,
               90};
  const double step = 90.0 / static_cast<double>(angles.even - 1) * degree;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    const double off = value[k] - exact[k], theta = angles.at.theta_deg[k];
    if (std::abs(off) > r.max_abs) r.max_abs = std::abs(off), r.max_abs_theta_deg = theta;
    if (const double rel = std::abs(off) / std::abs(exact[k]); exact[k] != 0 && rel > r.max_rel)
      r.max_rel = rel, r.max_rel_theta_deg = theta;
    if (std::abs(off) > one_percent) r.within_deg = std::min(r.within_deg, theta);
    if (k >= angles.even) continue;
    const double weight = (k == 0 || k + 1 == angles.even ? 0.5 : 1) * step,
                 c = angles.at.cosine[k];
    r.rms += weight * off * off / (std::numbers::pi / 2);
    r.bias += weight * 2 * c * std::sqrt((1 - c) * (1 + c)) * off;
  }
  r.rms = std::sqrt(r.rms);
  return r;
}

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

std::vector<FresnelRow> rows_of(const FresnelSurface& s, std::size_t steps) {
  const Angles angles(s, steps);
  const auto forms = forms_for(s);
  const auto exact = exact_values(s, angles.at.cosine);
  std::vector<FresnelRow> out;
  for (std::size_t c = 0; c < s.channels(); ++c)
    for (const auto& f : forms)
      out.push_back(row_of(f.name, s, c, angles, exact[c], form_values(f, s, c, angles.at.cosine)));
  return out;
}

void add_rows(SchlickReport& report,
              const SchlickOptions& o,
              const std::function<void(double)>& done) {
  auto surfaces = named_surfaces();
  for (const double ior : o.ior)
    for (const auto side : sides) surfaces.push_back(side(ior, fmt::format("IOR {:g}", ior)));
  std::vector<std::vector<FresnelRow>> rows(surfaces.size());
  tbb::parallel_for(std::size_t{0}, surfaces.size(),
                    [&](std::size_t i) { rows[i] = rows_of(surfaces[i], o.angles); });
  for (auto& of_one : rows) std::ranges::move(of_one, std::back_inserter(report.rows));
  done(1);
}

void add_maps(SchlickReport& report) {
  constexpr double ior_step = 0.05, theta_step = 2;
  for (int i = 0; i < 40; ++i) report.map_ior.push_back(1 + (i + 0.5) * ior_step);
  std::vector<double> cosine;
  for (double theta = theta_step / 2; theta < 90; theta += theta_step) {
    report.map_theta_deg.push_back(theta);
    cosine.push_back(std::cos(theta * degree));
  }
  for (const auto side : sides) {
    std::vector<FresnelMap> maps;
    for (const double ior : report.map_ior) {
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
    std::ranges::move(maps, std::back_inserter(report.maps));
  }
}

void add_curves(SchlickReport& report) {
  const auto at = angle_steps(90);
  report.curve_theta_deg = at.theta_deg;
  for (const auto& s : named_surfaces()) {
    const auto forms = forms_for(s);
    const auto exact = exact_values(s, at.cosine);
    for (std::size_t c = 0; c < s.channels(); ++c) {
      const auto add = [&](const std::string& form, std::vector<double> value) {
        report.curves.push_back({form, s.kind, s.material, s.channel(c), std::move(value)});
      };
      add("exact", exact[c]);
      for (const auto& f : forms) add(f.name, form_values(f, s, c, at.cosine));
    }
  }
}

}  // namespace gonio
