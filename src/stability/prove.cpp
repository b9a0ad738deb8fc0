#include "stability/prove.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/random.h"
#include "base/stopwatch.h"
#include "stability/evaluate.h"
#include "stability/places.h"
#include "stability/value_over.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio::stability {
namespace {

template <class F>
constexpr Number number_of = std::same_as<F, Half>    ? Number::half
                             : std::same_as<F, float> ? Number::float_
                                                      : Number::double_;

using Sides = std::vector<Range>;

/// Measure in which sides are halved: logarithms, but of what is smaller than the number has use for.
template <class F>
struct Measure {
  static constexpr int digits = std::numeric_limits<F>::digits;
  inline static const double least = std::ldexp(1.0, digits < 24 ? -16 : digits < 53 ? -44 : -70);

  static double of(double x) { return std::copysign(std::log2(1 + std::abs(x) / least), x); }
  static double back(double u) { return std::copysign(least * (std::exp2(std::abs(u)) - 1), u); }
  static double width(const Range& r) { return of(r.high) - of(r.low); }
  static double rounded(double x) { return static_cast<double>(static_cast<F>(x)); }
  static double middle(const Range& r) {
    return std::clamp(rounded(back((of(r.low) + of(r.high)) / 2)), r.low, r.high);
  }
};

/// Looking at a box.
struct Outcome {
  bool keeps = false;  ///< the bounds
  Range values{0, 0};
  bool may_be_nan = false;
  std::uint64_t evaluations = 0;
  std::vector<double> refuted;  ///< inputs of a value outside the bounds
};

template <class F>
class Prover {
 public:
  Prover(const Provable<F>& formula, const Rounding& rule, const Range& required)
      : formula_(formula), rule_(rule), required_(required) {}

  Outcome look(const Sides& box) const {
    const RoundingScope scope(rule_);
    Outcome out;
    const Enclosure<F> y = enclose(box);
    out.values = {y.low(), y.high()};
    out.may_be_nan = y.may_be_nan();
    out.keeps = keeps(out);
    if (out.keeps) return out;
    if (!out.may_be_nan) {
      faces(box, y.directions(), out);
      out.keeps = keeps(out);
      if (out.keeps) return out;
    }
    const Enclosure<F> ways = Enclosure<F>::over_all_ways([&] { return enclose(box); });
    out.values = {std::max(out.values.low, ways.low()), std::min(out.values.high, ways.high())};
    out.may_be_nan = ways.may_be_nan();
    out.keeps = keeps(out);
    if (out.keeps) return out;
    // Corners, all of up to four sides, and the middle.
    const std::size_t n = box.size(), corners = std::size_t{1} << std::min<std::size_t>(n, 4);
    std::vector<double> x(n);
    for (std::size_t corner = 0; corner < corners; ++corner) {
      for (std::size_t i = 0; i < n; ++i) x[i] = corner >> i % 4 & 1 ? box[i].high : box[i].low;
      if (refutes(x, out)) return out;
    }
    for (std::size_t i = 0; i < n; ++i) x[i] = Measure<F>::middle(box[i]);
    refutes(x, out);
    return out;
  }

  /// Places all over a box that stays open.
  void search(const Sides& box, int places, std::uint64_t seed, Outcome& out) const {
    Draws draw(seed);
    std::vector<double> x(box.size());
    for (int k = 0; k < places && out.refuted.empty(); ++k) {
      for (std::size_t i = 0; i < box.size(); ++i) {
        const auto [low, high] = box[i];
        const double part = draw.uniform(), width = Measure<F>::width(box[i]);
        const double at = width > 0 ? Measure<F>::back(Measure<F>::of(low) + part * width)
                                    : low + part * (high - low);
        x[i] = std::clamp(Measure<F>::rounded(at), low, high);
      }
      refutes(x, out);
    }
  }

 private:
  bool keeps(const Outcome& out) const {
    return !out.may_be_nan && required_.low <= out.values.low && out.values.high <= required_.high;
  }
  Enclosure<F> enclose(const Sides& box) const {
    std::vector<Enclosure<F>> in;
    for (const auto& side : box)
      in.push_back(
          Enclosure<F>::input(static_cast<F>(side.low), static_cast<F>(side.high), in.size()));
    return formula_.enclosed(in);
  }
  /// Bounds at the faces between which the value rises: those over the box.
  void faces(const Sides& box, const Directions& by, Outcome& out) const {
    Sides top = box, bottom = box;
    bool any = false;
    for (std::size_t i = 0; i < box.size(); ++i) {
      const bool rises = by.rises(i), falls = by.falls(i);
      if (!rises && !falls) continue;
      any = any || rises != falls;
      const double up = rises ? box[i].high : box[i].low, down = rises ? box[i].low : box[i].high;
      top[i] = {up, up};
      bottom[i] = {down, down};
    }
    if (!any) return;
    const Enclosure<F> high = enclose(top), low = enclose(bottom);
    out.values.high = std::min(out.values.high, high.high());
    out.values.low = std::max(out.values.low, low.low());
  }
  bool refutes(const std::vector<double>& x, Outcome& out) const {
    ++out.evaluations;
    const double y = formula_.value(x);
    if (required_.holds(y)) return false;
    out.refuted = x;
    return true;
  }

  const Provable<F>& formula_;
  Rounding rule_;
  Range required_;
};

/// Halves of a box across its longest side, which no input of the number lies between; none of a single input.  Sides too
/// short for the measure are halved as they are.
template <class F>
std::vector<Sides> halves(const Sides& box) {
  std::size_t longest = 0;
  double width = -1;
  for (std::size_t i = 0; i < box.size(); ++i)
    if (const double w = Measure<F>::width(box[i]); w > width && box[i].low < box[i].high) {
      longest = i;
      width = w;
    }
  if (width < 0) return {};
  const auto [low, high] = box[longest];
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double before_high = Enclosure<F>::after(high, -infinity);
  const double middle =
      width > 0 ? Measure<F>::middle(box[longest]) : Measure<F>::rounded(low + (high - low) / 2);
  const double cut = std::clamp(middle, low, before_high);
  Sides lower = box, upper = box;
  lower[longest].high = cut;
  upper[longest].low = Enclosure<F>::after(cut, infinity);
  return {lower, upper};
}

/// A subject in one arithmetic that the rule allows: to nearest, and in half with all liberties that it may take.
template <class F>
Provable<F> provable(const Subject& s, const Rounding& rule) {
  Arithmetic a{number_of<F>};
  if (a.number == Number::half) a.flush = rule.flushed, a.contract = rule.contracted;
  return {[&s](std::span<const Enclosure<F>> in) { return value_over<Enclosure<F>>(s, in); },
          [&s, a](std::span<const double> in) { return value_of(s, a, in); }};
}

}  // namespace

Range finite_values(Number number) {
  return {-largest(number), largest(number)};
}
Range finite_and_not_negative(Number number) {
  return {0, finite_values(number).high};
}

std::string OpenBox::text(const Subject& s) const {
  std::string text;
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const auto [low, high] = inputs[k];
    text += fmt::format("{}{} {:.3g}", k ? ", " : "", s.inputs[k].name, low);
    if (low < high) text += fmt::format(" to {:.3g}", high);
  }
  return fmt::format("{}: values from {:.3g} to {:.3g}{}", text, values.low, values.high,
                     may_be_nan ? ", or no number" : "");
}

Rounding rounding_of(const Arithmetic& a) {
  if (a.any_gpu) {
    Rounding rule = Rounding::vulkan();
    rule.contracted = a.contract;
    return rule;
  }
  return {.contracted = a.contract, .flushed = a.flush};
}

template <class F>
Proof prove(const Provable<F>& formula,
            std::span<const Range> domain,
            const Rounding& rule,
            const Range& required,
            const ProofBudget& budget) {
  const Prover<F> prover(formula, rule, required);
  const Stopwatch spent;
  Sides all;
  for (const auto& side : domain)
    all.push_back({Measure<F>::rounded(side.low), Measure<F>::rounded(side.high)});

  const auto share = [&](const Sides& box) {
    double s = 1;
    for (std::size_t i = 0; i < box.size(); ++i)
      if (const double whole = Measure<F>::width(all[i]); whole > 0)
        s *= Measure<F>::width(box[i]) / whole;
    return s;
  };
  Proof proof;
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  std::vector<Sides> left;  // open boxes
  const auto refute = [&](const Outcome& out) {
    if (out.refuted.empty() || proof.counterexample) return;
    Violation c{out.refuted, {}, formula.value(out.refuted)};
    for (const double x : c.inputs) c.inputs_hex.push_back(hex(number_of<F>, x, true));
    proof.counterexample = std::move(c);
  };

  constexpr std::size_t part = 1024;  // of a wave; time is looked at between parts
  std::vector<Sides> wave{all}, next;
  for (; !wave.empty(); std::swap(wave, next)) {
    next.clear();
    for (std::size_t first = 0, count = 0; first < wave.size(); first += count) {
      const std::size_t allowed = budget.boxes - std::min(budget.boxes, proof.boxes);
      count = std::min({part, wave.size() - first, allowed});
      if (proof.counterexample || count == 0 || spent.seconds() > budget.seconds) {
        proof.out_of_budget = !proof.counterexample;
        left.insert(left.end(), wave.begin() + static_cast<std::ptrdiff_t>(first), wave.end());
        break;
      }
      std::vector<Outcome> outcomes(count);
      tbb::parallel_for(std::size_t{0}, count,
                        [&](std::size_t k) { outcomes[k] = prover.look(wave[first + k]); });
      proof.boxes += count;
      for (std::size_t k = 0; k < count; ++k) {
        const Sides& box = wave[first + k];
        proof.evaluations += outcomes[k].evaluations;
        if (outcomes[k].keeps) {
          range.low = std::min(range.low, outcomes[k].values.low);
          range.high = std::max(range.high, outcomes[k].values.high);
          continue;
        }
        refute(outcomes[k]);
        const auto two = outcomes[k].refuted.empty() ? halves<F>(box) : std::vector<Sides>{};
        if (two.empty())
          left.push_back(box);
        else
          next.insert(next.end(), two.begin(), two.end());
      }
    }
  }

  // What is left is looked at in more places, together a limited number of them.
  proof.open_boxes = left.size();
  for (const auto& box : left) proof.open_share += share(box);
  if (!proof.counterexample && !left.empty()) {
    const int places = static_cast<int>(std::clamp<std::size_t>(200'000 / left.size(), 1, 1000));
    std::vector<Outcome> outcomes(left.size());
    tbb::parallel_for(std::size_t{0}, left.size(),
                      [&](std::size_t k) { prover.search(left[k], places, 1 + k, outcomes[k]); });
    for (const auto& out : outcomes) {
      proof.evaluations += out.evaluations;
      refute(out);
    }
  }
  constexpr std::size_t shown = 8;
  for (std::size_t k = 0; k < std::min(shown, left.size()); ++k) {
    const auto out = prover.look(left[k]);
    proof.open.push_back({left[k], out.values, out.may_be_nan});
  }
  if (proof.counterexample)
    proof.evidence = Evidence::searched;
  else if (left.empty()) {
    proof.evidence = Evidence::proved;
    proof.range = range;
  }
  return proof;
}

template Proof prove(const Provable<Half>&,
                     std::span<const Range>,
                     const Rounding&,
                     const Range&,
                     const ProofBudget&);
template Proof prove(const Provable<float>&,
                     std::span<const Range>,
                     const Rounding&,
                     const Range&,
                     const ProofBudget&);
template Proof prove(const Provable<double>&,
                     std::span<const Range>,
                     const Rounding&,
                     const Range&,
                     const ProofBudget&);

Proof prove(const Subject& s,
            Number number,
            const Rounding& rule,
            const Range& required,
            const ProofBudget& budget) {
  std::vector<Range> domain;
  for (const auto& input : s.inputs) domain.push_back(input.domain);
  switch (number) {
    case Number::half:
      return prove(provable<Half>(s, rule), domain, rule, required, budget);
    case Number::float_:
      return prove(provable<float>(s, rule), domain, rule, required, budget);
    case Number::double_:
      return prove(provable<double>(s, rule), domain, rule, required, budget);
    case Number::mixed:
    case Number::wide:
      break;
  }
  throw wrong_usage(
      fmt::format("{}: a proof is in half, float or double, not in {}", s.id, name_of(number)));
}

std::optional<double> proved_from(const Subject& s,
                                  Number number,
                                  const Rounding& rule,
                                  const Range& required,
                                  const ProofBudget& budget) {
  if (!s.decides) return {};
  Subject part = s;
  Range& side = part.inputs[*s.decides].domain;
  const auto proved = [&](double from) {
    side.low = from;
    return prove(part, number, rule, required, budget).holds();
  };
  const Range all = side;
  if (proved(all.low)) return all.low;
  if (!proved(all.high)) return {};
  using M = Measure<double>;
  double fails = M::of(all.low), holds = M::of(all.high);
  constexpr double near_enough = 0.05;  // 3.5 %
  while (holds - fails > near_enough) {
    const double middle = (fails + holds) / 2;
    (proved(rounded(number, M::back(middle), true)) ? holds : fails) = middle;
  }
  return rounded(number, M::back(holds), true);
}

}  // namespace gonio::stability
