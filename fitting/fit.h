#pragma once
/// \file
/// The fit: a table and a model in, parameters and how well they are known out.

#include <functional>
#include <optional>

#include "brdf/model/model.h"
#include "fitting/result/document.h"
#include "fitting/sample/shared_columns.h"
#include "fitting/solve/options.h"
#include "table/table.h"

namespace gonio {

struct FitResult {
  FitDocument document;
  BoundModel model;  ///< with the fitted values, also of parameters that are not identifiable
  /// The model without its lobes, where the data do not determine these: then the document's numbers are of this one.
  std::optional<BoundModel> without_lobes = {};

  /// The model that the document's numbers are of.
  const BoundModel& drawn() const { return without_lobes ? *without_lobes : model; }
};

/// Throws wrong usage for options that no table could be fitted with.
void check(const FitOptions&);

/// Other models are tried for `next` where a certificate is asked for.  Input path and hash are the caller's to fill in.  Throws wrong usage for options that do not fit
/// the model, bad_input for a table without a usable value.
FitResult fit(const Table&, const FitOptions&, const std::function<void(const char*)>& phase = {});
/// Fit of one of several models: what another fit has read of the table is not read again.
FitResult fit(const Table&,
              const FitOptions&,
              SharedColumns&,
              const std::function<void(const char*)>& phase = {});

}  // namespace gonio
