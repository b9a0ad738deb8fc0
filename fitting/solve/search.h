#pragma once
/// \file
/// Search for the best fit of all samples, from nothing: coarse levels first, float where it is enough.

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "brdf/model/model.h"
#include "fitting/sample/shared_columns.h"
#include "fitting/solve/problem.h"
#include "fitting/solve/solve.h"

namespace gonio {

/// Optimum of a problem on some data.
struct Fitted {
  BoundModel model;  ///< with the values found
  double huber = no_huber;
  Solution solution;
  bool in_float = false;   ///< whether that was enough
  std::size_t groups = 0;  ///< of the data that it is the best fit of
  double values = 0;       ///< compared there, see Sampling::count_of()
};

/// Best fit of `data`, all of the problem's free values moved from where `from` has them.
/// \param from  the problem's model, or one with fewer terms over the same values
template <class F>
Fitted minimise(const Problem&, const FitData<F>& data, BoundModel from, double huber);

/// Milliseconds since the last call, under a name.
class PhaseTimes {
 public:
  explicit PhaseTimes(std::vector<std::pair<std::string, double>>& into) : into_(into) {}
  void lap(std::string name) {
    into_.emplace_back(std::move(name), since_last_.ms());
    since_last_ = {};
  }

 private:
  std::vector<std::pair<std::string, double>>& into_;
  Stopwatch since_last_;
};

/// Values of the thinned table that the judges look at, of a table's million.
inline constexpr std::size_t scan_samples = 16384;

struct Profile;

/// Optimum of the data's bulk, from which a robust fit begins; null for others, and where no value has a
/// logarithm.
std::shared_ptr<const BoundModel> bulk_of(const Problem&, const Sampling&);

/// Huber's threshold: 1.345 times the spread that the residuals' median size tells, 1.4826 times that
/// size if they are normal; no_huber without residuals.
double huber_of(std::vector<double> sizes);

/// Optimum of about `most` groups of a table that are compared in another way, from one already found; a
/// robust fit's with outliers of that way.
Fitted compared_by(const Sampling&, const Problem&, std::size_t most, const Fitted& from);

/// Samples of a coarse table.
inline constexpr std::size_t coarse_samples = 2048;
/// Best fit of a coarse table, in a few milliseconds; none without a usable value.
std::optional<Fitted> coarse_fit(const Problem&, const Sampling&);

struct Searched {
  Fitted best;
  double cost_of_fewer = std::numeric_limits<double>::infinity();  ///< of the model less one lobe
  FitData<double> scanned;                 ///< about scan_samples of the table, evenly spread
  std::shared_ptr<const Profile> profile;  ///< none where no certificate was asked for
};
/// From nothing to the best fit of all samples.  Throws bad_input for a table without a usable value.
Searched search(Problem,
                const Sampling&,
                SharedColumns&,
                PhaseTimes&,
                const std::function<void(const char*)>& announce);

}  // namespace gonio
