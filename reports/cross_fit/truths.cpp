// What is synthesized: exact Fresnel facets, once met or as often as light meets them.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/whole_loop.h"
#include "integrate/scattering/walk.h"
#include "number/real.h"
#include "reports/cross_fit/cases.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Samples whose light and viewer lie within `reach_deg` of the normal, and above the horizon.
std::vector<std::size_t> within_reach(const Table& t, double reach_deg) {
  const SampleAngles at(t);
  const double least = std::max(std::cos(reach_deg * degree), horizon_cosine);
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (const auto a = at(i); a.nol > least && a.nov > least) out.push_back(i);
  return out;
}

/// The table with values at `kept` alone, where `more` [channel][kept] is added.
Table with(const Table& from,
           std::span<const std::size_t> kept,
           const std::vector<std::vector<double>>& more) {
  Table t = from;
  for (std::size_t c = 0; c < t.values.size(); ++c) {
    std::ranges::fill(t.values[c], std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < kept.size(); ++i)
      t.values[c][kept[i]] = from.values[c][kept[i]] + more[c][i];
  }
  return t;
}

}  // namespace

std::vector<CrossTruth> cross_truths(const CrossFitOptions& o) {
  std::vector<CrossTruth> out{{"GGX", "ggx", "smith_ggx.correlated"},
                              {"GGX, all orders", "ggx", "smith_ggx.correlated", {}, true}};
  for (const double gamma : o.gamma)
    out.push_back(
        {fmt::format("GTR {:g}", gamma), "gtr", "smith_gtr.correlated", {{"gamma", {gamma}}}});
  return out;
}

BoundModel bound_truth(const CrossTruth& t, const FresnelSurface& s, double roughness) {
  auto settings = t.shape;
  settings.push_back({"roughness", {roughness}});
  Setting eta{"eta", {}}, k{"k", {}};
  for (const auto& i : s.index) eta.values.push_back(i.n), k.values.push_back(i.k);
  settings.push_back(eta);
  if (s.kind == "metal") settings.push_back(k);
  return bind_model(model_of_lobe(t.ndf, t.masking, s.kind == "metal" ? "conductor" : "dielectric"),
                    settings, s.channels());
}

std::vector<std::vector<double>> beyond_one_facet(const BoundModel& m,
                                                  std::span<const DirectionPair> pairs,
                                                  std::size_t walks,
                                                  std::uint64_t seed) {
  std::vector<std::vector<double>> out(m.model.channels, std::vector<double>(pairs.size()));
  for_each_whole(pairs.size(), [&](std::size_t i) {
    const auto w = walk_value(m, pairs[i].wi, pairs[i].wo, {(seed << 32U) + i, walks});
    for (std::size_t c = 0; c < out.size(); ++c)
      for (std::size_t n = 1; n < w.order[c].size(); ++n) out[c][i] += w.order[c][n];
  });
  return out;
}

std::vector<CrossSlice> slices_of(const CrossTruth& t,
                                  std::span<const FresnelSurface> surfaces,
                                  double roughness,
                                  const CrossLayout& layout,
                                  const CrossFitOptions& o) {
  SynthOptions synth;
  synth.layout = layout.layout;
  synth.slice = layout.finer * o.bins;
  FresnelSurface all = surfaces.front();
  all.index.clear();
  std::vector<Table> once;
  for (const auto& s : surfaces) {
    once.push_back(synthesize(bound_truth(t, s, roughness), synth));
    all.index.insert(all.index.end(), s.index.begin(), s.index.end());
  }
  const auto kept = within_reach(once.front(), layout.reach_deg);
  std::vector<std::vector<double>> first, second;
  if (t.multiple) {
    const SampleAngles at(once.front());
    std::vector<DirectionPair> pairs;
    for (const std::size_t i : kept) pairs.push_back(at.directions(i));
    const auto model = bound_truth(t, all, roughness);
    const double more_walks = 1 / std::max(square(roughness), 1.0 / 16);
    const auto half = static_cast<std::size_t>(static_cast<double>(o.walks) * more_walks / 2);
    first = beyond_one_facet(model, pairs, half, 1);
    second = beyond_one_facet(model, pairs, half, 2);
  }

  std::vector<CrossSlice> out;
  std::size_t channel = 0;  // of all surfaces
  for (const auto& table : once) {
    const std::size_t channels = table.values.size();
    std::vector<std::vector<double>> more(channels, std::vector<double>(kept.size())), from_first;
    double sum = 0;
    for (std::size_t c = 0; t.multiple && c < channels; ++c, ++channel) {
      from_first.push_back(first[channel]);
      for (std::size_t i = 0; i < kept.size(); ++i) {
        more[c][i] = (first[channel][i] + second[channel][i]) / 2;
        const double error = (first[channel][i] - second[channel][i]) / 2;
        sum += square(error / (table.values[c][kept[i]] + more[c][i]));
      }
    }
    out.push_back({with(table, kept, more)});
    if (!t.multiple) continue;
    out.back().half = with(table, kept, from_first);
    out.back().log_error = std::sqrt(sum / static_cast<double>(channels * kept.size()));
  }
  return out;
}

}  // namespace gonio
