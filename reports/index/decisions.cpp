#include "reports/index/decisions.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "brdf/catalogue/registry.h"
#include "reports/finding/words.h"
#include "timing/timing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

using Candidates = std::vector<Candidate>;

constexpr std::string_view schlick = "fresnel.schlick", direct = "masking.schlick_ggx.direct",
                           correlated = "masking.smith_ggx.correlated", single = "single";

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
/// The nearest of those that are clearly cheaper than what is taken; the first of those that are as near.
const Candidate* nearest_cheaper(const Candidates& all, const Candidate& taken) {
  const Candidate* best = nullptr;
  for (const auto& c : all)
    if (is_clearly_cheaper(c, taken) && (!best || c.error < 0.99 * best->error)) best = &c;
  return best;
}

const Facts::Time* time_of(const std::vector<Facts::Time>& times, std::string_view id) {
  const auto at = std::ranges::find(times, id, &Facts::Time::id);
  return at == times.end() ? nullptr : &*at;
}
/// Id of the catalogue, of a form that may be a variant of it.
std::string id_of(std::string_view form) {
  return std::string(form.substr(0, form.find(',')));
}

// --- Words ---

/// "0", "0.26", "3.2", "13"
std::string short_number(double x) {
  return fmt::format("{:.{}g}", x, x < 9.95 ? 2 : x < 99.5 ? 2 : 3);
}
std::string delta(double x) {
  return "ΔE " + short_number(x);
}
/// Nothing is left by what is exact, but for what its integral is known to.
bool is_exact(const Candidate& c) {
  return c.error < 5e-3;
}

/// Cost of the cheap form.
constexpr std::string_view no_more = "none (the cheap form)";

/// "0.10 ns", "7.7 ns", "13 ns": one rounding, so that times beside each other agree.
std::string ns_text(double ns) {
  const double size = std::abs(ns);
  return fmt::format("{:.{}f} ns", size, size < 0.995 ? 2 : size < 9.95 ? 1 : 0);
}
/// "+0.40 ns", or that it takes no more.
std::string cost_text(const Candidate& taken, const Candidate& cheap) {
  if (&taken == &cheap || taken.form == cheap.form) return std::string(no_more);
  const auto d = more(cheap, taken);
  if (!d.survives) return "none measured";
  return (d.ns < 0 ? "−" : "+") + ns_text(d.ns);
}
/// What to take instead where time is what lacks, what that saves and what it leaves.
std::string cheaper_text(const Candidate& cheaper, const Candidate& taken, std::string_view left) {
  return fmt::format("time is short: {} saves {}, {}", name_of_form(cheaper.form),
                     ns_text(more(cheaper, taken).ns), left);
}
/// Aside on the cost, where both stand in a whole model: that it vanishes where memory is the limit.
std::string streaming_aside(const Facts& f, std::string_view taken, std::string_view cheap) {
  const auto *a = time_of(f.streaming, taken), *b = time_of(f.streaming, cheap);
  if (!a || !b) return {};
  if (const auto d = more(*b, *a); d.survives && d.ns > 0) return {};
  return " (none where memory is the limit)";
}

// --- Masking ---

void masking(std::vector<Decision>& to, const Facts& f) {
  Candidates all;
  for (const auto& m : f.masking)
    if (const auto* t = time_of(f.in_cache, m.form)) all.push_back(candidate(m.form, m.rms, *t));
  const auto *cheap = find(all, direct), *taken = choose(all, direct, small_masking_error);
  if (!cheap || !taken) return;
  const auto rms = [](const Candidate& c) { return fmt::format("RMS {:.2g} of G₂", c.error); };
  const auto model = [](std::string_view form) {
    return fmt::format("ggx/{}/schlick", short_id(form));
  };
  const auto cost = cost_text(*taken, *cheap);
  const auto* other = nearest_cheaper(all, *taken);
  to.push_back({"Masking", name_of_form(taken->form), taken->form,
                is_exact(*taken) ? fmt::format("none (Schlick's k: {})", rms(*cheap)) : rms(*taken),
                cost.starts_with('+')
                    ? cost + streaming_aside(f, model(taken->form), model(cheap->form))
                    : cost,
                other ? cheaper_text(*other, *taken, rms(*other)) : ""});
}

// --- Distribution ---

void distribution(std::vector<Decision>& to, const Facts& f) {
  const auto *ggx = time_of(f.in_cache, "ndf.ggx"), *gtr = time_of(f.in_cache, "ndf.gtr");
  const auto worst = std::ranges::max_element(f.tails, {}, &Facts::Tail::log_rms);
  if (!ggx || !gtr || worst == f.tails.end()) return;
  const auto cheap = candidate(ggx->id, 0, *ggx), other = candidate(gtr->id, 0, *gtr);
  to.push_back({"Distribution", name_of_form("ndf.ggx"), "ndf.ggx",
                fmt::format("a factor of {:.2g} (RMS of f, on a surface of {})",
                            std::exp(worst->log_rms), worst->truth),
                std::string(no_more),
                fmt::format("a fit finds γ far from 2: GTR, {} for D", cost_text(other, cheap))});
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
  std::vector<std::pair<std::string, std::vector<std::string>>> by_form;  // no form: nothing helps
  for (const auto& m : materials) {
    if (m.delta_e <= just_seen) continue;
    const auto all = fresnel_candidates(f, kind, {m});
    const auto* better = choose(all, schlick, just_seen);
    const auto form = better && better->error <= just_seen ? better->form : std::string();
    auto at = std::ranges::find(by_form, form, [](const auto& x) { return x.first; });
    if (at == by_form.end()) at = by_form.insert(at, {form, {}});
    at->second.push_back(material_text(m.material));
  }
  std::vector<std::string> parts;
  for (const auto& [form, seen] : by_form) {
    const auto what = form.empty()
                          ? (kind == "metal" ? "nothing but its spectrum" : "exact Fresnel")
                          : in_text(form);
    parts.push_back(fmt::format("{}{}: {}", list_text(seen, " or "),
                                parts.empty() ? " beside a photograph" : "", what));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

void fresnel_of(std::vector<Decision>& to,
                const Facts& f,
                std::string_view kind,
                const std::vector<Shown>& materials,
                bool is_all,
                bool is_rest) {
  const auto all = fresnel_candidates(f, kind, materials);
  const auto *cheap = find(all, schlick), *taken = choose(all, schlick, side_by_side);
  if (!cheap || !taken) return;
  const std::string kinds = kind == "metal" ? "metals" : "dielectrics";
  const auto names = materials_text(materials);
  Decision d;
  d.subject = is_all    ? fmt::format("Fresnel of {} ({})", kinds, names)
              : is_rest ? fmt::format("Fresnel of other {} ({})", kinds, names)
                        : fmt::format("Fresnel of {}", names);
  d.take = name_of_form(taken->form);
  d.take_id = id_of(taken->form);
  d.cost = cost_text(*taken, *cheap);
  const auto worst = std::ranges::max_element(materials, {}, &Shown::delta_e);
  const auto usual =
      std::ranges::find(materials, kind == "metal" ? "iron" : "IOR 1.5", &Shown::material);
  const auto& told = usual == materials.end() ? *worst : *usual;
  if (taken == cheap) {
    d.error = fmt::format("ΔE ≤ {}", short_number(taken->error));
    d.unless = seen_side_by_side(f, kind, materials);
  } else {
    d.error = fmt::format("{} (Schlick: {} for {})",
                          is_exact(*taken) ? "none" : "ΔE ≤ " + short_number(taken->error),
                          delta(told.delta_e), material_text(told.material));
    const double head_on = std::ranges::max(materials, {}, &Shown::head_on).head_on;
    if (is_clearly_cheaper(*cheap, *taken))
      d.unless =
          head_on <= just_seen
              ? fmt::format("it is seen head on alone: Schlick, ΔE ≤ {}", short_number(head_on))
              : cheaper_text(*cheap, *taken, "ΔE ≤ " + short_number(cheap->error));
  }
  if (d.cost.starts_with('+'))
    d.cost += streaming_aside(f, fmt::format("ggx/smith_ggx.correlated/{}", short_id(d.take_id)),
                              fmt::format("ggx/smith_ggx.correlated/{}", short_id(schlick)));
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

/// Reflectance of bright metals, and of plastics.
constexpr double bright = 0.9, plastic = 0.04;

const Facts::Scattering* scattering_of(const Facts& f, std::string_view id, double f0) {
  const auto at = std::ranges::find_if(
      f.scattering, [&](const Facts::Scattering& s) { return s.id == id && s.f0 == f0; });
  return at == f.scattering.end() ? nullptr : &*at;
}
double greatest(const Facts& f, std::string_view id) {
  double most = 0;
  for (const auto& s : f.scattering)
    if (s.id == id) most = std::max(most, std::ranges::max(s.delta_e));
  return most;
}
/// Least roughness at which one bounce is seen to lack the others.
std::optional<double> seen_from(const Facts& f, double f0) {
  const auto* s = scattering_of(f, single, f0);
  if (!s) return {};
  for (std::size_t i = 0; i < s->roughness.size(); ++i)
    if (s->delta_e[i] > side_by_side) return s->roughness[i];
  return {};
}

void scattering(std::vector<Decision>& to, const Facts& f, bool of_image_light) {
  const auto from = seen_from(f, bright);
  const auto* of_plastic = scattering_of(f, single, plastic);
  Candidates all;
  for (const auto& c : f.compensations)
    if (c.of_image_light == of_image_light && greatest(f, c.id) > 0)
      all.push_back({c.id, greatest(f, c.id), c.ns, c.spread});
  const auto* taken = choose(all, single, side_by_side);
  if (!from || !of_plastic || !taken) return;
  const auto costs = std::ranges::find(f.compensations, taken->form, &Facts::Compensation::id);
  const auto more_ns =
      fmt::format("+{} on {} a call", ns_text(taken->ns), ns_text(costs->without_ns));
  const auto* other = nearest_cheaper(all, *taken);
  const auto later = seen_from(f, plastic);
  const auto of_f0 =
      fmt::format("F0 is {:g}: {}", plastic,
                  later ? fmt::format("from roughness {:g} on", *later)
                        : fmt::format("one bounce, ΔE ≤ {}",
                                      short_number(std::ranges::max(of_plastic->delta_e))));
  to.push_back(
      {fmt::format("Multiple scattering under {} (of bright metal, F0 {:g})",
                   of_image_light ? "image-based light" : "a single light", bright),
       fmt::format("{}, from roughness {:g} on", name_of_form(taken->form), *from),
       "scattering." + taken->form,
       fmt::format("ΔE ≤ {} (one bounce: {}{})", short_number(taken->error),
                   short_number(greatest(f, single)),
                   taken->error > side_by_side ? "; no form leaves less" : ""),
       of_image_light
           ? fmt::format("{} (beside the split sum's table)", more_ns)
           : fmt::format("{} (by single calls, other times are of columns; {:.1f} kB of tables)",
                         more_ns, static_cast<double>(costs->bytes) / 1000),
       other && !of_image_light ? fmt::format("{}; time is short: {}, ΔE ≤ {}", of_f0,
                                              name_of_form(other->form), short_number(other->error))
                                : of_f0});
}

// --- Image-based light, and what is below the surface ---

void image_light(std::vector<Decision>& to, const Facts& f) {
  if (!f.split_sum) return;
  const auto& s = *f.split_sum;
  const auto table = fmt::format("RMS {:.1g}", s.rms);
  to.push_back(
      {"Image-based light", fmt::format("Split sum, {0} × {0} table in half", s.size), "split_sum",
       s.head_on
           ? fmt::format("mean ΔE ≤ {} (the table alone: {})", short_number(*s.head_on), table)
           : table + " of E",
       fmt::format("{:.1f} kB, one look-up", static_cast<double>(s.bytes) / 1000),
       s.grazing ? fmt::format("rims are looked at: integrate there, where the mean ΔE is ≤ {}",
                               short_number(*s.grazing))
                 : ""});
}

void diffuse(std::vector<Decision>& to, const Facts& f) {
  constexpr std::string_view cheap_id = "diffuse.lambert";
  const Facts::Diffuse *maker = nullptr, *rough = nullptr;
  const auto* cheap = time_of(f.in_cache, cheap_id);
  const auto own = std::ranges::find(f.diffuse, cheap_id, &Facts::Diffuse::id);
  if (!cheap || own == f.diffuse.end() || own->most_albedo > no_light_made) return;
  const Facts::Time* rough_time = nullptr;
  for (const auto& d : f.diffuse) {
    if (!maker || d.most_albedo > maker->most_albedo) maker = &d;
    // of those that scatter back, the fastest that makes no light
    const auto* t = time_of(f.in_cache, d.id);
    if (t && d.id != cheap_id && !d.with_interface && d.most_albedo <= no_light_made &&
        (!rough_time || t->ns < rough_time->ns))
      rough = &d, rough_time = t;
  }
  const auto made =
      maker->most_albedo > no_light_made
          ? fmt::format(" ({}: {})", name_of_form(maker->id), percent(maker->most_albedo, 3))
          : "";
  to.push_back(
      {"Diffuse", name_of_form(cheap_id), std::string(cheap_id),
       "gives back no more than it gets" + made, std::string(no_more),
       rough ? fmt::format("cloth, clay or plaster scatter back: {}, {}", name_of_form(rough->id),
                           cost_text(candidate(rough->id, 0, *rough_time),
                                     candidate(std::string(cheap_id), 0, *cheap)))
             : ""});
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

void precision(std::vector<Decision>& to, const Facts& f) {
  const auto* half = precision_of(f, "ndf.ggx", "cross", "half");
  if (!half || !half->safe_from) return;
  const auto* mixed = precision_of(f, "ndf.ggx.mobile", "cosine", "mixed");
  to.push_back(
      {"Precision: GGX in half", fmt::format("|n × h|², α clamped at {:.2g}", *half->safe_from),
       half->id, fmt::format("≤ {} of D", percent(half->tolerance, 1)),
       fmt::format("roughness below {:.2g} (looks that rough)", std::sqrt(*half->safe_from)),
       mixed && mixed->safe_from
           ? fmt::format("NoH is rounded to half: α clamped at {:.2g}", *mixed->safe_from)
           : ""});
}

}  // namespace

const Candidate* choose(std::span<const Candidate> all, std::string_view cheap, double enough) {
  const Candidate *nearest = nullptr, *cheapest = nullptr;
  for (const auto& c : all) {
    if (!nearest || c.error < nearest->error) nearest = &c;
    if (c.error <= enough && (!cheapest || c.ns < cheapest->ns)) cheapest = &c;
  }
  if (!cheapest) return nearest;
  const Candidate* taken = cheapest;
  for (const auto& c : all) {
    if (c.error > enough || is_clearly_cheaper(*cheapest, c)) continue;
    if (c.form == cheap) return &c;
    if (c.error < taken->error) taken = &c;
  }
  return taken;
}

std::vector<Decision> decisions(const Facts& f) {
  std::vector<Decision> out;
  masking(out, f);
  distribution(out, f);
  fresnel(out, f, "dielectric");
  fresnel(out, f, "metal");
  scattering(out, f, false);
  scattering(out, f, true);
  image_light(out, f);
  diffuse(out, f);
  precision(out, f);
  return out;
}

std::string without_aside(const std::string& cell) {
  return cell.substr(0, cell.find(" ("));
}

}  // namespace gonio
