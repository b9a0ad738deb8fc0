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
/// The largest value that no logarithm tells from 0 [1/sr].
inline constexpr long double faintest = 1e-30L;
/// The most columns of one channel's normal equations, the residual and its derivatives, in one loop: of fused models, and of texels.
inline constexpr std::size_t max_columns = 10;
/// The most of them column by column: people's own functions have many parameters.
inline constexpr std::size_t most_columns = 18;
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

/// Columns that a term multiplies or adds to, and those that it writes.
template <class F>
struct ProductColumns {
  const F *num, *den, *base;  ///< in; den may be nullptr: 1
  F *out, *out_den;           ///< out (out_den for `start_product` of a fraction only)
};

/// Columns of all channels, for a term that each of them has its own of, F or diffuse:
///
///   out_c = base_c + factor F_c   or   base_c + (factor − base_c) F_c   or   diffuse_c
template <class F>
struct ChannelColumns {
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
  using Value = void (*)(const Block<F>&, const F* parameters, const ProductColumns<F>&);
  Value start_product;   ///< out/out_den = term, still a fraction if it is one
  Value finish_product;  ///< out = num/den · term, divided
  Value add_product;     ///< out = base + num · term
  /// f of a diffuse term that is the same at all angles, else nullptr
  F (*uniform)(const F* parameters);
  /// by the number of channels, 1 and 3; nullptr for D and V
  using Shade = void (*)(const Block<F>&, const ChannelColumns<F>&);
  std::array<Shade, max_channels + 1> shade;
  /// value and ∂value/∂parameter, one column each; of an anisotropic term last the one by its frame's turn [1/°]
  void (*derivatives)(const Block<F>&, const F* parameters, F* value, F* const* d);
  /// D V of GGX's D and this V in one loop, which most models have; nullptr of other terms than V
  using WithGgx = void (*)(const Block<F>&, const F* ggx, const F* parameters, F* out);
  WithGgx with_ggx = nullptr;
};

/// The terms of a fused model by id, and how many of them come before the lobes: diffuse terms, then D, V,
/// F of each lobe.
struct FusedIds {
  std::size_t diffuse = 0;
  std::array<std::string_view, max_fused_terms> id{};
  bool operator==(const FusedIds&) const = default;
};
/// Parameters of a fused model's terms: [term][channel], in the order of FusedIds; D and V are the first
/// channel's.
template <class F>
using FusedParameters = std::array<std::array<const F*, max_channels>, max_fused_terms>;

/// Columns and parameters that a fused model reads and writes.
template <class F>
struct FusedArguments {
  Block<F> x;
  FusedParameters<F> parameters;
  std::array<F*, max_channels> out;
};

/// f of a whole model as one loop over all channels, which share D·V.
template <class F>
struct FusedKernel {
  FusedIds ids;
  using Value = void (*)(const FusedArguments<F>&);
  /// by the number of channels; nullptr where there is none
  std::array<Value, max_channels + 1> value;
};

/// Link by which a model's value f is compared with a target t: r = w (link(f + offset) − t).
enum class Link { identity, log };

/// Stored values as a fit compares with them: r = w (link(f + offset) − target).
template <class F>
struct TargetArguments {
  const F* value;            ///< as stored [1/sr]; valid where finite and not negative
  const F *weight, *cosine;  ///< factors of w
  F offset;
  bool relative;               ///< w is divided by value + offset too, and the link's offset is 0
  bool positive;               ///< value + offset must be above 1e-30 to be compared with
  F *y, *target, *out_weight;  ///< −1, 0, 0 where masked
};
/// Counts of values by what they are.
struct TargetCounts {
  std::size_t not_finite = 0, negative = 0, valid = 0;
  std::size_t zero = 0;         ///< valid, but not above 1e-30 where they must be
  std::size_t zero_weight = 0;  ///< could be compared with, were it not for their weight
};

/// Residual sums of each sample over its channels: columns that are added to.
template <class F>
struct ResidualSums {
  const F *f, *y, *log_f, *log_y;
  F *values, *squares;        ///< where y ≥ 0: how many, Σ (f − y)²
  F *positive, *log_squares;  ///< where y is above 1e-30 and f above 0: how many, Σ (ln f − ln y)²
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

/// Values of one channel and what each does to the unknowns by its derivatives j: β_r = slope Σ_k beta_rk j_k,
/// and its leverage h = slope² Σ_kl product_kl j_k j_l.  A value that counts as c samples stands for each of
/// them: h/c of it is one's leverage.
template <class F>
struct InfluenceArguments {
  const F *slope, *per_root;         ///< as `influence` leaves it; 1/√c
  const F* const* j;                 ///< [k]
  F* const* seen;                    ///< [k]; j, or 0 where it is masked: `leverage` makes them
  std::span<const F> product, beta;  ///< [k][l]; [r][k]
  F* score;           ///< as `influence` leaves it; `moves` makes it score/(√c (1 − h))
  F* h;               ///< of one of the c: `leverage` makes it
  F *fourth, *moves;  ///< lane sums of c times β⁴ and (β score/slope)⁴ of one, [r][padding]
};

/// Columns and parameters that fused normal equations read, and the sums that they add to.
template <class F>
struct NormalArguments {
  Block<F> x;
  std::size_t channels;
  FusedParameters<F> parameters;
  std::array<const F*, max_channels> target, weight;
  F offset;                           ///< the link's
  std::array<F*, max_channels> sums;  ///< of each channel, as `gram` adds them
  F* cost;                            ///< lane sums of r², `padding` of them
};

/// A parameter of a fused model.
struct FusedColumn {
  std::size_t term;       ///< in the order of FusedIds
  std::size_t parameter;  ///< of the term; one more than it has: the turn of the frame [°]
};

/// The normal equations of a whole model in one loop, for plain least squares: the same formulas and
/// sums as by column kernels.
template <class F>
struct NormalKernel {
  FusedIds ids;
  /// Parameters by which the columns after the residual's are derivatives; D and V of a lobe share those
  /// of one name.
  std::array<FusedColumn, max_columns - 1> columns;
  std::size_t count;                                        ///< of these columns
  std::array<void (*)(const NormalArguments<F>&), 2> pass;  ///< by Link
};

/// Groups of fused models that are compiled together.
enum class FusedGroup { ggx, isotropic, anisotropic, shipped };
template <class F>
struct FusedModels {
  std::span<const FusedKernel<F>> values;
  std::span<const NormalKernel<F>> normal;
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
  void (*residual_sums)(std::size_t n, const ResidualSums<F>&);

  using Residual = void (*)(std::size_t n, const ResidualArguments<F>&);
  /// For the normal equations: r ← √ρ' r, weighted_slope ← √ρ' ∂r/∂f.
  Residual residual;
  /// For the sandwich: r ← ρ' r ∂r/∂f (times j: the score), weighted_slope ← ∂r/∂f where not clipped.
  Residual influence;

  /// [r, slope·J]ᵀ[r, slope·J], upper triangle row by row, added lane by lane to
  /// `sums[entry][padding]`, which the caller adds up every few thousand samples; [k]: k columns
  std::array<void (*)(std::size_t n, const F* r, const F* slope, const F* const* j, F* sums),
             most_columns + 1>
      gram;

  /// Leverages of values; the scores, and sums of fourth powers, that follow; [k]: k derivatives
  using Influence = void (*)(std::size_t n, const InfluenceArguments<F>&);
  std::array<Influence, most_columns> leverage, moves;
};

/// Kernels of the best set that this machine and build have, or of the named one.  The environment
/// variable GONIO_INSTRUCTION_SET names the best that may be taken.
/// \throws Error (wrong usage) if either name is none of this build's
template <class F>
const Kernels<F>& kernels(std::string_view instruction_set = {});
/// Sets that may be taken here, the plainest first, the best last.
std::vector<std::string> instruction_sets();

}  // namespace gonio
