#include "stability/search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/random.h"
#include "stability/evaluate.h"
#include "stability/places.h"

#include <tbb/parallel_for.h>

namespace gonio::stability {
namespace {

using Inputs = std::vector<double>;

/// Size of a number's last digit, and its range.
struct Format {
  int digits;
  int least_counted;  ///< less than 2 to this power is held against that
  double most;

  double least() const { return std::ldexp(1, least_counted); }
  double ulp(double f) const {
    return std::ldexp(1, (std::abs(f) < least() ? least_counted : std::ilogb(f)) + 1 - digits);
  }
};
/// Exponent below which a result is black, in whatever light.
constexpr int black = -64;
Format format_of(Number number) {
  switch (number) {
    case Number::half:
      return {11, least_exponent(number), largest(number)};
    case Number::mixed:  // some results are floats, of what halves had left
      return {11, least_exponent(Number::half), largest(number)};
    case Number::float_:
      return {24, black, largest(number)};
    case Number::double_:
    case Number::wide:
      break;
  }
  return {53, black, largest(number)};
}
/// A result, judged.
struct Judged {
  double relative = 0, ulp = 0, beyond = 0;  ///< 0 where they are not asked for
  bool no_value = false, negative = false, overflow = false, undefined = false,
       negative_too = false, vanished = false, irreciprocal = false, not_monotone = false;
  bool lost = false;  ///< beyond the tolerance, or no value

  bool has_none() const { return no_value || overflow || undefined; }
  bool breaks(Requirement::Kind kind) const {
    return has_none() ||
           (kind == Requirement::Kind::nonnegative ? negative || negative_too
                                                   : kind != Requirement::Kind::finite && lost);
  }
};
/// Requirements whose largest broken parameter is looked for; the error's stands for relative and absolute.
constexpr std::array kinds{Requirement::Kind::relative, Requirement::Kind::finite,
                           Requirement::Kind::nonnegative};

class Judge {
 public:
  Judge(const Subject& s, const Arithmetic& a, const Tolerance& tolerance, bool measures_errors)
      : s_(s),
        a_(a),
        format_(format_of(a.number)),
        tolerance_(tolerance),
        measures_errors_(measures_errors) {}

  bool measures_errors() const { return measures_errors_; }
  bool wide() const { return a_.number == Number::double_; }

  double value(const Inputs& in) const { return value_of(s_, a_, in); }

  /// \param condition  `beyond` is wanted too
  Judged of(const Inputs& in, bool condition) const {
    if (!measures_errors_) {
      if (std::abs(value(in)) <= format_.most) return {};
      condition = false;
    }
    if (wide()) return against(truth_of(s_, in, condition), in);
    WideValue f{value_of(s_, Number::double_, in), 0, 1};
    if (condition) f.condition = condition_in_double(in, f.value);
    return against(f, in);
  }
  /// True where the value at `next` goes the other way than it should.
  bool goes_astray(const Inputs& in, const Inputs& next) const {
    const auto exact = [&](const Inputs& x) {
      return wide() ? truth_of(s_, x, false) : WideValue{value_of(s_, Number::double_, x), 0, 1};
    };
    const double x = value(in), y = value(next);
    const auto f = exact(in), g = exact(next);
    const double rise = (g.value - f.value) + (g.rest - f.rest);
    return (x < y && rise < 0) || (y < x && 0 < rise);
  }
  Judged confirmed(const Inputs& in) const { return against(truth_of(s_, in), in); }

 private:
  Judged against(const WideValue& f, const Inputs& in) const {
    const double x = value(in), size = std::abs(f.value), least = format_.least();
    Judged j;
    if (s_.given == Given::cosines) {
      Inputs exchanged = in;
      std::swap(exchanged[s_.parameters], exchanged[s_.parameters + 1]);
      const double y = value(exchanged);
      j.irreciprocal = x < y || y < x || std::isnan(x) != std::isnan(y);
    }
    const bool is_value = std::abs(x) <= format_.most;
    if (std::isnan(f.value)) {
      j.undefined = !is_value;
      return j;
    }
    if (!(size <= format_.most)) {
      j.overflow = !is_value;
      j.lost = true;
      return j;
    }
    if (!is_value) {
      j.no_value = j.lost = true;
      return j;
    }
    const double error = std::abs((x - f.value) - f.rest);
    j.ulp = error / format_.ulp(f.value);
    j.beyond = j.ulp / std::max(1.0, f.condition);
    if (least <= size && least <= std::abs(x)) j.relative = error / size;
    j.negative = x < 0 && f.value >= 0;
    j.negative_too = x < 0 && f.value < 0;
    j.vanished = x == 0 && least <= size;
    j.lost = std::max(tolerance_.relative * std::max(size, least), tolerance_.absolute) < error;
    return j;
  }

  double condition_in_double(Inputs in, double f) const {
    double sum = 0;
    const double step = 0x1p-22;
    for (double& x : in) {
      if (x == 0) continue;
      const double before = x;
      x *= 1 - step;
      sum += std::abs(value_of(s_, Number::double_, in) - f);
      x = before;
    }
    return sum / (step * std::abs(f));
  }

  const Subject& s_;
  Arithmetic a_;
  Format format_;
  Tolerance tolerance_;
  bool measures_errors_;
};

/// Domain of a subject in a number: inputs near its edges, and steps within.
class Domain {
 public:
  Domain(const Subject& s, Number number) : s_(s), number_(number) {
    for (std::size_t k = 0; k < s.inputs.size(); ++k)
      places_.push_back(places_within(number, s.inputs[k].domain, k < s.parameters));
    const auto index = [&](std::string_view name) {
      return static_cast<std::size_t>(std::ranges::find(s.inputs, name, &Input::name) -
                                      s.inputs.begin());
    };
    eta_ = index("eta"), k_ = index("k"), voh_ = index("voh"), nol_ = index("nol"),
    nov_ = index("nov");
  }

  Inputs seed(Draws& draw) const {
    Inputs in;
    for (const auto& i : s_.inputs) in.push_back(near_an_edge(i, draw));
    const auto has = [&](std::size_t k) { return k < in.size(); };
    // where inputs meet: equal cosines, the critical angle
    if (has(nol_) && has(nov_) && draw.uniform() < 0.25)
      in[nov_] = in[nol_] * (1 + signed_part(draw));
    if (has(eta_) && has(voh_) && draw.uniform() < 0.5) {
      const double k = has(k_) ? in[k_] : 0, c2 = (1 - in[eta_]) * (1 + in[eta_]) + k * k;
      if (c2 > 0 && c2 < 1) in[voh_] = std::sqrt(c2) * (1 + signed_part(draw));
    }
    for (std::size_t k = 0; k < in.size(); ++k) in[k] = within(k, in[k]);
    return in;
  }

  /// A step of 1, 2, 4 … places in one input, now and then in two.
  Inputs step(Inputs in, Draws& draw) const {
    for (int steps = draw.uniform() < 0.25 ? 2 : 1; steps > 0; --steps) {
      const auto k = std::min(
          static_cast<std::size_t>(draw.uniform() * static_cast<double>(in.size())), in.size() - 1);
      const auto& p = places_[k];
      if (p.first == p.last) continue;
      const double most = std::log2(static_cast<double>(p.last - p.first));
      const auto by = std::int64_t{1} << static_cast<int>(draw.uniform() * most);
      const auto from = place_of(number_, in[k], k < s_.parameters);
      const auto to = std::clamp(draw.uniform() < 0.5 ? from - by : from + by, p.first, p.last);
      in[k] = at_place(number_, to, k < s_.parameters);
    }
    return in;
  }

  /// The next value of an input above; none at its end.
  std::optional<double> above(std::size_t k, double x) const {
    const auto next = place_of(number_, x, k < s_.parameters) + 1;
    if (next > places_[k].last) return {};
    return at_place(number_, next, k < s_.parameters);
  }
  std::optional<double> below(std::size_t k, double x) const {
    const auto next = place_of(number_, x, k < s_.parameters) - 1;
    if (next < places_[k].first) return {};
    return at_place(number_, next, k < s_.parameters);
  }
  double lowest(std::size_t k) const {
    return at_place(number_, places_[k].first, k < s_.parameters);
  }
  double highest(std::size_t k) const {
    return at_place(number_, places_[k].last, k < s_.parameters);
  }

 private:
  /// 1 down to beyond the number's last digit, in logarithms.
  double part(Draws& draw) const {
    return std::exp2(-draw.uniform() * (format_of(number_).digits + 3));
  }
  double signed_part(Draws& draw) const {
    const double p = part(draw);
    return draw.uniform() < 0.5 ? -p : p;
  }
  double near_an_edge(const Input& i, Draws& draw) const {
    const auto [low, high] = i.domain;
    const double span = high - low, which = draw.uniform(), side = draw.uniform();
    if (which < 0.15) return low + span * draw.uniform();
    if (which < 0.25) return side < 0.5 ? low : high;
    if (which < 0.4 && !i.edges.empty()) {
      const auto n = static_cast<double>(i.edges.size());
      const auto edge = i.edges[std::min(static_cast<std::size_t>(side * n), i.edges.size() - 1)];
      return edge * (1 + signed_part(draw));
    }
    if (which < 0.6) return high - span * part(draw);
    if (low > 0) return low * std::pow(high / low, draw.uniform());
    if (low < 0 && which < 0.8) return span * signed_part(draw) / 2;  // towards 0
    // as small as numbers get, and seldom smaller than what still counts
    const double least = which < 0.7 ? least_exponent(number_) - 10.0 : -50.0;
    return low + span * std::exp2(draw.uniform() * least);
  }
  double within(std::size_t k, double x) const {
    const bool parameter = k < s_.parameters;
    const auto& p = places_[k];
    return at_place(
        number_,
        std::clamp(place_of(number_, rounded(number_, x, parameter), parameter), p.first, p.last),
        parameter);
  }

  const Subject& s_;
  Number number_;
  std::vector<Places> places_;
  std::size_t eta_ = 0, k_ = 0, voh_ = 0, nol_ = 0, nov_ = 0;
};

/// Inputs that were looked at.
struct Looking {
  Inputs in;
  Judged judged;
};
/// Inputs at which something happens, as they are met.
struct Met {
  struct Event {
    Count Looked::*count;
    bool Judged::*happens;
  };
  static constexpr Event events[] = {{&Looked::no_value, &Judged::no_value},
                                     {&Looked::negative, &Judged::negative},
                                     {&Looked::overflow, &Judged::overflow},
                                     {&Looked::undefined, &Judged::undefined},
                                     {&Looked::negative_too, &Judged::negative_too},
                                     {&Looked::vanished, &Judged::vanished},
                                     {&Looked::lost, &Judged::lost},
                                     {&Looked::irreciprocal, &Judged::irreciprocal},
                                     {&Looked::not_monotone, &Judged::not_monotone}};
  Looked looked;  ///< its counts
  std::uint64_t evaluations = 0;
  std::array<std::optional<double>, kinds.size()>
      broken{};  ///< largest deciding parameter where each is; of one that narrows the least,
                 ///< negated

  void look(const Subject& s, const Inputs& in, const Judged& j) {
    ++evaluations;
    for (const auto& e : events) {
      if (!(j.*e.happens)) continue;
      Count& c = looked.*e.count;
      if (c.count++ == 0) c.first = in;
    }
    if (!s.decides) return;
    for (std::size_t k = 0; k < kinds.size(); ++k)
      if (j.breaks(kinds[k])) raise(broken[k], s.narrows ? -in[*s.decides] : in[*s.decides]);
  }
  void add(const Met& other) {
    for (const auto& e : events) {
      Count& c = looked.*e.count;
      const Count& d = other.looked.*e.count;
      if (c.count == 0) c.first = d.first;
      c.count += d.count;
    }
    evaluations += other.evaluations;
    for (std::size_t k = 0; k < kinds.size(); ++k)
      if (other.broken[k]) raise(broken[k], *other.broken[k]);
  }

 private:
  static void raise(std::optional<double>& to, double x) { to = std::max(to.value_or(x), x); }
};

/// Aims of a climb: a larger error, relative or in units of the last digit, or than the condition explains; a larger
/// parameter at which the tolerance is not kept, or no value, or a negative one.
enum class Aim { relative, ulp, beyond, parameter, no_value, negative };
constexpr std::array aims{Aim::relative,  Aim::ulp,      Aim::beyond,
                          Aim::parameter, Aim::no_value, Aim::negative};

double reached(Aim aim, const Subject& s, const Looking& l) {
  switch (aim) {
    case Aim::relative:
      return l.judged.relative;
    case Aim::ulp:
      return l.judged.ulp;
    case Aim::beyond:
      return l.judged.beyond;
    case Aim::parameter:
    case Aim::no_value:
    case Aim::negative:
      break;
  }
  const auto kind = kinds[static_cast<std::size_t>(aim) - static_cast<std::size_t>(Aim::parameter)];
  if (!s.decides || !l.judged.breaks(kind)) return 0;
  const double x = l.in[*s.decides];
  return s.narrows ? s.inputs[*s.decides].domain.high - x + 1 : x;
}

/// Findings from one seed.
struct Found {
  Met met;
  Worst relative, ulp, beyond;
};

Found from_one_seed(
    const Subject& s, const Judge& judge, const Domain& domain, std::uint64_t seed, double effort) {
  const auto times = [&](double n) { return static_cast<std::size_t>(std::ceil(n * effort)); };
  const std::size_t seeds = times(judge.wide() ? 3000 : 40'000),
                    starts = judge.wide()              ? 12
                             : judge.measures_errors() ? 24
                                                       : 48,
                    steps = times(judge.wide() ? 300 : 3000);
  std::vector<Looking> seen(seeds);
  tbb::parallel_for(std::size_t{0}, seeds, [&](std::size_t i) {
    Draws draw(seed, i);
    seen[i].in = domain.seed(draw);
    seen[i].judged = judge.of(seen[i].in, !judge.wide());
    auto next = seen[i].in;
    if (const auto above = domain.above(next.size() - 1, next.back());
        above && judge.measures_errors()) {
      next.back() = *above;
      seen[i].judged.not_monotone = judge.goes_astray(seen[i].in, next);
    }
  });
  Found found;
  for (const auto& l : seen) found.met.look(s, l.in, l.judged);

  struct Climb {
    Aim aim;
    Looking at;
    Met met;
  };
  std::vector<Climb> climbs;
  for (const Aim aim : aims) {
    if (!judge.measures_errors() && aim != Aim::no_value) continue;
    std::vector<std::size_t> order(seeds);
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, std::greater<>(),
                             [&](auto i) { return reached(aim, s, seen[i]); });
    for (std::size_t k = 0; k < std::min(starts, seeds); ++k)
      if (reached(aim, s, seen[order[k]]) > 0) climbs.push_back({aim, seen[order[k]], {}});
  }
  tbb::parallel_for(std::size_t{0}, climbs.size(), [&](std::size_t c) {
    auto& climb = climbs[c];
    Draws draw(seed, c, 1);
    const bool condition = climb.aim == Aim::beyond;
    if (judge.wide() && condition) climb.at.judged = judge.of(climb.at.in, true);
    for (std::size_t k = 0; k < steps; ++k) {
      Looking next{domain.step(climb.at.in, draw), {}};
      if (next.in == climb.at.in) continue;
      next.judged = judge.of(next.in, condition);
      climb.met.look(s, next.in, next.judged);
      if (reached(climb.aim, s, next) >= reached(climb.aim, s, climb.at))
        climb.at = std::move(next);
    }
  });
  for (const auto& climb : climbs) {
    found.met.add(climb.met);
    if (!judge.measures_errors()) continue;
    const auto j = judge.confirmed(climb.at.in);
    const auto keep = [&](Worst& w, double value) {
      if (value > w.value) w = {value, climb.at.in};
    };
    keep(found.relative, j.relative);
    keep(found.ulp, j.ulp);
    keep(found.beyond, j.beyond);
  }
  return found;
}

}  // namespace

double least_asked(Number number) {
  return number == Number::half || number == Number::mixed ? 0x1p-14 : std::ldexp(1, black);
}

double usual_tolerance(Number number) {
  switch (number) {
    case Number::half:
    case Number::mixed:
      return 0.02;
    case Number::float_:
      return 1e-4;
    case Number::double_:
    case Number::wide:
      break;
  }
  return 1e-10;
}

Looked search(const Subject& s, const Arithmetic& a, const SearchOptions& options) {
  Looked looked;
  looked.evidence = Evidence::searched;
  const bool is_usual = options.tolerance.relative == 0 && options.tolerance.absolute == 0;
  looked.tolerance = is_usual ? Tolerance(usual_tolerance(a.number)) : options.tolerance;
  const Judge judge(s, a, looked.tolerance, options.measures_errors);
  const Domain domain(s, a.number);
  const double effort = options.effort * share_of_cheap(s);
  Found one = from_one_seed(s, judge, domain, 2 * options.seed, effort);
  const Found two = from_one_seed(s, judge, domain, 2 * options.seed + 1, effort);

  const double few = 8 * std::ldexp(1, 1 - format_of(a.number).digits);
  const auto agree = [](double x, double y, double little) {
    return std::max(x, y) <= std::max(little, 2 * std::min(x, y));
  };
  looked.settled = agree(one.relative.value, two.relative.value, few) &&
                   agree(one.beyond.value, two.beyond.value, 8);
  const auto take = [&](const Found& more) {
    one.met.add(more.met);
    const auto keep = [](Worst& worst, const Worst& other) {
      if (worst.value < other.value) worst = other;
    };
    keep(one.relative, more.relative);
    keep(one.ulp, more.ulp);
    keep(one.beyond, more.beyond);
  };
  take(two);
  // What a search calls safe is searched by itself: there is less of it to look at.
  constexpr std::size_t most_rounds = 8, quiet_rounds = 2;
  constexpr std::uint64_t stream = 1'000'003;
  const bool has_limit = s.decides && !s.narrows && !judge.wide() && judge.measures_errors();
  std::size_t quiet = 0;
  for (std::size_t round = 1; has_limit && quiet < quiet_rounds && round <= most_rounds; ++round) {
    const auto broken = one.met.broken[0];
    const auto next = broken ? domain.above(*s.decides, *broken) : std::nullopt;
    if (!next) break;
    Subject safe = s;
    safe.inputs[*s.decides].domain.low = *next;
    take(from_one_seed(safe, judge, Domain(safe, a.number), 2 * options.seed + round * stream,
                       effort));
    quiet = one.met.broken[0] == broken ? quiet + 1 : 0;
  }
  looked.relative = one.relative, looked.ulp = one.ulp, looked.beyond = one.beyond;
  if (a.number == Number::half && !looked.relative.at.empty()) {
    half_flags = {};
    value_of(s, a, looked.relative.at);
    looked.flags = half_flags;
  }
  if (!looked.ulp.at.empty()) looked.condition = truth_of(s, looked.ulp.at).condition;
  looked.evaluations = one.met.evaluations;
  for (const auto& e : Met::events) looked.*e.count = one.met.looked.*e.count;
  const std::array from{&looked.safe_from, &looked.finite_from, &looked.nonnegative_from};
  for (std::size_t k = 0; s.decides && k < kinds.size(); ++k) {
    const auto& broken = one.met.broken[k];
    if (s.narrows)
      *from[k] = broken ? domain.below(*s.decides, -*broken) : domain.highest(*s.decides);
    else
      *from[k] = broken ? domain.above(*s.decides, *broken) : domain.lowest(*s.decides);
  }
  return looked;
}

}  // namespace gonio::stability
