#pragma once
/// \file
/// Incident angles of a table, and which of its samples share one.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "fitting/sample/sampling.h"

namespace gonio {

/// Intervals between given angles, found by the cosine.
class AngleBands {
 public:
  explicit AngleBands(std::vector<double> edges_deg) : edges_deg_(std::move(edges_deg)) {
    for (const double e : edges_deg_) cosine_.push_back(std::cos(e * degree));
    for (std::size_t k = 0; k < near_.size(); ++k)
      near_[k] = onwards(0, std::min(static_cast<double>(k + 1) / cells, 1.0));
  }
  std::size_t size() const { return edges_deg_.size() - 1; }
  double from_deg(std::size_t band) const { return edges_deg_[band]; }
  double to_deg(std::size_t band) const { return edges_deg_[band + 1]; }
  std::size_t operator()(double cosine) const {
    return onwards(near_[static_cast<std::size_t>(std::clamp(cosine, 0.0, 1.0) * cells)], cosine);
  }
  /// True where operator() would give that band.
  bool holds(std::size_t band, double cosine) const {
    return (band == 0 || cosine < cosine_[band]) &&
           (band + 1 == size() || cosine >= cosine_[band + 1]);
  }
  /// Adds `step` times the band of each cosine.
  template <class F>
  void add_to(std::size_t n, const F* cosine, std::int32_t step, std::int32_t* sum) const {
    for (std::size_t band = 1; band < size(); ++band) {
      auto edge = static_cast<F>(cosine_[band]);  // of all F below it, and of no other
      if (static_cast<double>(edge) < cosine_[band]) edge = std::nextafter(edge, F(2));
      for (std::size_t i = 0; i < n; ++i) sum[i] += cosine[i] < edge ? step : 0;
    }
  }

 private:
  static constexpr double cells = 1024;
  std::size_t onwards(std::size_t band, double cosine) const {
    while (band + 1 < size() && cosine < cosine_[band + 1]) ++band;
    return band;
  }
  std::vector<double> edges_deg_, cosine_;
  /// The band of the largest cosine of each cell: none of the cell lies in a band before it.
  std::array<std::size_t, static_cast<std::size_t>(cells) + 1> near_{};
};

/// Numbers of incident angles.  These are told apart as the rows of a θ_i axis that are no copies, to 0.001° in
/// a list, and by whole degrees where those are more than 360 and on a half/difference grid, where every
/// sample has its own.
class IncidentKeys {
 public:
  explicit IncidentKeys(const Sampling&);
  std::size_t count() const { return count_; }
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  /// \param last  that of a neighbour, where the answer is looked for first; or `none`
  std::size_t operator()(std::size_t sample, double nol, std::size_t last = none) const {
    if (grid_ && first_.empty() && last != none && degrees_.holds(last, nol)) return last;
    if (!grid_) return rank_[sample];
    return first_.empty() ? degrees_(nol) : first_[sample / samples_per_angle_];
  }
  /// That of the table's nearest incident angle.
  std::size_t near(double nol) const;

 private:
  const Grid* grid_;
  std::vector<std::size_t> first_;
  std::size_t samples_per_angle_ = 1, count_ = 0;
  std::vector<std::uint32_t> rank_;
  AngleBands degrees_;
  std::vector<std::pair<double, std::size_t>> angles_;  ///< θ_i and number, where they are few
};

}  // namespace gonio
