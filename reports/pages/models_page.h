#pragma once
/// \file
/// The page of a choice among models: which to take, how near and how fast each is, all of them over the data, and the same sphere of
/// the table and of each.

#include <string>
#include <string_view>
#include <vector>

#include "fitting/choice/choice.h"
#include "fitting/choice/document.h"
#include "reports/pages/spheres.h"
#include "reports/picture/figure.h"

namespace gonio {

/// Content of the page beyond the choice's document.
struct ModelsPage {
  std::vector<std::string> names;  ///< of each row, as people say them
  std::vector<std::size_t>
      numbers;  ///< of each row, from 1 by its error; 0: it could not be compared
  /// Error against time, "error_and_time"; family "curves": the models over the data, their names their numbers.
  Pictures pictures;
  Spheres spheres;  ///< of the rows that were compared, in their order
};

/// Error by which models are numbered: on incident angles that the fit had not seen; without blocks over the table.
double error_of(const ModelChoice&, const ModelRow&);

/// Spheres of the fits that were compared.  Their rows are told how far they are from the table's, where it covers enough of one.
Spheres add_spheres(const Table&, ModelChoice&);

/// \param spheres  of the fits that were compared, in the order of the rows
ModelsPage make_models_page(const Table&, const ModelChoice&, const Advice&, Spheres spheres);

/// {"choice": …, "names", "numbers", "figures", "maps", "spheres"}: every figure of the page; what is not known is null.
/// \param choice_json  gonio.models/1 as text
std::string to_json(const ModelsPage&, std::string_view choice_json);

/// JSON Schema of that document.
std::string models_page_schema();

/// The page itself, HTML.
std::string models_page_html(const ModelChoice&,
                             const Advice&,
                             const ComparedTable&,
                             const ModelsPage&);

}  // namespace gonio
