// The remap report in sentences: made from its figures alone.
#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/finding/names.h"
#include "reports/finding/words.h"
#include "reports/remap/influence.h"
#include "reports/remap/remap.h"

#include <fmt/format.h>

namespace gonio {
namespace {

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
/// The masking to take: the nearest to exact Smith for GGX of what is shipped in its place, and what it spares.
void nearest_form(Findings& to, const RemapRows& r) {
  const RemapForm* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  const auto* smith = find_form(r.forms, form_id::smith);
  // Forms of the same values in other words: the one of fewer operations.
  const auto is_nearer = [&](double rms, const RemapForm& f) {
    const bool same = std::abs(rms - least) <= 1e-6 * least;
    return same ? f.operations < nearest->operations : rms < least;
  };
  for (const auto& f : r.forms) {
    // what is exact, or needs as much, spares nothing
    if (f.form == form_id::smith || f.form == form_id::separable_smith ||
        (smith && f.operations >= smith->operations))
      continue;
    if (const auto rms = overall_rms(r, f.form, form_id::smith);
        rms && (!nearest || is_nearer(*rms, f)))
      nearest = &f, least = *rms;
  }
  if (!nearest) return;
  const auto off = overall_rms(r, form_id::direct_k, form_id::smith);
  to.headline = fmt::format(
      "{} is the cheap masking nearest to height-correlated Smith: its RMS error in G₂ is "
      "{:.2g}{}.",
      name_of_form(nearest->form), least,
      off ? fmt::format(", that of Schlick's k = (r+1)²/8 is {:.2g}", *off) : "");
  to.say(to.headline);
  if (smith)
    to.say(
        fmt::format("It takes {} operations a sample where height-correlated Smith takes {}, {} of "
                    "them square roots.",
                    nearest->operations, smith->operations, smith->roots));
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
  const auto ours = rows_of(r, form_id::direct_k, form_id::smith),
             others = rows_of(r, form_id::image_k, form_id::smith);
  if (ours.empty() || others.empty()) return;
  const auto d = duel(ours, others);
  to.judge("k = (r+1)²/8 is right for direct light, r²/2 for image-based", "",
           verdict(d.nearer >= d.all, 2 * d.nearer >= d.all),
           fmt::format("RMS error of G₂: {:.2g} with (r+1)²/8, {:.2g} with r²/2",
                       *overall_rms(r, form_id::direct_k, form_id::smith),
                       *overall_rms(r, form_id::image_k, form_id::smith)),
           fmt::format("Smith's masking is the same for all light. (r+1)²/8 is nearer to it than "
                       "r²/2 at {} of {} "
                       "roughnesses.",
                       d.nearer, d.all));
  for (const double at : {0.1, 0.3})
    if (const auto* a = row_at(ours, at))
      to.say(fmt::format(
          "A surface of roughness {:g} is masked by Schlick's k = (r+1)²/8 like {} by "
          "height-correlated Smith.",
          at,
          a->by_g2.at_end ? a->by_g2.roughness < 0.5 ? "the smoothest" : "the roughest"
                          : fmt::format("one of roughness {:.2f}", a->by_g2.roughness)));
}

/// "13 % less"
std::string beside(double ratio, std::string_view below = "less", std::string_view above = "more") {
  return fmt::format("{} {}", percent(std::abs(ratio - 1), 2), ratio < 1 ? below : above);
}

/// Each k where the other is meant to be.
void wrong_place(Findings& to, const RemapRows& r) {
  constexpr double mu = 0.1, rough = 0.3;
  const auto find = [&](std::string_view form, std::string_view light) {
    const auto it = std::ranges::find_if(r.uses, [&](const RemapUse& u) {
      return u.form == form && u.light == light && std::abs(u.mu - mu) < 1e-9 &&
             std::abs(u.roughness - rough) < 1e-9;
    });
    return it == r.uses.end() ? nullptr : &*it;
  };
  struct Use {
    std::string_view light, of, form, k;
  };
  for (const auto& [light, of, form, k] :
       {Use{"even", "an even sky", form_id::direct_k, "direct light"},
        Use{"single", "a single light in the mirror direction", form_id::image_k,
            "image-based light"}})
    if (const auto* use = find(form, light))
      to.say(
          fmt::format("Schlick's k for {} reflects {} of {} than height-correlated Smith, at "
                      "roughness {:g} and cosine {:g}.",
                      k, beside(use->value / use->correlated), of, rough, mu));
}

/// 'k = α/2 is too bright at grazing angles', and what is taken in its place.
void verdict_on_g1(Findings& to, const RemapRows& r) {
  if (r.g1.size() < 2) return;
  const auto &half = r.g1[0], &remapped = r.g1[1];
  to.judge("k = α/2 is too bright at grazing angles", "", verdict(half.value > half.smith),
           fmt::format("{} than exact Smith at NoV {:g}",
                       beside(half.value / half.smith, "darker", "brighter"), half.nov),
           fmt::format("at roughness {:g} G1 is {:.3f}, exactly {:.3f}.", half.roughness,
                       half.value, half.smith));
  to.judge(
      "with k = (r+1)²/8 the edge is 72 % darker, like that of a medium roughness", "",
      verdict(std::abs(remapped.value - remapped.smith) < 0.05 * remapped.smith,
              std::abs(1 - remapped.value - 0.72) < 0.005),
      fmt::format(
          "it masks {1} of the light there; exact Smith of a medium roughness ({0:.2g}) masks {2}",
          remapped.roughness, percent(1 - remapped.value, 2), percent(1 - remapped.smith, 2)),
      fmt::format("at NoV {:g} G1 is {:.3f}, exactly {:.3f}.", remapped.nov, remapped.value,
                  remapped.smith));
}

/// Largest factor, up or down, by which a ratio that is so many times as large is off.
double largest_factor(const RemapVf& v, double as_large) {
  return std::max(as_large * v.most, 1 / (as_large * v.least));
}

/// 'F V ≈ 1/(LoH²(r+0.5))'
void verdict_on_vf(Findings& to, const RemapRows& r) {
  // the catalogue's form has the ¼ of a BRDF, which the claim leaves out
  constexpr double as_printed = 4;
  double most = 0, with_it = 0;
  for (const auto& v : r.vf) {
    if (v.form != "masking.unity_mobile" || v.over != "mirror" || v.fresnel != "glass, n = 1.5")
      continue;
    most = std::max(most, largest_factor(v, as_printed));
    with_it = std::max(with_it, largest_factor(v, 1));
  }
  if (most == 0) return;
  to.judge(
      "F V ≈ 1/(LoH²(r+0.5))", "", verdict(most < 1.1),
      fmt::format("off by a factor of up to {}", rounded_up(most)),
      fmt::format("tested on glass, in the mirror direction. With a ¼, as in Unity's own form, it "
                  "is off by up to {}.",
                  rounded_up(with_it)));
}

}  // namespace

Findings findings(const RemapRows& r) {
  Findings all;
  nearest_form(all, r);
  verdict_on_k(all, r);
  wrong_place(all, r);
  verdict_on_g1(all, r);
  verdict_on_vf(all, r);
  judge_influence_of_masking(all, r);
  return all;
}

}  // namespace gonio
