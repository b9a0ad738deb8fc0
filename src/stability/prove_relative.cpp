#include "stability/prove_relative.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/process.h"
#include "base/stopwatch.h"
#include "number/scripted.h"
#include "stability/evaluate.h"
#include "stability/value_over.h"

#include <fmt/format.h>

namespace gonio::stability {
namespace {

using Domain = std::vector<Range>;

template <class F>
std::string script(const Subject& s, const Domain& domain, bool split, std::string& why) {
  using Limits = std::numeric_limits<F>;
  Script script;
  std::vector<Scripted<F>> in;
  std::string inputs, hypotheses, cuts;
  for (const auto& [low, high] : domain) {
    const auto k = in.size();
    inputs += fmt::format("x{0} = rnd(X{0});\n", k);
    hypotheses += fmt::format("{}x{} in [{:a},{:a}]", k ? " /\\ " : "", k, low, high);
    in.push_back(
        Scripted<F>::input(fmt::format("x{}", k), static_cast<F>(low), static_cast<F>(high)));
    // In powers of two towards 0, and of angles towards 1.
    std::string points;
    const auto cut = [&, from = low, to = high](double x) {
      if (from < x && x < to) points += fmt::format("{}{:a}", points.empty() ? "" : ",", x);
    };
    for (int e = -6; e <= -1; ++e) cut(std::ldexp(1.0, e));
    if (k >= s.parameters) {
      for (const double x : {0.625, 0.75, 0.875}) cut(x);
      for (int e = 4; e <= 7; ++e) cut(1 - std::ldexp(1.0, -e));
    }
    if (split && !points.empty())
      cuts += fmt::format("{}x{} in ({})", cuts.empty() ? "$ " : ", ", k, points);
  }
  const auto y = value_over<Scripted<F>>(s, in);
  why = script.refused();
  if (!why.empty()) return {};
  return fmt::format("@rnd = float<{},{},ne>;\n{}{}{{ {} -> {} -/ {} in ? }}\n{}{}", Limits::digits,
                     Limits::min_exponent - Limits::digits, inputs, script.text(), hypotheses,
                     y.rounded(), y.exact(), script.hints(), cuts.empty() ? "" : cuts + ";\n");
}

/// "-332669339962575889b-78": an integer times a power of two.
std::optional<double> read_number(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  std::int64_t integer = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), integer);
  if (error != std::errc()) return {};
  int exponent = 0;
  if (const char* last = text.data() + text.size(); end != last && *end == 'b')
    if (std::from_chars(end + 1, last, exponent).ec != std::errc()) return {};
  const double size = std::ldexp(std::abs(static_cast<double>(integer)), exponent);
  return size > 0 ? std::nextafter(size, std::numeric_limits<double>::infinity()) : 0;
}

}  // namespace

std::optional<double> gappa_bound(const std::string& output) {
  const auto results = output.find("Results:"), open = output.find(" in [", results);
  if (results == output.npos || open == output.npos) return {};
  const auto text = std::string_view(output).substr(open + 5);
  const auto end_of_low = text.find('}'),
             comma = text.find(',', end_of_low == text.npos ? 0 : end_of_low);
  const auto low = read_number(text);
  if (!low || comma == text.npos) return {};
  const auto high = read_number(text.substr(comma + 1));
  if (!high) return {};
  return std::max(*low, *high);
}

std::string gappa_script(const Subject& s,
                         Number number,
                         const Rounding& rule,
                         const Domain& domain,
                         bool split,
                         std::string& why) {
  const RoundingScope scope(rule);
  switch (number) {
    case Number::half:
      return script<Half>(s, domain, split, why);
    case Number::float_:
      return script<float>(s, domain, split, why);
    case Number::double_:
      return script<double>(s, domain, split, why);
    case Number::mixed:
    case Number::wide:
      break;
  }
  throw wrong_usage(
      fmt::format("{}: a proof is in half, float or double, not in {}", s.id, name_of(number)));
}

RelativeProof prove_relative(const Subject& s,
                             Number number,
                             const Rounding& rule,
                             double seconds) {
  Domain all;
  for (const auto& input : s.inputs)
    all.push_back(
        {rounded(number, input.domain.low, true), rounded(number, input.domain.high, true)});
  const bool half = number == Number::half, single = number == Number::float_;
  const double below_1 = 1 - std::ldexp(1.0, half     ? -11
                                             : single ? -24
                                                      : -53),
               // Twice the least normal number: of less a product with what may be just below 1 is
               // subnormal.
      least = std::ldexp(1.0, half     ? -13
                              : single ? -125
                                       : -1021);
  Domain part = all;
  for (std::size_t k = s.parameters; k < part.size(); ++k) {
    auto& [low, high] = part[k];
    if (low < below_1 && high == 1) high = below_1;
    if (low == 0 && least < high) low = least;
  }

  const Stopwatch spent;
  RelativeProof proof;
  const auto same = [](const Range& a, const Range& b) {
    return a.low == b.low && a.high == b.high;
  };
  for (const bool narrower : {false, true}) {
    if (narrower && std::ranges::equal(all, part, same)) break;
    for (const bool split : {false, true}) {
      if (split && proof.bound && all.size() > 2) continue;  // pieces of three sides are many
      const auto& domain = narrower ? part : all;
      std::string why;
      const auto text = gappa_script(s, number, rule, domain, split, why);
      std::optional<double> bound;
      if (!text.empty()) {
        const auto run = run_program("gappa", {}, text, std::max(0.0, seconds - spent.seconds()));
        if (!run) return {{}, all, false, std::string(without_gappa)};
        if (run->status == 0) bound = gappa_bound(run->output);
        why = run->out_of_time ? "Gappa was out of time" : "Gappa found no bound";
      }
      // What leaves inputs out must say much more.
      if (bound && (!proof.bound || *bound < (narrower ? 0.1 : 1) * *proof.bound))
        proof = {bound, domain, !narrower, {}};
      if (!proof.bound) proof.why = why;
    }
  }
  if (!proof.bound) proof.domain = all;
  return proof;
}

}  // namespace gonio::stability
