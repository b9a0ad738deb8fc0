#pragma once
/// \file
/// f of a surface over columns of angles.

#include <optional>
#include <span>
#include <vector>

#include "brdf/model/evaluate.h"
#include "scene/kernel/layer.h"
#include "scene/surface/surface.h"

namespace gonio::scene {

/// Kernels that a surface is evaluated with.
template <class F>
struct SurfaceKernels {
  Kernels<F> terms = kernels<F>();
  LayerKernels<F> layers = layer_kernels<F>();

  /// Those without fused models: every surface is composed of its terms, so that times compare like with like.
  static SurfaceKernels composed() {
    SurfaceKernels k;
    k.terms.fused = {};
    return k;
  }
};

/// f of one surface, block by block: the base, then what leaves it after several bounces, then the coat.  What a surface has
/// not costs nothing: no kernel of it is called.  Not shared by threads.
template <class F>
class SurfaceEvaluator {
 public:
  explicit SurfaceEvaluator(const Surface&, const SurfaceKernels<F>& = {});
  /// f of three channels, each as long as x.  Below the horizon the terms are not defined.
  void operator()(const Block<F>& x, std::span<F* const> out);
  /// True of a base that one fused loop computes.
  bool is_fused() const { return base_.is_fused(); }

 private:
  void add_multiple(const Block<F>&, const std::array<F*, max_channels>& out);
  void add_coat(const Block<F>&, const std::array<F*, max_channels>& out);

  SurfaceKernels<F> kernels_;
  Evaluator<F> base_;
  std::optional<Evaluator<F>> lobe_;  ///< first lobe alone, where a share of it is added
  MultipleKernel<F> multiple_ = nullptr;
  AlbedoCurve<F> albedo_{};
  std::array<F, max_channels> strength_{};
  /// Terms D, V, F of the coat, and their parameters by channel.
  struct Coat {
    std::array<std::size_t, 3> term;
    std::array<std::array<std::vector<F>, max_channels>, 3> parameters;
  };
  std::optional<Coat> coat_;
  using Between = typename Evaluator<F>::Between;
  Between scratch_;
};

}  // namespace gonio::scene
