#include "reports/index/decisions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "brdf/catalogue/registry.h"
#include "brdf/model/spec.h"
#include "reports/finding/words.h"
#include "timing/timing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

using Candidates = std::vector<Candidate>;

constexpr std::string_view schlick = "fresnel.schlick", direct = "masking.schlick_ggx.direct",
                           correlated = "masking.smith_ggx.correlated", single = "single",
                           usual_model = "ggx/smith_ggx.correlated/schlick";

/// Time that `to` takes more than `from`, which are candidates or times.
template <class Timed>
TimeDifference more(const Timed& from, const Timed& to) {
  return difference({{from.ns, from.spread}, from.each}, {{to.ns, to.spread}, to.each});
}
Candidate candidate(std::string form, double error, const Facts::Time& t) {
  return {std::move(form), error, t.ns, t.spread, t.each};
}
bool is_clearly_cheaper(const Candidate& a, const Candidate& b) {
  const auto d = more(a, b);
  return d.survives && d.ns > 0;
}
const Candidate* find(const Candidates& all, std::string_view form) {
  const auto at = std::ranges::find(all, form, &Candidate::form);
  return at == all.end() ? nullptr : &*at;
}
/// It saves a part of the other's time for which one leaves a form.
bool saves_enough(const Candidate& a, const Candidate& b) {
  constexpr double worth = 0.1;
  return is_clearly_cheaper(a, b) && more(a, b).ns > worth * b.ns;
}
/// The nearest of those that save a part of what is taken that is worth an error; the first of those that are as near.
const Candidate* nearest_cheaper(const Candidates& all, const Candidate& taken) {
  const Candidate* best = nullptr;
  for (const auto& c : all)
    if (saves_enough(c, taken) && (!best || c.error < 0.99 * best->error)) best = &c;
  return best;
}

/// Id of the catalogue, of a form that may be a variant of it.
std::string id_of(std::string_view form) {
  return std::string(form.substr(0, form.find(',')));
}

// --- Words ---

/// "ΔE ≤ 2.5": a bound, never below the number.
std::string delta_at_most(double x) {
  return "ΔE " + at_most(x);
}
/// Nothing is left by what is exact, but for what its integral is known to.
bool is_exact(const Candidate& c) {
  return c.error < 5e-3;
}

/// Cost of the usual form.
constexpr std::string_view no_more = "none (the usual form)";

/// "+0.40 ns", or that it takes no more.
std::string cost_text(const Candidate& taken, const Candidate& usual) {
  if (&taken == &usual || taken.form == usual.form) return std::string(no_more);
  const auto d = more(usual, taken);
  if (!d.survives) return "none measured";
  return (d.ns < 0 ? "−" : "+") + ns_text(d.ns);
}
/// Names the form to take if time is short, and its error.
std::string cheaper_text(const Candidate& cheaper, std::string_view left) {
  return fmt::format("time is short: then {}, {}", name_of_form(cheaper.form), left);
}

// --- Masking ---

void masking(std::vector<Decision>& to, const Facts& f) {
  Candidates all;
  for (const auto& m : f.masking)
    if (const auto* t = time_of(f.in_cache, m.form)) all.push_back(candidate(m.form, m.rms, *t));
  const auto *usual = find(all, direct), *taken = choose(all, direct, small_masking_error);
  if (!usual || !taken) return;
  const auto rms = [](const Candidate& c) {
    return fmt::format("RMS error {:.2g} in G₂", c.error);
  };
  const auto model = [](std::string_view form) {
    return to_text(model_of_lobe("ggx", short_id(form), "schlick"));
  };
  const auto* other = nearest_cheaper(all, *taken);
  if (other) {  // what saves nothing in a whole model is worth no error
    const auto *whole = time_of(f.whole, model(taken->form)),
               *cheaper = time_of(f.whole, model(other->form));
    if (whole && cheaper &&
        !is_clearly_cheaper(candidate(other->form, 0, *cheaper), candidate(taken->form, 0, *whole)))
      other = nullptr;
  }
  to.push_back({"Masking", name_of_form(taken->form), taken->form,
                is_exact(*taken) ? fmt::format("none (Schlick's k: {})", rms(*usual)) : rms(*taken),
                cost_text(*taken, *usual), other ? cheaper_text(*other, rms(*other)) : ""});
}

// --- Distribution ---

/// Materials that were measured, by the fits that were published of them: what a tail other than GGX's costs, and gains.
void distribution(std::vector<Decision>& to, const Facts& f) {
  // A distribution by itself writes a fraction, which a whole model divides once with its masking.
  const auto *ggx = time_of(f.whole, usual_model),
             *gtr = time_of(f.whole, "gtr/smith_gtr.correlated/schlick");
  if (!ggx || !gtr || !f.tails) return;
  const auto& t = *f.tails;
  const auto usual = candidate(ggx->id, 0, *ggx), other = candidate(gtr->id, 0, *gtr);
  const auto factor = [](double log_rms) { return fmt::format("×/÷ {:.3g}", std::exp(log_rms)); };
  to.push_back(
      {"Distribution", name_of_form("ndf.ggx"), "ndf.ggx",
       fmt::format(
           "typically {} off published fits of measured materials ({} of the {} that determine "
           "gamma have a longer tail)",
           factor(t.ggx_log_rms), t.longer, t.determined),
       std::string(no_more),
       fmt::format(
           "you fit gamma, too (its median is {:.2g}): then GTR with its own Smith, typically {}, "
           "{}",
           t.gamma, factor(t.gtr_log_rms), cost_text(other, usual))});
}

// --- Fresnel ---

/// A material and what Schlick shows of it.
struct Shown {
  std::string material;
  double delta_e, head_on;
};

std::string material_text(const std::string& material) {
  if (material == "IOR 1.33") return "water";
  if (material == "IOR 1.5") return "glass";
  return material;
}
/// "gold, silver"; indices that have no name as a range, "IOR 1.1 to 3".
std::string materials_text(const std::vector<Shown>& all) {
  std::vector<std::string> names, indices;
  for (const auto& m : all) {
    const auto name = material_text(m.material);
    (name.starts_with("IOR ") ? indices : names).push_back(name);
  }
  if (indices.size() > 1)
    names.push_back(fmt::format("{} to {}", indices.front(), indices.back().substr(4)));
  else if (!indices.empty())
    names.push_back(indices.front());
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Every form that is known on all of these, by its greatest ΔE; of dielectrics the exact one among them.  Metals have one among
/// their forms: at three wavelengths it is off from their spectra.
Candidates fresnel_candidates(const Facts& f,
                              std::string_view kind,
                              const std::vector<Shown>& materials) {
  Candidates out;
  constexpr auto exact = "fresnel.dielectric";
  if (const auto* t = time_of(f.in_cache, exact); t && kind == "dielectric")
    out.push_back(candidate(exact, 0, *t));
  for (const auto& x : f.fresnel) {
    if (find(out, x.form)) continue;
    const auto* t = time_of(f.in_cache, id_of(x.form));
    if (!t) continue;
    auto c = candidate(x.form, 0, *t);
    std::size_t known = 0;
    for (const auto& m : materials)
      for (const auto& y : f.fresnel)
        if (y.form == x.form && y.material == m.material) {
          c.error = std::max(c.error, y.delta_e);
          ++known;
        }
    if (known == materials.size()) out.push_back(c);
  }
  return out;
}

/// Materials that show Schlick side by side where it is taken, and what to take then, where that does not show; empty: none.
std::string seen_side_by_side(const Facts& f,
                              std::string_view kind,
                              const std::vector<Shown>& materials) {
  struct Helps {
    std::string form;  ///< none: nothing helps
    double error = 0;  ///< the greatest that it leaves
    std::vector<std::string> materials{};
  };
  std::vector<Helps> by_form;
  for (const auto& m : materials) {
    if (m.delta_e <= just_seen) continue;
    const auto all = fresnel_candidates(f, kind, {m});
    const auto* better = choose(all, schlick, just_seen);
    const auto form = better && better->error <= just_seen ? better->form : std::string();
    auto at = std::ranges::find(by_form, form, &Helps::form);
    if (at == by_form.end()) at = by_form.insert(at, {form});
    if (better) at->error = std::max(at->error, better->error);
    at->materials.push_back(material_text(m.material));
  }
  std::vector<std::string> parts;
  for (const auto& [form, error, seen] : by_form) {
    parts.push_back(fmt::format("{} for {}{}",
                                !form.empty()     ? in_text(form)
                                : kind == "metal" ? "the full spectrum"
                                                  : "exact Fresnel",
                                list_text(seen, " and "),
                                form.empty() ? "" : fmt::format(" ({})", delta_at_most(error))));
  }
  return parts.empty()
             ? std::string()
             : fmt::format("it is seen next to a photograph: then {}", fmt::join(parts, "; "));
}

void fresnel_of(std::vector<Decision>& to,
                const Facts& f,
                std::string_view kind,
                const std::vector<Shown>& materials,
                bool is_all,
                bool is_rest) {
  const auto all = fresnel_candidates(f, kind, materials);
  const auto *usual = find(all, schlick), *taken = choose(all, schlick, side_by_side);
  if (!usual || !taken) return;
  const std::string kinds = kind == "metal" ? "metals" : "dielectrics";
  const auto names = materials_text(materials);
  Decision d;
  d.subject = is_all    ? fmt::format("Fresnel of {} ({})", kinds, names)
              : is_rest ? fmt::format("Fresnel of other {} ({})", kinds, names)
                        : fmt::format("Fresnel of {}", names);
  d.take = name_of_form(taken->form);
  d.take_id = id_of(taken->form);
  d.cost = cost_text(*taken, *usual);
  const auto worst = std::ranges::max_element(materials, {}, &Shown::delta_e);
  if (taken == usual) {
    d.error = delta_at_most(taken->error);
    d.unless = seen_side_by_side(f, kind, materials);
  } else {
    d.error = fmt::format("{} (Schlick: {} for {})",
                          is_exact(*taken) ? "none" : delta_at_most(taken->error),
                          delta_at_most(worst->delta_e), material_text(worst->material));
    const double head_on = std::ranges::max(materials, {}, &Shown::head_on).head_on;
    if (is_clearly_cheaper(*usual, *taken))
      d.unless = head_on <= just_seen
                     ? "it is seen only head on: then Schlick, " + delta_at_most(head_on)
                     : cheaper_text(*usual, delta_at_most(usual->error));
  }
  to.push_back(std::move(d));
}

/// Materials of a kind in two groups: those on which Schlick is seen side by side at most, and the others.
void fresnel(std::vector<Decision>& to, const Facts& f, std::string_view kind) {
  std::vector<Shown> unseen, seen;
  for (const auto& x : f.fresnel)
    if (x.kind == kind && x.form == schlick)
      (x.delta_e <= side_by_side ? unseen : seen).push_back({x.material, x.delta_e, x.head_on});
  std::ranges::stable_sort(unseen, {}, &Shown::delta_e);
  if (!unseen.empty()) fresnel_of(to, f, kind, unseen, seen.empty(), false);
  if (!seen.empty()) fresnel_of(to, f, kind, seen, unseen.empty(), true);
}

// --- Multiple scattering ---

/// Reflectance of bright metals, of dark ones, and of plastics.
constexpr double bright = 0.9, dark = 0.5, plastic = 0.04;

const Facts::Scattering* scattering_of(const Facts& f,
                                       std::string_view id,
                                       double f0,
                                       bool of_image_light) {
  const auto at = std::ranges::find_if(f.scattering, [&](const Facts::Scattering& s) {
    return s.id == id && s.f0 == f0 && s.of_image_light == of_image_light;
  });
  return at == f.scattering.end() ? nullptr : &*at;
}
/// Least roughness at which one bounce is seen to lack the others.
std::optional<double> seen_from(const Facts::Scattering& s) {
  for (std::size_t i = 0; i < s.roughness.size(); ++i)
    if (s.delta_e[i] > side_by_side) return s.roughness[i];
  return {};
}

/// Greatest ΔE2000 of a form at roughnesses from one on, below another.
double most_between(const Facts::Scattering& way, double from, double below) {
  double most = 0;
  for (std::size_t i = 0; i < way.roughness.size(); ++i)
    if (!(way.roughness[i] < from) && way.roughness[i] < below)
      most = std::max(most, way.delta_e[i]);
  return most;
}
/// Compensation from a roughness on, below which nothing is done: where it shows and is nearer than nothing.  No value where what it
/// gains is not seen.
struct Compensated {
  double from;
  double below,
      error;  ///< greatest ΔE2000 of one bounce below it, and of the compensation from it on
  double both() const { return std::max(below, error); }
};
std::optional<Compensated> compensated(const Facts::Scattering& way,
                                       const Facts::Scattering& nothing) {
  const auto nearer = nearer_from(way, nothing), seen = seen_from(nothing);
  if (!nearer || !seen) return {};
  const double from = std::max(*nearer, *seen);
  const Compensated c{from, most_between(nothing, 0, from), most_between(way, from, HUGE_VAL)};
  if (std::ranges::max(nothing.delta_e) - c.both() < just_seen) return {};
  return c;
}

/// The compensation for surfaces smoother than those that `pays` is used on.
struct Below {
  const Facts::Compensation* form = nullptr;  ///< null: one bounce
  double from = 0;
  double error;  ///< greatest ΔE2000 of all surfaces smoother than those
};
/// Returns the one that leaves least there, with one bounce below its own start; one bounce, if nobody sees what that leaves or what
/// a compensation gains.
Below nearest_below(const Facts& f,
                    const std::map<std::string, Compensated>& used,
                    const Facts::Scattering& nothing,
                    const Compensated& pays) {
  Below best{nullptr, 0, pays.below};
  if (!(pays.below > side_by_side)) return best;
  double least = pays.below - just_seen;
  for (const auto& c : f.compensations)
    if (const auto at = used.find(c.id); at != used.end() && at->second.from < pays.from) {
      const auto* way = scattering_of(f, c.id, nothing.f0, nothing.of_image_light);
      const double from = at->second.from,
                   error = std::max(at->second.below, most_between(*way, from, pays.from));
      if (error < least) best = {&c, from, least = error};
    }
  return best;
}

void scattering(std::vector<Decision>& to, const Facts& f, double f0, bool of_image_light) {
  const auto* nothing = scattering_of(f, single, f0, of_image_light);
  if (!nothing) return;
  const double without = std::ranges::max(nothing->delta_e);
  Candidates all{{std::string(single), without, 0, 0}};
  std::map<std::string, Compensated> used;
  for (const auto& c : f.compensations)
    if (const auto* way = scattering_of(f, c.id, f0, of_image_light);
        way && c.of_image_light == of_image_light)
      if (const auto pays = compensated(*way, *nothing)) {
        all.push_back({c.id, pays->both(), c.ns, c.spread});
        used.emplace(c.id, *pays);
      }
  const auto* taken = choose(all, single, side_by_side);
  const auto* other = nearest_cheaper(all, *taken);
  const auto timed =
      std::ranges::find(f.compensations, of_image_light, &Facts::Compensation::of_image_light);
  Decision d{fmt::format("Multiple scattering under {}, F0 {:g} ({})",
                         of_image_light ? "image-based light" : "single lights", f0,
                         f0 == bright ? "bright metal"
                         : f0 == dark ? "dark metal"
                                      : "no metal"),
             "One bounce",
             "scattering." + taken->form,
             delta_at_most(taken->error),
             timed == f.compensations.end()
                 ? std::string(no_more)
                 : fmt::format("{} (the usual form)", ns_text(timed->without_ns)),
             {}};
  const auto from = [](const Compensated& c) {
    return fmt::format("for roughness {:g} or more", c.from);
  };
  if (taken->form != single) {
    const auto costs = std::ranges::find(f.compensations, taken->form, &Facts::Compensation::id);
    const auto& pays = used.at(taken->form);
    const auto below = nearest_below(f, used, *nothing, pays);
    d.take =
        fmt::format("{} {}, {}otherwise one bounce", name_of_form(taken->form), from(pays),
                    below.form ? fmt::format("{} for {:g} to {:g}, ", name_of_form(below.form->id),
                                             below.from, pays.from)
                               : "");
    d.error = fmt::format("{} (one bounce: {})", delta_at_most(std::max(pays.error, below.error)),
                          at_most(without));
    d.cost = fmt::format("{} {}{} (one bounce: {})", name_of_form(taken->form),
                         ns_text(costs->without_ns + taken->ns),
                         below.form ? fmt::format(", {} {}", name_of_form(below.form->id),
                                                  ns_text(below.form->without_ns + below.form->ns))
                                    : "",
                         ns_text(costs->without_ns));
  }
  if (other && other->form != single)
    d.unless = fmt::format("time is short: then {} {} ({}), otherwise one bounce",
                           name_of_form(other->form), from(used.at(other->form)),
                           delta_at_most(other->error));
  to.push_back(std::move(d));
}

// --- Image-based light, and what is below the surface ---

void image_light(std::vector<Decision>& to, const Facts& f) {
  if (!f.split_sum) return;
  const auto& s = *f.split_sum;
  // A sphere shows its middle head on, and most of itself from the side.
  to.push_back({fmt::format("Image-based light on white metal (worst of {} skies)", s.skies),
                fmt::format("Split sum, {0} × {0} table in half precision", s.size), "split_sum",
                s.head_on && s.from_side
                    ? fmt::format("mean ΔE {} head on, {} at 60°", rounded_up(*s.head_on),
                                  rounded_up(*s.from_side))
                    : fmt::format("RMS {:.1g} of E", s.rms),
                s.ns ? fmt::format("{} a pixel", ns_text(*s.ns)) : "one look-up",
                s.grazing ? "the rim matters: then integrate over directions" : ""});
}

/// Diffuse terms by how they look at equal albedo: matte surfaces beside EON, and what lies below a lobe beside EON coupled by albedos.
void diffuse(std::vector<Decision>& to, const Facts& f, bool below_lobe) {
  constexpr std::string_view usual_id = "diffuse.lambert";
  Candidates all;
  const auto form_of = [&](std::string_view id) {
    return std::ranges::find(f.diffuse, id, &Facts::Diffuse::id);
  };
  const auto most_light = [&](const Facts::Diffuse& d) {
    return below_lobe ? d.most_with_lobe : d.most_albedo;
  };
  double least =
      HUGE_VAL;  // that the forms give back at most; none may keep it within what comes in
  for (const auto& d : f.diffuse)
    if (below_lobe || !d.with_interface) least = std::min(least, most_light(d));
  for (const auto& d : f.diffuse) {
    const auto* t = time_of(f.in_cache, d.id);
    const bool is_reference = !below_lobe && d.id == "diffuse.eon";
    const auto& off = below_lobe ? d.below_lobe : d.matte;
    if (t && (off || is_reference) && most_light(d) <= std::max(no_light_made, least))
      all.push_back(candidate(d.id, is_reference ? 0 : *off, *t));
  }
  const auto* taken = choose(all, usual_id, side_by_side);
  const auto lambert = form_of(usual_id);
  const auto* time = time_of(f.in_cache, usual_id);
  if (!taken || lambert == f.diffuse.end() || !time) return;
  const auto usual = candidate(std::string(usual_id), 0, *time);
  const auto& own = below_lobe ? lambert->below_lobe : lambert->matte;
  Decision d{below_lobe ? "Diffuse below a lobe (F0 0.04)" : "Diffuse of matte surfaces",
             name_of_form(taken->form),
             taken->form,
             is_exact(*taken) ? "none" : delta_at_most(taken->error),
             cost_text(*taken, usual),
             ""};
  if (const double made = most_light(*form_of(taken->form)); below_lobe && made > no_light_made)
    d.error += fmt::format(", energy gain ≤ {}", percent_at_most(made - 1, 2));
  if (taken->form != usual_id && own)
    d.error = fmt::format("{} (Lambert: {})", d.error, delta_at_most(*own));
  to.push_back(std::move(d));
}

// --- Few bits ---

const Facts::Precision* precision_of(const Facts& f,
                                     std::string_view id,
                                     std::string_view form,
                                     std::string_view number) {
  const auto at = std::ranges::find_if(f.precision, [&](const Facts::Precision& p) {
    return p.id == id && p.form == form && p.number == number;
  });
  return at == f.precision.end() ? nullptr : &*at;
}

/// A whole highlight: D in itself keeps its digits where D V F is already infinite.
void precision(std::vector<Decision>& to, const Facts& f) {
  const auto *half = precision_of(f, usual_model, "directions", "half"),
             *own = precision_of(f, "ndf.ggx", "cross", "half, flushed"),
             *kept = precision_of(f, "ndf.ggx", "cross", "half");
  if (!half || !own || !own->safe_from) return;
  if (!half->safe_from) {
    to.push_back({"Precision: D V F NoL of GGX in half precision", "float instead", "ndf.ggx",
                  "none (half keeps its digits from no α on)", "", ""});
    return;
  }
  to.push_back(
      {fmt::format("Precision: a GGX highlight in half precision (on metal, F0 {:g} or more)",
                   half->least_f0),
       fmt::format("sin² θ_h from |n × h|², α clamped to at least {}",
                   rounded_up(*half->safe_from)),
       "ndf.ggx",
       fmt::format("off by ≤ {0}; surfaces smoother than roughness {1} look too rough (found by a "
                   "search over angles up to {2:.0f}°, with cosines in half precision)",
                   percent(half->tolerance, 2), rounded_up(std::sqrt(*half->safe_from)),
                   half->zenith_deg),
       "not timed",
       fmt::format("half precision is used for D only: then α clamped to at least {}{}",
                   rounded_up(*own->safe_from),
                   kept && kept->safe_from
                       ? fmt::format(", or to {} if the processor keeps subnormals",
                                     rounded_up(*kept->safe_from))
                       : "")});
}

}  // namespace

const Facts::Time* time_of(const std::vector<Facts::Time>& times, std::string_view id) {
  const auto at = std::ranges::find(times, id, &Facts::Time::id);
  return at == times.end() ? nullptr : &*at;
}

const Candidate* choose(std::span<const Candidate> all, std::string_view usual, double enough) {
  const Candidate *nearest = nullptr, *cheapest = nullptr;
  for (const auto& c : all) {
    if (c.form == usual && c.error <= enough) return &c;
    if (!nearest || c.error < nearest->error) nearest = &c;
    if (c.error <= enough && (!cheapest || c.ns < cheapest->ns)) cheapest = &c;
  }
  if (!cheapest) return nearest;
  const Candidate* taken = cheapest;
  for (const auto& c : all)
    if (c.error < taken->error && !saves_enough(*cheapest, c)) taken = &c;
  return taken;
}

std::vector<Decision> decisions(const Facts& f) {
  std::vector<Decision> out;
  masking(out, f);
  distribution(out, f);
  fresnel(out, f, "dielectric");
  fresnel(out, f, "metal");
  for (const bool of_image_light : {false, true})
    for (const double f0 : {bright, dark, plastic}) scattering(out, f, f0, of_image_light);
  image_light(out, f);
  diffuse(out, f, false);
  diffuse(out, f, true);
  precision(out, f);
  return out;
}

std::string without_aside(const std::string& cell) {
  return cell.ends_with(')') ? cell.substr(0, cell.find(" (")) : cell;
}

}  // namespace gonio
