#pragma once
/// \file
/// Warnings that a reader must know before believing a fit's numbers.

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fitting/judge/lack_of_fit.h"
#include "fitting/result/document.h"
#include "fitting/solve/options.h"
#include "table/health/facts.h"

namespace gonio {

/// Number of clusters from which on their moves alone tell the errors.
bool enough_angles(std::size_t clusters);

/// Facts of a fit and its table that its document does not hold.
struct FitFacts {
  std::size_t angles = 0;  ///< incident angles of the table, where they were counted
  std::size_t free = 0;    ///< unknowns
  double cost_of_fewer = std::numeric_limits<double>::infinity();  ///< of the model less one lobe
  bool needless = false;       ///< whether the diffuse terms alone do as well
  bool no_f = false;           ///< whether values are of another unit, or have a cosine left in
  bool no_scale = false;       ///< whether they return more light than arrives, or next to none
  bool few_angles = false;     ///< whether they are too few for errors that an angle's values share
  bool beyond_stated = false;  ///< whether what is left is more than the table's own uncertainties
  bool offset = false;         ///< whether negative values are an offset rather than noise
  bool copies = false;         ///< whether angles of the table only repeat another
  bool clipped = false;        ///< whether noise of dark values was clipped
  double dark_bias = 0;        ///< of ln f, by noise of the darkest values; 0 where it is little
  std::optional<OddAngle> odd_angle = {};
  std::optional<Outliers> outliers = {};
  std::string without_outliers =
      {};  ///< what a robust fit finds otherwise, in words; "" where that is little
  std::optional<Peak> retro = {};  ///< the highlight, where it is at wo = wi
  std::optional<Peak> unresolved =
      {};  ///< that of a narrow lobe, where the samples do not resolve it
};
/// Fills in what follows from the table and the document.
FitFacts with_table(FitFacts, const FitOptions&, TableFacts&, const FitDocument&);

/// Factor that a log RMS stands for, with two digits of what it is above 1.
std::string typical_factor(double log_rms);

std::vector<std::string> warnings(const FitOptions&,
                                  const Table&,
                                  const FitDocument&,
                                  const FitFacts&);

/// True where the model returns more light than arrives, by more than its integral's error.
bool returns_too_much(const Physics&);

/// Sentences of a model that returns more light than arrives, or rises far above its table.
/// \param misfit  the model misses the table: then a peak far below it is named, too
std::vector<std::string> physics_in_words(const Physics&, bool misfit);

/// Sentences of a misfit that is told: its size with the angles that it follows, and its place.
/// \param allowed_for  whether a parameter has an interval, which allows for it
std::vector<std::string> misfit_in_words(const Misfit&, bool allowed_for);
/// How far a model is from a table at one place: "too bright by a factor of 1.52".  \param ratio  of model to table
std::string deviation_in_words(double ratio);

}  // namespace gonio
