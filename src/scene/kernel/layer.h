#pragma once
/// \file
/// Multiple scattering and spectra of metals over columns: the border between plain code and code compiled per instruction set.

#include <array>

#include "brdf/kernel/kernels.h"
#include "scene/kernel/albedo_curve.h"
#include "scene/kernel/spectral.h"

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

/// A loop over three channels, as a Fresnel term's: out_c = base_c + factor F_c or base_c + (factor − base_c) F_c.
template <class F>
using SpectralKernel = void (*)(const Block<F>&, const SpectralMetal<F>&, const ChannelColumns<F>&);

template <class F>
struct LayerKernels {
  std::string_view instruction_set;
  MultipleKernel<F> turquin, fdez_aguera, kulla_conty;
  SpectralKernel<F> spectral;
};

/// Kernels of the set that brdf's kernels are taken from.
template <class F>
const LayerKernels<F>& layer_kernels(std::string_view instruction_set = {});

}  // namespace gonio::scene
