#include "scene/plan/difference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/quantile.h"
#include "image/display.h"
#include "scene/plan/confidence.h"

namespace gonio::scene {
namespace {

double relative(const Rgb& reference, const Rgb& found) {
  double worst = 0;
  for (std::size_t c = 0; c < reference.size(); ++c)
    if (found[c] != reference[c])
      worst = std::max(worst,
                       reference[c] > 0 ? std::abs(found[c] - reference[c]) / reference[c] : 1.0);
  return worst;
}

}  // namespace

std::vector<double> differences(Metric metric,
                                double exposure,
                                std::span<const Rgb> reference,
                                std::span<const Rgb> radiance) {
  std::vector<double> all(reference.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = metric == Metric::relative ? relative(reference[i], radiance[i])
                                        : displayed_difference(radiance[i], reference[i], exposure);
    if (std::isnan(all[i])) all[i] = std::numeric_limits<double>::infinity();
  }
  return all;
}

double Margin::part(double x, double most) {
  return x <= 0 ? 0 : most > 0 ? x / most : std::numeric_limits<double>::infinity();
}

Judgement judge(std::vector<double>& values, const Tolerance& t) {
  Judgement j;
  j.samples = values.size();
  if (values.empty()) return j;
  j.exceeding = static_cast<std::size_t>(
      std::ranges::count_if(values, [&](double v) { return v > t.limit; }));
  j.worst = *std::ranges::max_element(values);
  j.upper = quantile_bound(values, t.quantile, t.confidence);
  j.bound = exceedance_bound(j.exceeding, j.samples, t.confidence);
  j.quantile = quantile(values, t.quantile);
  return j;
}

}  // namespace gonio::scene
