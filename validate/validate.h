#pragma once
/// \file
/// Validation of a choice: each budget against the worst that is found in the choice's domain.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/finding/report.h"
#include "reports/picture/figure.h"
#include "validate/choice.h"

namespace gonio {

/// One budget, and the worst that was found.
///
///   proved, exhaustive  for every input of the domain, as `gonio stability` has it
///   searched            on a grid of the domain and then around the worst of it: there may be worse
///   counted, measured   operations and bytes; times
struct BudgetCheck {
  std::string budget;  ///< its key
  double limit, found;
  bool holds;
  std::string evidence;
  /// Inputs of the worst; empty where there are none.
  std::vector<std::pair<std::string, double>> at{};
  std::string substance{};  ///< of these
  std::string words{};      ///< what was found, as a sentence
};

/// Cheapest choice of the catalogue that keeps every budget: the same distribution and diffuse terms under another masking,
/// Fresnel term or scattering.  Where none keeps them all, the nearest: the fewest are broken, and by the smallest factor.
struct Suggestion {
  std::string model, scattering;
  bool holds;
  std::string why;         ///< one sentence; of a nearest one it names what stops it
  std::size_t operations;  ///< of a sample, the scattering's own too
  std::size_t tried;       ///< choices that were compared, each of which breaks a budget
  std::vector<std::string> stopped_by{};  ///< budgets that a nearest one breaks
};

struct Validation {
  std::string path;  ///< of the choice
  std::string model, scattering, reference;
  std::vector<UsedParameter> parameters, reference_parameters;
  Number number;
  std::vector<BudgetCheck> budgets;
  Pictures pictures{};
  std::optional<Suggestion> suggestion{};  ///< where one was asked for and there is one

  bool holds() const;
};

/// \param done  told what is looked at, and the part that is done
/// \throws Error (bad_input of the choice's file) where a budget cannot be asked of this model
Validation validate(const Choice&, const ReportProgress& done = {});

/// Cheapest choice that keeps every budget, or the nearest; none where no masking or Fresnel term fits the domain.
/// \throws Error (bad_input of the choice's file) of a model that has not one isotropic lobe
std::optional<Suggestion> suggest(const Choice&, const ReportProgress& done = {});

/// gonio.validation/1
std::string to_json(const Validation&);
std::string validation_schema();
/// JUnit's XML: a test case a budget.
std::string junit_of(const Validation&);
/// SARIF 2.1.0: a result for each budget that is broken.
std::string sarif_of(const Validation&);
std::string validation_page_html(const Validation&);

}  // namespace gonio
