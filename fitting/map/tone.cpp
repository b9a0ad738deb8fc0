#include "fitting/map/tone.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "number/real.h"

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

constexpr std::array<OtherTone, 9> tones{{{2.2, 0, 1},
                                          {1.8, 0, 1},
                                          {1, 0.05, 1},
                                          {1, 0.1, 1},
                                          {1, 0.15, 1},
                                          {1, 0.2, 1},
                                          {1, 0.3, 1},
                                          {1, 0, 0.5},
                                          {1, 0, 0.25}}};

/// Changes all numbers.  With `shadows` they stay, and those below the light of the room become negative: they are left out.
void change(TexelSample& s, const OtherTone& tone) {
  const auto cosine = [&](std::size_t i, std::size_t t) {
    return s.of_light ? 1 : cosine_of(s, i, t);
  };
  for (std::size_t c = 0; c < s.channels; ++c)
    for (std::size_t t = 0; t < s.texels; ++t) {
      const auto value = [&](std::size_t i) -> float& {
        return s.values[(i * s.channels + c) * s.texels + t];
      };
      double sum = 0, count = 0;
      for (std::size_t i = 0; i < s.images; ++i)
        if (const double y = double{value(i)} * cosine(i, t); y >= 0) sum += y, ++count;
      for (std::size_t i = 0; i < s.images; ++i) {
        const double light = double{value(i)} * cosine(i, t),
                     left = light - tone.room * sum / count;
        const double y = tone.shadows && left >= 0 ? light : left;
        value(i) = static_cast<float>(tone.scale * std::pow(pi<double>() * y, tone.power) /
                                      pi<double>() / cosine(i, t));
      }
    }
}

/// rms of texels beside their signal.
std::vector<double> relative(const TexelFit& f) {
  auto all = residual_deviations(f);
  for (std::size_t t = 0; t < all.size(); ++t) all[t] /= double{f.signal[t]};
  return all;
}

}  // namespace

std::optional<OtherTone> other_tone(const TexelSample& s,
                                    const TexelOptions& o,
                                    const TexelFit& before) {
  constexpr double most_left = 0.6;
  const auto left = relative(before);
  const std::vector<double> least(s.texels, 1e-3);
  const auto compare = [&](const OtherTone& tone) {
    ResidualRatio least_left;
    for (const bool sought : {false, true}) {
      TexelOptions as = o;
      as.refine_normals = as.refine_normals || sought;
      try {
        check(as, s.channels);
      } catch (const Error&) {  // of an anisotropic model
        continue;
      }
      TexelSample changed = s;
      change(changed, tone);
      const TexelFit fit = fit_sample(changed, as);
      const auto now = compare_residuals(relative(fit), left, least);
      if (2 * now.texels >= s.texels && now.ratio < least_left.ratio) least_left = now;
    }
    return least_left;
  };
  std::array<ResidualRatio, tones.size()> seen;
  tbb::parallel_for(std::size_t{0}, tones.size(),
                    [&](std::size_t k) { seen[k] = compare(tones[k]); });
  const auto best = std::ranges::min_element(seen, {}, &ResidualRatio::ratio);
  if (best->ratio > most_left || best->lower < 0.8) return std::nullopt;
  OtherTone found = tones[static_cast<std::size_t>(best - seen.begin())];
  found.ratio = best->ratio;
  if (found.room > 0) {
    // To subtract light also leaves out all values that become negative, and that may be the whole
    // cure.
    OtherTone without = found;
    without.shadows = true;
    if (const auto same = compare(without); same.ratio < 2 * found.ratio)
      without.ratio = same.ratio, found = without;
  }
  return found;
}

}  // namespace gonio
