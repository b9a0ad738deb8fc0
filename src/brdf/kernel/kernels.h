#pragma once
/// \file
/// The border between plain code and code compiled per instruction set: structs of function
/// pointers, no templates over Real.  Every loop over samples stands behind it.
///
/// A column is a 64-byte aligned array, padded to a multiple of `padding` with harmless values and
/// weight 0, so that no kernel has a tail.  Kernels may write over what they read, element by
/// element.

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/term/term.h"

namespace gonio {

inline constexpr std::size_t padding = 16;
/// The most columns of one channel's normal equations: the residual and its derivatives.
inline constexpr std::size_t max_columns = 10;
/// The most parameters of a term.
inline constexpr std::size_t max_parameters = 4;
/// The most channels and terms that fused kernels take.
inline constexpr std::size_t max_channels = 3;
inline constexpr std::size_t max_fused_terms = 7;

/// The angles of n samples, as columns.
template <class F>
struct Block {
  const F *nol, *nov, *noh, *voh, *sin2_theta_h;
  std::size_t n;  ///< a multiple of `padding`
  /// XoH, YoH, XoL, YoL, XoV, YoV; null where no term is anisotropic
  std::array<const F*, 6> frame{};

  Block part(std::size_t first, std::size_t count) const {
    Block b{nol + first, nov + first, noh + first, voh + first, sin2_theta_h + first, count, frame};
    for (auto& column : b.frame)
      if (column) column += first;
    return b;
  }
};

/// What a term does to the columns that the terms before it left.
template <class F>
struct Join {
  const F *num, *den, *base;  ///< in; den may be nullptr: 1
  F *out, *out_den;           ///< out (out_den for `begin` of a fraction only)
};

/// The same of a term that channels have each their own of, F or diffuse, for all of them at once:
///
///   out_c = base_c + factor F_c   or   base_c + (factor − base_c) F_c   or   diffuse_c
template <class F>
struct ChannelJoin {
  const F* factor = nullptr;                  ///< of F
  std::array<const F*, max_channels> base{};  ///< of F; nullptr: nothing
  const F* uniform =
      nullptr;           ///< of F, in place of a column: the base of each channel at all samples
  bool coupled = false;  ///< the base lies under this lobe
  std::array<F*, max_channels> out{};
  std::array<const F*, max_channels> parameters{};
};

template <class F>
struct TermKernels {
  using Value = void (*)(const Block<F>&, const F* parameters, const Join<F>&);
  Value begin;  ///< out/out_den = term, still a fraction if it is one
  Value close;  ///< out = num/den · term, divided
  Value add;    ///< out = base + num · term
  /// Of V: out = D V with GGX's D, which most models have, in one loop; else nullptr
  void (*with_ggx)(const Block<F>&, const F* ggx, const F* parameters, F* out);
  /// f of a diffuse term that is the same at all angles, else nullptr
  F (*uniform)(const F* parameters);
  /// by the number of channels, 1 and 3; nullptr for D and V
  using Shade = void (*)(const Block<F>&, const ChannelJoin<F>&);
  std::array<Shade, max_channels + 1> shade;
  /// value and ∂value/∂parameter, one column each
  void (*derivatives)(const Block<F>&, const F* parameters, F* value, F* const* d);
};

/// What a fused model reads and writes.
template <class F>
struct FusedArguments {
  Block<F> x;
  /// [term][channel], in the order of FusedKernel::ids; D and V are the first channel's
  std::array<std::array<const F*, max_channels>, max_fused_terms> parameters;
  std::array<F*, max_channels> out;
};

/// f of a whole model as one loop over all channels, which share D·V.
template <class F>
struct FusedKernel {
  std::size_t diffuse;  ///< how many terms come before the lobes
  std::array<std::string_view, max_fused_terms>
      ids;  ///< diffuse terms, then D, V, F of each lobe; ""
  using Value = void (*)(const FusedArguments<F>&);
  /// by the number of channels; nullptr where there is none
  std::array<Value, max_channels + 1> value;
};

/// How a model's value f is compared with a target t: r = w (link(f + offset) − t).
enum class Link { identity, log };

/// Stored values as a fit compares with them: r = w (link(f + offset) − target).
template <class F>
struct TargetArguments {
  const F* value;            ///< as stored [1/sr]; valid where finite and not negative
  const F *weight, *cosine;  ///< factors of w
  F offset;
  bool relative;               ///< w is divided by value + offset too, and the link's offset is 0
  bool positive;               ///< value + offset must be above 0 to be compared with
  F *y, *target, *out_weight;  ///< −1, 0, 0 where masked
};
/// How many values are what.
struct TargetCounts {
  std::size_t not_finite = 0, negative = 0, valid = 0;
  std::size_t zero = 0;         ///< valid, but not above 0 where they must be
  std::size_t zero_weight = 0;  ///< could be compared with, were it not for their weight
};

/// What is left of each sample over channels: columns that are added to.
template <class F>
struct LeftArguments {
  const F *f, *y, *log_f, *log_y;
  F *values, *squares;        ///< where y ≥ 0: how many, Σ (f − y)²
  F *positive, *log_squares;  ///< where both are above 0: how many, Σ (ln f − ln y)²
};

/// One channel of one block.  Where the weight is not above 0 the sample is masked, whatever else
/// stands there.
template <class F>
struct ResidualArguments {
  const F *value, *slope;  ///< link(f + offset) and its derivative by f
  const F *target, *weight;
  F huber;  ///< residuals beyond it count linearly
  F *r, *weighted_slope;
  F* cost;  ///< lane sums of ρ(r²), `padding` of them
};

/// What the fused normal equations read and add to.
template <class F>
struct NormalArguments {
  Block<F> x;
  std::size_t channels;
  const F *d, *v;                                 ///< parameters of D and of V
  std::array<const F*, max_channels> f, diffuse;  ///< parameters of each channel
  std::array<const F*, max_channels> target, weight;
  F offset;                           ///< the link's
  std::array<F*, max_channels> sums;  ///< of each channel, as `gram` adds them
  F* cost;                            ///< lane sums of r², `padding` of them
};

/// The normal equations of a whole model in one loop, for plain least squares: the same formulas and
/// sums as by column kernels.  Columns: r; the parameters of D and those of V that D has not; those of
/// F; those of the diffuse term.
template <class F>
struct NormalKernel {
  std::string_view diffuse;  ///< empty: none
  std::array<std::string_view, 3> ids;
  std::array<void (*)(const NormalArguments<F>&), 2> pass;  ///< by Link
};

/// Column kernels in F, for one instruction set.
template <class F>
struct Kernels {
  std::string_view instruction_set;
  std::span<const TermKernels<F>> terms;
  std::span<const FusedKernel<F>> fused;
  std::span<const NormalKernel<F>> normal;

  /// The product rule, column by column: out = a·b, a·b + c·d, a + b·c.
  void (*product)(std::size_t n, const F* a, const F* b, F* out);
  void (*product_sum)(std::size_t n, const F* a, const F* b, const F* c, const F* d, F* out);
  void (*add_product)(std::size_t n, const F* a, const F* b, const F* c, F* out);

  /// value ← link(f + offset), slope ← its derivative by f; of the log below 1e-30 that of 1e-30,
  /// and no slope.
  using LinkKernel = void (*)(std::size_t n, const F* f, F offset, F* value, F* slope);
  std::array<LinkKernel, 2> link;

  std::array<void (*)(std::size_t n, const TargetArguments<F>&, TargetCounts&), 2>
      target;  ///< by Link
  void (*left)(std::size_t n, const LeftArguments<F>&);

  using Residual = void (*)(std::size_t n, const ResidualArguments<F>&);
  /// For the normal equations: r ← √ρ' r, weighted_slope ← √ρ' ∂r/∂f.
  Residual residual;
  /// For the sandwich: r ← ρ' r ∂r/∂f (times j: the score), weighted_slope ← ∂r/∂f where not clipped.
  Residual influence;

  /// [r, slope·J]ᵀ[r, slope·J], upper triangle row by row, added lane by lane to
  /// `sums[entry][padding]`, which the caller adds up every few thousand samples; [k]: k columns
  std::array<void (*)(std::size_t n, const F* r, const F* slope, const F* const* j, F* sums),
             max_columns + 1>
      gram;
};

/// The best set that this machine and build have, or the named one.
template <class F>
const Kernels<F>& kernels(std::string_view instruction_set = {});
/// The sets that this machine can run, "scalar" first, best last.
std::vector<std::string> instruction_sets();

}  // namespace gonio
