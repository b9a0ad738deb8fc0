#pragma once
/// \file
/// Description of a table's health.

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/describe.h"
#include "table/format/side_file.h"
#include "table/health/health.h"
#include "table/health/next_direction.h"

namespace gonio {

/// A table and its health, as one document.
struct TableHealth {
  const Table& table;
  const Health& health;
  std::optional<std::vector<NextDirection>> next = {};  ///< where a plan was asked for
};

/// Band over the zenith angle, where a band alone is over the value.
struct ZenithBand {
  NoiseBand band;
};

/// Entries by the masks' names, `valid` excepted.
template <class Entry>
std::vector<std::pair<std::string_view, Entry>> by_mask(
    const std::array<Entry, names_of<Mask>.size()>& all) {
  std::vector<std::pair<std::string_view, Entry>> named;
  for (std::size_t m = 1; m < all.size(); ++m) named.emplace_back(names_of<Mask>[m], all[m]);
  return named;
}

template <>
inline constexpr auto description<AlbedoSample> =
    FieldList{Field{"theta_i_deg", "°", &AlbedoSample::theta_i_deg, "angle of incidence"},
              Field{"phi_i_deg", "°", &AlbedoSample::phi_i_deg, "its azimuth"},
              Field{"albedo", per_channel(&AlbedoSample::albedo), "∫ f cos θ_o dω_o"},
              Field{"coverage", &AlbedoSample::coverage,
                    "share of the cosine-weighted hemisphere that valid samples speak for"},
              Field{"error", &AlbedoSample::error,
                    "bound of the integral's error, of what is between samples"}};

template <>
inline constexpr auto description<Peak> = FieldList{
    Field{"half_width_deg", "°", &Peak::half_width_deg, "angle at which the value has halved"},
    Field{"height", "1/sr", &Peak::height, ""},
    Field{"base", "1/sr", &Peak::base, "value beside the highlight"}};

template <>
inline constexpr auto description<Highlight> = FieldList{
    Field{"half_width_deg", "°", &Highlight::half_width_deg, "angle at which the value has halved"},
    Field{"alpha", &Highlight::alpha, "of the GGX lobe of that width"},
    Field{"samples_within", &Highlight::samples_within, "distinct angles within the half width"},
    Field{"resolved", &Highlight::resolved, "whether these are enough"},
    Field{"height", "1/sr", &Highlight::height, ""},
    Field{"base", "1/sr", &Highlight::base, "value beside the highlight"},
    Field{"limit", &Highlight::limit, "why the width is not only the surface's"},
    Field{"in_words", peak_in_words, ""}};

template <>
inline constexpr auto description<NoiseBand> =
    FieldList{Field{"from", "1/sr", &NoiseBand::from, ""}, Field{"to", "1/sr", &NoiseBand::to, ""},
              Field{"values", &NoiseBand::values, "number of values"},
              Field{"sigma", &NoiseBand::sigma, "σ of ln f"}};
template <>
inline constexpr auto description<ZenithBand> =
    FieldList{Field{"from_deg", "°", at(&ZenithBand::band, &NoiseBand::from), ""},
              Field{"to_deg", "°", at(&ZenithBand::band, &NoiseBand::to), ""},
              Field{"values", at(&ZenithBand::band, &NoiseBand::values), "number of values"},
              Field{"sigma", at(&ZenithBand::band, &NoiseBand::sigma), "σ of ln f"}};

template <>
inline constexpr auto description<Noise> =
    FieldList{Field{"sigma", &Noise::sigma, "σ of ln f; null where no line of samples shows it"},
              Field{"bound", &Noise::bound, "whether σ is at most that"},
              Field{"along", &Noise::along, "angle that varies along the lines, or repeats"},
              Field{"channels", per_channel(&Noise::channels), "σ of each channel"},
              Field{"over_zenith",
                    [](const Noise& n) {
                      std::vector<ZenithBand> bands;
                      for (const auto& b : n.over_angle) bands.push_back({b});
                      return bands;
                    },
                    "σ by the larger of the two zenith angles"},
              Field{"over_value", &Noise::over_value, "σ by the value"}};

template <>
inline constexpr auto description<Prospect> =
    FieldList{Field{"of", &Prospect::of, "what the table may determine"},
              Field{"verdict", &Prospect::verdict, ""},
              Field{"because", &Prospect::because, "the figure that says so"}};

template <>
inline constexpr auto description<NextDirection> = FieldList{
    Field{"theta_i", "°", &NextDirection::theta_i_deg, ""},
    Field{"phi_i", "°", &NextDirection::phi_i_deg, ""},
    Field{"theta_o", "°", &NextDirection::theta_o_deg, ""},
    Field{"phi_o", "°", &NextDirection::phi_o_deg, "that of phi_i + 180 is the mirror's"},
    Field{"parameter", &NextDirection::parameter, "least known before"},
    Field{"width_before", &NextDirection::width_before,
          "of its 95 % interval; null where it has none"},
    Field{"width_after", &NextDirection::width_after,
          "forecast for this direction and those above it"},
    Field{"over", &NextDirection::over,
          "what widths are compared over: the value, or a hundredth of its range if that is more"}};

template <>
struct Description<TableHealth> {
  /// Member of the table, or of its health.
  template <class Get>
  struct OfTable {
    Get get;
    constexpr decltype(auto) operator()(const TableHealth& t) const {
      return value_in(get, t.table);
    }
  };
  template <class Get>
  struct OfHealth {
    Get get;
    constexpr decltype(auto) operator()(const TableHealth& t) const {
      return value_in(get, t.health);
    }
  };
  template <class Get>
  static constexpr OfTable<Get> table(Get get) {
    return {get};
  }
  template <class Get>
  static constexpr OfHealth<Get> health(Get get) {
    return {get};
  }

  static constexpr auto fields() {
    return FieldList{
        field("path", table(&Table::path), ""),
        field("format", table(&Table::format), ""),
        field("layout", table(layout_text), ""),
        field("channels", table(&Table::channels), ""),
        field("samples", health(&Health::samples), "pairs of directions"),
        field("values", health(&Health::values), "samples times channels"),
        field("valid", health(&Health::valid), "values that are not masked"),
        field("masked", health([](const Health& h) { return by_mask(h.masked); }),
              "values left out, by reason"),
        field("bins", table([](const Table& t) {
                return t.has_bins() ? name_of(t.grid()->bins) : std::string_view("none");
              }),
              "centre, edge or none"),
        field("bin_sensitivity", health([](const Health& h) {
                return h.peak ? h.peak->bin_sensitivity : std::nullopt;
              }),
              "relative change of the highlight's alpha under the other bin convention"),
        field("noise_floor", "1/sr", health(&Health::noise_floor),
              "noise that negative values betray"),
        field("copied_rows", health(&Health::copied_rows),
              "incident angles that only repeat another"),
        field("copied_columns", health(&Health::copied_columns),
              "outgoing angles that only repeat another"),
        field("largest", "1/sr", health(&Health::largest), "largest value"),
        field("smallest_positive", "1/sr", health(&Health::smallest_positive), ""),
        field("albedo", health(&Health::albedo), "at some angles of incidence"),
        field("albedo_left_out", health(&Health::albedo_left_out),
              "angles of incidence that have none, and why"),
        field("reciprocity_error", health(&Health::reciprocity_error),
              "median |f(wi,wo) − f(wo,wi)| over their mean; null where the layout cannot tell"),
        field("reciprocity_note", health(&Health::reciprocity_note), ""),
        field("noise", health(&Health::noise), ""),
        field("peak", health(&Health::peak), "the specular highlight"),
        field(
            "warnings",
            [](const TableHealth& t) {
              auto all = t.table.warnings;
              all.insert(all.end(), t.health.warnings.begin(), t.health.warnings.end());
              return all;
            },
            "sentences to know before believing the values"),
        field("peak_profiles", health(&Health::peak_profiles),
              "profiles that reach the place where the highlight would be"),
        field("peak_contrast", health(&Health::peak_contrast),
              "median of their height over their base"),
        field("retro", health(&Health::retro), "the highlight around the retro direction"),
        field("prospects", health(&Health::prospects), "what a fit can hope for"),
        field("truth", table(&Table::truth), "what a synthesized table was made from"),
        field("next", if_there(&TableHealth::next),
              "directions to measure, where --plan-next asks for them")};
  }
};

}  // namespace gonio
