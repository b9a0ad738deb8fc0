#pragma once
/// \file
/// Problem that a fit solves: which parameters are free, and within which bounds.

#include <memory>
#include <span>
#include <vector>

#include "fitting/solve/accumulate.h"
#include "fitting/solve/options.h"
#include "fitting/solve/solve.h"

namespace gonio {

/// Model, unknowns and bounds: all that a fit is asked, the samples apart.
struct Problem {
  const FitOptions& options;
  BoundModel start;  ///< fixed values in place
  FreeSlots free;
  Bounds bounds;               ///< of the free slots
  std::vector<bool> narrowed;  ///< of the free slots: whether the user gave the bounds
  double offset;
  double rounding = 0;  ///< of the cost of one value in float, see SolveOptions; 0: in double alone
};

/// A preset's name becomes the spec over its own parameters; where it has none such, its spec with what the preset holds held, whose
/// parameters a fit leaves free.  An anisotropy held at 0 makes it the model of the isotropic terms.
FitOptions expanded(FitOptions);
/// The same for a table: a metal is held at the wavelengths of its channels, where these are such; else at those that stand for r, g
/// and b.
FitOptions expanded(FitOptions, const Table&);

/// Options for another model: what it has no parameter for is left out.
FitOptions options_for(FitOptions, const std::string& model);

/// Throws wrong usage for an anisotropic model where the table does not say how its surface was turned.
void check_azimuths(const Table&, const Model&);

/// Throws wrong usage for options that do not fit the model or the table's channels.
/// \param expanded  outlives the problem
Problem pose(const Table&, const FitOptions& expanded);
/// The same of samples that are no table.
/// \param offset  of the log and relative metrics [1/sr]
Problem pose(std::size_t channels, double offset, const FitOptions& expanded);

/// True of a problem whose fit takes samples with light and viewer exchanged for one.
bool folds(const Problem&);
/// Samples of the problem's table as its fit looks at them.
/// \param fold  whether those that a reciprocal model cannot tell apart are one
Sampling sampling_for(const Problem&, const Table&, Bins, bool fold = false);

/// The problem with fewer unknowns: those not in the mask stay where `start` has them.
/// \param model  the problem's own, or one with fewer terms over the same values
Problem with_free(const Problem&, Model model, const std::vector<bool>& mask);

/// Slots of the parameters that a model's terms read: those of fewer terms leave some unread.
std::vector<bool> slots_read(const Model&);

/// The model with some of its lobes, in that order.
Model with_lobes(const Model&, std::span<const std::size_t> lobes);

/// True where the fit looks for the parameter.
inline bool is_free(const Problem& p, const ModelParameter& q) {
  return p.free.mask()[q.first];
}

/// True of lobes of the same terms: then one is as good as the other.
bool are_alike(const Lobe&, const Lobe&);

/// True where f stays the same with light and viewer exchanged: then such samples are one to the fit.
bool is_reciprocal(const BoundModel&);

}  // namespace gonio
