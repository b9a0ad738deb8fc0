#pragma once
/// \file
/// What a table's values show without a model: each found once, when it is first asked for.

#include <cmath>
#include <optional>
#include <vector>

#include "table/health/computed.h"
#include "table/health/directional_albedo.h"
#include "table/health/health.h"
#include "table/health/lost_values.h"
#include "table/health/noise.h"
#include "table/health/peak.h"
#include "table/health/reciprocity.h"

namespace gonio {

/// Facts of one table for all who judge it.  For one thread; keeps a reference.
class TableFacts {
 public:
  explicit TableFacts(const Table& t) : table_(t) {}
  const Table& table() const { return table_; }

  const PeakSearch& peak() {
    return once(peak_, [&] { return find_peak(table_, table_.bins()); });
  }
  const std::optional<Peak>& retro() {
    return once(retro_, [&] {
      auto found = retro_peak(table_, peak().peak);
      if (found && is_noise(*found)) found.reset();
      return found;
    });
  }
  const NoiseSamples& noise_samples() {
    return once(noise_samples_, [&] { return gonio::noise_samples(table_); });
  }
  const Noise& noise() {
    return once(noise_, [&] { return estimate_noise(table_, noise_samples()); });
  }
  const TableAlbedo& albedo() {
    constexpr double step_deg = 15;
    return once(albedo_, [&] { return albedo_of_table(table_, step_deg, peak()); });
  }
  const Reciprocity& reciprocity() {
    return once(reciprocity_, [&] { return gonio::reciprocity(table_); });
  }
  const std::optional<std::size_t>& negative_channel() {
    return once(negative_channel_, [&] { return gonio::negative_channel(*this); });
  }
  double negative_offset() {
    return once(negative_offset_, [&] { return gonio::negative_offset(*this); });
  }
  double noise_floor() {
    return once(noise_floor_, [&] { return gonio::noise_floor(*this); });
  }
  const std::optional<SharedEnd>& clipped_end() {
    return once(clipped_end_, [&] { return gonio::clipped_end(*this); });
  }
  const std::vector<double>& lost_below() {
    return once(lost_below_, [&] { return gonio::lost_below(*this); });
  }
  /// True where the noise of single values makes as high a peak by itself: three standard deviations above its base.
  bool is_noise(const Peak& p) {
    const Noise& n = noise();
    return n.sigma && !n.bound && p.height < p.base * std::exp(3 * *n.sigma);
  }
  /// See one_value_per_angle().
  bool computed() {
    return once(computed_, [&] { return one_value_per_angle(table_); });
  }

 private:
  template <class T, class Find>
  static const T& once(std::optional<T>& kept, Find&& find) {
    if (!kept) kept.emplace(find());
    return *kept;
  }
  const Table& table_;
  std::optional<PeakSearch> peak_;
  std::optional<std::optional<Peak>> retro_;
  std::optional<NoiseSamples> noise_samples_;
  std::optional<Noise> noise_;
  std::optional<TableAlbedo> albedo_;
  std::optional<Reciprocity> reciprocity_;
  std::optional<std::optional<std::size_t>> negative_channel_;
  std::optional<double> negative_offset_, noise_floor_;
  std::optional<std::optional<SharedEnd>> clipped_end_;
  std::optional<std::vector<double>> lost_below_;
  std::optional<bool> computed_;
};

}  // namespace gonio
