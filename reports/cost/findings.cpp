// The findings of the cost report, in sentences.
#include <algorithm>
#include <cmath>

#include "brdf/term/term.h"
#include "reports/cost/claims.h"
#include "reports/cost/cost.h"
#include "reports/finding/names.h"
#include "reports/finding/words.h"
#include "reports/measure/load.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// "0.31 ± 0.02": to the first digit of the spread, or to picoseconds.
std::string with_spread(double value, double spread) {
  const double digit = -std::floor(std::log10(std::max(spread, 1e-3)));
  const int decimals = std::clamp(static_cast<int>(digit), 0, 3);
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, spread, decimals);
}
std::string time_text(const Timing& t) {
  return with_spread(t.ns, t.spread_ns) + " ns";
}
/// Error in words: what rounding alone leaves has no figure.
std::string error_text(double e) {
  constexpr double rounding = 1e-5;
  return e < rounding ? "that of only rounding" : fmt::format("{:.2g}", e);
}

class Sayings {
 public:
  explicit Sayings(const CostRows& r) : r_(r), best_(r.machine.instruction_sets.back()) {}
  Findings all() && {
    headline();
    if (!said_.headline.empty()) say(said_.headline);
    if (auto text = load_text(r_.others, r_.machine.threads); !text.empty()) say(std::move(text));
    masking();
    front();
    fresnel();
    tail();
    whole();
    over_by_hand();
    compensation();
    quadrature();
    fits();
    sampling();
    lookups();
    frame();
    half();
    return std::move(said_);
  }

 private:
  template <class... Values>
  void say(fmt::format_string<Values...> text, Values&&... values) {
    said_.say(fmt::format(text, std::forward<Values>(values)...));
  }
  void say(std::string sentence) { said_.say(std::move(sentence)); }

  /// Sentence on the time of exact Smith over Schlick's: of the term in cache, as the index decides by, and of a whole model where
  /// memory is the limit.
  void headline() {
    const auto *cache = between("masking.schlick_ggx.direct", "masking.smith_ggx.correlated", best_,
                                "cache"),
               *streaming = between("ggx/schlick_ggx.direct/schlick",
                                    "ggx/smith_ggx.correlated/schlick", best_, "streaming");
    if (!cache || !streaming) return;
    const auto text = [&](const CostSwitch& s) {
      if (s.differs) return s.ns > 0 ? ns_text(s.ns) + " more" : std::string("nothing");
      return fmt::format("nothing that shows (± {})", ns_text(s.ns_spread));
    };
    said_.headline = fmt::format(
        "Exact Smith in place of Schlick's k costs {} if its inputs are in cache. In a whole GGX "
        "model that reads its inputs from memory it costs {}.",
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
  /// "takes 0.28 ± 0.02 ns more of a sample than", or that nothing tells them apart.
  static std::string takes(const CostSwitch& s) {
    if (!s.differs) return "takes the same time of a sample as";
    return fmt::format("{} {} ns {} of a sample than",
                       s.way == "fused" ? "takes, fused into one loop," : "takes",
                       with_spread(std::abs(s.ns), s.ns_spread), s.ns > 0 ? "more" : "less");
  }
  /// Sentences on a form in place of another, in cache.
  void in_place_of(std::string_view from,
                   std::string_view to,
                   std::string_view to_name,
                   std::string_view from_name,
                   std::string_view factor) {
    const auto* s = between(from, to, best_, "cache");
    if (!s) return;
    say("{} {} {}, in columns of floats in cache ({}).", capital(std::string(to_name)), takes(*s),
        from_name, best_);
    if (!std::isnan(s->error_to) && !factor.empty())
      say("Over the directions that the audit looks at, its RMS error of {} is {}; {} leaves {}.",
          factor, error_text(s->error_to), from_name, error_text(s->error_from));
  }
  void masking() {
    const auto* const from = "masking.schlick_ggx.direct";
    const auto* const to = "masking.smith_ggx.correlated";
    in_place_of(from, to, in_text(to), in_text(from), "G₂");
    in_place_of("ggx/schlick_ggx.direct/schlick", "ggx/smith_ggx.correlated/schlick",
                "a whole GGX model with exact Smith", "with Schlick's k", "");
  }
  void fresnel() {
    in_place_of("fresnel.schlick", "fresnel.dielectric", "exact dielectric Fresnel", "Schlick",
                "F");
    in_place_of("ggx/smith_ggx.correlated/schlick", "ggx/smith_ggx.correlated/conductor",
                "a whole GGX model with a metal's exact Fresnel", "with Schlick", "");
  }
  void tail() {
    in_place_of("ndf.ggx", "ndf.gtr", "GTR, whose tail is free,", "GGX", "");
    in_place_of("masking.smith_ggx.correlated", "masking.smith_gtr.correlated",
                "GTR's own exact masking", "GGX's", "");
  }
  void front() {
    std::vector<const CostRow*> on;
    std::size_t all = 0, ties = 0;
    for (const auto& r : r_.rows) {
      if (r.kind != "masking" || r.error.truth != "masking.smith_ggx.correlated" ||
          r.number != "float" || r.isa != best_ || r.memory != "cache" || is_mistake(r))
        continue;
      ++all;
      ties += r.pareto && !r.on_line;
      if (r.on_line) on.push_back(&r);
    }
    if (on.empty()) return;
    say("Among {} masking forms compared with height-correlated Smith, {} worth their time in "
        "cache: none as exact was faster. For {} more that difference is within the spread.",
        all, on.size() == 1 ? "one is" : fmt::format("{} are", on.size()), number_or_none(ties));
    std::ranges::sort(on, {}, [](const CostRow* r) { return -r->error.rms; });
    constexpr std::size_t told = 4;
    std::vector<std::string> names;
    for (const auto* r : on) names.push_back(in_text(r->id));
    if (names.size() > told) names = {names.front(), names[names.size() / 2], names.back()};
    say("{} from fast to exact: {}.", on.size() > told ? "Three of these" : "They are",
        list_text(names));
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
    say("GGX with height-correlated Smith and Schlick takes {} of a float sample in cache, fused "
        "into one loop.",
        time_text(fused->time));
    say("Written by hand it takes {:.2f} ns, composed of its terms at run time {:.2f} ns; only its "
        "division and two roots take {:.2f} ns.",
        by_hand->time.ns, composed->time.ns, roots->time.ns);
    say("In {} it takes {:.2f} ns, where reading four columns and writing one takes {:.2f} ns.",
        long_columns(r_.options), far->time.ns, columns->time.ns);
  }
  void over_by_hand() {
    std::vector<double> fused, composed;
    for (const auto& hand : r_.rows) {
      if (hand.kind != "by_hand" || hand.number != "float" || hand.isa != best_ ||
          hand.memory != "cache")
        continue;
      const auto *f = row(hand.id, "cache", "fused"), *c = row(hand.id, "cache", "composed");
      if (!f || !c) continue;
      fused.push_back(f->time.ns / hand.time.ns);
      composed.push_back(c->time.ns / hand.time.ns);
    }
    if (fused.size() < 2) return;
    const auto range = [](const std::vector<double>& all) {
      const auto [least, most] = std::ranges::minmax(all);
      return fmt::format("{:.2f} to {:.2f} times as long", least, most);
    };
    say("Beside the same {} models written by hand, fused loops take {}.", fused.size(),
        range(fused));
    say("Composed of their terms at run time, they take {}.", range(composed));
  }
  std::vector<const CostPoint*> of(std::string_view picture) const {
    std::vector<const CostPoint*> out;
    for (const auto& p : r_.points)
      if (p.picture == picture) out.push_back(&p);
    return out;
  }
  void compensation() {
    for (const auto* p : of("compensation")) {
      if (p->label == "single") {
        say("Single scattering leaves an RMS error of {:.2g} of the albedo, over all roughnesses "
            "and reflectances looked at.",
            p->error);
        continue;
      }
      const auto more = difference({p->without}, {p->time});
      say("Compensated as by {}, {} takes {} ns more and leaves {:.2g}.", name_of_form(p->label),
          p->series == "a light" ? "a single light" : "image-based light",
          with_spread(more.ns, more.spread_ns), p->error);
    }
  }
  void quadrature() {
    const CostPoint *one = nullptr, *normals = nullptr;
    for (const auto* p : of("quadrature")) {
      if (!p->series.ends_with("roughness 0.5, mu 0.5")) continue;
      if (p->series.starts_with("one integral") && p->error < 1e-6 && !one) one = p;
      if (p->series.starts_with("random visible normals")) normals = p;
    }
    if (!one || !normals) return;
    say("A directional albedo at roughness 0.5 takes {:.1f} µs by one integral that is right to "
        "six digits.",
        one->time.ns / 1000);
    say("By {} it takes {:.0f} µs and is off by {:.1g}.",
        normals->label + " random visible normals", normals->time.ns / 1000, normals->error);
  }
  void fits() {
    const auto all = of("fit");
    if (all.size() < 2) return;
    const auto ms = [](const CostPoint* p) { return fmt::format("{:.3g} ms", p->time.ns / 1e6); };
    say("A fit of a MERL table with 2 % noise takes {} on all threads and finds alpha to {}.",
        ms(all.front()), percent(all.front()->error, 2));
    say("From {} chosen by chance it takes {} and finds alpha to {}.", all.back()->label,
        ms(all.back()), percent(all.back()->error, 2));
  }
  /// "0.31 ns"
  static std::string in_ns(const Timing& t) { return short_text(t.ns) + " ns"; }
  void sampling() {
    const auto at = [&](std::string_view id) -> const SamplingRow* {
      const auto found = std::ranges::find_if(r_.studies.sampling, [&](const SamplingRow& r) {
        return r.id == id && r.roughness == 0.5 && r.mu == 0.5 && !std::isnan(r.time.ns);
      });
      return found == r_.studies.sampling.end() ? nullptr : &*found;
    };
    const auto *plain = at("sampling.ggx.d"), *disk = at("sampling.ggx.vndf2018"),
               *caps = at("sampling.ggx.caps"), *bounded = at("sampling.ggx.bounded");
    if (!plain || !disk || !caps || !bounded) return;
    say("Visible normals reach an error in {} of the time that normals by D take, at "
        "roughness 0.5 and NoV 0.5.",
        short_text(us_to_percent(*caps) / us_to_percent(*plain)));
    say("Spherical caps draw a light in {} and Heitz's disk of 2018 in {}.", in_ns(caps->time),
        in_ns(disk->time));
    say("Bounded caps draw {} % of their lights below the horizon there, where unbounded ones "
        "draw {} %.",
        short_text(100 * bounded->below), short_text(100 * caps->below));
  }
  void lookups() {
    const auto at = [&](std::string_view id) -> const LookupRow* {
      const auto found = std::ranges::find(r_.studies.lookup, id, &LookupRow::id);
      return found == r_.studies.lookup.end() ? nullptr : &*found;
    };
    const auto *table = at("split_sum.table.32.half"), *karis = at("split_sum.karis"),
               *lazarov = at("split_sum.lazarov"), *materialx = at("split_sum.materialx"),
               *ours = at("split_sum.ours");
    if (!table || !karis || !lazarov || !materialx || !ours) return;
    say("The split sum's table of 32 × 32 texels in half leaves an RMS error of {} of a "
        "mirror's albedo.",
        short_text(table->mirror_rms));
    say("That is over roughness from 0.05 and NoV from 1/32 on.");
    say("In its place Karis's formula leaves {}, MaterialX's {} and Lazarov's, made for "
        "Blinn–Phong, {}.",
        short_text(karis->mirror_rms), short_text(materialx->mirror_rms),
        short_text(lazarov->mirror_rms));
    say("Our formula of only a mirror's albedo leaves {} in {}.", short_text(ours->mirror_rms),
        in_ns(ours->time));
  }
  /// Costs of a whole model's switches in a frame.
  void frame() {
    // Whole model and what is exchanged in it: all composed, as a shader with switches is.
    const auto* whole = row("ggx/smith_ggx.correlated/schlick", "cache", "composed");
    if (!whole) return;
    const auto ms = [](double ns) { return 1e-6 * frame_samples * ns; };
    say("A frame of 1080p takes {} ms of one processor for one light by GGX with "
        "height-correlated Smith and Schlick, composed of its terms, in cache.",
        short_text(ms(whole->time.ns)));
    const auto *direct = row("ggx/schlick_ggx.direct/schlick", "cache", "composed"),
               *metal = row("ggx/smith_ggx.correlated/conductor", "cache", "composed");
    if (!direct || !metal) return;
    const auto text = [&](const CostRow& from, const CostRow& to) {
      const auto d = difference(compared(from), compared(to));
      return d.survives && d.ns > 0 ? short_text(ms(d.ns)) + " ms"
                                    : std::string("nothing that can be measured");
    };
    say("Exact Smith in place of Schlick's k is {} of that, and a metal's exact Fresnel {} more.",
        text(*direct, *whole), text(*whole, *metal));
  }
  void half() {
    say("This processor has {}: times are of float and double.",
        r_.machine.native_half ? "arithmetic in half, which no kernel here uses"
                               : "no arithmetic in half (AVX512-FP16)");
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
