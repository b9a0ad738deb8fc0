#pragma once
/// \file
/// Samples of the texels that a register of lanes holds, and their angles under the tangents and normals that a fit tries.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fitting/map/passes.h"
#include "geometry/direction.h"

namespace gonio {

class TexelRegister {
 public:
  /// Looks into all of these, which outlive it.  \param is_fused  see TexelPasses
  TexelRegister(const TexelTask&,
                const TexelSamples&,
                const Kernels<float>&,
                const LaneKernels&,
                bool is_fused);

  /// Reads the samples of as many texels as there are lanes.  Targets of the log metric are values first: starts are found by relative
  /// differences.
  void gather(std::span<const std::size_t> texels);
  /// Puts the logarithms of the log metric in their place.
  void in_logarithms();

  /// Turns the tangents.  \param deg  [padding]
  void turn(const float* deg);
  /// Tilts the normals by what is added to them along their tangents and bitangents.  \param tilt  [2][padding]
  void tilt(const float* tilt);
  /// Tilts from which a fit may begin: where matt surfaces would send the light that was measured, and where the highlight is.
  /// \param low, high  bounds of the two unknowns   \param matt, highlight  [2][padding]; 0 where lights or values say nothing
  void find_tilts(std::span<const float> low,
                  std::span<const float> high,
                  float* matt,
                  float* highlight) const;

  const LaneSamples& samples() const { return samples_; }
  /// Σ (w target)², [padding]
  float* signal() { return signal_.data(); }
  /// Number of values that are compared.
  float count(std::size_t lane) const { return count_[lane]; }
  /// Number of images in which any channel is compared.
  std::size_t images_with_light(std::size_t lane) const;
  /// Component of the normal as tilted.
  float normal(std::size_t k, std::size_t lane) const;

 private:
  void read_shared();
  /// Whether angles are made for these turns or tilts already; else they are about to be.
  bool is_at(const float* unknowns, std::size_t count);
  bool gather_shared(std::size_t first);
  void gather_lanes(std::span<const std::size_t> texels);
  void put_frames(std::span<const std::size_t> texels);
  void make_angles();
  Direction axis(std::size_t k, std::size_t lane) const;
  Direction of_image(const Column<float>& directions, std::size_t image, std::size_t lane) const;
  /// Light that an image has of a lane, the mean of its channels that are compared, with its directions.
  struct Sent {
    Direction light, half;
    double y;
  };
  std::vector<Sent> sent_by(std::size_t lane) const;
  static Direction matt_normal(const std::vector<Sent>&);
  static Direction highlight_normal(const std::vector<Sent>&);

  const TexelTask& task_;
  const TexelSamples& in_;
  const Kernels<float>& kernels_;
  const LaneKernels& lanes_;
  const std::size_t width_ = lanes_.lanes;

  std::array<Column<float>, 11> angles_;
  std::array<Column<float>, max_channels> target_, weight_;
  Column<float> light_, view_, per_cosine_, slope_;
  Column<float> frame_;    ///< tangents, bitangents and normals, as given
  Column<float> turn_;     ///< see TexelDirections
  std::vector<float> at_;  ///< turns or tilts that angles are of; empty: as given
  /// Coordinates before tangents turn or normals tilt them: x and y, then z, of half vector, light and view.
  std::array<Column<float>, 9> given_;
  Column<float> usable_;  ///< [sample][lane]: 1 above the surface as given
  LaneSamples samples_;
  Column<float> signal_;
  std::array<float, padding> count_{};

  // Samples whose angles are the same for all texels.
  bool same_angles_, is_shared_;
  std::array<Column<float>, 5> shared_angles_;
  Column<float> shared_weight_;
  std::vector<std::size_t> shared_image_;  ///< [sample]: above the surface
  std::vector<std::size_t> rows_;          ///< of the values that are read, channel by channel
  std::vector<float> row_weight_;
  Column<float> read_, read_signal_;                  ///< of the registers that are read at once
  std::size_t chunk_ = static_cast<std::size_t>(-1);  ///< the first texel of those
};

}  // namespace gonio
