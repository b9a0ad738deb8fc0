// The energy report in sentences: made from its figures alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "brdf/catalogue/registry.h"
#include "brdf/model/presets.h"
#include "reports/energy/distribution_claims.h"
#include "reports/energy/energy.h"
#include "reports/finding/words.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// "from roughness 0.57 on": where a loss exceeds a share; empty: nowhere.
std::string where_lost(const std::vector<Crossing>& all, double mu, double share) {
  const auto c =
      std::ranges::find_if(all, [&](const Crossing& x) { return x.mu == mu && x.share == share; });
  if (c == all.end() || c->ranges.empty()) return {};
  return range_text(c->ranges[0].from, c->ranges[0].to, "roughness ");
}
constexpr double tenth = 0.1;

/// Form as it stands in a sentence, by its title in the catalogue.
std::string words_for(const EnergyForm& f) {
  if (f.masking == "masking.none") return "GGX without masking";
  if (f.masking == "masking.disney_coat") return "Disney's coat";
  if (!f.model.empty()) return std::string(find_preset(f.model)->about.title);
  return fmt::format("“{}”", catalogue()[find_term(f.masking)].about->title);
}

/// Place where a form reflects most.
const EnergyForm::At& brightest(const EnergyForm& f) {
  return *std::ranges::max_element(f.rows, {}, &EnergyForm::At::albedo);
}

/// More than comes in is reflected somewhere, beyond its error.
bool makes_light(const EnergyForm& f) {
  const auto& at = brightest(f);
  return at.albedo - at.error > 1 + 1e-6;
}

/// Loss of GGX by its masking alone.
void of_white(Findings& to, const EnergyRows& r) {
  const auto* f = find_form(r.forms, "masking.smith_ggx.correlated");
  if (!f) return;
  to.say(fmt::format(
      "White GGX under height-correlated Smith loses a tenth of the light {}, seen head on. Seen "
      "at cosine 0.1 it does {}.",
      where_lost(f->crossings, 1, tenth), where_lost(f->crossings, 0.1, tenth)));
  const auto& rough = f->averages.back();
  for (const auto& c : f->crossings)
    if (c.mu == 0 && c.share == 0.05 && !c.ranges.empty())
      to.headline = fmt::format(
          "Rough metal goes dark: averaged over the hemisphere, one bounce under GGX loses {} of "
          "white light at roughness {:g}. It loses {} or more {}.",
          percent(1 - rough.albedo, 2), rough.roughness, percent(c.share),
          range_text(c.ranges[0].from, c.ranges[0].to, "roughness "));
  const auto normal =
      std::ranges::find_if(f->rows, [](const auto& at) { return at.roughness == 1 && at.mu == 1; });
  const auto* other = find_form(r.forms, "masking.smith_ggx.separable");
  if (other && normal != f->rows.end())
    to.say(
        fmt::format("At roughness 1 it loses {} at normal incidence and {} on average. Separable "
                    "Smith loses {} on average.",
                    percent(1 - normal->albedo), percent(1 - rough.albedo),
                    percent(1 - other->averages.back().albedo)));
}

/// Loss of materials, as a share of what they should reflect.
void of_materials(Findings& to, const EnergyRows& r) {
  struct Told {
    std::string_view material, words;
  };
  static constexpr Told told[] = {{"F0 = 0.04", "plastic of F0 = 0.04"},
                                  {"gold, red", "gold in its red channel"}};
  for (const auto& t : told)
    for (const auto& m : r.materials)
      if (m.name == t.material) {
        const auto where = where_lost(m.crossings, 0, tenth);
        to.say(
            where.empty()
                ? fmt::format("On average over the hemisphere, {} never misses a tenth of what it "
                              "should reflect, however rough it is.",
                              t.words)
                : fmt::format("On average over the hemisphere, {} misses a tenth of what it should "
                              "reflect {}.",
                              t.words, where));
      }
}

void of_compensations(Findings& to, const EnergyRows& r) {
  const auto rms = [&](std::string_view id) {
    const auto c = std::ranges::find(r.compensations, id, &CompensationCost::id);
    return c == r.compensations.end() ? "–" : fmt::format("{:.2g}", c->rms);
  };
  if (!r.compensations.empty())
    to.say(
        fmt::format("With the tables that a shader reads, Kulla and Conty leave an RMS error of "
                    "{} in the albedo, Turquin {} and Fdez-Agüera {}. This is under Schlick's "
                    "Fresnel with F0 from 0.04 on, and roughness and mu of 0.1 or more.",
                    rms("kulla_conty"), rms("turquin"), rms("fdez_aguera")));
  if (r.albedo_forms.size() == 3)
    to.say(fmt::format(
        "The albedo E of GGX as a formula of {} operations is off by {} at most. MaterialX's "
        "fit of it takes {} and is off by up to {}.",
        r.albedo_forms[0].operations, rounded_up(std::abs(r.albedo_forms[0].worst)),
        r.albedo_forms[1].operations, rounded_up(std::abs(r.albedo_forms[1].worst))));
}

/// "0.75", "0.75 to 0.9": roughnesses at which a light by itself shows a way farther from all bounces than nothing is.
std::string farther_at(const std::vector<SingleLight>& all,
                       std::string_view light,
                       std::string_view way,
                       double f0,
                       double from) {
  std::optional<double> least, most;
  for (const auto& s : all) {
    if (s.light != light || s.id != way || s.f0 != f0 || s.roughness < from) continue;
    for (const auto& nothing : all)
      if (nothing.light == light && nothing.id == "single" && nothing.f0 == f0 &&
          nothing.roughness == s.roughness && nothing.delta_e < s.delta_e) {
        if (!least) least = s.roughness;
        most = s.roughness;
      }
  }
  return !least            ? std::string()
         : *least == *most ? fmt::format("{:g}", *least)
                           : fmt::format("{:g} to {:g}", *least, *most);
}

/// Under a single light the order is that of pictures, and need not be that of albedos.
void of_single_lights(Findings& to, const EnergyRows& r) {
  constexpr double metal = 0.9;
  const auto all = facts(r).scattering;
  const auto of = [&](std::string_view id) {
    return std::ranges::find_if(all, [&](const Facts::Scattering& s) {
      return s.id == id && s.f0 == metal && !s.of_image_light;
    });
  };
  const auto nothing = of("single");
  if (nothing == all.end()) return;
  struct Way {
    std::string_view id, name;
    double left = 0;  ///< ΔE2000 at most, from where it pays on
  };
  std::array ways{Way{"kulla_conty", "Kulla and Conty"}, Way{"turquin", "Turquin"}};
  for (auto& w : ways) {
    const auto way = of(w.id);
    if (way == all.end()) return;
    const auto from = nearer_from(*way, *nothing);
    if (!from) {
      to.say(
          fmt::format("Under the worse of a front and a rim light, white metal of F0 = {:g} with "
                      "{} is no nearer to all bounces than with nothing.",
                      metal, w.name));
      w.left = HUGE_VAL;
      continue;
    }
    double without = 0;
    for (std::size_t i = 0; i < way->roughness.size(); ++i)
      if (way->roughness[i] >= *from) {
        w.left = std::max(w.left, way->delta_e[i]);
        without = std::max(without, nothing->delta_e[i]);
      }
    to.say(fmt::format(
        "Under the worse of a front and a rim light, white metal of F0 = {:g} with {} is nearer "
        "to all bounces than with nothing, by more than twice the walks' error, {}.",
        metal, w.name,
        *from == way->roughness.front() ? std::string("at every roughness looked at")
                                        : fmt::format("from roughness {:g} on", *from)));
    to.say(fmt::format("There it leaves ΔE2000 {} at most, where one bounce leaves up to {}.",
                       rounded_up(w.left), rounded_up(without)));
    for (const std::string_view light : {"front light", "rim light"})
      if (const auto at = farther_at(r.single_lights, light, w.id, metal, *from); !at.empty())
        to.say(fmt::format("Under the {} by itself {} is farther than nothing at roughness {}.",
                           light, w.name, at));
  }
  const auto rms = [&](const Way& w) {
    const auto c = std::ranges::find(r.compensations, w.id, &CompensationCost::id);
    return c == r.compensations.end() ? HUGE_VAL : c->rms;
  };
  const auto worst = [&](const Way& w) {
    return std::abs(std::ranges::find(r.compensations, w.id, &CompensationCost::id)->worst);
  };
  if (ways[0].left == ways[1].left || rms(ways[0]) == rms(ways[1])) return;
  const auto& by_light = ways[ways[0].left < ways[1].left ? 0 : 1];
  const auto& by_albedo = ways[rms(ways[0]) < rms(ways[1]) ? 0 : 1];
  to.say(by_light.id == by_albedo.id
             ? fmt::format("Where they pay, {} leaves less at most, as by albedos.", by_light.name)
             : fmt::format("Where they pay, {} leaves less at most. Over albedos, which are light "
                           "from all sides, {}'s RMS error is smaller{}.",
                           by_light.name, by_albedo.name,
                           worst(by_light) < worst(by_albedo)
                               ? fmt::format(", but {}'s largest error is", by_light.name)
                               : std::string()));
}

/// Error of the split sum, where it shows most.
void of_split_sum(Findings& to, const EnergyRows& r) {
  for (const auto& t : r.light.tables)
    if (t.size == 32 && t.stored == "half")
      to.say(
          fmt::format("Over every NoV and roughness, a split-sum table of 32 × 32 texels "
                      "in half gives A + B to {:.2g} RMS. Beyond the outermost centres, at grazing "
                      "angles, it is off by up to {}.",
                      t.lookup_rms, rounded_up(t.lookup)));
  const auto most = [&](double f0, double nov) {
    const LitError* worst = nullptr;
    for (const auto& l : r.light.lit)
      if (l.f0 == f0 && l.nov == nov && (!worst || l.delta_e > worst->delta_e)) worst = &l;
    return worst;
  };
  if (const auto* head_on = most(1, 1), *grazing = most(1, 0.1); head_on && grazing) {
    const auto light = [](const LitError& l) { return fmt::format("the {}", l.environment); };
    to.say(
        fmt::format("The split sum changes white metal seen head on by a mean ΔE2000 of {} "
                    "at most, under {} at roughness {:g}.",
                    rounded_up(head_on->delta_e), light(*head_on), head_on->roughness));
    if (const auto* side = most(1, 0.5))
      to.say(
          fmt::format("Seen at cosine 0.5, where the lobe is no longer round, it is up to {}, "
                      "under {}.",
                      rounded_up(side->delta_e), light(*side)));
    to.say(fmt::format("Seen at cosine 0.1 it is up to {}, under {}.", rounded_up(grazing->delta_e),
                       light(*grazing)));
  }
  if (const auto* plastic = most(0.04, 0.1))
    to.say(
        fmt::format("Black plastic of F0 = 0.04, seen at cosine 0.1, changes by a mean ΔE2000 of "
                    "{} at most.",
                    rounded_up(plastic->delta_e)));
  if (r.light.costs.size() == 2)
    to.say(
        fmt::format("A pixel of image-based light takes {:.0f} ns by the split sum, and {:.2g} "
                    "ms by the integral to 1\u00a0%.",
                    r.light.costs[0].ns, r.light.costs[1].ns / 1e6));
}

void no_light_is_made(Findings& to, const EnergyRows& r) {
  if (r.forms.empty()) return;
  const EnergyForm* most = nullptr;
  std::map<std::string, bool> makes;  // by form: one whose tail was varied is one
  for (const auto& f : r.forms) {
    makes[f.model.empty() ? std::string(f.masking) : std::string(f.model)] |= makes_light(f);
    if (makes_light(f) && (!most || brightest(f).albedo > brightest(*most).albedo)) most = &f;
  }
  const auto makers = static_cast<std::size_t>(
      std::ranges::count(makes, true, &std::pair<const std::string, bool>::second));
  std::string worst;
  if (most) {
    const auto& at = brightest(*most);
    worst = fmt::format("worst: {} reflects {:.3g} times the light that arrives, at {}.",
                        words_for(*most), at.albedo, place(at.roughness, at.mu));
  }
  to.judge("reflected energy never exceeds incoming", "", verdict(makers == 0, true),
           fmt::format("{} maskings and whole models reflect more", of_all(makers, makes.size())),
           std::move(worst));
}

void energy_does_not_stay(Findings& to, const EnergyRows& r) {
  const auto* f = find_form(r.forms, "masking.smith_ggx.correlated");
  if (!f || f->averages.empty()) return;
  const auto &smooth = f->averages.front(), &rough = f->averages.back();
  to.judge("as roughness grows the highlight widens and dims so that energy stays", "",
           verdict(rough.albedo > 0.99),
           fmt::format("one bounce under GGX reflects {} at roughness {:g}", percent(rough.albedo),
                       rough.roughness),
           fmt::format("no light is absorbed. At roughness {:g} one bounce reflects {}.",
                       smooth.roughness, percent(smooth.albedo)));
}

void fixed_coat(Findings& to, const EnergyRows& r) {
  const auto *coat = find_form(r.forms, "masking.disney_coat, gamma 1"),
             *smith = find_form(r.forms, "masking.smith_gtr.correlated, gamma 1");
  if (!coat || !smith) return;
  double most = 0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < coat->rows.size(); ++i) {  // the same rows, as far as the coat's go
    const double off = std::abs(coat->rows[i].albedo - smith->rows[i].albedo);
    if (off > most) most = off, at = i;
  }
  const auto& row = coat->rows[at];
  to.judge("GGX's G of a fixed roughness 0.25 looks good on the coat",
           "Burley 2012, Physically-Based Shading at Disney", verdict_on_small(most),
           fmt::format("at F = 1 the coat reflects {} instead of {}", percent(row.albedo),
                       percent(smith->rows[at].albedo)),
           fmt::format("this is the worst case, at {}, before Fresnel. It is compared with the "
                       "height-correlated Smith masking of the coat's own distribution.",
                       place(row.roughness, row.mu)));
}

void clamped_at_2048(Findings& to, const EnergyRows& r) {
  if (r.claims.clamped.empty()) return;
  // D without 1/π is 1/α² at its peak.
  const double reached = std::pow(2048.0, -0.25);
  const auto& most = *std::ranges::max_element(r.claims.clamped, {}, &ClaimRows::Clamped::lost);
  to.judge("the mobile form's clamp of D at 2048 hardly shows", "", verdict_on_small(most.lost),
           fmt::format("{} of the highlight is lost at roughness {:g}", percent(most.lost),
                       most.roughness),
           fmt::format("the form's D has no 1/π, so the clamp acts below roughness {:.3f}. The "
                       "highlight is seen head on.",
                       reached));
}

void look_of_the_simple_form(Findings& to, const EnergyRows& r) {
  if (!find_form(r.forms, "model.ue_mobile_simple") || r.claims.simple_form.empty()) return;
  const auto& most = *std::ranges::max_element(r.claims.simple_form, {}, &ClaimRows::Look::delta_e);
  to.judge("the simple mobile form keeps the look", "", verdict(most.delta_e <= 1),
           fmt::format("ΔE2000 {:.2g} at {}", most.delta_e, place(most.roughness, most.mu)),
           fmt::format("compared with GGX, Smith and Schlick under even light, for F0 = {:g}.",
                       most.f0));
}

void deviation_of_slopes(Findings& to, const EnergyRows& r) {
  const auto& slopes = r.claims.ggx_slopes;
  if (slopes.empty()) return;
  const auto &first = slopes.front(), &last = slopes.back();
  const double growth = last.deviation - first.deviation;
  to.judge("alpha is the standard deviation of the slopes", "",
           verdict(growth < 1e-3 && std::abs(last.deviation - 1) < 1e-3),
           fmt::format("{:.2f} α for Beckmann, infinite for GGX", r.claims.beckmann_deviation),
           fmt::format("over slopes up to {:g} α it is {:.3g} α for GGX. It grows as steeper "
                       "slopes are counted.",
                       last.most, last.deviation));
}

void solid_angle_of_half(Findings& to, const EnergyRows& r) {
  if (!r.claims.half_angle) return;
  const auto& [pairs, step, off] = *r.claims.half_angle;
  to.judge("dωₕ = dωₗ/(4 VoH)", "", verdict(off < 1e-5),
           fmt::format("equal to {:.0f} digits", -std::log10(std::max(off, 1e-15))),
           fmt::format("finite differences at {} pairs of directions give the same ratio of solid "
                       "angles{}.",
                       pairs, off < 1e-6 ? "" : fmt::format(" to a share of {:.6f}", off)));
}

}  // namespace

Findings findings(const EnergyRows& r) {
  Findings all;
  of_white(all, r);
  of_materials(all, r);
  of_compensations(all, r);
  of_single_lights(all, r);
  of_split_sum(all, r);
  no_light_is_made(all, r);
  energy_does_not_stay(all, r);
  fixed_coat(all, r);
  clamped_at_2048(all, r);
  look_of_the_simple_form(all, r);
  deviation_of_slopes(all, r);
  solid_angle_of_half(all, r);
  judge_distributions_and_sums(all, r);
  return all;
}

}  // namespace gonio
