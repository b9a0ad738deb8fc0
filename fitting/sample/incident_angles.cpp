#include "fitting/sample/incident_angles.h"

#include <utility>

#include "table/health/health.h"

namespace gonio {
namespace {

/// Cut at three quarters: grids tend to have their angles at whole and half degrees.
std::vector<double> whole_degrees() {
  std::vector<double> edges{0};
  for (double e = 0.75; e < 90; ++e) edges.push_back(e);
  edges.push_back(90);
  return edges;
}

}  // namespace

IncidentKeys::IncidentKeys(const Sampling& s)
    : grid_(s.table().grid()), first_(first_of_copies(s.table())), degrees_(whole_degrees()) {
  if (grid_) {
    count_ = first_.empty() ? degrees_.size() : first_.size();
    if (first_.empty()) return;
    samples_per_angle_ = grid_->axes[1].size * grid_->axes[2].size;
    for (std::size_t i = 0; i < first_.size(); ++i)
      angles_.emplace_back(s.angles().theta_i(i * samples_per_angle_), first_[i]);
    return;
  }
  const auto& theta_deg = s.table().list()->theta_i_deg;
  auto angles = incident_angles(*s.table().list());
  count_ = angles.count;
  rank_ = std::move(angles.number);
  constexpr std::size_t many = 360;
  if (count_ > many) {
    for (std::size_t i = 0; i < rank_.size(); ++i)
      rank_[i] = static_cast<std::uint32_t>(degrees_(std::cos(theta_deg[i] * degree)));
    count_ = degrees_.size();
    return;
  }
  std::vector<bool> met(count_);
  for (std::size_t i = 0; i < rank_.size(); ++i)
    if (!met[rank_[i]]) {
      met[rank_[i]] = true;
      angles_.emplace_back(theta_deg[i] * degree, rank_[i]);
    }
  std::ranges::sort(angles_);
}

std::size_t IncidentKeys::near(double nol) const {
  if (angles_.empty()) return degrees_(nol);
  const double theta = std::acos(std::clamp(nol, -1.0, 1.0));
  const auto above =
      std::ranges::lower_bound(angles_, theta, {}, &decltype(angles_)::value_type::first);
  if (above == angles_.begin()) return above->second;
  const auto below = above - 1;
  return above == angles_.end() || theta - below->first < above->first - theta ? below->second
                                                                               : above->second;
}

}  // namespace gonio
