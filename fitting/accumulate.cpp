#include "fitting/accumulate.h"

#include <algorithm>
#include <array>

#include "brdf/plan.h"

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

constexpr std::size_t block = Scratch<double>::block;
constexpr std::size_t chunk =
    64 * block;  ///< one task; fixed, so that sums do not depend on threads

/// The sums of one channel of one chunk: lanes during a chunk, added up after it.
struct GramSums {
  static constexpr std::size_t most = max_columns * (max_columns + 1) / 2;
  alignas(64) std::array<double, most * padding> lanes{};

  double entry(std::size_t e) const {
    double sum = 0;
    for (std::size_t i = 0; i < padding; ++i) sum += lanes[e * padding + i];
    return sum;
  }
};

/// A chunk's columns of each channel as the kernels want them, and the loop over its blocks.
class ChunkPass {
 public:
  struct Channel {
    std::vector<std::size_t> free;               ///< index among the free slots, per derivative
    std::array<const double*, max_columns> j{};  ///< ∂f/∂slot
  };

  ChunkPass(const Model& m,
            const FitData& d,
            const FreeSlots& free,
            const Objective& o,
            std::span<const double> values,
            std::size_t number)
      : kernels_(kernels<double>()),
        plan_(m, values, free.mask(), kernels_),
        data_(d),
        objective_(o),
        first_(number * chunk),
        last_(std::min(first_ + chunk, d.angles.padded())),
        r_(plan_.fresh()),
        slope_(plan_.fresh()) {
    for (std::size_t c = 0; c < m.channels; ++c) {
      Channel x;
      for (const auto& [slot, column] : plan_.channel(c).d) {
        x.j[x.free.size()] = column;
        x.free.push_back(free.index(slot));
      }
      channels_.push_back(std::move(x));
    }
  }

  const Kernels<double>& kernel() const { return kernels_; }
  const Channel& channel(std::size_t c) const { return channels_[c]; }
  const double* r() const { return r_; }
  const double* slope() const { return slope_; }
  double cost() const {
    double sum = 0;
    for (const double lane : cost_) sum += lane;
    return sum;
  }

  /// visit(c, first sample, n) with r and slope made by `kernel` for that block and channel
  template <class Visit>
  void run(const std::array<Kernels<double>::Residual, metric_names.size()>& kernel,
           Visit&& visit) {
    for (std::size_t at = first_; at < last_; at += block) {
      const auto b = data_.angles.block().part(at, std::min(block, last_ - at));
      plan_.run(b, [&](std::size_t c) {
        kernel[static_cast<std::size_t>(objective_.metric)](
            b.n, {plan_.channel(c).value, data_.y[c].data() + at, data_.root_weight.data() + at,
                  b.nol, data_.offset, objective_.huber, r_, slope_, cost_.data()});
        visit(c, at, b.n);
      });
    }
  }

 private:
  const Kernels<double>& kernels_;
  Plan<double> plan_;
  const FitData& data_;
  const Objective& objective_;
  std::size_t first_, last_;
  double *r_, *slope_;
  std::vector<Channel> channels_;
  alignas(64) std::array<double, padding> cost_{};
};

std::size_t chunks(const FitData& d) {
  return (d.angles.padded() + chunk - 1) / chunk;
}

/// Adds [r, J]ᵀ[r, J] of one channel, whose row 0 is r, where it belongs.
void scatter(const GramSums& s,
             const std::vector<std::size_t>& free,
             std::size_t n,
             Matrix& h,
             std::vector<double>* g) {
  const std::size_t k = free.size();
  if (g)
    for (std::size_t a = 0; a < k; ++a) (*g)[free[a]] += s.entry(1 + a);
  std::size_t e = k + 1;
  for (std::size_t a = 0; a < k; ++a)
    for (std::size_t b = a; b < k; ++b, ++e) {
      const double v = s.entry(e);
      h[free[a] * n + free[b]] += v;
      if (free[a] != free[b]) h[free[b] * n + free[a]] += v;
    }
}

void add(std::vector<double>& to, const std::vector<double>& from) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += from[i];
}

}  // namespace

FreeSlots::FreeSlots(std::vector<bool> free) : mask_(std::move(free)), index_(mask_.size()) {
  for (std::size_t i = 0; i < mask_.size(); ++i)
    if (mask_[i]) {
      index_[i] = slots_.size();
      slots_.push_back(i);
    }
}

NormalEquations Accumulator::normal_equations(std::span<const double> values) const {
  const std::size_t n = free_.size();
  std::vector<NormalEquations> parts(chunks(data_));
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t number) {
    ChunkPass pass(model_, data_, free_, objective_, values, number);
    std::vector<GramSums> sums(model_.channels);
    pass.run(pass.kernel().residual, [&](std::size_t c, std::size_t, std::size_t count) {
      const auto& x = pass.channel(c);
      pass.kernel().gram[x.free.size() + 1](count, pass.r(), pass.slope(), x.j.data(),
                                            sums[c].lanes.data());
    });
    auto& e = parts[number];
    e = {Matrix(n * n), std::vector<double>(n), pass.cost() / 2};
    for (std::size_t c = 0; c < model_.channels; ++c)
      scatter(sums[c], pass.channel(c).free, n, e.h, &e.g);
  });
  NormalEquations total{Matrix(n * n), std::vector<double>(n), 0};
  for (const auto& e : parts) {  // in the order of the samples
    add(total.h, e.h);
    add(total.g, e.g);
    total.cost += e.cost;
  }
  return total;
}

Sandwich Accumulator::sandwich(std::span<const double> values, bool by_incident_angle) const {
  const std::size_t n = free_.size(), clusters = by_incident_angle ? data_.clusters : 0;
  struct Part {
    Matrix bread, meat;
    std::vector<std::uint32_t> clusters;  ///< those of the chunk's samples, ascending
    std::vector<double> scores;           ///< [of those][free slot]
  };
  std::vector<Part> parts(chunks(data_));
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t number) {
    ChunkPass pass(model_, data_, free_, objective_, values, number);
    std::vector<GramSums> bread(model_.channels), meat(model_.channels);
    auto& part = parts[number];
    part = {Matrix(n * n), Matrix(n * n), {}, {}};
    if (by_incident_angle) {
      const auto from = data_.incident.begin();
      part.clusters.assign(
          from + static_cast<std::ptrdiff_t>(std::min(number * chunk, data_.samples())),
          from + static_cast<std::ptrdiff_t>(std::min((number + 1) * chunk, data_.samples())));
      std::ranges::sort(part.clusters);
      part.clusters.erase(std::unique(part.clusters.begin(), part.clusters.end()),
                          part.clusters.end());
      part.scores.resize(part.clusters.size() * n);
    }
    pass.run(pass.kernel().influence, [&](std::size_t c, std::size_t first, std::size_t count) {
      const auto& x = pass.channel(c);
      const std::size_t k = x.free.size();
      pass.kernel().gram[k + 1](count, pass.r(), pass.slope(), x.j.data(), bread[c].lanes.data());
      if (!by_incident_angle) {  // r holds the score factor ρ' r ∂r/∂f
        pass.kernel().gram[k + 1](count, pass.r(), pass.r(), x.j.data(), meat[c].lanes.data());
        return;
      }
      for (std::size_t i = 0;
           i < std::min(count, data_.samples() - std::min(first, data_.samples())); ++i) {
        const double score = pass.r()[i];
        if (score == 0) continue;  // masked values, whose derivatives may be NaN
        const auto at = std::ranges::lower_bound(part.clusters, data_.incident[first + i]);
        double* const to =
            part.scores.data() + static_cast<std::size_t>(at - part.clusters.begin()) * n;
        for (std::size_t p = 0; p < k; ++p) to[x.free[p]] += score * x.j[p][i];
      }
    });
    for (std::size_t c = 0; c < model_.channels; ++c) {
      scatter(bread[c], pass.channel(c).free, n, part.bread, nullptr);
      if (!by_incident_angle) scatter(meat[c], pass.channel(c).free, n, part.meat, nullptr);
    }
  });

  Sandwich total{Matrix(n * n), Matrix(n * n)};
  std::vector<double> scores(clusters * n);
  for (const auto& p : parts) {
    add(total.bread, p.bread);
    add(total.meat, p.meat);
    for (std::size_t k = 0; k < p.clusters.size(); ++k)
      for (std::size_t a = 0; a < n; ++a) scores[p.clusters[k] * n + a] += p.scores[k * n + a];
  }
  for (std::size_t c = 0; c < clusters; ++c)
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b)
        total.meat[a * n + b] += scores[c * n + a] * scores[c * n + b];
  return total;
}

std::vector<double> Accumulator::residuals(std::span<const double> values) const {
  std::vector<std::vector<double>> by_channel(model_.channels);
  const Objective plain{objective_.metric};
  for (std::size_t number = 0; number < chunks(data_); ++number) {
    ChunkPass pass(model_, data_, free_, plain, values, number);
    pass.run(pass.kernel().residual, [&](std::size_t c, std::size_t first, std::size_t count) {
      for (std::size_t i = 0; i < count; ++i)
        if (data_.root_weight[first + i] > 0 &&
            usable(objective_.metric, data_.y[c][first + i], data_.offset))
          by_channel[c].push_back(pass.r()[i]);
    });
  }
  std::vector<double> all;
  for (const auto& r : by_channel) all.insert(all.end(), r.begin(), r.end());
  return all;
}

}  // namespace gonio
