#include "table/health/noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "base/quantile.h"
#include "table/health/health.h"
#include "table/health/key_counts.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

namespace gonio {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t enough_values = 200'000;  ///< per family of lines: σ to half a percent
constexpr std::size_t few = 50;
constexpr std::size_t reach = 4;  ///< neighbours on either side

struct Place {
  double x;
  std::size_t sample;
};
using Line = std::vector<Place>;
/// Lines along one angle.
struct Family {
  std::string along;
  std::vector<Line> lines;
};

/// Weights of the neighbours x[0 … 2k] (the middle one excepted) in the polynomial's value at x[k].
std::vector<double> lagrange(const double* x, std::size_t k) {
  std::vector<double> w(2 * k + 1, 1);
  w[k] = 0;
  for (std::size_t i = 0; i <= 2 * k; ++i)
    for (std::size_t j = 0; j <= 2 * k; ++j)
      if (i != k && j != k && j != i) w[i] *= (x[k] - x[j]) / (x[i] - x[j]);
  return w;
}

double difference(const double* x, const double* y, std::size_t k) {
  static const auto even = [] {
    std::array<std::vector<double>, reach + 1> all;
    std::array<double, 2 * reach + 1> steps{};
    std::iota(steps.begin(), steps.end(), 0.0);
    for (std::size_t n = 1; n <= reach; ++n) all[n] = lagrange(steps.data(), n);
    return all;
  }();
  const double step = x[1] - x[0];
  bool is_even = true;
  for (std::size_t i = 2; i <= 2 * k; ++i)
    is_even = is_even && std::abs(x[i] - x[i - 1] - step) <= 1e-6 * step;
  const auto& w = is_even ? even[k] : lagrange(x, k);
  double value = 0, squares = 1;
  for (std::size_t i = 0; i <= 2 * k; ++i) {
    value += w[i] * y[i];
    squares += w[i] * w[i];
  }
  return (y[k] - value) / std::sqrt(squares);
}

/// Number of lines, taken evenly among all, that together hold enough_values.
std::size_t enough_lines(const Table& t, std::size_t lines, std::size_t samples) {
  return std::clamp<std::size_t>(enough_values * lines / (samples * t.values.size()), 1, lines);
}

std::vector<Family> of_grid(const Table& t) {
  const Grid& g = *t.grid();
  std::vector<Family> all;
  const std::array copies{copied_rows(t, 0), copied_rows(t, 1), std::size_t{0}};
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t n = g.axes[a].size;
    if (n < 2 * reach + 1 || copies[a] > 0) continue;  // copies are no measurements
    std::size_t step = 1;
    for (std::size_t b = a + 1; b < 3; ++b) step *= g.axes[b].size;
    const std::size_t lines = g.size() / n, wanted = enough_lines(t, lines, g.size());
    Family f{g.axes[a].name, {}};
    for (std::size_t k = 0; k < wanted; ++k) {
      const std::size_t l = k * lines / wanted, start = l / step * step * n + l % step;
      Line& line = f.lines.emplace_back();
      for (std::size_t i = 0; i < n; ++i)
        line.push_back({static_cast<double>(i), start + i * step});
    }
    all.push_back(std::move(f));
  }
  return all;
}

/// Angles closer than 1e-6° are one.
long rounded(double deg) {
  return std::lround(deg * 1e6);
}

/// Angles that the samples of a line share.
using LineKey = AngleKey<3>;

/// Samples that share a key, in the order of the keys, over what differs in each; those of nine different places or more.
/// \param key    of a sample
/// \param place  of a sample on its line
template <class KeyOf, class PlaceOf>
std::vector<Line> lines_of(std::size_t samples, const KeyOf& key, const PlaceOf& place) {
  constexpr std::size_t least = 2 * reach + 1;
  const Hashes hashes = hashes_of(samples, key);
  std::vector<std::pair<std::uint64_t, std::size_t>> found;
  for (const std::size_t i : KeyCounts(hashes).among(hashes, least))
    found.emplace_back(hashes[i], i);
  tbb::parallel_sort(found);
  std::vector<std::pair<LineKey, Line>> all;
  for (auto from = found.begin(); from != found.end();) {
    const auto to = std::find_if(from, found.end(),
                                 [&](const auto& other) { return other.first != from->first; });
    // Keys of one hash are one key, or nearly always.
    std::map<LineKey, Line> of_hash;
    for (auto last = of_hash.end(); from != to; ++from) {
      const LineKey here = key(from->second);
      if (last == of_hash.end() || last->first != here) last = of_hash.try_emplace(here).first;
      last->second.push_back({place(from->second), from->second});
    }
    for (auto& [line_key, line] : of_hash)
      if (line.size() >= least) all.emplace_back(line_key, std::move(line));
  }
  std::ranges::sort(all, {}, [](const auto& line) { return line.first; });
  std::vector<Line> lines;
  for (auto& members : all) {
    Line& line = lines.emplace_back(std::move(members.second));
    std::ranges::stable_sort(line, {}, &Place::x);
    double before = -std::numeric_limits<double>::infinity();
    std::erase_if(line, [&](const Place& p) {
      const bool repeats = p.x - before < 1e-6;
      before = p.x;
      return repeats;
    });
    if (line.size() < least) lines.pop_back();
  }
  return lines;
}

/// Samples that share all but one angle; a plane of incidence holds both of its sides.
std::vector<Family> of_list(const Table& t) {
  const DirectionList& l = *t.list();
  constexpr long half_turn = 180'000'000;
  const auto turn = [&](std::size_t i) {
    return (rounded(l.phi_o_deg[i]) % (2 * half_turn) + 2 * half_turn) % (2 * half_turn);
  };
  std::array<Family, 3> families{Family{"theta_o", {}}, Family{"phi_o", {}}, Family{"theta_i", {}}};
  tbb::parallel_for(0, 3, [&](int along) {
    if (along == 0)
      families[0].lines = lines_of(
          t.size(),
          [&](std::size_t i) -> LineKey {
            return {rounded(l.theta_i_deg[i]), rounded(l.phi_i_deg[i]), turn(i) % half_turn};
          },
          [&](std::size_t i) {
            return turn(i) >= half_turn ? -l.theta_o_deg[i] : l.theta_o_deg[i];
          });
    else if (along == 1)
      families[1].lines = lines_of(
          t.size(),
          [&](std::size_t i) -> LineKey {
            return {rounded(l.theta_i_deg[i]), rounded(l.phi_i_deg[i]), rounded(l.theta_o_deg[i])};
          },
          [&](std::size_t i) { return l.phi_o_deg[i]; });
    else
      families[2].lines = lines_of(
          t.size(),
          [&](std::size_t i) -> LineKey {
            return {rounded(l.phi_i_deg[i]), rounded(l.theta_o_deg[i]), rounded(l.phi_o_deg[i])};
          },
          [&](std::size_t i) { return l.theta_i_deg[i]; });
  });
  std::vector<Family> all;
  for (Family& f : families) {
    if (f.lines.empty()) continue;
    const std::size_t lines = f.lines.size(), wanted = enough_lines(t, lines, t.size());
    for (std::size_t k = 0; k < wanted; ++k) std::swap(f.lines[k], f.lines[k * lines / wanted]);
    f.lines.resize(wanted);
    all.push_back(std::move(f));
  }
  return all;
}

bool usable(const Table& t, const SampleAngles& at, std::size_t i, std::size_t channel) {
  const double v = t.values[channel][i];
  return v > 0 && mask(at(i), v) == Mask::valid;
}

std::vector<NoiseSample> differences(const Table& t, const SampleAngles& at, const Family& f) {
  std::vector<NoiseSample> all;
  std::vector<double> x, y;
  std::vector<std::size_t> sample;
  for (const Line& line : f.lines)
    for (std::size_t c = 0; c < t.values.size(); ++c) {
      x.clear();
      y.clear();
      sample.clear();
      for (const Place& p : line)
        if (usable(t, at, p.sample, c)) {
          x.push_back(p.x);
          y.push_back(std::log(t.values[c][p.sample]));
          sample.push_back(p.sample);
        }
      for (std::size_t i = reach; i + reach < x.size(); ++i)
        all.push_back({sample[i], c, difference(&x[i - reach + 1], &y[i - reach + 1], reach - 1),
                       difference(&x[i - reach], &y[i - reach], reach)});
    }
  return all;
}

/// Pairs of values at the same four angles.
std::vector<NoiseSample> repeats(const Table& t, const SampleAngles& at) {
  std::vector<NoiseSample> all;
  const auto* l = t.list();
  if (!l) return all;
  const auto key = [&](std::size_t i) -> AngleKey<4> {
    return {rounded(l->theta_i_deg[i]), rounded(l->phi_i_deg[i]), rounded(l->theta_o_deg[i]),
            rounded(l->phi_o_deg[i])};
  };
  const Hashes hashes = hashes_of(t.size(), key);
  std::vector<std::pair<AngleKey<4>, std::size_t>> keys;
  for (const std::size_t i : KeyCounts(hashes).among(hashes, 2)) keys.emplace_back(key(i), i);
  tbb::parallel_sort(keys);
  for (std::size_t k = 1; k < keys.size(); ++k) {
    if (keys[k].first != keys[k - 1].first) continue;
    const std::size_t a = keys[k - 1].second, b = keys[k].second;
    for (std::size_t c = 0; c < t.values.size(); ++c)
      if (usable(t, at, a, c) && usable(t, at, b, c)) {
        const double d = std::log(t.values[c][a] / t.values[c][b]) / std::numbers::sqrt2;
        all.push_back({a, c, d, d});
      }
  }
  return all;
}

double spread(std::vector<double> differences) {
  if (differences.empty()) return nan;
  for (double& d : differences) d = std::abs(d);
  return 1.4826 * median(differences);
}
template <class Which>
double spread(const std::vector<NoiseSample>& all, Which which) {
  std::vector<double> chosen;
  for (const NoiseSample& d : all)
    if (const auto v = which(d); !std::isnan(v)) chosen.push_back(v);
  return spread(std::move(chosen));
}

/// The spread of the differences in each of the bands between edges.
template <class Coordinate>
std::vector<NoiseBand> bands(const std::vector<NoiseSample>& all,
                             const std::vector<double>& edges,
                             Coordinate coordinate) {
  std::vector<std::vector<double>> in(edges.size() - 1);
  for (const NoiseSample& d : all) {
    const auto above = std::ranges::upper_bound(edges, coordinate(d));
    if (above != edges.begin() && above != edges.end())
      in[static_cast<std::size_t>(above - edges.begin() - 1)].push_back(d.more);
  }
  std::vector<NoiseBand> out;
  for (std::size_t b = 0; b < in.size(); ++b)
    if (const std::size_t n = in[b].size(); n >= few)
      out.push_back({edges[b], edges[b + 1], n, spread(std::move(in[b]))});
  return out;
}

}  // namespace

NoiseSamples noise_samples(const Table& t) {
  const SampleAngles at(t);
  NoiseSamples best{"repeats", repeats(t, at)};
  // What repeats to the last bit is written twice, and not measured.
  const auto alike = std::ranges::count(best.all, 0.0, &NoiseSample::more);
  if (best.all.size() >= few && 2 * static_cast<std::size_t>(alike) < best.all.size()) return best;
  best = {};
  double least = std::numeric_limits<double>::infinity();
  for (const Family& f : t.grid() ? of_grid(t) : of_list(t)) {
    auto here = differences(t, at, f);
    if (here.empty()) continue;
    // What does not change along an angle at all was filled in, unless nothing changes anywhere.
    double sigma = spread(here, [](const auto& d) { return d.more; });
    if (sigma == 0) sigma = std::numeric_limits<double>::max();
    if (sigma >= least) continue;
    least = sigma;
    best = {f.along, std::move(here)};
  }
  return best;
}

Noise estimate_noise(const Table& t, const NoiseSamples& samples) {
  const SampleAngles at(t);
  const auto& best = samples.all;
  Noise noise;
  noise.along = samples.along;
  if (best.empty()) return noise;
  noise.sigma = spread(best, [](const auto& d) { return d.more; });
  const double fewer = spread(best, [](const auto& d) { return d.fewer; });
  noise.bound = *noise.sigma < 0.8 * fewer || *noise.sigma < 1e-4;
  std::vector<std::vector<double>> of_channel(t.values.size());
  for (const NoiseSample& d : best)
    if (!std::isnan(d.more)) of_channel[d.channel].push_back(d.more);
  for (auto& here : of_channel) noise.channels.push_back(spread(std::move(here)));
  if (noise.bound) return noise;
  noise.over_angle = bands(best, {0, 15, 30, 45, 60, 75, 90}, [&](const NoiseSample& d) {
    const auto a = at(d.sample);
    return std::acos(std::clamp(std::min(a.nol, a.nov), 0.0, 1.0)) / degree;
  });
  std::vector<double> decades;
  for (int power = -12; power <= 12; ++power) decades.push_back(std::pow(10.0, power));
  noise.over_value =
      bands(best, decades, [&](const NoiseSample& d) { return t.values[d.channel][d.sample]; });
  return noise;
}

bool negatives_follow_neighbours(const Table& t) {
  constexpr double follows = 0.4;
  constexpr std::size_t least_values = 8;
  const SampleAngles at(t);
  double most = nan;
  for (const Family& f : t.grid() ? of_grid(t) : of_list(t)) {
    std::vector<double> sizes, apart;
    for (const Line& line : f.lines)
      for (const auto& plane : t.values)
        for (std::size_t k = 1; k + 1 < line.size(); ++k) {
          const double v = plane[line[k].sample], before = plane[line[k - 1].sample],
                       after = plane[line[k + 1].sample];
          if (!(v < 0) || mask(at(line[k].sample), v) != Mask::negative || !std::isfinite(before) ||
              !std::isfinite(after))
            continue;
          const double part = (line[k].x - line[k - 1].x) / (line[k + 1].x - line[k - 1].x);
          sizes.push_back(-v);
          apart.push_back(std::abs(v - std::lerp(before, after, part)));
        }
    if (sizes.size() < least_values) continue;
    const double ratio = median(apart) / median(sizes);
    if (!(ratio <= most)) most = ratio;
  }
  return most < follows;
}

}  // namespace gonio
