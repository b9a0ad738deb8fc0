#pragma once
/// \file
/// A model at the samples of a table: what every judge of its residuals looks at, block by block.

#include <cstddef>
#include <utility>
#include <vector>

#include "brdf/model/derivatives.h"
#include "fitting/sample/sampling.h"

namespace gonio {

/// A model's values, the metric's link of them and its slope, and derivatives by the free slots, beside the targets and weights of
/// a BlockReader: a residual is weight × (link − target), its derivative weight × slope × derivative.
/// Not shared by threads.
template <class F>
class ModelBlocks {
 public:
  /// \param sampling, model  are looked into   \param free  per value slot: whether its derivative is wanted
  ModelBlocks(const Sampling& sampling, const BoundModel& model, std::vector<bool> free)
      : free_(std::move(free)),
        offset_(static_cast<F>(sampling.link_offset())),
        link_kernel_(kernels<F>().link[static_cast<std::size_t>(link_of(sampling.metric()))]),
        derivatives_(model.model, free_, kernels<F>(), nullptr, sampling.aperture() != nullptr) {
    derivatives_.set(std::vector<F>(model.values.begin(), model.values.end()));
    link_ = derivatives_.fresh();
    slope_ = derivatives_.fresh();
  }
  ModelBlocks(const ModelBlocks&) = delete;

  /// The columns of channel c: values, and derivatives by slots, while it is visited.
  const DualColumn<F>& channel(std::size_t c) const { return derivatives_.channel(c); }
  /// Link of the values, and its slope, while a channel is visited; where the values underflow the slope is 0.
  const F* link() const { return link_; }
  const F* slope() const { return slope_; }
  /// A further column of a block, for the visitor.
  F* fresh() { return derivatives_.fresh(); }

  /// Calls visit(channel) for the channels of the reader's block, one after the other.
  template <class Visit>
  void run(const BlockReader<F>& in, Visit&& visit) {
    const auto samples = in.angles();
    derivatives_.run(samples, [&](std::size_t c) {
      link_kernel_(samples.n, channel(c).value, offset_, link_, slope_);
      visit(c);
    });
  }

 private:
  std::vector<bool> free_;
  F offset_;
  decltype(kernels<F>().link[0]) link_kernel_;
  ModelDerivatives<F> derivatives_;
  F *link_, *slope_;
};

}  // namespace gonio
