#pragma once
/// \file
/// Sections of a fit's page that judge the fit, and what they share with its warnings.

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "fitting/result/document.h"
#include "reports/page/section.h"
#include "reports/pages/residual_map.h"
#include "reports/picture/figure.h"

namespace gonio::fit_sections {

inline bool known(double x) {
  return std::isfinite(x);
}

/// Two parameters and their correlation.
struct Tied {
  std::string a, b;
  double rho;
};
/// The strongest among parameters that are known.
std::optional<Tied> strongest_correlation(const FitDocument&);
std::string rho_text(double rho);

/// Where the model is off: the map of residuals, and their size by angle.
page::Section residuals(const FitDocument&, const ResidualMap&, Pictures&);
/// Share of the light that comes back, of the table and of the model.
page::Section albedo(const FitDocument&, const Health&, Pictures&);
/// Search for a lower optimum over the widths.
page::Section search(const FitDocument&, Pictures&);
/// How well the parameters are separated, and what the other convention of bins would change.
page::Section confidence(const FitDocument&, Pictures&);
/// Iterations and times of the solver.
page::Section solver(const FitDocument&, Pictures&);
/// File, hash, and the values that were left out.
page::Section input(const FitDocument&, const std::string& document);

}  // namespace gonio::fit_sections
