#include "table/health/lost_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "base/few.h"
#include "base/quantile.h"
#include "table/format/measured_by.h"
#include "table/health/facts.h"
#include "table/health/fills.h"
#include "table/health/rounding.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

constexpr double digits_of_one = 20;  ///< standard deviations of rounding in six steps

constexpr double some_lost = 0.005;  ///< of the values: fewer zeros may be anything

/// True where rounding to 0 or to one digit shifts many values.  A table all of whose values are short numbers may have been
/// written so, but for zeros.
bool is_coarse(std::size_t zeros, std::size_t coarse, std::size_t values) {
  const auto many = [&](std::size_t n, double part) {
    return static_cast<double>(n) > part * static_cast<double>(values);
  };
  return many(zeros + coarse, 0.05) && (many(zeros, 0.02) || !many(zeros + coarse, 0.95));
}

/// Values that are 0, or that rounding left one digit, of a table's.
struct Zeros {
  std::size_t none = 0, coarse = 0, values = 0, negative = 0;
  std::vector<double> lost;    ///< by rounding, of each value, in parts of it
  std::set<double> different;  ///< the first few
  FileRounding rounding;

  bool are_many(double part) const {
    return static_cast<double>(none) > part * static_cast<double>(values);
  }
  bool are_rounded() const { return rounding.absolute > 0 && is_coarse(none, coarse, values); }
  bool are_clipped() const { return !are_rounded() && negative == 0 && are_many(some_lost); }
};
constexpr std::size_t few_values = 8;
Zeros zeros_of(const Table& t) {
  const SampleAngles at(t);
  Zeros z;
  z.rounding = rounding_of(t);
  const double one_digit = digits_of_one * z.rounding.absolute;
  const std::size_t step = t.size() / 60'000 + 1;
  for (const auto& plane : t.values) {
    std::size_t none = 0, some = 0;
    for (std::size_t i = 0; i < t.size(); i += step) {
      const Mask m = plane[i] <= 0 ? mask(at(i), plane[i]) : Mask::valid;
      none += m == Mask::valid && plane[i] == 0;
      z.negative += m == Mask::negative;
      some += plane[i] > 0;
      z.coarse += plane[i] > 0 && plane[i] < one_digit;
      if (!(plane[i] > 0) || mask(at(i), plane[i]) != Mask::valid) continue;
      z.lost.push_back(z.rounding.of(plane[i]) / plane[i]);
      if (z.different.size() < few_values) z.different.insert(plane[i]);
    }
    if (some == 0) continue;  // of a channel of zeros something else is said
    z.none += none;
    z.values += none + some;
  }
  return z;
}

/// Number of values at the end of a range, where many share the last one, as they share no other near it.
/// \param values  of a channel or of several with one end, sorted from that end on
/// \param is_near  whether a value is near the last one
template <class Near>
std::size_t shared_end(const std::vector<double>& values, const Near& is_near) {
  std::size_t run = 0, last = 0, longest = 0;  // of equal values: this, at the end, and elsewhere
  for (std::size_t k = 0; k < values.size() && is_near(values[k]); ++k) {
    run = k > 0 && values[k] == values[k - 1] ? run + 1 : 1;
    (values[k] == values[0] ? last : longest) =
        std::max(values[k] == values[0] ? last : longest, run);
  }
  constexpr std::size_t few = 8, others = 4;
  return last < few || longest == 0 || last < others * longest || 500 * last < values.size() ? 0
                                                                                             : last;
}

std::vector<SharedEnd> shared_ends(const Table& t, bool greatest) {
  const SampleAngles at(t);
  const FileRounding rounding = rounding_of(t);
  // Of values of few digits many are equal.
  const auto is_coarse_step = [](double sigma, double value) {
    constexpr double coarse = 0.006;
    return sigma > coarse * value;
  };
  const std::size_t step = t.size() / 60'000 + 1;
  std::map<double, std::pair<std::vector<double>, std::vector<std::string>>> with_end;
  for (std::size_t c = 0; c < t.values.size(); ++c) {
    std::vector<double> values;
    for (std::size_t i = 0; i < t.size(); i += step)
      if (const double v = t.values[c][i]; v > 0 && mask(at(i), v) == Mask::valid)
        values.push_back(v);
    if (values.empty()) continue;
    const auto [low, high] = std::ranges::minmax(values);
    auto& [together, channels] = with_end[greatest ? high : low];
    together.insert(together.end(), values.begin(), values.end());
    channels.push_back(t.channels[c]);
  }
  std::vector<SharedEnd> all;
  for (auto& [end, found] : with_end) {
    auto& [values, channels] = found;
    if (greatest && is_coarse_step(rounding.of(end), end)) continue;
    std::ranges::sort(values);
    if (greatest) std::ranges::reverse(values);
    const auto is_near = [&, last = end](double v) {
      return greatest ? v > last / 2 : v < 2 * last;
    };
    if (const std::size_t n = shared_end(values, is_near))
      all.push_back({end, n, values.size(), std::move(channels)});
  }
  return all;
}

/// A base that nearly all values share has no noise that could have been clipped.
bool is_base(const SharedEnd& e) {
  return 4 * e.sharers > 3 * e.values;
}

/// Whether values up to about a size have so little noise that none of that size was clipped: it would be in all of them.  Nothing
/// where too few of them have neighbours.
std::optional<bool> are_exact_up_to(TableFacts& facts, std::size_t channel, double size) {
  const Values& plane = facts.table().values[channel];
  std::vector<double> near;
  for (const auto& d : facts.noise_samples().all)
    if (d.channel == channel && plane[d.sample] < 4 * size) near.push_back(std::abs(d.more));
  constexpr std::size_t few = 8;
  constexpr double exact = 0.1;
  return near.size() < few ? std::nullopt : std::optional(median(near) < exact);
}

/// Noise that took values of a channel down to its least one, at which it was clipped, or below 0: what stands beside these scatters so
/// much.  0 where they are marks of what is missing: next to no value lies between them and what stands beside them, or that is exact or,
/// where nothing shows how exact, alike.
/// \param known  whether they are known to be no marks
double noise_beside(TableFacts& facts, std::size_t channel, double least, bool known = false) {
  constexpr double of_half = 1.4826;  // the standard deviation of noise, of its typical size
  constexpr double smooth = 0.35;     // ln of a factor: noise would not reach down so far
  constexpr std::size_t few = 8;      // as many as one between them
  const Table& t = facts.table();
  const Values& plane = t.values[channel];
  const SampleAngles at(t);
  const std::size_t step = t.size() / 60'000 + 1;
  std::vector<double> beside, apart, above;  // apart: how far its neighbours are from each other
  std::size_t lost = 0;
  for (std::size_t i = 0; i < t.size(); i += step) {
    const Mask m = mask(at(i), plane[i]);
    if (m != Mask::valid && m != Mask::negative) continue;
    if (plane[i] > least) {
      above.push_back(plane[i]);
      continue;
    }
    ++lost;
    for (const std::size_t k : {i - 1, i + 1})
      if (k < t.size() && plane[k] > least) beside.push_back(plane[k]);
    if (i > 0 && i + 1 < t.size() && plane[i - 1] > least && plane[i + 1] > least)
      apart.push_back(std::abs(std::log(plane[i - 1] / plane[i + 1])));
  }
  if (beside.empty()) return 0;
  const double typical = median(beside);
  for (double& f : beside) f = std::abs(f - typical);
  const double noise = of_half * median(beside);
  const auto below = [&](double most) {
    return static_cast<std::size_t>(
        std::ranges::count_if(above, [&](double f) { return f < most; }));
  };
  // Noise that was cut at 0 comes down to it: some of it is a tenth as large. Above a mark is none.
  constexpr std::size_t many = 30, next = 50;
  const bool is_far_below = lost >= many && next * below(noise / 10) < lost;
  if (!known && (is_far_below || few * below(typical / 2) < lost ||
                 are_exact_up_to(facts, channel, of_half * typical)
                     .value_or(!apart.empty() && median(apart) < smooth)))
    return 0;
  return noise;
}

/// The least value of channels, where several share it and noise is far larger.
std::optional<SharedEnd> end_in_noise(TableFacts& facts) {
  constexpr std::size_t several = 3;
  constexpr double far = 3;
  const Table& t = facts.table();
  const SampleAngles at(t);
  const std::size_t step = t.size() / 60'000 + 1;
  SharedEnd all{0, 0, 0, {}};
  for (std::size_t c = 0; c < t.values.size(); ++c) {
    SharedEnd e{std::numeric_limits<double>::infinity(), 0, 0, {t.channels[c]}};
    for (std::size_t i = 0; i < t.size(); i += step) {
      const double v = t.values[c][i];
      if (!(v > 0) || mask(at(i), v) != Mask::valid) continue;
      if (v < e.value) e.value = v, e.sharers = 0;
      e.sharers += v == e.value;
      ++e.values;
    }
    if (e.sharers < several || 500 * e.sharers < e.values || is_base(e) ||
        (all.sharers > 0 && e.value != all.value) ||
        !(noise_beside(facts, c, e.value) > far * e.value))
      continue;
    all.value = e.value, all.sharers += e.sharers, all.values += e.values;
    all.channels.push_back(t.channels[c]);
  }
  return all.sharers > 0 ? std::optional(std::move(all)) : std::nullopt;
}

/// Name of a channel's values in a mask.
std::string in_mask(const std::string& channel) {
  return channel == "f" ? channel : "f_" + channel;
}

void warn_of_fill(const Table& t, const Fill& fill, std::vector<std::string>& all) {
  std::vector<std::string> channels, conditions;
  for (const std::size_t c : fill.channels) {
    channels.push_back(t.channels[c]);
    conditions.push_back(
        fmt::format("{0} >= {1} and {0} <= {1}", in_mask(t.channels[c]), fill.value));
  }
  all.push_back(
      fmt::format("{} of {} values of channel {} are {}, unlike those beside them: a mark for "
                  "missing data? (--mask '{}' leaves {} out)",
                  fill.sharers, fill.values, few_of(channels), fill.value, conditions[0],
                  conditions.size() > 1 ? "their samples" : "them"));
}

}  // namespace

std::optional<SharedEnd> clipped_end(TableFacts& facts) {
  const Table& t = facts.table();
  for (auto& e : shared_ends(t, false)) {
    std::vector<double> above;  // a computed base is shared, too
    for (const auto& d : facts.noise_samples().all)
      if (const double v = t.values[d.channel][d.sample]; v > e.value && v < 10 * e.value)
        above.push_back(std::abs(d.more));
    constexpr std::size_t few = 8;
    constexpr double noisy = 0.1;
    if (above.size() >= few && median(above) > noisy && !is_base(e)) return std::move(e);
  }
  return end_in_noise(facts);
}

void warn_of_zeros(TableFacts& facts, std::vector<std::string>& all) {
  constexpr std::size_t most_by_hand = 50;  // numbers that somebody typed may be as short
  constexpr double small_loss = 0.015;      // standard deviation
  Zeros z = zeros_of(facts.table());
  if (z.are_rounded())
    all.push_back(fmt::format(
        "{} of {} values are rounded to one digit or to 0: dark places get upper limits",
        z.none + z.coarse, z.values));
  else if (z.are_clipped())
    all.push_back(fmt::format(
        "{} of {} values are 0, shadow or clipped noise, which biases every metric (leave negative "
        "values in the file)",
        z.none, z.values));
  else if (const double typical = z.lost.empty() ? 0 : median(z.lost);
           z.lost.size() >= most_by_hand && z.different.size() == few_values &&
           typical > small_loss)
    all.push_back(fmt::format(
        "values are rounded to {}, typically {:.2g} % of a value: parameters may be off by more "
        "than their intervals",
        z.rounding.digits > 0
            ? fmt::format("{} significant digit{}", z.rounding.digits,
                          z.rounding.digits > 1 ? "s" : "")
            : fmt::format("steps of {:.3g} 1/sr", z.rounding.absolute * std::sqrt(12)),
        100 * typical));
}

void warn_of_shared_ends(TableFacts& facts, std::vector<std::string>& all) {
  const auto found = [](const SharedEnd& e) {
    return fmt::format("{} of {} values of channel {} are {}", e.sharers, e.values,
                       few_of(e.channels), e.value);
  };
  const Table& t = facts.table();
  const auto full = shared_ends(t, true);
  if (!full.empty()) {
    std::vector<std::string> conditions;
    for (const auto& e : full)
      for (const auto& channel : e.channels)
        conditions.push_back(fmt::format("{} >= {}", in_mask(channel), e.value));
    const bool few = conditions.size() <= most_listed;
    all.push_back(fmt::format(
        "{}, and none is more: a full detector? (--mask {} {})", found(full[0]),
        few ? fmt::format("'{}'", fmt::join(conditions, " or ")) : few_of(conditions, " or "),
        few ? "leaves them out" : "leave them out"));
  }
  if (const auto& e = facts.clipped_end()) {
    all.push_back(found(*e) + ", and none is less: clipped noise? It biases every metric");
    return;
  }
  if (full.empty())
    if (const auto fill = fill_of(t)) warn_of_fill(t, *fill, all);
}

bool is_clipped(TableFacts& facts) {
  return zeros_of(facts.table()).are_clipped() || facts.clipped_end();
}

std::vector<double> lost_below(TableFacts& facts) {
  const Table& t = facts.table();
  const SampleAngles at(t);
  const double rounding = rounding_of(t).absolute, floor = facts.noise_floor();
  const std::size_t step = t.size() / 60'000 + 1;
  const auto& end = facts.clipped_end();
  const auto below = [&](std::size_t c) -> double {
    const Values& plane = t.values[c];
    if (std::ranges::none_of(plane, [](double v) { return v > 0; })) return 0;
    if (floor > 0)  // of a few the typical size is less than noise has
      return std::ranges::any_of(plane, [](double v) { return v < 0; })
                 ? std::max(floor, noise_beside(facts, c, 0))
                 : 0;
    const double least = end && std::ranges::count(end->channels, t.channels[c]) ? end->value : 0;
    std::size_t lost = 0, coarse = 0, values = 0;
    for (std::size_t i = 0; i < t.size(); i += step) {
      values += plane[i] >= 0;
      coarse += plane[i] > 0 && plane[i] < digits_of_one * rounding;
      lost += plane[i] >= 0 && plane[i] <= least && mask(at(i), plane[i]) == Mask::valid;
    }
    if (rounding > 0 && is_coarse(lost, coarse, values)) return std::sqrt(12) * rounding / 2;
    return least > 0 || static_cast<double>(lost) > some_lost * static_cast<double>(values)
               ? noise_beside(facts, c, least, least > 0)
               : 0;
  };
  std::vector<double> lost;
  for (std::size_t c = 0; c < t.values.size(); ++c) lost.push_back(below(c));
  return lost;
}

}  // namespace gonio
