// The findings of the cost report, in sentences.
#include <algorithm>
#include <cmath>

#include "brdf/term/term.h"
#include "reports/cost/claims.h"
#include "reports/cost/cost.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// "0.31 ± 0.02 ns": to the first digit of the spread, or to picoseconds.
std::string ns_text(double ns, double spread) {
  const double digit = -std::floor(std::log10(std::max(spread, 1e-3)));
  const int decimals = std::clamp(static_cast<int>(digit), 0, 3);
  auto text = fmt::format("{:.{}f}", ns, decimals);
  if (text.find_first_of("123456789") == text.npos) std::erase(text, '-');  // no -0.0
  return fmt::format("{} ± {:.{}f} ns", text, spread, decimals);
}
std::string ns_text(const Timing& t) {
  return ns_text(t.ns, t.spread_ns);
}
/// "4e-8"
std::string error_text(double e) {
  auto text = fmt::format("{:.2g}", e);
  if (const auto at = text.find("e-0"); at != text.npos) text.erase(at + 2, 1);
  return text;
}

class Sayings {
 public:
  explicit Sayings(const CostRows& r) : r_(r), best_(r.machine.instruction_sets.back()) {}
  Findings all() && {
    schlick_to_smith();
    headline();
    fresnel();
    gtr();
    front("masking", "masking.smith_ggx.correlated", "masking forms held against Smith's for GGX");
    whole();
    compensation();
    quadrature();
    fits();
    return std::move(said_);
  }

 private:
  void say(std::string sentence) { said_.say(std::move(sentence)); }
  /// Sentence on the time of exact Smith over Schlick's in a whole model.
  void headline() {
    const auto* const from = "ggx/schlick_ggx.direct/schlick";
    const auto* const to = "ggx/smith_ggx.correlated/schlick";
    const auto *cache = between(from, to, best_, "cache"),
               *streaming = between(from, to, best_, "streaming");
    if (!cache || !streaming) return;
    const auto text = [](const CostSwitch& s) {
      return std::abs(s.ns) <= s.ns_spread ? std::string("nothing that can be measured")
                                           : fmt::format("{:.2f} ns", s.ns);
    };
    said_.headline = fmt::format(
        "Exact Smith in place of Schlick's k takes {} more of a GGX sample in cache, and {} where "
        "memory is the limit.",
        text(*cache), text(*streaming));
  }
  const CostSwitch* between(std::string_view from,
                            std::string_view to,
                            std::string_view isa,
                            std::string_view memory) const {
    const auto at = std::ranges::find_if(r_.switches, [&](const CostSwitch& s) {
      return s.from == from && s.to == to && s.isa == isa && s.number == "float" &&
             s.memory == memory;
    });
    return at == r_.switches.end() ? nullptr : &*at;
  }
  /// "0.28 ± 0.02 ns more (2.3 times as long)", or that there is no difference.
  static std::string more(const CostSwitch& s) {
    if (std::abs(s.ns) <= s.ns_spread)
      return fmt::format("the same ({})", ns_text(s.ns, s.ns_spread));
    return fmt::format("{} {} ({:.2g} times as long)", ns_text(std::abs(s.ns), s.ns_spread),
                       s.ns > 0 ? "more" : "less", s.ratio);
  }

  /// \param what  "From Schlick's k = (r+1)²/8 to exact Smith"
  void switch_sentence(std::string_view what,
                       std::string_view from,
                       std::string_view to,
                       std::string_view factor) {
    const auto *s = between(from, to, best_, "cache"),
               *streaming = between(from, to, best_, "streaming"),
               *scalar = between(from, to, "scalar", "cache");
    if (!s || !streaming || !scalar) return;
    say(fmt::format(
        "{}: a sample takes, in float columns of {}, {} in cache and {} streaming; one at a "
        "time, {}. It has {:.0f} operations more{}.",
        what, best_, more(*s), more(*streaming), more(*scalar), s->operations,
        std::isnan(s->error_to)
            ? ""
            : fmt::format(", and the RMS error of {} goes from {} to {}", factor,
                          error_text(s->error_from), error_text(s->error_to))));
  }
  void schlick_to_smith() {
    switch_sentence("From Schlick's k = (r+1)²/8 to exact Smith, correlated",
                    "masking.schlick_ggx.direct", "masking.smith_ggx.correlated", "G2");
    switch_sentence("The same in a whole model, GGX with Schlick's Fresnel",
                    "ggx/schlick_ggx.direct/schlick", "ggx/smith_ggx.correlated/schlick", "G2 F");
  }
  void fresnel() {
    switch_sentence("From Schlick to the exact dielectric", "fresnel.schlick", "fresnel.dielectric",
                    "F");
    switch_sentence("From Schlick to the exact conductor in a whole model",
                    "ggx/smith_ggx.correlated/schlick", "ggx/smith_ggx.correlated/conductor",
                    "G2 F");
  }
  void gtr() {
    const auto* s = between("ndf.ggx", "ndf.gtr", best_, "cache");
    const auto* m =
        between("masking.smith_ggx.correlated", "masking.smith_gtr.correlated", best_, "cache");
    if (s && m)
      say(fmt::format("From GGX to GTR, whose gamma is free: {} in D, {} in its own exact masking.",
                      more(*s), more(*m)));
  }
  void front(std::string_view kind, std::string_view truth, std::string_view what) {
    std::vector<const CostRow*> on, beside;
    for (const auto& r : r_.rows) {
      if (r.kind != kind || r.error.truth != truth || r.number != "float" || r.isa != best_ ||
          r.memory != "cache")
        continue;
      (r.pareto && !r.tie ? on : beside).push_back(&r);
    }
    if (on.empty()) return;
    const auto ties = std::ranges::count_if(beside, [&](const CostRow* r) {
      return std::ranges::any_of(on, [&](const CostRow* o) {
        return std::abs(r->time.ns - o->time.ns) <= r->time.spread_ns + o->time.spread_ns;
      });
    });
    std::ranges::sort(on, {}, [](const CostRow* r) { return -r->error.rms; });
    std::string names;
    for (const auto* r : on)
      names += fmt::format("{}{} ({:.2f} ns, {})", names.empty() ? "" : ", ", short_id(r->id),
                           r->time.ns, error_text(r->error.rms));
    say(fmt::format(
        "Of {} {}, these are worth their time (in float columns of {} in cache, with the RMS "
        "error of G2): {}. {} more take as long as one of them, and are off by more.",
        on.size() + beside.size(), what, best_, names, ties));
  }
  const CostRow* row(std::string_view id, std::string_view memory, std::string_view way) const {
    return find_row(r_.rows, id, "float", best_, memory, way);
  }
  void whole() {
    constexpr std::string_view id = "ggx/smith_ggx.correlated/schlick";
    const auto *fused = row(id, "cache", "fused"), *composed = row(id, "cache", "composed"),
               *by_hand = row(id, "cache", "by_hand"), *far = row(id, "streaming", "fused"),
               *roots = row("bound.roots_and_division", "cache", ""),
               *columns = row("bound.columns", "streaming", "");
    if (!fused || !composed || !by_hand || !far || !roots || !columns) return;
    say(fmt::format(
        "GGX with correlated Smith and Schlick, float in {} in cache: {} fused into one loop, {} "
        "written by "
        "hand (fused {:.2f} times as long), {} composed of its terms at run time ({:.2f} times); "
        "its division "
        "and two roots alone take {}. Streaming it takes {}, reading four columns and writing one "
        "{}.",
        best_, ns_text(fused->time), ns_text(by_hand->time), fused->time.ns / by_hand->time.ns,
        ns_text(composed->time), composed->time.ns / by_hand->time.ns, ns_text(roots->time),
        ns_text(far->time), ns_text(columns->time)));
    over_by_hand();
  }
  void over_by_hand() {
    struct Ratio {
      double of;
      std::string_view id;
    };
    std::vector<Ratio> fused, composed;
    for (const auto& hand : r_.rows) {
      if (hand.kind != "by_hand" || hand.number != "float" || hand.isa != best_ ||
          hand.memory != "cache")
        continue;
      const auto *f = row(hand.id, "cache", "fused"), *c = row(hand.id, "cache", "composed");
      if (!f || !c) continue;
      fused.push_back({f->time.ns / hand.time.ns, f->id});
      composed.push_back({c->time.ns / hand.time.ns, c->id});
    }
    const auto text = [](std::vector<Ratio> all) {
      std::ranges::sort(all, {}, &Ratio::of);
      return fmt::format("{:.2f} to {:.2f} times as long ({:.2f} in the middle, the most {})",
                         all.front().of, all.back().of, all[all.size() / 2].of, all.back().id);
    };
    if (!fused.empty())
      say(fmt::format(
          "Beside {} models that were written by hand, fused loops take {}, composed ones {}.",
          fused.size(), text(fused), text(composed)));
  }
  std::vector<const CostPoint*> of(std::string_view picture) const {
    std::vector<const CostPoint*> out;
    for (const auto& p : r_.points)
      if (p.picture == picture) out.push_back(&p);
    return out;
  }
  void compensation() {
    std::string text;
    double single = 0;
    for (const auto* p : of("compensation")) {
      if (p->label == "single") {
        single = p->error;
        continue;
      }
      text +=
          fmt::format("{}{} for {}{}, leaving {:.2g}", text.empty() ? "" : "; ", p->label,
                      ns_text(p->time.ns - p->without_ns, p->time.spread_ns),
                      p->series == "a light" ? "" : " beyond the split sum's lookups", p->error);
    }
    if (!text.empty())
      say(fmt::format("Single scattering is off by {:.2g} (RMS of the albedo); compensated by {}.",
                      single, text));
  }
  void quadrature() {
    const CostPoint *one = nullptr, *normals = nullptr;
    for (const auto* p : of("quadrature")) {
      if (!p->series.ends_with("roughness 0.5, mu 0.5")) continue;
      if (p->series.starts_with("one integral") && p->error < 1e-6 && !one) one = p;
      if (p->series.starts_with("random visible normals")) normals = p;
    }
    if (one && normals)
      say(fmt::format(
          "A directional albedo at roughness 0.5 takes {:.1f} µs by one integral to better "
          "than 1e-6; {} random visible normals take {:.0f} µs and leave {:.1g}.",
          one->time.ns / 1000, normals->label, normals->time.ns / 1000, normals->error));
  }
  void fits() {
    const auto all = of("fit");
    if (all.size() < 2) return;
    std::string text;
    for (const auto* p : all)
      text += fmt::format("{}{} in {:.1f} ± {:.1f} ms to {:.2g} %", text.empty() ? "" : ", ",
                          p->label, p->time.ns / 1e6, p->time.spread_ns / 1e6, 100 * p->error);
    say(fmt::format("A fit on all threads finds alpha of a MERL table with 2 % noise from {}.",
                    text));
  }

  const CostRows& r_;
  Findings said_;
  std::string best_;
};

}  // namespace

Findings findings(const CostRows& rows) {
  auto said = Sayings(rows).all();
  judge_costs(said, rows);
  return said;
}

}  // namespace gonio
