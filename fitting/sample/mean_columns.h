#pragma once
/// \file
/// Angles over which the samples of a block are means, as columns.

#include <cstdint>
#include <span>
#include <vector>

#include "brdf/model/evaluate.h"
#include "brdf/model/mean_block.h"
#include "integrate/aperture/aperture_angles.h"

namespace gonio {

template <class F>
class MeanColumns {
 public:
  /// \param samples  numbers of the block's samples
  /// \param padded   of the block; what follows the samples is a mean over nothing
  MeanColumns(const ApertureAngles&,
              std::span<const std::size_t> samples,
              std::size_t padded,
              bool frame);
  MeanColumns(const MeanColumns&) = delete;
  const MeanBlock<F>& block() const { return block_; }

 private:
  AngleColumns<F> angles_;
  Column<F> weight_;
  std::vector<std::uint32_t> end_;
  MeanBlock<F> block_;
};

}  // namespace gonio
