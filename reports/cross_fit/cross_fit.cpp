#include "reports/cross_fit/cross_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <tuple>

#include "base/whole_loop.h"
#include "optics/refractive_index.h"
#include "reports/cross_fit/cases.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Forms that are fitted by the other metric and over the other layouts too, on these materials.
constexpr std::array compared{"exact",
                              "fresnel.schlick",
                              "masking.smith_ggx.separable",
                              "masking.schlick_ggx.half_alpha",
                              "masking.schlick_ggx.direct",
                              "masking.ue_joint",
                              "ndf.gtr",
                              "ndf.beckmann",
                              "ndf.blinn_phong",
                              "gtr/schlick_ggx.direct/schlick",
                              "model.gltf"};
constexpr std::array compared_materials{"IOR 1.5", "gold"};

/// A slice and all that is fitted to it.
struct Scene {
  const CrossTruth& truth;
  const FresnelSurface& surface;
  double roughness;
  const CrossLayout& layout;
  bool compared;  ///< of a material where more is looked at
};

bool holds(auto&& list, std::string_view name) {
  return std::ranges::find(list, name) != std::end(list);
}

/// What is fitted to a slice.
std::vector<CrossCase> fitted(const Scene& at, const CrossSlice& slice, const CrossFitOptions& o) {
  const bool other_layout = &at.layout != &cross_layouts[0];
  std::vector<CrossCase> out;
  for (const auto& form : cross_forms(at.truth)) {
    if (form.metals_only && at.surface.kind != "metal") continue;
    if (form.name != "exact" && !o.forms.empty() && !holds(o.forms, form.name)) continue;
    const bool more = at.compared && holds(compared, form.name);
    if (other_layout && !more) continue;
    for (const Metric metric : {Metric::log, Metric::l2_cosine}) {
      // a finer slice is a check of the bins, and no other set of directions
      if (metric != Metric::log && (!more || at.layout.finer > 1)) continue;
      auto c = fit_case(at.truth, form, at.surface, at.roughness, slice, metric);
      c.layout = at.layout.name;
      out.push_back(std::move(c));
    }
  }
  return out;
}

}  // namespace

CrossFitOptions cross_fit_options(bool full) {
  CrossFitOptions o{full,
                    {},
                    {1.33, 1.5, 2},
                    {"Au", "Al", "Cu"},
                    {1.5, 3},
                    full ? 45U : 30U,
                    full ? 2048U : 1024U};
  o.published = true;
  const int n = full ? 20 : 10;
  for (int i = full ? 2 : 1; i <= n; ++i) o.roughness.push_back(static_cast<double>(i) / n);
  if (full) {
    o.ior.push_back(2.42);
    o.metals.insert(o.metals.end(), {"Ag", "Cr"});
    o.gamma = {1, 1.5, 3, 5};
  }
  return o;
}

CrossFitRows cross_fit_rows(const CrossFitOptions& o, const ReportProgress& done) {
  CrossFitRows r;
  r.roughness = o.roughness;
  const auto truths = cross_truths(o);
  std::vector<FresnelSurface> surfaces;
  for (const double ior : o.ior) surfaces.push_back(dielectric(ior, fmt::format("IOR {:g}", ior)));
  for (const auto& m : o.metals) surfaces.push_back(metal(*find_metal(m)));
  for (const auto& s : surfaces) r.materials.push_back(s.material);

  std::vector<Scene> scenes;
  for (const auto& t : truths)
    for (const auto& s : surfaces)
      for (const double roughness : o.roughness)
        for (const auto& layout : cross_layouts) {
          const bool more = t.ndf == "ggx" && holds(compared_materials, s.material);
          if (&layout == &cross_layouts[0] || (more && !t.multiple))
            scenes.push_back({t, s, roughness, layout, more});
        }

  std::map<std::tuple<const CrossTruth*, std::string_view, double, const CrossLayout*>,
           std::vector<std::size_t>>
      alike;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto& at = scenes[i];
    alike[{&at.truth, at.surface.kind, at.roughness, &at.layout}].push_back(i);
  }
  std::vector<std::vector<std::size_t>> groups;  // of scenes that share their walks
  for (auto& [key, group] : alike) groups.push_back(std::move(group));

  std::vector<std::vector<CrossCase>> cases(scenes.size());
  std::vector<double> walk_errors(scenes.size());
  std::mutex telling;
  std::size_t ready = 0;
  for_each_whole(groups.size(), [&](std::size_t g) {
    const auto& at = scenes[groups[g].front()];
    std::vector<FresnelSurface> of_group;
    for (const auto i : groups[g]) of_group.push_back(scenes[i].surface);
    const auto slices = slices_of(at.truth, of_group, at.roughness, at.layout, o);
    for_each_whole(slices.size(), [&](std::size_t k) {
      const auto i = groups[g][k];
      cases[i] = fitted(scenes[i], slices[k], o);
      walk_errors[i] = slices[k].log_error;
    });
    const std::lock_guard lock(telling);
    ready += slices.size();
    if (done)
      done("slices fitted", static_cast<double>(ready) / static_cast<double>(scenes.size()));
  });
  for (auto& of_one : cases) std::ranges::move(of_one, std::back_inserter(r.cases));
  r.walk_error = std::ranges::max(walk_errors);
  if (o.published) r.published = published_fits(o.bins);
  return r;
}
CrossFitReport cross_fit_report(const CrossFitOptions& o, const ReportProgress& done) {
  return report_of(o.full, cross_fit_rows(o, done));
}

}  // namespace gonio
