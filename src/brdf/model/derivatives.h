#pragma once
/// \file
/// A composed model with its derivatives, block by block: the product rule over columns.

#include <array>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include "brdf/kernel/kernels.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/mean_block.h"
#include "brdf/model/model.h"

namespace gonio {

/// A value column and its derivative columns, each with the value slot it belongs to.
template <class F>
struct DualColumn {
  const F* value = nullptr;
  std::vector<std::pair<std::size_t, const F*>> d;
};

/// Terms where texels are lanes (TexelsAsLanes): each texel has its own values, [slot][padding].
template <class F>
struct TexelTerms {
  using Derivatives = void (*)(const Block<F>&, const F* parameters, F* value, F* const* d);
  std::span<const Derivatives> derivatives;  ///< [term of the catalogue]
  /// f times this column, which has derivatives by two unknowns more, the tilt of the normal, as every term then has: those of
  /// slots value_count and value_count + 1.
  const DualColumn<F>* cosine = nullptr;
};

/// A model's values and derivatives by the product rule (brdf/term/product.h) over columns.  Writes down
/// once what is to be done to every block (the scratch columns are the same each time, so a step is a
/// kernel with the columns it reads and writes), then does it.  Not shared by threads.
template <class F>
class ModelDerivatives {
 public:
  /// \param free  per value slot: whether its derivative is wanted; others are left out
  /// \param texels  null: one model at all samples
  /// \param means   whether the samples are means over several angles
  ModelDerivatives(const Model&,
                   const std::vector<bool>& free,
                   const Kernels<F>&,
                   const TexelTerms<F>* texels = nullptr,
                   bool means = false);
  ModelDerivatives(const ModelDerivatives&) = delete;

  /// The values, model.value_count of them, of the runs that follow; of texels, whose frames are turned already, [slot][padding].
  void set(std::span<const F> values);

  /// The columns of channel c during visit(c) in run().
  const DualColumn<F>& channel(std::size_t c) const { return channels_[c]; }
  /// A further scratch column for the visitor, distinct from all that are used here.
  F* fresh() { return scratch_[next_++]; }

  /// The channels share scratch columns, so each is visited before the next is made.
  template <class Visit>
  void run(const Block<F>& angles, Visit&& visit) {
    const Block<F> b = turned_(angles);
    for (const auto& s : shared_steps_) s(b);
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      for (const auto& s : channel_steps_[c]) s(b);
      visit(c);
    }
  }
  /// The same of samples that are means, where these are.
  template <class Visit>
  void run(const SampleBlock<F>& samples, Visit&& visit) {
    if (!samples.mean) return run(static_cast<const Block<F>&>(samples), visit);
    find_means(samples);
    for (std::size_t c = 0; c < channels_.size(); ++c) visit(c);
  }

 private:
  void find_means(const SampleBlock<F>&);
  struct Written;
  using Step = std::function<void(const Block<F>&)>;
  DualColumn<F> term(const TermUse&, std::size_t channel);
  DualColumn<F> product(const DualColumn<F>& a, const DualColumn<F>& b);
  /// a + sign·b; sign is a column of ones or of minus ones
  DualColumn<F> sum(const DualColumn<F>& a, const DualColumn<F>& b, const F* sign);
  const F* times(const F* a, const F* b);
  const F* times_sum(const F* a, const F* b, const F* c, const F* d);
  const F* plus(const F* a, const F* b, const F* sign);

  /// A term's parameters and the slots that they are values of.
  struct Gathered {
    Column<F> p;
    std::vector<std::size_t> slots;
  };

  const Model& model_;
  const std::vector<bool>& free_;
  const Kernels<F>& k_;
  const TexelTerms<F>* texels_;
  Scratch<F> scratch_;
  TurnedFrame<F> turned_;
  std::size_t next_ = Scratch<F>::first_free;
  std::deque<Gathered> parameters_;  ///< the steps point into it
  std::vector<Step> shared_steps_;
  std::vector<std::vector<Step>> channel_steps_;
  std::vector<Step>* into_ = &shared_steps_;
  std::vector<DualColumn<F>> channels_;
  /// Where samples are means: what channels_ were at single angles, and the columns of the means, value first, [channel].
  std::vector<DualColumn<F>> at_angles_;
  std::vector<std::vector<Column<F>>> means_;
};

}  // namespace gonio
