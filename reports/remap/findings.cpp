// The remap report in sentences: made from its figures alone.
#include <algorithm>
#include <cmath>
#include <limits>

#include "brdf/catalogue/registry.h"
#include "reports/finding/words.h"
#include "reports/remap/influence.h"
#include "reports/remap/remap.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

constexpr std::string_view separable = "masking.smith_ggx.separable",
                           correlated = "masking.smith_ggx.correlated",
                           direct = "masking.schlick_ggx.direct",
                           image = "masking.schlick_ggx.half_alpha";

std::string rough(const NearestRoughness& n) {
  return !n.at_end           ? fmt::format("{:.2f}", n.roughness)
         : n.roughness < 0.5 ? "the smoothest"
                             : "the roughest";
}

std::vector<const RemapRow*> rows_of(const RemapRows& r,
                                     std::string_view form,
                                     std::string_view reference) {
  std::vector<const RemapRow*> out;
  for (const auto& row : r.rows)
    if (row.form == form && row.reference == reference) out.push_back(&row);
  return out;
}
const RemapRow* row_at(const std::vector<const RemapRow*>& rows, double roughness) {
  const auto it = std::ranges::find_if(
      rows, [&](const RemapRow* r) { return std::abs(r->roughness - roughness) < 1e-9; });
  return it == rows.end() ? nullptr : *it;
}
/// Forms from the nearest to the furthest.
void ranking(Findings& to, const RemapRows& r, std::string_view reference, std::string_view what) {
  struct Place {
    std::string_view form;
    double rms;
  };
  std::vector<Place> places;
  for (const auto& f : r.forms)
    if (const auto rms = overall_rms(r, f.form, reference); f.form != reference && rms)
      places.push_back({f.form, *rms});
  if (places.empty()) return;
  std::ranges::sort(places, {}, &Place::rms);
  std::vector<std::string> words;
  for (const auto& p : places) words.push_back(fmt::format("{} {:.2g}", short_id(p.form), p.rms));
  to.say(fmt::format("Nearest to {}, by RMS of G2 over directions and roughness: {}.", what,
                     ranking_text(words, "; furthest: ")));
}

/// Operations of a sample, of exact Smith and of what stands for it.
void costs(Findings& to, const RemapRows& r) {
  std::vector<std::string> words;
  for (const auto id : {correlated, separable, image, direct, std::string_view("masking.ue_joint")})
    for (const auto& f : r.forms)
      if (f.form == id)
        words.push_back(fmt::format("{} {} ({} roots)", short_id(id), f.operations, f.roots));
  if (words.size() > 1)
    to.say(fmt::format("Operations of one sample: {}.", fmt::join(words, ", ")));
}

/// Number of roughnesses at which the one is nearer than the other, where the figures can tell.
struct Duel {
  std::size_t nearer = 0, tied = 0, all = 0;
};
Duel duel(const std::vector<const RemapRow*>& ours, const std::vector<const RemapRow*>& others) {
  Duel d{0, 0, ours.size()};
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const double least = 1e-12 + ours[i]->rms_error + others[i]->rms_error;
    d.tied += std::abs(ours[i]->rms - others[i]->rms) <= least;
    d.nearer += ours[i]->rms < others[i]->rms - least;
  }
  return d;
}

/// 'k = (r+1)²/8 is right for direct light, r²/2 for image-based'
void verdict_on_k(Findings& to, const RemapRows& r) {
  const auto ours = rows_of(r, direct, separable), others = rows_of(r, image, separable);
  if (ours.empty() || others.empty()) return;
  const auto one = duel(ours, others),
             two = duel(rows_of(r, direct, correlated), rows_of(r, image, correlated));
  const std::size_t nearer = one.nearer + two.nearer;
  if (const auto* a = row_at(ours, 0.1); a && !a->by_g2.at_end)
    to.headline = fmt::format(
        "Schlick's k = (r+1)²/8 masks a surface of roughness 0.1 like one of roughness {:.2f}.",
        a->by_g2.roughness);
  std::vector<std::string> behaves;
  for (const double at : {0.1, 0.3, 0.5, 0.8})
    if (const auto* a = row_at(ours, at), *b = row_at(others, at); a && b)
      behaves.push_back(fmt::format("{:g} as {} (r²/2: {})", at, rough(a->by_g2), rough(b->by_g2)));
  to.judge(
      "k = (r+1)²/8 is right for direct light, r²/2 for image-based", "seed 000, k of Schlick's G1",
      verdict(nearer >= one.all + two.all, 2 * nearer >= one.all + two.all),
      fmt::format("G₂ off by {:.2g} against {:.2g}, RMS", *overall_rms(r, direct, separable),
                  *overall_rms(r, image, separable)),
      fmt::format(
          "Smith's masking knows no "
          "kind of light, and (r+1)²/8 is nearer than r²/2 to separable Smith at {} of {} "
          "roughnesses "
          "({} tied), to correlated Smith at {} ({} tied); RMS of G2 from separable Smith {:.2g} "
          "against {:.2g}. Roughness masks with (r+1)²/8 like another of exact Smith: {}.",
          one.nearer, one.all, one.tied, two.nearer, two.tied, *overall_rms(r, direct, separable),
          *overall_rms(r, image, separable), fmt::join(behaves, ", ")));
}

void wrong_place(Findings& to, const RemapRows& r) {
  const auto find = [&](std::string_view form, std::string_view light, double mu, double rough) {
    const auto it = std::ranges::find_if(r.uses, [&](const RemapUse& u) {
      return u.form == form && u.light == light && std::abs(u.mu - mu) < 1e-9 &&
             std::abs(u.roughness - rough) < 1e-9;
    });
    return it == r.uses.end() ? nullptr : &*it;
  };
  const auto *low = find(direct, "even", 0.1, 0.3), *up = find(direct, "even", 1, 0.3),
             *image_low = find(image, "even", 0.1, 0.3), *image_up = find(image, "even", 1, 0.3);
  if (low && up && image_low && image_up)
    to.say(fmt::format(
        "Direct light's k under an even environment (F = 1, roughness 0.3): E = {:.3f} at normal "
        "incidence and {:.3f} at mu = 0.1, where r²/2 gives {:.3f} and {:.3f}, Smith (separable) "
        "{:.3f} and {:.3f}.",
        up->value, low->value, image_up->value, image_low->value, up->separable, low->separable));
  const auto *light = find(image, "single", 0.1, 0.3), *own = find(direct, "single", 0.1, 0.3),
             *normal = find(image, "single", 1, 0.3), *own_normal = find(direct, "single", 1, 0.3);
  if (light && own && normal && own_normal)
    to.say(fmt::format(
        "A single light seen in its mirror direction at roughness 0.3: at normal incidence "
        "image-based light's k gives {:.3g} of exact Smith's (separable) and direct light's "
        "{:.3g}; "
        "at cosine 0.1 they give {:.3g} and {:.3g} of it.",
        normal->value / normal->separable, own_normal->value / own_normal->separable,
        light->value / light->separable, own->value / own->separable));
}

void verdict_on_g1(Findings& to, const RemapRows& r) {
  if (r.g1.empty()) return;
  std::vector<std::string> values, exact;
  bool holds = true;
  for (const auto& g : r.g1) {
    holds = holds && std::abs(g.value - g.claimed) < 0.005;
    values.push_back(fmt::format("{:.4f} (k {:.3f})", g.value, g.k));
    exact.push_back(fmt::format("{:.3f} at roughness {:g}", g.smith, g.roughness));
  }
  to.judge("G1 at NoV 0.1: 0.47 (k 0.125) and 0.28 (k 0.281)", "seed 000, Disney's remapping of k",
           verdict(holds), fmt::format("exact Smith: {}", fmt::join(exact, ", ")),
           fmt::format("of Schlick's form it is {}. Exact Smith "
                       "for GGX, which these k = (r+1)²/8 stand for, is {}.",
                       fmt::join(values, " and "), fmt::join(exact, " and ")));
}

/// 'F V ≈ 1/(LoH²(r+0.5))'
void verdict_on_vf(Findings& to, const RemapRows& r) {
  constexpr std::string_view glass = "glass, n = 1.5";
  const auto of = [&](std::string_view over, std::string_view fresnel) {
    std::vector<const RemapVf*> out;
    for (const auto& v : r.vf)
      if (v.form == "masking.unity_mobile" && v.over == over && v.fresnel == fresnel)
        out.push_back(&v);
    return out;
  };
  const auto all = of("all", glass), mirror = of("mirror", glass), white = of("mirror", "F = 1");
  if (all.empty()) return;
  const auto range = [](const std::vector<const RemapVf*>& list) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const auto* v : list) least = std::min(least, v->least), most = std::max(most, v->most);
    return fmt::format("{:.2g} to {:.3g}", least, most);
  };
  const auto factors = [](const std::vector<const RemapVf*>& list) {
    const auto [least, most] = std::ranges::minmax_element(list, {}, &RemapVf::factor);
    return fmt::format("{:.2g} to {:.2g}", (*least)->factor, (*most)->factor);
  };
  const bool holds = (*std::ranges::max_element(mirror, {}, &RemapVf::factor))->factor < 1.1;
  to.judge(
      "F V ≈ 1/(LoH²(r+0.5))", "seed 000, mobile specular BRDF", verdict(holds),
      fmt::format("off by a factor of {}", factors(mirror)),
      fmt::format(
          "against Smith (correlated) times the exact Fresnel term of "
          "glass it is off by a factor of {} (RMS, by roughness) in the mirror direction and of {} "
          "over "
          "all directions, where it is {} times as much; at F = 1 by {} in the mirror direction, "
          "{} "
          "times as much.",
          factors(mirror), factors(all), range(all), factors(white), range(white)));
}

}  // namespace

Findings findings(const RemapRows& r) {
  Findings all;
  verdict_on_k(all, r);
  ranking(all, r, correlated, "exact Smith for GGX, correlated");
  costs(all, r);
  wrong_place(all, r);
  verdict_on_g1(all, r);
  verdict_on_vf(all, r);
  ranking(all, r, "masking.smith_beckmann.correlated", "exact Smith for Beckmann, correlated");
  judge_influence_of_masking(all, r);
  return all;
}

}  // namespace gonio
