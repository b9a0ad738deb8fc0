#include "fitting/map/images.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// How much less is left of a sample that was put right; nothing where that is no cure: more than half is left, or a fifth that is no noise.
std::optional<double> cured(const TexelSample& right,
                            const TexelOptions& o,
                            const std::vector<double>& before,
                            const std::vector<double>& least) {
  const TexelFit fit = fit_sample(right, o);
  const auto seen = compare_residuals(residual_deviations(fit), before, least);
  if (seen.ratio > 0.5 || seen.lower < 0.9 || seen.texels < few_texels) return {};
  if (seen.ratio > 0.2 && shared_residuals(right, fit, o) > 0) return {};
  return seen.ratio;
}

std::vector<float>::iterator values_of(TexelSample& s, std::size_t image) {
  return s.values.begin() + static_cast<std::ptrdiff_t>(image * s.channels * s.texels);
}

void scale_image(TexelSample& s, std::size_t image, double by) {
  std::for_each_n(values_of(s, image), s.channels * s.texels,
                  [&](float& v) { v *= static_cast<float>(by); });
}

/// Logarithms of how bright each image is beside what fits of all say, found in turns.
std::vector<double> brightness_of(TexelSample s, TexelOptions by_ratios) {
  constexpr int most = 24;
  by_ratios.metric = Metric::log;
  const TexelTask task(by_ratios, s.channels);
  std::vector<double> logarithms(s.images);
  for (int turn = 0; turn < most; ++turn) {
    const auto f_r = predicted(s, fit_sample(s, by_ratios), task);
    for (std::size_t i = 0; i < s.images; ++i) {
      std::vector<double> off = differences(s, i, f_r, Metric::log);
      const double middle = off.empty() ? 0 : median_of(std::move(off));
      logarithms[i] += middle;
      scale_image(s, i, std::exp(-middle));
    }
  }
  return logarithms;
}

}  // namespace

std::vector<std::size_t> loudest(const TexelSample& s,
                                 std::vector<std::size_t> images,
                                 const std::vector<double>& f_r) {
  std::vector<double> loud(s.images);
  for (const std::size_t i : images) {
    const auto off = differences(s, i, f_r, Metric::log);
    loud[i] = off.empty() ? 0 : rms_of_all(off);
  }
  std::ranges::stable_sort(images, std::ranges::greater{}, [&](std::size_t i) { return loud[i]; });
  constexpr std::size_t most = 16;
  images.resize(std::min(images.size(), most));
  return images;
}

std::optional<OtherExposure> other_exposure(const TexelSample& s,
                                            const TexelOptions& o,
                                            const TexelFit& given) {
  const auto bright = brightness_of(s, o);
  std::vector<std::size_t> order(s.images);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return bright[i]; });
  // Two groups, cut where the brightness leaps most.
  std::size_t cut = 1;
  const auto leap = [&](std::size_t k) { return bright[order[k]] - bright[order[k - 1]]; };
  for (std::size_t k = 2; k < order.size(); ++k)
    if (leap(k) > leap(cut)) cut = k;
  if (order.size() < 4 || !(leap(cut) > 0.05)) return {};
  const auto middle = [&](std::size_t begin, std::size_t end) {
    std::vector<double> of;
    for (std::size_t k = begin; k < end; ++k) of.push_back(bright[order[k]]);
    return median_of(std::move(of));
  };
  const double darker = middle(0, cut) - middle(cut, order.size());
  const bool are_dark = 2 * cut <= order.size();
  OtherExposure found;
  found.images.assign(are_dark ? order.begin() : order.begin() + static_cast<std::ptrdiff_t>(cut),
                      are_dark ? order.begin() + static_cast<std::ptrdiff_t>(cut) : order.end());
  std::ranges::sort(found.images);
  found.brightness = std::exp(are_dark ? darker : -darker);
  TexelSample right = s;
  for (const std::size_t i : found.images) scale_image(right, i, 1 / found.brightness);
  const auto left = cured(right, o, residual_deviations(given), residual_floor(given));
  if (!left) return {};
  found.ratio = *left;
  return found;
}

std::optional<Exchanged> exchanged_images(const TexelSample& s,
                                          const TexelOptions& o,
                                          const TexelFit& given) {
  const auto before = residual_deviations(given), least = residual_floor(given);
  std::vector<std::size_t> all(s.images);
  std::iota(all.begin(), all.end(), std::size_t{0});
  auto loud = loudest(s, all, predicted(s, given, TexelTask(o, s.channels)));
  std::ranges::sort(loud);
  std::vector<Exchanged> pairs;
  for (std::size_t k = 0; k < loud.size(); ++k)
    for (std::size_t j = 0; j < k; ++j) pairs.push_back({loud[j], loud[k]});
  std::vector<char> cures(pairs.size());
  tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t k) {
    TexelSample other = s;
    std::swap_ranges(
        values_of(other, pairs[k].first),
        values_of(other, pairs[k].first) + static_cast<std::ptrdiff_t>(s.channels * s.texels),
        values_of(other, pairs[k].second));
    const auto left = cured(other, o, before, least);
    cures[k] = left.has_value();
    pairs[k].ratio = left.value_or(1);
  });
  std::optional<Exchanged> best;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (cures[k] && (!best || pairs[k].ratio < best->ratio)) best = pairs[k];
  return best;
}

}  // namespace gonio
