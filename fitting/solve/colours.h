#pragma once
/// \file
/// Colours of a model whose shapes are held: reflectances, refractive indices, extinctions, all that is
/// solved for where widths and exponents are given.

#include <span>
#include <vector>

#include "fitting/solve/descend.h"
#include "fitting/solve/problem.h"

namespace gonio {

/// True for what a term's shape depends on and not its colour: a width or an exponent.
bool is_shape(const ModelParameter&);

/// Place that a fit may begin from or pass through.
struct Start {
  double cost = 0;             ///< infinite where it is none
  std::vector<double> values;  ///< of all slots
};

/// Leaves so many, the best first; of those that ended at the same place, one.
void keep_best(std::vector<Start>&, std::size_t most);

/// Descent from a place, with all of the problem's unknowns.
template <class F>
Start descended(const Accumulator<F>&,
                const Problem&,
                std::vector<double> values,
                const DescentOptions&);

/// The problem's bounds but where a valley ends: an extinction is kept from 0, or at 0 where it is that;
/// an index without one is kept from 1, on the side where it is.
Bounds bounds_of_valley(const Problem&, const std::vector<double>& values);

/// Descent from a place to the bottom of its valley, then with all of the problem's range open.
template <class F>
Start descended_in_valley(const Accumulator<F>&,
                          const Problem&,
                          std::vector<double> values,
                          const DescentOptions&);

/// Solves for the colours.  Those of a Fresnel term have valleys: F of an index falls to 0 from both
/// sides of 1 and is even in the extinction, so that descents end at eta = 1 or k = 0 where they are not
/// kept from it.  Where each channel has an index of its own, each takes its own valley.
template <class F>
class Colours {
 public:
  /// Keeps references.
  /// \param p  of a model whose shapes are free or held; they are held here
  Colours(const Problem& p, const FitData<F>& data, double huber);

  /// From the best of the lobe's valleys, without looking at the bottom of the others.
  /// \param lobe  by its number in the problem's model
  Start from_best_valley(std::vector<double> values, std::size_t lobe, const DescentOptions&) const;
  /// From where they are and, of a lobe with an index or an extinction, from every valley of it.
  Start from_every_valley(std::vector<double> values, const DescentOptions&) const;
  /// Bottoms of all valleys, each of one channel where these are apart, that are not above the place's
  /// cost by more than `worth` of it; where these are more than `most`, the lowest.
  std::vector<Start> other_valleys(const Start& place,
                                   const DescentOptions&,
                                   double worth,
                                   std::size_t most = 64) const;
  /// True where some lobe has an index or an extinction that is free.
  bool has_valleys() const;
  /// From where they are.
  Start from(std::vector<double> values, const DescentOptions&) const;

 private:
  /// A parameter's value to begin with, and the ends of its valley.
  struct Place {
    std::size_t parameter;
    double value;
    Range valley;
  };
  struct Look {  ///< of one lobe
    std::vector<Place> places;
    bool at_saddle = false;  ///< an extinction of 0, to be left by no descent
  };
  struct Lobe {
    std::vector<Look> looks;
    bool has_valleys = false;  ///< more than one: an index or an extinction is free
    bool apart = false;        ///< each channel has values of its own
  };

  Lobe lobe_of(const TermUse& fresnel) const;
  void set(const Look&, std::size_t channel, std::vector<double>& values, Bounds&) const;
  Start in_valley(const Look&, std::vector<double> values, const DescentOptions&) const;
  void take(std::size_t channel, const std::vector<double>& from, std::vector<double>& to) const;
  std::vector<double> channel_costs(const Lobe&, const std::vector<double>& values) const;

  Problem held_;
  Accumulator<F> accumulate_;
  std::vector<Lobe> lobes_;
};

}  // namespace gonio
