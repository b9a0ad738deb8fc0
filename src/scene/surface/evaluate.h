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

/// f of one surface, block by block: the base, of a metal's spectrum what is under its lobe and then that, then what leaves it after several bounces, then the coat.  What a surface has
/// not costs nothing: no kernel of it is called.  Not shared by threads.
template <class F>
class SurfaceEvaluator {
 public:
  explicit SurfaceEvaluator(const Surface&, const SurfaceKernels<F>& = {});
  /// f of three channels, each as long as x.  Below the horizon the terms are not defined.
  /// \param off  gets f with two standard errors more of the tabulated light between facets; or nothing
  void operator()(const Block<F>& x, std::span<F* const> out, std::span<F* const> off = {});
  /// True of a base that one fused loop computes.
  bool is_fused() const { return base_ && base_->is_fused(); }

 private:
  using Columns = std::array<F*, max_channels>;
  /// Terms of a lobe's shape D V and their parameters.
  struct Shape {
    std::array<std::size_t, 2> term{};
    std::array<std::vector<F>, 2> parameters;
  };
  static Shape shape_of(const BoundModel&, const Lobe&);
  /// D V, in a scratch column that another call writes over.
  const F* shape(const Block<F>&, const Shape&);
  /// Scratch columns of the first lobe alone.
  Columns alone();
  void add_spectral(const Block<F>&, const Columns& out);
  void add_multiple(const Block<F>&, const Columns& out);
  void add_coat(const Block<F>&, const Columns& out);

  SurfaceKernels<F> kernels_;
  std::optional<Evaluator<F>>
      base_;  ///< without the first lobe, where that is spectral; then none if nothing is left
  std::optional<Evaluator<F>> lobe_;  ///< first lobe alone, where a share of it is added
  struct Spectral {
    Shape shape;
    SpectralMetal<F> metal;
    bool coupled;
    bool alone;  ///< is wanted alone too
  };
  std::optional<Spectral> spectral_;
  MultipleKernel<F> multiple_ = nullptr;
  AlbedoCurve<F> albedo_{};
  std::array<F, max_channels> strength_{};
  std::shared_ptr<const TabulatedLobe> tabulated_;
  struct Coat {
    Shape shape;
    std::size_t fresnel;                                  ///< term
    std::array<std::vector<F>, max_channels> parameters;  ///< of F, by channel
  };
  std::optional<Coat> coat_;
  using Between = typename Evaluator<F>::Between;
  Between scratch_;
};

}  // namespace gonio::scene
