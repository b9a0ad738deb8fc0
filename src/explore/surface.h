#pragma once
/// \file
/// What the page of `gonio explore` asks of a model or a table: curves, slices and albedos as plain numbers.
/// It is compiled twice: as a part of the program, where tests hold it, and as WebAssembly, which the page runs
/// (src/explore/module). No formula stands here.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "brdf/model/evaluate.h"
#include "brdf/model/model.h"
#include "table/table.h"

namespace gonio::explore {

/// Values by channel and sample.
using Channels = std::vector<std::vector<double>>;

/// A grid over θ_h, θ_d and φ_d that any isotropic table can be resampled to: θ_h dense near the peak as MERL has it.
/// \param sizes  of the three axes
Grid page_grid(const std::array<std::size_t, 3>& sizes);

/// A model whose values move, or a table.
class Surface {
 public:
  /// \param settings  NAME=VALUE, apart by blanks; empty for the defaults
  /// \throws Error    wrong_usage of a spec or settings that are none
  Surface(std::string_view spec, std::string_view settings, std::optional<std::size_t> channels);
  explicit Surface(Table);

  /// nullptr of a table
  BoundModel* model() { return std::get_if<BoundModel>(&what_); }
  const BoundModel* model() const { return std::get_if<BoundModel>(&what_); }
  /// nullptr of a model
  const Table* table() const { return std::get_if<Table>(&what_); }
  std::size_t channels() const;
  /// f_r [1/sr]: 0 below the horizon; NaN where a table has no value.
  Channels operator()(std::span<const DirectionPair>) const;
  /// Replaces the model's spec. Parameters of the same name and count keep their values where the new model takes them; a width
  /// becomes both widths of an anisotropic model and back.
  /// \throws Error  wrong_usage; the model is then as it was
  void swap_model(std::string_view spec);
  /// What a page must know to show sliders, as JSON: the model's spec, its name and parts, and each parameter's values, legal range, range of a
  /// slider, whether that is logarithmic, default and meaning. Of a table its channels.
  std::string description() const;

 private:
  std::variant<BoundModel, Table> what_;
};

/// The terms of the catalogue by role, whole models and metals, as JSON.
std::string catalogue_json();

/// f_r in a plane through the normal at the azimuth phi_i [°]: theta_o [°] is positive on the mirror side.
/// As `gonio eval` has it, phi_o is phi_i + 180 there and phi_i on the other side.
Channels cut(const Surface&,
             double theta_i_deg,
             double phi_i_deg,
             std::span<const double> theta_o_deg);

/// f_r over the hemisphere, for the same incident direction: at each zenith angle and, within it, each azimuth from the mirror
/// direction's [°].
Channels lobe(const Surface&,
              double theta_i_deg,
              double phi_i_deg,
              std::span<const double> theta_o_deg,
              std::span<const double> phi_deg);

/// Directions of an image slice: size² cells, θ_h from left to right and θ_d from bottom to top, both over 90°, at one φ_d.
DirectionPair slice_directions(std::size_t size, std::size_t cell, double phi_d_deg);
/// f_r there, row by row from the top; NaN below the horizon.
Channels slice(const Surface&, std::size_t size, double phi_d_deg);

/// Bytes red, green, blue, alpha of values as a display shows them. What is no number is transparent.
/// \param exposure     what values are multiplied with: 1 is white then
/// \param logarithmic  from 1/10,000 of white, black, to white
void paint(const Channels& f, double exposure, bool logarithmic, std::span<unsigned char> rgba);

/// How far a model is from a table, over the table's samples where both are above 0.
struct Difference {
  static constexpr std::size_t cells = 18;  ///< of a map's side: 5° each

  std::size_t values = 0;
  double typical_factor = 1;                    ///< exp of the RMS of ln(model/table)
  double worst_factor = 1;                      ///< mean over the cell that is furthest from 1
  double worst_theta_h_deg, worst_theta_d_deg;  ///< that cell's middle; NaN without values
  std::array<double, cells * cells>
      log_ratio;  ///< mean of ln(model/table) by θ_h from left to right and θ_d from bottom to
                  ///< top; NaN where the table has no sample
};
/// \throws Error  wrong_usage where one is no model, the other no table, or their channels differ
Difference difference(const Surface& model, const Surface& table);
/// A channel's values at the table's samples, measured and as the model has them; NaN where there is none.
std::array<std::vector<double>, 2> measured_and_modelled(const Surface& model,
                                                         const Surface& table,
                                                         std::size_t channel);
/// Bytes of that map as paint() gives them: white where they agree, blue where the model is too dark, orange where it is too
/// bright, full at a factor of 2.
void paint_ratio(const Difference&, std::span<unsigned char> rgba);

/// Share of the light from each zenith angle [°] that the model reflects; with `furnace` what its first lobe alone would reflect
/// with F = 1, so that one less this is the energy lost between facets. NaN where the integral diverges, or there is no lobe.
/// To 1e-3.
/// \throws Error  wrong_usage of a table
Channels albedo(const Surface&, std::span<const double> theta_deg, bool furnace);

}  // namespace gonio::explore
