#pragma once
/// \file
/// Fits whose lanes are texels: the border between plain code and code compiled per instruction set.
///
/// A register holds one number of `lanes` texels.  Columns of samples are [sample][lane]; whatever a texel has one of, a value, a
/// sum, a bound, has `padding` numbers, the first `lanes` of which are used.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "brdf/kernel/kernels.h"
#include "brdf/model/derivatives.h"

namespace gonio {

/// Arguments of a pass over a register of texels.
struct TexelArguments : NormalArguments<float> {
  /// Inverse of the bread, of each channel's own derivatives: lower triangle row by row, [entry][padding]; of `worth` alone.
  std::array<const float*, max_channels> inverse{};
  /// 1/NoL of the normals given, [sample][lane]; of tilted ones.
  const float* per_cosine = nullptr;
};
using TexelPass = void (*)(const TexelArguments&);

/// Derivatives that a pass makes, after the residual.  Where normals tilt, D's parameters are followed by the two tilts.
struct TexelColumns {
  std::array<FusedColumn, max_columns - 1> of{};
  std::size_t count = 0;
};

/// A whole model in one loop.  Passes are by whether angles and weights are [sample], the same for all texels, and by Link.
struct FusedTexels {
  FusedIds ids;
  TexelColumns columns, linear_columns;
  std::array<std::array<TexelPass, 2>, 2> normal;
  /// Without derivatives by the parameters of D and V, differences alone.
  std::array<TexelPass, 2> linear;
  /// Sums of the sandwich: of values with leverage h = jᵀ B⁻¹ j those of [r, s]ᵀ[r, s], s = r j/(1 − h), upper triangle row by row;
  /// but beside Σ r² stand Σ (B⁻¹ j)² over values that alone determine something, h near 1.  Below them Σ v of each derivative, v = (B⁻¹ s)² being what a value
  /// adds to the variance, and then Σ v².
  std::array<std::array<TexelPass, 2>, 2> worth;
};

/// The same sums for r and derivatives in columns, added to.
using WorthOfColumns = void (*)(std::size_t n,
                                const float* r,
                                const float* slope,
                                const float* const* j,
                                const float* inverse,
                                float* sums);

/// Directions of samples over texels, and the angles that become of them.
struct TexelDirections {
  std::size_t samples;
  bool shared;  ///< light and view are [3][sample], else [3][sample][lane]
  const float *light, *view;
  const float* frame;  ///< tangent, bitangent and normal: [9][padding]
  const float* turn;   ///< see TexelTurn
  /// [sample][lane]: 1 where light and view are above the surface; elsewhere 0, and all angles are 0.5
  float* above;
  std::array<float*, 11> angles;  ///< [sample][lane], as a Block with its frame has them
};

/// Normals that tilt: n ~ (t, u, 1) in the frame that coordinates are of.
struct TexelTilt {
  std::size_t samples;
  const float* tilt;                 ///< t and u: [2][padding]
  float least;                       ///< cosines of light and view are no less
  std::array<const float*, 9> from;  ///< x, y and z of half vector, light and view
  /// NoL, NoV, NoH, sin²θ_h; then the derivatives of NoH, NoL and NoV by t and by u, in a Block's frame
  std::array<float*, 10> to;
};

/// Tangents that turn about their normals.
struct TexelTurn {
  std::size_t samples;
  const float* turn;  ///< [4][padding]: x' = turn₀ x + turn₁ y, y' = turn₂ x + turn₃ y
  std::array<const float*, 6>
      from;  ///< x and y of half vector, light and view, as in a Block's frame
  std::array<float*, 6> to;
};

/// Rows of values, texel fastest, of which several registers of texels are read at once: their rows lie far apart, and what is near is
/// fetched with them.
struct TexelRows {
  static constexpr std::size_t registers = 4;
  const float* values;  ///< [row][texel]
  std::size_t texels, first;
  std::span<const std::size_t> rows;
  std::span<const float> weight;  ///< of each row read
  float* to;                      ///< [register][row read][lane]
  float* signal;  ///< [register][padding]: Σ (w y)²; NaN where a value is none or negative
};

/// Unknowns of a texel, in the order of elimination: those of one channel alone, channel by channel, then the others.
struct TexelUnknowns {
  std::size_t count = 0, channels = 0;
  std::size_t linear = 0;          ///< the first of them, in which residuals are linear
  std::vector<std::size_t> slot;   ///< of each; value_count and one more: the normal's tilt
  std::vector<std::size_t> first;  ///< of each row of the matrix, its first column that is not 0
  std::vector<float> low, high;
  std::vector<std::uint8_t> by_ratio;  ///< steps are ratios: of widths
  std::vector<float> furthest;         ///< that a step may lead
  float rounding = 0;                  ///< see descend
};
/// Unknown of each of a pass's derivatives, channel by channel; count: it is held.
using UnknownOf = std::vector<std::vector<std::size_t>>;

/// A register of texels on their way: arrays of `padding` numbers a row.
struct TexelState {
  float* x;      ///< [unknown]: best so far
  float* tried;  ///< [unknown]: where to look next; in the end, where it ends
  float* h;      ///< [unknown (unknown + 1)/2 + unknown], lower triangle, by steps
  float* g;      ///< [unknown], by steps
  float* cost;  ///< one row: of x with its linear unknowns at their best; infinite before the first
  float* gain;  ///< one row: how much lower that is than the cost of x
  float* damping;  ///< one row
  float* promise;  ///< one row: what the last step from x promised of that cost
  float* signal;   ///< one row: Σ (w target)², below whose rounding nothing is to be gained
  float* done;     ///< one row: 0 on its way; 1 there; 2 no step leads anywhere
  float* scratch;  ///< room for 3 matrices and 8 vectors
};

struct LaneKernels {
  std::string_view instruction_set;
  std::size_t lanes;
  std::span<const TexelTerms<float>::Derivatives> terms,
      tilted;                                         ///< tilted: nullptr of anisotropic terms
  std::span<const FusedTexels> fused, fused_tilted;   ///< tilted: whatever is shared
  std::array<WorthOfColumns, max_columns + 1> worth;  ///< [k]: k columns, r one of them
  void (*angles)(const TexelDirections&);
  void (*turn)(const TexelTurn&);
  void (*tilt)(const TexelTilt&);
  void (*read)(const TexelRows&);
  /// Sums of a pass at `tried` → the state, and the next `tried`.
  /// \return whether any texel is on its way
  bool (*descend)(const TexelUnknowns&, const UnknownOf&, const float* const* sums, TexelState&);
  /// Sums of a linear pass at `tried`, where some unknowns stand on a grid: the others move to their best, and where that is lower `x`
  /// does, too.
  void (*compare)(const TexelUnknowns&, const UnknownOf&, const float* const* sums, TexelState&);
  /// Parts of the sandwich from the state's matrix, for the channels' derivatives; unknowns at a bound are left out.
  /// \param left_out  [unknown][padding]: 1 at a bound, 2 where nothing depends on it, 3 where others may make up for it
  /// \param judged  whether it is known which are left out; else that is found
  void (*invert)(const TexelUnknowns&, TexelState&, bool judged, float* left_out, float* inverse);
  /// Variances, and how many values of equal parts they are made of.  \param inverse  [unknown][unknown][padding]
  /// \param freedom  3 (Σ v)²/Σ v² − 2, v = c χ²₁ of each value: unbiased but for the ratio; [unknown][padding]
  void (*variances)(const TexelUnknowns&,
                    const UnknownOf&,
                    const float* const* sums,
                    const float* inverse,
                    float* variance,
                    float* freedom);
};

/// Kernels of the set that brdf's kernels are taken from.
const LaneKernels& lane_kernels(std::string_view instruction_set = {});

}  // namespace gonio
