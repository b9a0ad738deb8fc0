// What is said of the remaps: each k in either use, Schlick's G1, what stands in place of V F.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "brdf/catalogue/registry.h"
#include "brdf/in_number/one_term.h"
#include "geometry/half_difference.h"
#include "reports/finding/names.h"
#include "reports/remap/pairs.h"

namespace gonio::remapping {
namespace {

/// The mirror direction, h = n.
Row mirror(double mu) {
  const double theta = std::acos(mu);
  return frame_angles({direction(theta, 0), direction(theta, std::numbers::pi)});
}
double mirrored(std::string_view id, double roughness, double mu) {
  const Row row = mirror(mu);
  return g2_at(find_term(id), roughness, {&row, 1})[0];
}

/// G1 of the viewer: NoL = 1, where G1(l) = 1.
double g1(std::string_view id, double alpha, double nov) {
  return evaluate_term(find_term(id), Number::double_, {{"alpha", alpha}},
                       {{"nol", {1}}, {"nov", {nov}}})
      .values[0];
}

struct Fresnel {
  std::string_view name, id;
  std::vector<double> parameters;
  double f0;
};

/// F0 V' over V F at each row.
RemapVf ratios(const RemapForm& f,
               const Fresnel& fresnel,
               std::string_view over,
               double roughness,
               std::span<const Row> rows) {
  const auto shipped = g2_at(find_term(f.form), roughness, rows),
             smith = g2_at(find_term(form_id::smith), roughness, rows);
  const auto reflected =
      values_in(Number::double_, find_term(fresnel.id), fresnel.parameters, rows);
  RemapVf out{f.form,
              std::string(fresnel.name),
              over,
              roughness,
              0,
              0,
              std::numeric_limits<double>::infinity(),
              0};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double ratio = fresnel.f0 * shipped[i] / (smith[i] * reflected[i]), ln = std::log(ratio);
    out.bias += ln;
    out.factor += ln * ln;
    out.least = std::min(out.least, ratio);
    out.most = std::max(out.most, ratio);
  }
  const auto n = static_cast<double>(rows.size());
  out.bias = std::exp(out.bias / n);
  out.factor = std::exp(std::sqrt(out.factor / n));
  return out;
}

}  // namespace

std::vector<RemapUse> uses_of_k(const std::vector<RemapForm>& forms, std::span<const double> mus) {
  std::vector<RemapUse> out;
  const auto *of_separable = find_form(forms, form_id::separable_smith),
             *of_correlated = find_form(forms, form_id::smith);
  if (!of_separable || !of_correlated) return out;
  for (const auto id : {form_id::direct_k, form_id::image_k}) {
    const auto* f = find_form(forms, id);
    if (!f) continue;
    for (std::size_t i = 0; i < f->at.size(); ++i) {
      const double r = f->at[i].roughness;
      for (std::size_t m = 0; m < mus.size(); ++m) {
        const double mu = mus[m];
        out.push_back({std::string(id), "even", mu, r, f->at[i].albedo[m],
                       of_separable->at[i].albedo[m], of_correlated->at[i].albedo[m]});
        out.push_back({std::string(id), "single", mu, r, mirrored(id, r, mu),
                       mirrored(form_id::separable_smith, r, mu), mirrored(form_id::smith, r, mu)});
      }
    }
  }
  return out;
}

std::vector<RemapG1> claimed_g1() {
  std::vector<RemapG1> out;
  constexpr double nov = 0.1;
  constexpr double r = 0.5;  // the claim's example
  for (const auto& [k, claimed] : {std::pair(r * r / 2, 0.47), {(r + 1) * (r + 1) / 8, 0.28}})
    // G1 depends on k alone, and alpha = 2k says it
    out.push_back({k, nov, claimed, g1(form_id::image_k, 2 * k, nov), r,
                   g1(form_id::separable_smith, r * r, nov)});
  return out;
}

std::vector<RemapVf> in_place_of_vf(const std::vector<RemapForm>& forms,
                                    const RemapOptions& o,
                                    std::span<const double> cosines) {
  std::vector<RemapVf> out;
  const Fresnel interfaces[] = {{"glass, n = 1.5", "fresnel.dielectric", {1.5}, 0.04},
                                {"F = 1", "fresnel.constant", {1}, 1}};
  const Pairs all(all_pairs(cosines), o.azimuths);
  std::vector<Row> mirrors;
  for (const double c : cosines) mirrors.push_back(mirror(c));
  for (const auto* id :
       {"masking.unity_mobile", "masking.unity_mobile.urp", "masking.ue_mobile_simple"})
    if (const auto* f = find_form(forms, id))
      for (const auto& fresnel : interfaces)
        for (const double r : o.roughness) {
          out.push_back(ratios(*f, fresnel, "all", r, all.rows()));
          out.push_back(ratios(*f, fresnel, "mirror", r, mirrors));
        }
  return out;
}

}  // namespace gonio::remapping
