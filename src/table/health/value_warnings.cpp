#include "table/health/value_warnings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/few.h"
#include "base/quantile.h"
#include "table/format/measured_by.h"
#include "table/health/cosine.h"
#include "table/health/elevation.h"
#include "table/health/light.h"
#include "table/health/lost_values.h"

#include <fmt/format.h>

namespace gonio {
namespace {

void warn_of_dark_channels(const Table& t, std::vector<std::string>& all) {
  std::vector<std::string> dark;
  for (std::size_t c = 0; c < t.values.size(); ++c)
    if (std::ranges::none_of(t.values[c], [](double v) { return v > 0; }))
      dark.push_back(t.channels[c]);
  if (!dark.empty())
    all.push_back(
        fmt::format("no value of channel {} is above 0: nothing is known of it", few_of(dark)));
}

/// Interfaces reflect a few percent of every colour, and more at grazing light: where one channel holds next to nothing
/// of the others at each direction, no colour makes it.
void warn_of_faint_channels(const Table& t, std::vector<std::string>& all) {
  if (t.values.size() < 2) return;
  constexpr double faint = 1 / 80.0, most_of_all = 0.99;  // the rest may be noise
  constexpr std::size_t fewest = 8, enough = 20'000;
  const std::size_t step = t.size() / enough + 1;
  std::vector<double> brightest, second;  // of all channels
  for (std::size_t i = 0; i < t.size(); i += step) {
    double first = 0, next = 0;
    for (const auto& plane : t.values) {
      const double v = std::fmax(plane[i], 0.0);
      next = std::max(next, std::min(first, v));
      first = std::max(first, v);
    }
    brightest.push_back(first);
    second.push_back(next);
  }
  std::vector<std::string> names;
  double most = 0;
  std::size_t last = 0;
  for (std::size_t c = 0; c < t.values.size(); ++c) {
    std::vector<double> parts;
    for (std::size_t k = 0; k < brightest.size(); ++k) {
      const double v = t.values[c][k * step], others = v < brightest[k] ? brightest[k] : second[k];
      if (v > 0 && others > 0) parts.push_back(v / others);
    }
    if (parts.size() < fewest) continue;
    const double part = quantile(parts, most_of_all);
    if (part >= faint) continue;
    names.push_back(t.channels[c]);
    most = std::max(most, part);
    last = c;
  }
  if (names.empty()) return;
  all.push_back(
      fmt::format("channel {} holds at most {:.2g} of the brightest one at any direction: a scale "
                  "of its own?{}",
                  few_of(names), most, names.size() == 1 ? without_channel(t, last) : ""));
}

/// Noise lets neighbours change sides; what was taken off too much does not.
void warn_of_offset(TableFacts& facts, std::vector<std::string>& all) {
  if (facts.negative_channel() || facts.negative_offset() == 0) return;
  all.push_back(
      fmt::format("negative values, typically -{:.2g} 1/sr, follow their neighbours: rather an "
                  "offset than noise, perhaps too much dark signal taken off",
                  facts.negative_offset()));
}

void warn_of_negative_channel(TableFacts& facts, std::vector<std::string>& all) {
  const auto of = facts.negative_channel();
  if (!of) return;
  const Table& t = facts.table();
  all.push_back(fmt::format(
      "all negative values are of channel {}: a colour outside the gamut, or an offset: "
      "they follow their neighbours{}",
      t.channels[*of], without_channel(t, *of)));
}

/// A value that is said to be far surer than the others, which a fit then goes through.
void warn_of_sure_values(const Table& t, std::vector<std::string>& all) {
  constexpr double far = 30;  // below both the typical uncertainty and the typical part of a value
  const double part = typical_uncertainty(t);
  for (std::size_t c = 0; c < t.errors.size(); ++c) {
    const Values &u = t.errors[c], &f = t.values[c];
    const double typical = typical_value(u).value_or(0);
    std::optional<std::size_t> surest;
    std::size_t sure = 0;
    for (std::size_t i = 0; i < t.size(); ++i)
      if (u[i] > 0 && f[i] > 0 && far * u[i] < typical && far * u[i] < part * f[i]) {
        ++sure;
        if (!surest || u[i] < u[*surest]) surest = i;
      }
    if (!surest) continue;
    all.push_back(fmt::format(
        "{} of {} stated uncertainties {} far below the others (sample {}: {:.2g} % of its value, "
        "typically {:.2g} %): a fit passes through such values",
        sure, t.size(), sure == 1 ? "is" : "are", *surest + 1, 100 * u[*surest] / f[*surest],
        100 * part));
    return;
  }
}

}  // namespace

std::optional<std::size_t> negative_channel(TableFacts& facts) {
  const Table& t = facts.table();
  if (!t.negative_is_noise || t.values.size() < 2) return {};
  std::optional<std::size_t> of;
  std::size_t count = 0;
  const SampleAngles at(t);
  for (std::size_t c = 0; c < t.values.size(); ++c)
    for (std::size_t i = 0; i < t.size(); ++i)
      if (t.values[c][i] < 0 && mask(at(i), t.values[c][i]) == Mask::negative) {
        if (of && *of != c) return {};
        of = c;
        ++count;
      }
  constexpr std::size_t few = 8;
  return count >= few && negatives_follow_neighbours(t) ? of : std::nullopt;
}

std::vector<ValueWarning> value_warnings(TableFacts& facts) {
  std::vector<std::string> texts, cosine;
  const auto* c = warn_of_cosine(facts, cosine);
  std::vector<ValueWarning> all;
  for (auto& w : warnings_of_light(facts, c && c->incident + c->outgoing < 0))
    all.push_back({std::move(w.text), true, true, std::move(w.guess)});
  if (!c && warn_of_elevation(facts, texts))
    cosine.clear();  // of exchanged directions there is nothing more to say
  const bool is_told = !cosine.empty();
  texts.insert(texts.end(), cosine.begin(), cosine.end());
  warn_of_negative_channel(facts, texts);
  const std::size_t offset = texts.size();
  warn_of_offset(facts, texts);
  const bool has_offset = texts.size() > offset;
  warn_of_shared_ends(facts, texts);
  const std::size_t of_unit = texts.size();
  if (!is_told) warn_of_reciprocity(facts, texts);
  warn_of_dark_channels(facts.table(), texts);
  if (all.empty()) warn_of_faint_channels(facts.table(), texts);  // light has said so otherwise
  warn_of_zeros(facts, texts);
  warn_of_sure_values(facts.table(), texts);
  for (std::size_t k = 0; k < texts.size(); ++k) {
    all.push_back({std::move(texts[k]), k < of_unit});
    if (has_offset && k == offset) all.back().metric = " (--metric l2_cosine minds it less)";
  }
  return all;
}

}  // namespace gonio
