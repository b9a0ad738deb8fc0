#include "table/health/reciprocity.h"

#include <algorithm>

#include "base/quantile.h"
#include "base/text.h"
#include "table/health/key_counts.h"

#include <fmt/format.h>
#include <tbb/parallel_sort.h>

namespace gonio {
namespace {

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

Pairs of_in_out(const Grid& g) {
  Pairs pairs;
  const std::size_t n = g.axes[0].size, n_phi = g.axes[2].size;
  if (g.axes[1] != Axis{"theta_o", g.axes[0].spacing, n, g.axes[0].span}) return pairs;
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b)
      for (std::size_t k = 0; k < n_phi; ++k)
        pairs.emplace_back((a * n + b) * n_phi + k, (b * n + a) * n_phi + k);
  return pairs;
}

/// φ_d and φ_d + π, where the axis goes all the way round.
Pairs of_half_difference(const Grid& g) {
  Pairs pairs;
  const Axis& phi = g.axes[2];
  if (!phi.has_bins() || phi.span < 6) return pairs;
  for (std::size_t start = 0; start < g.size(); start += phi.size)
    for (std::size_t k = 0; k < phi.size / 2; ++k)
      pairs.emplace_back(start + k, start + k + phi.size / 2);
  return pairs;
}

Pairs of_list(const DirectionList& l) {
  using Key = AngleKey<4>;  // [1e-6 degrees]
  const auto part = [](double deg) { return std::lround(deg * 1e6); };
  const auto around = [&](double deg) {
    return (part(deg) % 360'000'000 + 360'000'000) % 360'000'000;
  };
  const auto& phi_i = l.phi_i_deg;
  const bool one_azimuth = std::ranges::all_of(phi_i, [&](double p) { return p == phi_i[0]; });
  const auto key = [&](std::size_t i, bool swapped) -> Key {
    const long ti = part(l.theta_i_deg[i]), to = part(l.theta_o_deg[i]);
    if (one_azimuth) {
      // At the normal an azimuth means nothing.
      const double turn = ti == 0 || to == 0 ? 0 : l.phi_o_deg[i] - phi_i[i];
      return swapped ? Key{to, 0, ti, around(-turn)} : Key{ti, 0, to, around(turn)};
    }
    const long of_i = ti == 0 ? 0 : around(phi_i[i]), of_o = to == 0 ? 0 : around(l.phi_o_deg[i]);
    return swapped ? Key{to, of_o, ti, of_i} : Key{ti, of_i, to, of_o};
  };
  const auto hashes = [&](bool swapped) {
    return hashes_of(phi_i.size(), [&](std::size_t i) { return key(i, swapped); });
  };
  const Hashes own = hashes(false), partners = hashes(true);
  std::vector<std::pair<Key, std::size_t>> sorted;
  for (const std::size_t i : KeyCounts(partners).among(own, 1))
    sorted.emplace_back(key(i, false), i);
  tbb::parallel_sort(sorted);
  Pairs pairs;
  for (const std::size_t i : KeyCounts(own).among(partners, 1)) {
    const Key partner = key(i, true);
    const auto found = std::ranges::lower_bound(sorted, std::pair{partner, std::size_t{0}});
    if (found != sorted.end() && found->first == partner) pairs.emplace_back(i, found->second);
  }
  const bool only_own =
      std::ranges::all_of(pairs, [](const auto& p) { return p.first == p.second; });
  return only_own ? Pairs{} : pairs;
}

}  // namespace

Partners for_each_reciprocal(const Table& t, const ReciprocalVisitor& visit) {
  const Grid* g = t.grid();
  Pairs pairs = !g                                       ? of_list(*t.list())
                : g->kind == Grid::Kind::half_difference ? of_half_difference(*g)
                                                         : of_in_out(*g);
  const SampleAngles at(t);
  // Of leaves of unlike sizes only a few find a partner, at equal zenith angles.
  if (t.between && 2 * pairs.size() < t.size()) pairs.clear();
  for (const auto& [i, j] : pairs) {
    const auto here = at(i), there = at(j);
    for (std::size_t c = 0; c < t.values.size(); ++c) {
      const double a = t.values[c][i], b = t.values[c][j];
      if (mask(here, a) == Mask::valid && mask(there, b) == Mask::valid) visit(i, c, a, b);
    }
  }
  if (!pairs.empty()) return Partners::samples;
  if (!t.between) return Partners::none;
  for (std::size_t i = 0; i < t.size(); i += 1 + t.size() * t.values.size() / 100'000)
    for (std::size_t c = 0; c < t.values.size(); ++c) {
      const auto [wi, wo] = at.directions(i);
      const double a = t.values[c][i], b = t.between({wo, wi}, c);
      if (mask(at(i), a) == Mask::valid && b >= 0) visit(i, c, a, b);
    }
  return Partners::between;
}

double reciprocity_error(double a, double b) {
  return a + b > 0 ? std::abs(a - b) / ((a + b) / 2) : 0;
}

Reciprocity reciprocity(const Table& t) {
  std::vector<double> errors;
  const Partners partners =
      for_each_reciprocal(t, [&](std::size_t, std::size_t, double a, double b) {
        errors.push_back(reciprocity_error(a, b));
      });
  if (partners == Partners::none) {
    const bool half = t.grid() && t.grid()->kind == Grid::Kind::half_difference;
    return {{},
            half ? "cannot be checked: the layout holds each reciprocal pair once"
                 : "no sample has a reciprocal partner"};
  }
  if (errors.empty()) return {{}, "no valid value has a valid partner"};
  const auto note = fmt::format("median over {}{}", counted(errors.size(), "value"),
                                partners == Partners::between ? " against f between samples" : "");
  return {median(errors), note};
}

}  // namespace gonio
