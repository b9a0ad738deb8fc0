#pragma once
/// \file
/// Samples each of which is a mean of f over several angles, as an instrument's are.

#include <algorithm>
#include <cstdint>

#include "brdf/kernel/kernels.h"

namespace gonio {

/// Angles over which samples are means:  sample i is Σ weight_k f(angles_k) over k from end[i − 1] to end[i].
template <class F>
struct MeanBlock {
  Block<F> at;               ///< angles of all samples, one sample's after the other's; padded
  const F* weight;           ///< of each
  const std::uint32_t* end;  ///< of each sample
};

/// The angles of a block's samples; `mean` is null where f at these is what was sampled.
template <class F>
struct SampleBlock : Block<F> {
  const MeanBlock<F>* mean = nullptr;
};

/// Calls part(angles, add) for parts of the angles, each of which add(of_angles, of_samples) takes into sums by sample.
/// \param most  angles at once
template <class F, class Part>
void for_parts(const SampleBlock<F>& b, std::size_t most, Part&& part) {
  const MeanBlock<F>& mean = *b.mean;
  std::size_t sample = 0;
  for (std::size_t first = 0; first < mean.at.n; first += most) {
    const std::size_t n = std::min(most, mean.at.n - first);
    std::size_t after = sample;
    part(mean.at.part(first, n), [&](const F* of_angles, F* of_samples) {
      std::size_t i = sample;
      for (std::size_t k = first; k < first + n && i < b.n;) {
        F sum = 0;
        const std::size_t end = std::min<std::size_t>(mean.end[i], first + n);
        for (; k < end; ++k) sum += mean.weight[k] * of_angles[k - first];
        of_samples[i] += sum;
        if (mean.end[i] > first + n) break;
        ++i;
      }
      after = i;
    });
    sample = after;
  }
}

}  // namespace gonio
