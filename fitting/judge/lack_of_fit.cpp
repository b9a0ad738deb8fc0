#include "fitting/judge/lack_of_fit.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include "base/quantile.h"
#include "brdf/model/evaluate.h"
#include "fitting/judge/regression.h"
#include "fitting/judge/scales.h"
#include "fitting/judge/warnings.h"
#include "number/distributions.h"
#include "table/health/lost_values.h"

namespace gonio {
namespace {

constexpr double significant = 0.01;    ///< probability below which a misfit is one
constexpr double worth_telling = 0.01;  ///< of f
constexpr double of_an_interval = 1;    ///< squares beyond noise, of those of noise
constexpr double surely = 0.001;        ///< probability of what no test of the angles finds
constexpr double beside_noise =
    1.5;  ///< squares of what is left over those of neighbours' differences

using namespace misfit;

/// Mean square of what is left, of f.
double mean_square(const Left& left) {
  double sum = 0, n = 0;
  for (const auto& v : left.values)
    if (v.change > 0) {
      const double count = v.root_count * v.root_count;
      sum += count * v.r * v.r / (v.change * v.change), n += count;
    }
  return sum / std::max(n, 1.0);
}
/// That of the noise, at most: half the mean square of what values of a list and those nearest to them differ by beyond the model;
/// or NaN.
double noise_square_of_nearest(const Left& left) {
  constexpr std::size_t asked = 1024;
  std::vector<std::vector<const Value*>> of_channel(left.unknowns.size());
  for (const auto& v : left.values)
    if (v.change > 0) of_channel[v.channel].push_back(&v);
  const auto distance = [&](const Value* a, const Value* b) {
    const auto &x = left.units[a->unit].at, &y = left.units[b->unit].at;
    const double near = dot(x.wi, y.wi) + dot(x.wo, y.wo);
    constexpr double same = 2 - 1e-12;  // a sample twice is one of twice the weight
    return a == b || near > same ? HUGE_VAL : -near;
  };
  double squares = 0, pairs = 0;
  for (const auto& values : of_channel) {
    const std::size_t step = values.size() * of_channel.size() / asked + 1;
    for (std::size_t i = 0; values.size() > 1 && i < values.size(); i += step) {
      const Value* const a = values[i];
      const Value* const b =
          *std::ranges::min_element(values, {}, [&](const Value* v) { return distance(a, v); });
      const double apart = a->whole / a->change - b->whole / b->change;
      const double count = a->root_count * a->root_count;
      squares += count * apart * apart / 2, pairs += count;
    }
  }
  return pairs > 0 ? squares / pairs : std::nan("");
}
/// That of the noise by the median of what neighbours differ by, which no highlight between them moves, or at most what is left of
/// the nearest values of a list differs by, or what the table's own values show without a model; or NaN.
/// \param all  mean square of what is left
double noise_square(const Left& left, TableFacts& facts, double all) {
  std::vector<double> sizes;
  for (const auto& v : left.values)
    if (!std::isnan(v.noise)) sizes.push_back(std::abs(v.noise));
  const double of_lines =
      2 * sizes.size() > left.values.size() ? std::pow(1.4826 * median(sizes), 2) : std::nan("");
  const double of_list = left.turned ? noise_square_of_nearest(left) : std::nan("");
  // The mean, as dark values have more than the typical one; known of some, so only where it is
  // next to nothing of what is left.
  constexpr double little = 0.1;
  double squares = 0, samples = 0;
  for (const auto& d : facts.noise_samples().all) squares += square(d.more), ++samples;
  const double of_table =
      samples > 0 && squares / samples < little * all ? squares / samples : std::nan("");
  return std::fmin(std::fmin(of_lines, of_list), of_table);
}

/// Values of a model at all samples of a table.
std::vector<std::vector<double>> values_at(const Table& t, const BoundModel& b) {
  const SampleAngles at(t, t.bins());
  std::vector<std::vector<double>> all(t.values.size());
  constexpr std::size_t block = 4096;
  std::vector<FrameAngles<double>> angles;
  for (std::size_t first = 0; first < t.size(); first += block) {
    angles.clear();
    for (std::size_t i = first; i < std::min(first + block, t.size()); ++i)
      angles.push_back(at.frame(i));
    const auto f = evaluate(b, angles);
    for (std::size_t c = 0; c < f.size(); ++c)
      all[c].insert(all[c].end(), f[c].begin(), f[c].end());
  }
  return all;
}

/// The table without what the model has within a channel's noise, of which the lower half is lost; but what the table has far above
/// it no noise has lost, whatever the model.
Table without_lost(const Table& t, const BoundModel& b, const std::vector<double>& lost_below) {
  constexpr double noises = 5;  // beyond which logarithms are hardly lowered
  constexpr double far = 1.5;   // times that, which takes no noise
  Table bright = t;
  const auto f = values_at(t, b);
  for (std::size_t c = 0; c < f.size(); ++c)
    for (std::size_t i = 0; i < t.size(); ++i)
      if (const double most = noises * lost_below[c];
          !(f[c][i] > most || t.values[c][i] > far * most))
        bright.values[c][i] = std::nan("");
  return bright;
}

/// The table with uncertainties as large as noise that was found.
Table with_errors(const Table& t, const BoundModel& b, const std::vector<UnevenNoise>& noise) {
  Table stated = t;
  const auto f = values_at(t, b);
  stated.errors.assign(f.size(), Values(t.size()));
  for (std::size_t c = 0; c < f.size(); ++c)
    for (std::size_t i = 0; i < t.size(); ++i)
      stated.errors[c][i] = noise[c].part * std::hypot(f[c][i], noise[c].floor);
  return stated;
}

/// A file of another scale shows so.  A wrong model misses several angles, and within one angle not by one factor.
std::optional<OddAngle> odd_angle(const Left& left, const Sampling& s) {
  constexpr std::size_t few_angles = 5, most_angles = 64, few_values = 8;
  constexpr double least = 0.05;      // of a scale
  constexpr double stands_out = 3;    // times as far as any other angle
  constexpr double of_one_kind = .5;  // of the deviation, by which its values scatter
  constexpr auto incident = static_cast<std::size_t>(SharedAngle::incident);
  const std::size_t angles = left.angles[incident];
  if (angles < few_angles || angles > most_angles) return {};
  std::vector<std::vector<double>> off(angles);  // ln of data over model
  std::vector<std::size_t> sample(angles);
  for (const auto& v : left.values) {
    if (!(v.change > 0)) continue;
    const std::size_t a = left.units[v.unit].angle[incident];
    off[a].push_back(-v.whole / v.change);
    sample[a] = v.sample;
  }
  std::vector<double> scale;
  for (auto& values : off) {
    if (values.size() < few_values) return {};
    scale.push_back(median(values));
  }
  std::vector<double> sorted = scale;
  const double typical = median(sorted);
  for (double& x : scale) x -= typical;
  const auto farther = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto odd = std::ranges::max_element(scale, farther);
  const double deviation = std::exchange(*odd, 0.0);
  const auto a = static_cast<std::size_t>(odd - scale.begin());
  if (std::abs(deviation) < least ||
      std::abs(deviation) < stands_out * std::abs(*std::ranges::max_element(scale, farther)))
    return {};
  for (double& x : off[a]) x = std::abs(x - deviation - typical);
  if (1.4826 * median(off[a]) > of_one_kind * std::abs(deviation)) return {};
  return OddAngle{SampleAngles(s.table()).theta_i(sample[a]) / degree, std::exp(deviation)};
}

/// Regressions that decide, the first of which is of single values where there is one.
struct Tests {
  /// What the residuals are regressed on: smooth functions, which all channels follow alike, one channel against the others, or
  /// harmonics.  A tenth of the chance is left to each of the last two, which seldom say anything.
  enum class Kind { alike, apart, azimuth };
  struct One {
    Regression regression;
    bool clustered;
    Kind kind = Kind::alike;
  };
  std::vector<One> all;
  std::vector<Scales::Scaled> scaled;
  double p_of_scales = 1, of_scales = 0;  ///< probability by chance, and their mean square
  bool are_a_models = false;              ///< these scales are no instrument's

  /// Probability by chance that one of all tests of that kind shows as much.
  double p_of(const One& one) const {
    constexpr double tenth = 10;
    const auto alike = static_cast<double>(std::ranges::count(all, one.kind, &One::kind));
    return std::min(1.0, one.regression.p * alike * (one.kind == Kind::alike ? 1 : tenth));
  }
};
Tests test(const Left& left, bool measured, bool by_angle) {
  Tests t;
  const auto add = [&](const std::vector<SharedAngle>& gains,
                       std::optional<SharedAngle> clustered) {
    const bool is_first = t.all.empty();
    const auto add_one = [&](Tests::Kind kind, std::optional<std::size_t> apart,
                             const std::optional<Harmonics>& harmonics) {
      t.all.push_back(
          {regress(left, gains, clustered, false, apart, harmonics), clustered.has_value(), kind});
    };
    add_one(Tests::Kind::alike, {}, {});
    // A width that depends on the channel leaves residuals that cancel over the channels.
    constexpr std::size_t most_apart = 4;
    if (is_first && left.unknowns.size() > 1 && left.unknowns.size() <= most_apart)
      for (std::size_t c = 0; c < left.unknowns.size(); ++c) add_one(Tests::Kind::apart, c, {});
    for (std::size_t k = 0; left.turned && k < azimuths.size(); ++k) {
      Harmonics harmonics{azimuths[k]};
      add_one(Tests::Kind::azimuth, {}, harmonics);
      if (!t.all.back().regression.limited) continue;
      // A wave that has one order needs few angles.
      for (int order = Harmonics{}.first; order <= Harmonics{}.last; ++order) {
        harmonics.first = harmonics.last = order;
        add_one(Tests::Kind::azimuth, {}, harmonics);
      }
    }
  };
  if (!measured) return add({}, {}), t;
  const auto incident = number_of_angles(left, SharedAngle::incident);
  const bool has_angles =
      number_of_angles(left, SharedAngle::outgoing) > 0;  // else samples are means over several
  std::vector<SharedAngle> gains;
  if (has_angles) {
    Scales found(left, by_angle);
    gains = found.axes();
    t.scaled = std::move(found.all), t.p_of_scales = found.luck;
    for (const auto& s : t.scaled) t.of_scales += s.square;
    t.are_a_models = found.follows_incident || found.between_few || found.of_all;
  }
  if (!t.scaled.empty() || (has_angles && has_room(left, SharedAngle::incident))) {
    add(gains, {});
    for (const auto& s : t.scaled) {
      auto others = gains;
      std::erase(others, s.of);
      others.insert(others.end(), s.coarser.begin(), s.coarser.end());
      if (enough_angles(number_of_angles(left, s.of))) add(others, s.of);
    }
  } else {
    const bool shared = enough_angles(incident) &&
                        (by_angle || 2 * static_cast<double>(incident) < left.directions);
    add({}, shared ? std::optional(SharedAngle::incident) : std::nullopt);
  }
  return t;
}

/// What the tests say of a model.
struct Verdict {
  Misfit misfit;
  double excess = 0;                      ///< squares beyond noise, of those of noise
  const Regression* likeliest = nullptr;  ///< of the tests
  double within = 0;                      ///< mean square of what is left within an angle, of f
};
/// \param more   times as many values as were looked at
/// \param retro  whether values at wo = wi lie alone
Verdict verdict_of(const Tests& tests, const Left& left, double more, bool retro) {
  Verdict v;
  Misfit& m = v.misfit;
  double& excess = v.excess;
  const Regression& first = tests.all[0].regression;
  double least = 1;
  for (const auto& one : tests.all) {
    const auto& [r, clustered, kind] = one;
    const double by_luck = tests.p_of(one);
    if (!r.tested || (kind != Tests::Kind::alike && !(by_luck < significant))) continue;
    if (!v.likeliest || by_luck < least) v.likeliest = &r, least = by_luck;
    m.size = m.tested ? std::max(m.size, r.size) : r.size;
    m.tested = true;
    if (r.noise > 0) excess = std::max(excess, r.excess / r.noise * (clustered ? 1 : more));
  }
  if (m.tested) {
    m.p = least;
    m.told = m.p < significant && m.size > v.likeliest->rounding &&
             (m.size > worth_telling || excess > of_an_interval);
  }
  // Scales that take up everything leave nothing within an angle.
  v.within = first.left > 0 || !tests.scaled.empty() ? first.left : mean_square(left);
  if (first.p_beside_noise < surely && first.beside_noise > beside_noise &&
      first.left > worth_telling * worth_telling) {
    m.told = true;
    m.p = std::min(m.tested ? m.p : 1.0, first.p_beside_noise);
    excess = std::max(excess, 1 - 1 / first.beside_noise);
  }
  if (retro) {  // a highlight that gains of angles may take up
    m.told = true;
    m.p = std::min(m.tested ? m.p : 1.0, surely);
    excess = std::max(excess, 1 - first.left / std::max(mean_square(left), first.left));
  }
  const double most_of_scales = tests.are_a_models ? worth_telling : most_of_a_scale;
  if (tests.p_of_scales < surely && tests.of_scales > most_of_scales * most_of_scales) {
    m.told = true;
    m.p = std::min(m.tested ? m.p : 1.0, tests.p_of_scales);
    excess = std::max(excess, tests.of_scales / mean_square(left));
  }
  return v;
}

/// What a fit would leave that knew the scales: values that they lift or lower pull the fit to where the model bends other than its
/// derivatives say, most where unknowns and a scale do nearly the same, as a metal's two indices.
Left left_beside(
    const Sampling& s, const Problem& p, Fitted f, const Tests& tests, TableFacts& facts) {
  std::vector<SharedAngle> gains;
  for (const auto& scaled : tests.scaled) gains.push_back(scaled.of);
  constexpr int tries = 24;
  constexpr double settled = 1e-4, most_damped = 1e6, towards_bound = 0.9;
  Left left = left_over(s, p, f, facts);
  double damping = 1e-3;
  auto step = step_beside(left, gains);
  for (int k = 0; k < tries && damping < most_damped; ++k) {
    Fitted there = f;
    const auto by = step.damped(damping);
    for (std::size_t u = 0; u < left.slots.size(); ++u) {
      const std::size_t slot = left.slots[u], i = p.free.index(slot);
      double& x = there.model.values[slot];  // at a bound it would be no unknown
      x += std::clamp(by[u], towards_bound * (p.bounds.low[i] - x),
                      towards_bound * (p.bounds.high[i] - x));
    }
    Left at = left_over(s, p, there, facts);
    auto next = step_beside(at, gains);
    if (!(next.squares < step.squares)) {
      damping *= 8;
      continue;
    }
    damping /= 8;
    const bool is_settled = next.squares > (1 - settled) * step.squares;
    f = std::move(there), left = std::move(at), step = std::move(next);
    if (is_settled) break;
  }
  find_variances(left);
  return left;
}

std::vector<LackOfFit::SharedGains> gains_of(const Left& left,
                                             const Problem& p,
                                             const Tests& tests) {
  std::vector<LackOfFit::SharedGains> all;
  for (const auto& [a, square, coarser] : tests.scaled) {
    if (a == SharedAngle::incident) continue;
    const auto angles = static_cast<double>(number_of_angles(left, a));
    const double gain = std::sqrt(square * angles / (angles - 1));
    auto& of = all.emplace_back();
    of.of = shared_angle_names[static_cast<std::size_t>(a)];
    of.freedom = angles - 1;
    of.std_error.resize(p.free.size());
    const auto moved = moved_by_gains(left, a);
    for (std::size_t u = 0; u < moved.size(); ++u)
      of.std_error[p.free.index(left.slots[u])] = gain * moved[u];
  }
  return all;
}

/// Whether each free parameter is the colour of a diffuse term.
/// \param lost  if there, only of channels that lost values: one for all channels where all did
std::vector<bool> are_diffuse(const Problem& p, const std::vector<double>& lost = {}) {
  std::vector<bool> all(p.free.size());
  for (const auto& q : p.start.model.parameters)
    for (std::size_t s = q.first; s < q.first + q.count; ++s)
      if (p.free.mask()[s])
        all[p.free.index(s)] =
            q.name.starts_with("kd") &&
            (lost.empty() || (q.count > 1 ? lost[s - q.first] : std::ranges::min(lost)) > 0);
  return all;
}

LackOfFit lack_of_all(
    const Sampling& s, const Problem& p, const Fitted& f, double samples_used, TableFacts& facts) {
  LackOfFit found;
  Misfit& m = found.misfit;
  bool by_logarithms = s.metric() == Metric::log;
  std::optional<Sampling> logs;
  Fitted judged = f;
  Left left = left_over(s, p, f, facts);
  const auto alone =
      !p.options.robust && p.free.size() > 0 ? outliers(left) : std::optional<Outliers>();
  if (alone) {
    found.outliers = alone;
    if (!alone->retro) {
      FitOptions options = p.options;
      options.robust = true;
      const Problem robust{options, p.start, p.free, p.bounds, p.narrowed, p.offset, p.rounding};
      Sampling beside_bulk = s;
      beside_bulk.set_bulk(bulk_of(robust, s));
      const Fitted beside = compared_by(beside_bulk, robust, scan_samples, f);
      found = lack_of_all(beside_bulk, robust, beside, samples_used, facts);
      found.outliers = alone;
      found.moved_by_outliers = p.free.of(f.model.values);
      const auto without = p.free.of(beside.model.values);
      for (std::size_t i = 0; i < without.size(); ++i) found.moved_by_outliers[i] -= without[i];
      return found;
    }
  }
  if (!s.table().truth) found.odd_angle = odd_angle(left, s);
  std::vector<double> residuals;
  for (const auto& v : left.values) residuals.push_back(v.r);
  const bool relative = find_variances(left);
  if (!by_logarithms && p.free.size() > 0 && !only_rounded(left.values, residuals) && relative &&
      100 * left.without_logarithm <= left.values.size()) {
    // Whose squares weigh such noise unequally the highlight alone determines the parameters, whose
    // errors move faint values by far more than these are wrong: and none of that is a misfit.
    logs.emplace(s.by(Metric::log, p.offset));
    judged = compared_by(*logs, p, scan_samples, f);
    left = left_over(*logs, p, judged, facts);
    find_variances(left);
    by_logarithms = true;
  } else if (s.metric() == Metric::log && !left.stated && !left.robust && p.free.size() > 0) {
    // Logarithms of dark values that noise is large beside are lowered, and weigh as much as
    // others.
    if (const auto noise = uneven_noise(left); noise.size() == s.channels()) {
      FitOptions options = p.options;
      options.metric = Metric::uncertainty;
      const Problem by_noise{options, p.start, p.free, p.bounds, p.narrowed, p.offset, p.rounding};
      const Table stated = with_errors(s.table(), f.model, noise);
      const Sampling weighed = sampling_for(by_noise, stated, stated.bins());
      return lack_of_all(weighed, by_noise, compared_by(weighed, by_noise, scan_samples, f),
                         samples_used, facts);
    }
  }
  const bool by_angle = p.options.intervals == Intervals::by_angle;
  const bool measured =
      by_angle || (!s.table().truth && p.options.intervals != Intervals::independent);
  Tests tests = test(left, measured, by_angle);
  if (std::ranges::all_of(tests.all, [](const auto& t) { return t.regression.rounded; })) {
    m.too_few = left.values.size() <= p.free.size();
    m.note = m.too_few ? "no more values than unknowns"
                       : "what is left is no more than the values' own rounding";
    if (const auto moved = moved_by_rounding(left); !moved.empty()) {
      found.moved_by_rounding.resize(p.free.size());
      for (std::size_t u = 0; u < moved.size(); ++u)
        found.moved_by_rounding[p.free.index(left.slots[u])] = moved[u];
    }
    return found;
  }
  // Of all values, noise is as much less as there are more of them than were looked at; what values
  // share is not.
  const double more = std::max(1.0, samples_used / left.samples);
  Verdict verdict = verdict_of(tests, left, more, alone.has_value());
  if (verdict.misfit.told && !alone && !tests.scaled.empty()) {
    const Left beside = left_beside(logs ? *logs : s, p, judged, tests, facts);
    Tests there = test(beside, measured, by_angle);
    if (Verdict v = verdict_of(there, beside, more, false);
        !v.misfit.told && !there.scaled.empty()) {
      tests = std::move(there);
      verdict = verdict_of(tests, beside, more, false);
    }
  }
  m = verdict.misfit;
  const Regression& first = tests.all[0].regression;
  const Regression* const likeliest = verdict.likeliest;
  const auto [excess, within] = std::pair(verdict.excess, verdict.within);
  if (!m.told) {
    found.gains = gains_of(left, p, tests);
    // A wrong model's residuals may look like a factor per incident angle, but not like one per
    // other angle: so few incident angles cannot tell the two apart.
    const bool few_angles =
        std::ranges::any_of(tests.scaled,
                            [&](const auto& axis) {
                              return axis.of == SharedAngle::incident &&
                                     !enough_angles(number_of_angles(left, axis.of));
                            }) &&
        tests.of_scales > worth_telling * worth_telling;
    const bool maybe = first.p_beside_noise < significant && first.beside_noise > beside_noise &&
                       first.left > worth_telling * worth_telling;
    if (!m.tested || first.limited || few_angles || maybe) {
      m.tested = false;
      m.too_few = true;
      m.note = few_angles || (!first.tested && tests.all[0].clustered)
                   ? "the angles whose values share errors are too few to tell"
                   : "the values are too few to tell";
    }
    return found;
  }
  m.tested = true;
  // What the noise does not explain, as far as it is known; else what the functions and the scales
  // do.
  const double all = mean_square(left), noise = noise_square(left, facts, all);
  const double seen = m.size > 0 ? m.size * m.size : 0;
  const double beyond =
      std::isnan(noise) ? seen + std::max(0.0, all - within) : std::max(seen, all - noise);
  m.size = std::sqrt(std::min(all, beyond));
  m.worst_cell = worst_cell(left);
  if (auto& cell = m.worst_cell) {  // of the data, where it was of f
    const double off = cell->difference;
    cell->difference = by_logarithms ? std::expm1(off) : off / (1 - std::min(off, 0.99));
  }
  if (likeliest) {
    const double most = std::ranges::max(likeliest->follows);
    for (std::size_t g = 1; g < names.size(); ++g)
      if (likeliest->follows[g] > 0.5 * most) m.follows.emplace_back(names[g]);
  }
  found.widening = std::sqrt(1 + 16 * excess);
  return found;
}

}  // namespace

LackOfFit lack_of_fit(
    const Sampling& s, const Problem& p, const Fitted& f, double samples_used, TableFacts& facts) {
  const auto lost =
      s.table().truth || p.options.robust ? std::vector<double>() : facts.lost_below();
  if (!is_any_lost(lost)) return lack_of_all(s, p, f, samples_used, facts);
  // Beside values that lost their lower half to noise the right model misses the others, too.
  const Table bright = without_lost(s.table(), f.model, lost);
  const Sampling sampling = sampling_for(p, bright, bright.bins());
  const auto data = fit_data<double>(sampling, scan_samples);
  constexpr std::size_t few_values = 24, fewest = 8;
  constexpr double far_off = 0.7;  // of ln f: more than noise does to any of them
  LackOfFit found;
  if (data.counts.used < few_values + p.free.size()) {
    found.moved_by_noise = p.free.of(f.model.values);  // which may be noise
    Misfit& m = found.misfit;
    const double left = residual_statistics(f.model, sampling, scan_samples).log_rms;
    m.tested = m.told = data.counts.used >= fewest + p.free.size() && left > far_off;
    m.too_few = !m.told;
    if (m.told)
      m.size = left, m.p = 0;
    else
      m.note = "the values above noise are too few to tell";
    return found;
  }
  const Fitted beside = minimise(p, data, f.model, no_huber);
  found = lack_of_all(sampling, p, beside, samples_used, facts);
  found.moved_by_noise = p.free.of(f.model.values);
  const auto without = p.free.of(beside.model.values);
  const auto diffuse = are_diffuse(p, lost);
  for (std::size_t i = 0; i < without.size(); ++i)  // dark values only limit a diffuse term
    found.moved_by_noise[i] = diffuse[i] ? 0 : found.moved_by_noise[i] - without[i];
  return found;
}

double LackOfFit::moved(std::size_t i) const {
  const auto of = [&](const std::vector<double>& all) { return all.empty() ? 0 : all[i]; };
  return std::hypot(std::hypot(of(moved_by_outliers), of(moved_by_noise), of(moved_by_scale)),
                    of(moved_by_rounding));
}

void find_dark_bias(LackOfFit& found,
                    const Sampling& sampling,
                    const Problem& p,
                    const Fitted& f,
                    const Uncertainty& judged,
                    TableFacts& table) {
  if (p.options.metric != Metric::log || p.options.robust || table.table().truth ||
      found.misfit.told || found.outliers || is_any_lost(table.lost_below()))
    return;
  const Left left = left_over(sampling, p, f, table);
  std::vector<std::pair<double, double>> values;  // f, and ln of data over model
  for (const auto& v : left.values)
    if (v.change > 0) values.emplace_back(v.f, std::clamp(-v.whole / v.change, -1.0, 1.0));
  const std::size_t dark = values.size() / 2;
  if (dark == 0) return;
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(dark));
  double bias = 0;  // mean of a factor less 1, over that of its logarithm
  for (std::size_t i = 0; i < dark; ++i)
    bias += (std::expm1(values[i].second) - values[i].second) / static_cast<double>(dark);
  constexpr double little = 0.2;  // of half an interval
  bool matters = false;
  std::vector<double> moved(p.free.size());
  const auto diffuse = are_diffuse(p);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (!diffuse[i]) continue;
    moved[i] = bias * std::abs(f.model.values[p.free.slots()[i]]);
    matters = matters || moved[i] > little * judged[i].t * judged[i].std_error;
  }
  if (!matters) return;
  constexpr double worth_a_warning = 0.01;  // of a value
  if (bias > worth_a_warning) found.dark_bias = bias;
  found.moved_by_noise = std::move(moved);
}

double widened(double error, double widening, double seen_against) {
  return std::hypot(error, std::sqrt(widening * widening - 1) *
                               (std::isnan(seen_against) ? error : seen_against));
}

double with_gains(const LackOfFit& l, std::size_t i, double error, double& freedom) {
  double variance = error * error, by_freedom = variance * variance / freedom;
  for (const auto& gains : l.gains) {
    const double own = gains.std_error[i] * gains.std_error[i];
    variance += own;
    by_freedom += own * own / gains.freedom;
  }
  if (variance > 0) freedom = variance * variance / by_freedom;
  return std::hypot(std::sqrt(variance), l.moved(i));
}

void widen(Uncertainty& u, const LackOfFit& l, std::span<const double> seen_against) {
  for (std::size_t i = 0; i < u.verdicts.size(); ++i) {
    double& e = u[i].std_error;
    if (std::isnan(e)) continue;
    double wider = widened(e, l.widening, seen_against[i]);
    if (!l.gains.empty() || l.moved(i) != 0) {
      wider = with_gains(l, i, wider, u[i].freedom);
      u[i].t = students_t_quantile(0.975, std::max(1.0, u[i].freedom));
    }
    u[i].variance = e > 0 ? u[i].variance * (wider * wider / (e * e)) : wider * wider;
    e = wider;
  }
}

}  // namespace gonio
