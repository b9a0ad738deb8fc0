#pragma once
/// \file
/// The page of one fit: its parameters and how well they are known, the table and how far to trust
/// it, data against model, and where the model is off.

#include <string>
#include <string_view>
#include <vector>

#include "fitting/result/document.h"
#include "reports/pages/residual_map.h"
#include "reports/pages/spheres.h"
#include "table/cut/cuts.h"

namespace gonio {

/// Content of the page beyond fit.json and the table's health.
struct FitPage {
  std::vector<std::string> channels;
  std::vector<Cut> curves;
  ResidualMap residual_map;
  Spheres spheres;
  bool has_lobe = true;  ///< the model that is drawn
};

FitPage make_fit_page(const Table&, const BoundModel& fitted);

/// {"fit": …, "health": …, "channels", "curves", "residual_map", "spheres"}: every figure of the page; what is
/// not known is null.
/// \param fit_json, health_json  the documents as JSON text
std::string to_json(const FitPage&, std::string_view fit_json, std::string_view health_json);

/// JSON Schema of that document.
std::string fit_page_schema();

/// The page itself, HTML.
/// \param document  file of the fit's document; "": none is known
std::string fit_page_html(const FitDocument&,
                          const Table&,
                          const Health&,
                          const FitPage&,
                          const std::string& document = "");

}  // namespace gonio
