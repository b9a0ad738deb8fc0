#pragma once
/// \file
/// A table as the solver reads it: one column entry for each group of samples that a model cannot tell
/// apart, cosines ready.

#include <span>
#include <vector>

#include "fitting/sample/sampling.h"

namespace gonio {

/// Σ w_k² (m − t_k)² over the members of a group is W² (m − T)² + rest with W² = Σ w_k² and
/// T = Σ w_k² t_k / W²: what is minimised stays the same to the last bit but rounding.
template <class F>
struct FitBlock {
  std::size_t n = 0;              ///< groups; a multiple of `padding` with masked ones at the end
  std::size_t angle_columns = 5;  ///< and six more of a frame
  std::size_t columns_count = 0;  ///< those of angles, then target and weight of each channel
  F* columns = nullptr;           ///< n of each; the FitData's
  /// Under an aperture, whose last column is the samples' numbers.
  std::shared_ptr<const MeanColumns<F>> means;

  SampleBlock<F> angles() const;
  F* target(std::size_t channel) const { return columns + (angle_columns + 2 * channel) * n; }
  F* weight(std::size_t channel) const { return target(channel) + n; }
};

template <class F>
struct FitData {
  /// Blocks of a task: a fixed number, so that sums do not depend on threads.
  std::vector<std::vector<FitBlock<F>>> tasks;
  Column<F> memory;  ///< of all blocks
  Link link = Link::log;
  F offset = 0;     ///< the link's
  double rest = 0;  ///< Σ rest: what no model can explain
  std::size_t groups = 0;
  SampleCounts counts;

  std::size_t angle_columns = 5;                   ///< of a block
  std::shared_ptr<const ApertureAngles> aperture;  ///< angles that samples are means over
  /// Columns of a block for that many channels.
  std::size_t columns(std::size_t channels) const {
    return angle_columns + 2 * channels + (aperture ? 1 : 0);
  }

  /// Makes room for that many blocks.
  void reserve(std::size_t tasks, std::size_t blocks, std::size_t channels);
  /// The next block of a task; different tasks may add at the same time.
  FitBlock<F>& add_block(std::size_t task, std::size_t groups);

 private:
  std::size_t columns_count_ = 0, used_ = 0;  ///< used_: blocks
};

/// All groups, or about `most` of them, evenly spread.
template <class F>
FitData<F> fit_data(const Sampling&, std::size_t most = static_cast<std::size_t>(-1));

template <class F>
struct FitLevels {
  FitData<F> all;
  std::vector<FitData<F>> thinned;
};
/// All groups and, read in the same pass, about as many of those with a value as each of `levels`
/// says, evenly spread.  In those a group counts as one value (counts.used) and nothing is known of
/// what it has folded away (rest).
template <class F>
FitLevels<F> fit_levels(const Sampling&, std::span<const std::size_t> levels);

/// Groups picked from fit data, cut into blocks and tasks; what is used is counted.
/// \param rows  [group][column], as the blocks have columns
template <class F>
FitData<F> picked_from(const FitData<F>& all, std::size_t channels, const std::vector<F>& rows);

/// Fit data in double.
template <class F>
FitData<double> in_double(const FitData<F>&);

}  // namespace gonio
