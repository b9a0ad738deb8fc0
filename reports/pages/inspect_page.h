#pragma once
/// \file
/// The page of one table: what it holds and how far to trust it, before any fit.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "table/cut/cuts.h"
#include "table/health/health.h"

namespace gonio {

/// f_r over theta_h × theta_d, as pictures of MERL's tables show it.
struct SlicePicture {
  double phi_d_deg;                              ///< NaN: the mean over all phi_d
  std::vector<double> theta_h_deg, theta_d_deg;  ///< edges, one more than there are cells
  std::vector<std::vector<double>> value;  ///< [channel][h · cells of theta_d + d], 1/sr; NaN
};

/// A grid, or a list with Table::between, is interpolated at phi_d = 90°, or at the one that it has, at the middles of 90 × 90 cells
/// (of an image slice its own, at most 180 × 180); another list is binned, 45 × 30.
SlicePicture make_slice_picture(const Table&);

/// Counts of masked values, and how far values are from their reciprocal partners', by angle: over theta_h ×
/// theta_d for grids over those, else over theta_i × theta_o.
struct TrustMap {
  std::string x, y;                  ///< names of the angles
  std::vector<double> x_deg, y_deg;  ///< edges
  std::vector<std::size_t> values;   ///< [x · cells of y + y], masked ones included
  std::array<std::vector<std::size_t>, names_of<Mask>.size()> masked;  ///< by Mask
  std::vector<double> reciprocity;  ///< mean of reciprocity_error(); NaN where there is no pair
  std::vector<std::size_t> pairs;   ///< of values
};

TrustMap make_trust_map(const Table&);

/// Content of the page beyond the table's health.
struct InspectPage {
  std::vector<std::string> channels;
  std::vector<Cut> curves;
  SlicePicture picture;
  TrustMap trust;
  std::vector<AlbedoSample> albedo;  ///< of grids by 5°
};

InspectPage make_inspect_page(const Table&);

/// {"health", "channels", "curves", "picture", "trust", "albedo"}: every figure of the page; what is not
/// known is null.
/// \param health_json  the document as JSON text
std::string to_json(const InspectPage&, std::string_view health_json);

/// JSON Schema of that document.
std::string inspect_page_schema();

/// The page itself, HTML.
/// \param next  directions to measure, where they were asked for
std::string inspect_page_html(const Table&,
                              const Health&,
                              const InspectPage&,
                              const std::vector<NextDirection>& next = {});

}  // namespace gonio
