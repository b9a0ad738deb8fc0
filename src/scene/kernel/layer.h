#pragma once
/// \file
/// Multiple scattering over columns: the border between plain code and code compiled per instruction set.

#include <array>

#include "brdf/kernel/kernels.h"
#include "scene/kernel/albedo_curve.h"

namespace gonio::scene {

/// Columns that multiple scattering changes.
template <class F>
struct MultipleColumns {
  std::array<const F*, max_channels> lobe;  ///< f of the lobe alone, whose share is made brighter
  std::array<F*, max_channels> f;           ///< f of all; added to
};
/// A loop over three channels.  \param strength  of each channel, as MultipleScattering has it
template <class F>
using MultipleKernel = void (*)(const Block<F>&,
                                const AlbedoCurve<F>&,
                                const std::array<F, max_channels>& strength,
                                const MultipleColumns<F>&);

template <class F>
struct LayerKernels {
  std::string_view instruction_set;
  MultipleKernel<F> turquin, fdez_aguera, kulla_conty;
};

/// Kernels of the set that brdf's kernels are taken from.
template <class F>
const LayerKernels<F>& layer_kernels(std::string_view instruction_set = {});

}  // namespace gonio::scene
