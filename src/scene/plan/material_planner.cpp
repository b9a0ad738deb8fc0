#include "scene/plan/material_planner.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "scene/plan/bounds.h"
#include "scene/plan/combinations.h"
#include "scene/plan/confidence.h"
#include "scene/plan/cost.h"
#include "scene/plan/reference.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio::scene {
namespace {

constexpr std::size_t most_candidates = 512;
/// Confidence with which a set is ruled out: it cannot come back.
constexpr double surely = 0.999;
/// Fresh points by which most sets that fail do.
constexpr std::size_t glance = 8192;
/// Fresh points are drawn up to so many times as many, where fewer do not decide.
constexpr std::size_t most_times = 16, most_fresh = std::size_t{1} << 20;
/// Part of the limit that a proved bound may take without being measured.
constexpr double proved_share = 0.1;
/// Part of the limit that nobody sees: what changes every point by less changes nothing.
constexpr double unseen_share = 0.01;

/// Key of a set by what it computes: what is not there has no form.
using Key = std::tuple<std::string, Form, bool, bool, bool>;
Key key_of(const Surface& s) {
  return {s.spec(), s.multiple.form, s.spectrum.has_value(), s.image_lit != nullptr, s.single};
}

Forms in_float(const Look& look, Forms f) {
  f[Effect::precision] = look.offer(Effect::precision).forms.front();
  return f;
}
/// All effects that the material has, in float: what a plan's speed is compared with.
Surface shipped_surface(const Look& look) {
  return look.surface(in_float(look, look.shipped()));
}

class MaterialPlanner {
 public:
  MaterialPlanner(const Lit& lit, std::size_t material, const PlanOptions& o)
      : scene_(lit.scene),
        options_(o),
        look_(lit.looks[material]),
        drawer_(lit.drawer(material, o.directions)),
        exact_(look_.surface(look_.exact())),
        everything_(look_.surface(look_.everything())),
        shipped_(shipped_surface(look_)),
        reference_(scene_, seen(drawer_.draw(choosing, 0, o.samples), scene_, material), exact_),
        margin_(margin_of(scene_)) {
    for (const auto& object : scene_.objects)
      if (lit.same_as[object.material] == material) join(reached_angles(scene_, object));
  }

  MaterialPlan plan() {
    screen();
    make_candidates();
    if (!scene_.budget_ns) add_sets_whose_errors_cancel();  // else every form is a candidate's
    measure();
    return chosen();
  }

 private:
  static LitPoints seen(LitPoints p, const Scene& s, std::size_t material) {
    if (p.count == 0)
      throw bad_input(s.path, fmt::format("material '{}'", s.materials[material].name),
                      "none of 16384 looks from its views meets it",
                      "an object of it that is larger in the picture");
    return p;
  }
  void join(const ReachedAngles& r) {
    reached_.voh.low = std::min(reached_.voh.low, r.voh.low);
    reached_.voh.high = std::max(reached_.voh.high, r.voh.high);
  }
  const Reference& compared_with(const Surface& s) const {
    return s.image_lit ? *under_sky_ : reference_;
  }
  Judgement judged(const Surface& s) const {
    auto d = compared_with(s).bounds_of(scene_, s);
    return judge(d, scene_.tolerance);
  }
  /// False where these points rule it out that a verification agrees.
  bool may_pass(const Judgement& j, double most_worst) const {
    return j.worst <= most_worst &&
           exceedance_lower_bound(j.exceeding, j.samples, surely) <= margin_.most_exceeding;
  }
  bool may_keep(const Judgement& j) const { return may_pass(j, scene_.tolerance.max); }
  /// All exact but one.
  Surface with(Effect e, Form form) const { return with(e, form, e, form); }
  /// All exact but two.
  Surface with(Effect e, Form form, Effect other, Form other_form) const {
    Forms f = look_.exact();
    f[e] = form;
    f[other] = other_form;
    return look_.surface(f);
  }
  /// Forms without what has no part in the light that comes here.  Where all of it is looked up, GGX as wide in all directions,
  /// Schlick's Fresnel, Lambert's diffuse and one compensation are all that is computed.
  Forms plain(Forms f) const {
    f = look_.plain(f);
    if (f[Effect::environment] != Form::split_sum || !under_sky_ ||
        !under_sky_->points.angles.empty())
      return f;
    for (const Effect e : {Effect::fresnel, Effect::anisotropy, Effect::tail, Effect::precision})
      f[e] = look_.offer(e).forms.front();
    if (f.keeps(Effect::compensation)) f[Effect::compensation] = Form::fdez_aguera;
    if (look_.offer(Effect::diffuse).forms.size() > 1)
      f[Effect::diffuse] = std::min(f[Effect::diffuse], Form::lambert);
    return look_.plain(f);
  }

  /// Whether the environment may be looked up.
  bool may_look_up() {
    const auto& offer = look_.offer(Effect::environment);
    if (offer.forms.size() < 2) return false;
    constexpr std::size_t few = 1024;
    const Surface looked_up = with(Effect::environment, offer.forms.front());
    const auto keeps_at = [&](std::size_t n) {
      under_sky_.emplace(Reference::under_sky(scene_, drawer_, choosing, 0, n, exact_));
      return scene_.budget_ns || may_keep(judged(looked_up));
    };
    // A few points tell most that it may not be.
    const bool ask_few = !scene_.budget_ns && few < options_.samples;
    return (!ask_few || keeps_at(few)) && keeps_at(options_.samples);
  }

  /// Effects one by one.
  void screen() {
    const bool looks_up = may_look_up();
    const Form lookup = look_.offer(Effect::environment).forms.front();
    std::vector<Surface> timed;
    for (std::size_t i = 0; i < effect_count; ++i) {
      const auto e = static_cast<Effect>(i);
      const auto& offer = look_.offer(e);
      const Surface dropped = with(e, offer.forms.front());
      Forms lean = look_.everything();
      lean[e] = offer.forms.front();
      timed.push_back(look_.surface(lean));
      PlannedEffect planned;
      planned.effect = e;
      auto& left = left_[i];
      if (offer.same_as_exact == offer.forms.front()) {
        planned.why = Why::structural;
        planned.reason = offer.why;
        left = {offer.forms.front()};
      } else if (const auto bound = proved(e, offer.forms.front());
                 bound && *bound <= proved_share * scene_.tolerance.limit) {
        planned.why = Why::proved;
        planned.error_if_dropped = *bound;
        left = {offer.forms.front()};
      } else {
        planned.error_if_dropped = changed_by(dropped);
        const auto may_be = [&](Form form) {
          if (form == offer.forms.back() || scene_.budget_ns) return true;
          if (e == Effect::environment) return looks_up;
          return may_keep(judged(with(e, form))) ||
                 (looks_up && may_keep(judged(with(Effect::environment, lookup, e, form))));
        };
        // No shader takes double for so little, whatever a noisy clock says.
        const bool rounds_unseen =
            e == Effect::precision &&
            planned.error_if_dropped <= proved_share * scene_.tolerance.limit;
        if (rounds_unseen)
          left = {offer.forms.front()};
        else
          for (const auto form : offer.forms)
            if (may_be(form)) left.push_back(form);
      }
      effects_.push_back(planned);
    }
    timed.push_back(everything_);
    timed.push_back(exact_);
    const auto times = times_of(timed, reference_.points);
    const double ns = times[effect_count].ns, ops = operations_of(everything_, reference_.points);
    const auto none = static_cast<std::size_t>(Effect::compensation);
    table_ns_saved_ = times.back().ns - times[none].ns;
    table_ops_saved_ =
        operations_of(exact_, reference_.points) - operations_of(timed[none], reference_.points);
    for (std::size_t i = 0; i < effects_.size(); ++i) {
      if (effects_[i].why == Why::structural) continue;  // what is absent is computed by no shader
      effects_[i].ns_saved = ns - times[i].ns;
      effects_[i].ops_saved = ops - operations_of(timed[i], reference_.points);
    }
  }
  std::optional<double> proved(Effect e, Form form) const {
    const auto change = change_bound(look_, e, form, reached_);
    if (!change) return {};
    return scene_.tolerance.metric == Metric::relative ? *change : delta_e_bound(*change);
  }

  std::array<double, effect_count> saved() const {
    std::array<double, effect_count> all;
    std::ranges::transform(effects_, all.begin(), [&](const PlannedEffect& e) {
      return options_.cost == Cost::time ? e.ns_saved : e.ops_saved;
    });
    return all;
  }
  void make_candidates() {
    thin_out(left_, saved(), most_candidates);
    for (const Forms& forms : combinations(left_))
      if (auto s = new_surface(forms)) {
        candidates_.emplace_back().forms = plain(forms);
        surfaces_.push_back(*std::move(s));
      }
  }
  /// Surface of a set that computes something new.
  std::optional<Surface> new_surface(const Forms& forms) {
    Surface s = look_.surface(plain(forms));
    if (!known_.insert(key_of(s)).second) return {};
    return s;
  }

  /// Errors of forms may cancel: of all sets of forms that shaders have, those that may keep the tolerance though one of their forms
  /// by itself does not.  A few points tell of most that they do not.
  void add_sets_whose_errors_cancel() {
    constexpr std::size_t few = 512;
    FormsLeft all = left_;
    for (std::size_t i = 0; i < effect_count; ++i) {
      const auto e = static_cast<Effect>(i);
      if (effects_[i].why != Why::measured || e == Effect::environment || e == Effect::precision)
        continue;
      all[i] = look_.offer(e).forms;
      if (e == Effect::compensation && all[i].size() > 1) std::erase(all[i], Form::tabulated);
    }
    thin_out(all, saved(), most_candidates);
    std::vector<Candidate> found;
    std::vector<Surface> surfaces;
    for (const Forms& forms : combinations(all))
      if (auto s = new_surface(forms)) {
        found.emplace_back().forms = plain(forms);
        surfaces.push_back(*std::move(s));
      }
    if (found.empty()) return;
    const Reference first(scene_, drawer_.draw(choosing, 0, few), exact_);
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
      if (!surfaces[i].image_lit) {
        auto d = first.bounds_of(scene_, surfaces[i]);
        if (!may_keep(judge(d, scene_.tolerance))) return;
      }
      found[i].error = judged(surfaces[i]);
    });
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found[i].error.samples > 0 && may_keep(found[i].error)) {
        candidates_.push_back(found[i]);
        surfaces_.push_back(std::move(surfaces[i]));
      }
  }

  void measure() {
    tbb::parallel_for(std::size_t{0}, candidates_.size(), [&](std::size_t i) {
      if (candidates_[i].error.samples == 0) candidates_[i].error = judged(surfaces_[i]);
      candidates_[i].ops = operations_of(surfaces_[i], reference_.points);
    });
    auto timed = surfaces_;
    timed.push_back(shipped_);
    const auto times = times_of(timed, reference_.points);
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      candidates_[i].ns = times[i].ns;
      candidates_[i].ns_spread = times[i].spread_ns;
    }
    count_times(candidates_, look_);
    ns_exact_ = times.back().ns;
  }

  /// Of a candidate, or a judged set.
  double cost(const auto& c) const { return options_.cost == Cost::time ? c.ns : c.ops; }
  double counted_cost(const Candidate& c) const {
    return options_.cost == Cost::time ? c.counted_ns : c.ops;
  }
  bool costs_more(const Candidate& c, const Candidate& cheapest) const {
    return options_.cost == Cost::time ? !c.is_as_fast_as(cheapest) : c.ops > cheapest.ops;
  }

  /// Those that may keep the tolerance, best first: the cheapest, and before it those as cheap of fewer operations, or effects.
  std::vector<const Candidate*> in_order() const {
    std::vector<const Candidate*> left, order;
    for (const auto& c : candidates_)
      if (may_keep(c.error)) left.push_back(&c);
    std::ranges::sort(left, [&](auto* a, auto* b) {
      return std::tuple(counted_cost(*a), a->forms.form) <
             std::tuple(counted_cost(*b), b->forms.form);
    });
    while (!left.empty()) {
      const auto end =
          std::ranges::find_if(left, [&](auto* c) { return costs_more(*c, *left[0]); });
      const auto best = std::min_element(left.begin(), end,
                                         [](auto* a, auto* b) { return a->is_simpler_than(*b); });
      order.push_back(*best);
      left.erase(best);
    }
    return order;
  }

  JudgedSet judged_set(const Forms& forms, double ns, double ops) const {
    return {forms, ns, ops, {}, margin_};
  }
  /// A set by fresh points: enough to decide on it, or of one that fails at a glance few.  Those with the many directions that a lookup is compared with are drawn once.
  JudgedSet checked(
      const Forms& forms, const Surface& s, double ns, double ops, std::size_t first = glance) {
    const auto& t = scene_.tolerance;
    JudgedSet set = judged_set(forms, ns, ops);
    const auto judge_both = [&](std::vector<double>& all, std::vector<double> own) {
      set.error = judge(all, t);
      set.reference_error = judge(own, t).quantile;
    };
    if (s.image_lit) {
      if (!fresh_under_sky_)
        fresh_under_sky_.emplace(Reference::under_sky(scene_, drawer_, checking, 0,
                                                      fresh_points(scene_, options_, s), exact_));
      auto d = fresh_under_sky_->bounds_of(scene_, s);
      judge_both(d, fresh_under_sky_->own_error);
      return set;
    }
    const std::size_t enough = options_.fresh,
                      most = std::max(enough, std::min(most_times * enough, most_fresh));
    FreshDifferences fresh;
    for (std::size_t n = std::min(first, enough);; n = n < enough ? enough : 4 * n) {
      fresh.draw_to(std::min(n, most), scene_, drawer_, checking, exact_, s);
      judge_both(fresh.all, fresh.own);
      // What is beyond even by its estimate on many points would be a lucky draw.
      const bool beyond =
          n > enough && static_cast<double>(set.error.exceeding) >
                            margin_.most_exceeding * static_cast<double>(fresh.drawn);
      const bool fails = beyond || !may_pass(set.error, margin_.most_worst);
      if (fails || (n >= enough && (set.keeps_margin() || n >= most))) return set;
    }
  }

  /// What a surface changes: the quantile of its differences, without the reference's own error.
  double changed_by(const Surface& s) const {
    auto changes = compared_with(s).differences_of(scene_, s);
    return judge(changes, scene_.tolerance).quantile;
  }
  void compare_shipped(MaterialPlan& p) const {
    p.shipped_upper = std::numeric_limits<double>::infinity();
    for (const auto form : look_.offer(Effect::compensation).forms)
      if (form != Form::tabulated)
        p.shipped_upper = std::min(p.shipped_upper, judged(with(Effect::compensation, form)).upper);
  }
  /// On as many fresh points as a plan: of the sets without the table the cheapest that keeps the margin where sets are compared; if
  /// there it does not, or none does, the one that takes least of it, those among them that differ from the plan, or from all effects,
  /// only by the table.
  std::optional<JudgedSet> nearest_without_table(const MaterialPlan& p) {
    const auto& offered = look_.offer(Effect::compensation).forms;
    if (offered.back() != Form::tabulated) return {};
    std::vector<Candidate> all;
    std::ranges::copy_if(candidates_, std::back_inserter(all), [](const Candidate& c) {
      return c.forms[Effect::compensation] != Form::tabulated;
    });
    std::vector<Forms> with_table{in_float(look_, look_.structural())};
    if (!scene_.budget_ns) with_table.push_back(p.forms);
    for (const auto& forms : with_table)
      for (const auto form : offered) {
        if (form == Form::tabulated) continue;
        Candidate& c = all.emplace_back();
        c.forms = forms;
        c.forms[Effect::compensation] = form;
        c.forms = plain(c.forms);
        const Surface s = look_.surface(c.forms);
        c.error = judged(s);
        c.ops = operations_of(s, reference_.points);
      }
    const auto taken = [&](const Candidate& c) {
      Judgement j = c.error;
      if (c.failed) j.worst = c.failed->worst, j.bound = c.failed->exceeding_bound;
      return margin_.taken(j);
    };
    const auto checked_set = [&](const Forms& forms) {
      const std::array surface{look_.surface(forms)};
      return checked(forms, surface[0], times_of(surface, reference_.points)[0].ns,
                     operations_of(surface[0], reference_.points), options_.fresh);
    };
    const Candidate* cheapest = nullptr;
    for (const auto& c : all)
      if (taken(c) <= 1 && (!cheapest || cost(c) < cost(*cheapest))) cheapest = &c;
    if (cheapest)
      if (const auto set = checked_set(cheapest->forms); set.keeps_margin()) return set;
    return checked_set(std::ranges::min_element(all, {}, taken)->forms);
  }

  MaterialPlan chosen() {
    MaterialPlan p;
    p.effects = std::move(effects_);
    p.ns_exact = ns_exact_;
    p.ops_exact = operations_of(shipped_, reference_.points);
    p.reference = look_.exact().name(Effect::compensation);
    p.bounded = look_.is_bounded();
    p.coverage = drawer_.coverage();
    p.directions = static_cast<double>(reference_.points.point.size()) /
                   static_cast<double>(reference_.points.count);
    p.margin = margin_;
    p.table_ns_saved = table_ns_saved_;
    p.table_ops_saved = table_ops_saved_;
    compare_shipped(p);
    if (!scene_.budget_ns) choose(p);
    if (scene_.budget_ns || p.needs_table()) p.without_table = nearest_without_table(p);
    front(p);
    if (scene_.budget_ns) p.sets = std::move(candidates_);
    return p;
  }

  /// The first that keeps the margin; else what changes nothing.
  void choose(MaterialPlan& p) {
    for (const auto* c : in_order()) {
      const auto i = static_cast<std::size_t>(c - candidates_.data());
      const auto set = checked(c->forms, surfaces_[i], c->ns, c->ops);
      if (set.keeps_margin()) {
        if (!p.failed) p.failed = nearest_cheaper(p, set);
        p.ns_spread = c->spread();
        return take(p, look_, set);
      }
      candidates_[i].failed = {set.error.worst, set.error.bound};
      ++p.passed_over;
      if (!p.failed || cost(set) < cost(*p.failed)) p.failed = set;
    }
    p.only_unseen = true;
    const auto same = nearest();
    const std::array surface{look_.surface(same)};
    take(p, look_,
         checked(same, surface[0], times_of(surface, reference_.points)[0].ns,
                 operations_of(surface[0], reference_.points), options_.fresh));
  }
  /// Of the sets with one form cheaper than a set that is taken, the nearest, by the points that sets are compared on.
  std::optional<JudgedSet> nearest_cheaper(const MaterialPlan& p, const JudgedSet& taken) const {
    std::optional<JudgedSet> nearest;
    for (std::size_t i = 0; i < effect_count; ++i) {
      const auto e = static_cast<Effect>(i);
      if (p.effects[i].why != Why::measured || e == Effect::environment) continue;
      for (const auto form : look_.offer(e).forms) {
        if (form == taken.forms[e]) break;
        Forms forms = taken.forms;
        forms[e] = form;
        const Surface s = look_.surface(forms = plain(forms));
        JudgedSet set = judged_set(forms, 0, operations_of(s, reference_.points));
        if (set.ops >= taken.ops) continue;
        set.error = judged(s);
        if (!may_keep(set.error) && (!nearest || set.error.bound < nearest->error.bound))
          nearest = set;
      }
    }
    if (nearest) {
      const std::array surface{look_.surface(nearest->forms)};
      nearest->ns = times_of(surface, reference_.points)[0].ns;
    }
    return nearest;
  }
  /// Forms without what changes nothing: they err by what the reference does.
  Forms nearest() const {
    Forms f = look_.structural();
    for (std::size_t i = 0; i < effect_count; ++i) {
      const auto e = static_cast<Effect>(i);
      const auto cheapest = look_.offer(e).forms.front();
      if (f[e] == cheapest || (e == Effect::environment && !under_sky_)) continue;
      const Surface dropped = with(e, cheapest);
      const auto changes = compared_with(dropped).differences_of(scene_, dropped);
      if (*std::ranges::max_element(changes) < unseen_share * scene_.tolerance.limit)
        f[e] = cheapest;
    }
    return plain(f);
  }
  void front(MaterialPlan& p) const {
    std::vector<Candidate> all = candidates_;
    std::ranges::sort(all, {},
                      [&](const Candidate& c) { return std::tuple(cost(c), c.error.upper); });
    double least = std::numeric_limits<double>::infinity();
    for (const auto& c : all)
      if (c.error.upper < least) {
        least = c.error.upper;
        p.front.push_back(c);
      }
  }

  const Scene& scene_;
  const PlanOptions& options_;
  const Look& look_;
  PointDrawer drawer_;
  Surface exact_, everything_;  ///< the latter as shaders have it: what dropping an effect saves is
                                ///< measured on it
  /// All effects that the material has, in float: what a plan's speed is compared with.
  Surface shipped_;
  Reference reference_;
  Margin margin_;
  /// What surfaces that look the environment up are compared with, and its fresh points.
  std::optional<Reference> under_sky_, fresh_under_sky_;
  ReachedAngles reached_{{1, 0}};
  std::vector<PlannedEffect> effects_;
  FormsLeft left_;
  std::set<Key> known_;  ///< of all sets so far
  std::vector<Candidate> candidates_;
  std::vector<Surface> surfaces_;
  double ns_exact_ = 0, table_ns_saved_ = 0, table_ops_saved_ = 0;
};

}  // namespace

MaterialPlan plan_material(const Lit& lit, std::size_t material, const PlanOptions& options) {
  return MaterialPlanner(lit, material, options).plan();
}

void take(MaterialPlan& p, const Look& look, const JudgedSet& set) {
  const Surface surface = look.surface(set.forms);
  p.checked = set.error;
  p.holds = set.keeps_margin();
  p.reference_error = set.reference_error;
  p.forms = set.forms;
  p.ns = set.ns;
  // What computes the same takes as long, whatever a noisy clock says.
  if (key_of(surface) == key_of(shipped_surface(look))) p.ns_exact = set.ns;
  p.spec = surface.spec();
  p.parameters = surface.parameters();
  p.speedup = p.ns_exact / p.ns;
  p.ops_saved = p.ops_exact > 0 ? 1 - set.ops / p.ops_exact : 0;  // a constant has no operations
  for (auto& e : p.effects) {
    e.keep = set.forms.keeps(e.effect);
    e.form = set.forms.name(e.effect);
    if (e.effect == Effect::compensation && p.needs_table())
      e.ns_saved = p.table_ns_saved, e.ops_saved = p.table_ops_saved;
  }
}

std::size_t fresh_points(const Scene& scene, const PlanOptions& o, const Surface& s) {
  return s.image_lit ? std::min(o.fresh, samples_of_verification(scene)) : o.fresh;
}

}  // namespace gonio::scene
