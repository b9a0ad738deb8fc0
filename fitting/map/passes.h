#pragma once
/// \file
/// Passes over the samples of a register of texels: a fused loop where there is one, else the model's terms column by column.

#include <memory>
#include <vector>

#include "fitting/map/task.h"

namespace gonio {

/// Samples of a register of texels as a pass reads them.
struct LaneSamples {
  Block<float> x;       ///< n = samples times lanes
  bool shared = false;  ///< angles and weights are [sample], else [sample][lane]
  std::array<const float*, max_channels> target{}, weight{};
  const float* per_cosine =
      nullptr;  ///< 1/NoL of the given normals [sample][lane]; where normals are refined
};

class TexelPasses {
 public:
  TexelPasses(const TexelTask&, const Kernels<float>&, const LaneKernels&);

  /// Whether samples may be shared.
  bool is_fused() const { return fused_ != nullptr; }
  const UnknownOf& unknowns() const { return all_; }
  const UnknownOf& linear_unknowns() const { return linear_; }

  /// \param values  [slot][padding]
  void normal(const LaneSamples&, const float* values);
  /// Of differences, given D and V.
  void linear(const LaneSamples&, const float* values);
  /// \param inverse  [channel], of the derivatives that unknowns() names
  void worth(const LaneSamples&,
             const float* values,
             const std::array<const float*, max_channels>& inverse);
  /// Sums of the last pass: [channel], of [entry][padding].
  const float* const* sums() const { return sums_.data(); }

 private:
  /// A model's derivatives over texels.
  struct Composed {
    Composed(const TexelTask&, std::vector<bool> free, const Kernels<float>&, TexelTerms<float>);
    std::vector<bool> free;
    TexelTerms<float> terms;
    ModelDerivatives<float> derivatives;
    float *link, *link_slope, *r, *slope;
    std::vector<std::vector<const float*>> j;  ///< [channel]: those of unknowns
    UnknownOf unknown_of;
  };

  void clear(const UnknownOf&);
  void run(TexelPass, const LaneSamples&, const float* values, Link);
  template <class Visit>
  void run(Composed&, const LaneSamples&, const float* values, Link, Visit&&);

  const TexelTask& task_;
  const Kernels<float>& kernels_;
  const LaneKernels& lanes_;
  const FusedTexels* fused_ = nullptr;
  std::vector<const TermUse*> terms_;
  Link link_;
  std::array<Column<float>, 3> cosine_;
  DualColumn<float> cosine_column_,
      held_cosine_;  ///< held: without derivatives, which no term then has, either
  std::unique_ptr<Composed> composed_all_, composed_linear_;
  UnknownOf all_, linear_;
  TexelArguments arguments_;
  Column<float> parameters_, memory_, cost_;
  std::array<float*, max_channels> sums_{};
};

}  // namespace gonio
