#include "fitting/judge/other_units.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "fitting/judge/free_scale.h"
#include "fitting/judge/warnings.h"
#include "table/format/columns_command.h"
#include "table/format/measured_by.h"
#include "table/health/cosine.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// Values are f times cosines and divided by the scale.
struct TriedUnit {
  std::string in_words;
  CosinePowers cosines;
  double scale = 1;
};

std::vector<TriedUnit> units_to_try() {
  constexpr double radiance_factor = std::numbers::inv_pi;
  std::vector<TriedUnit> all{{"radiance factors", {}, radiance_factor},
                             {"radiance factors in percent", {}, radiance_factor / 100}};
  for (const auto& c : cosines)
    if (std::abs(c.incident) < 2 && std::abs(c.outgoing) < 2) {
      all.push_back({c.in_words, c});
      all.push_back({fmt::format("pi {}", c.in_words), c, radiance_factor});
    }
  return all;
}

Table in_unit(const Table& t, const TriedUnit& u) {
  Table as = t;
  const SampleAngles at(t);
  for (auto* planes : {&as.values, &as.errors})
    for (auto& plane : *planes)
      for (std::size_t i = 0; i < plane.size(); ++i) {
        const auto a = at(i);
        plane[i] *=
            u.scale / (std::pow(a.nol, u.cosines.incident) * std::pow(a.nov, u.cosines.outgoing));
      }
  return as;
}

/// What the model leaves of values known up to one factor.
struct AnyScale {
  double log_rms = std::nan("");
  bool is_option = true;  ///< whether --scale free takes the model
};
AnyScale of_any_scale(const Table& t, const FitOptions& o, const TryTable& attempt) {
  AnyScale any;
  FitOptions open = o;
  try {
    open = with_weights(o);
  } catch (const Error&) {  // its lobes have no weights, but its colours take up what is dark
    any.is_option = false;
  }
  // Where a highlight is far above the other values, its weight would be more than 1 but at a
  // smaller scale.
  constexpr double smaller = 0.01;
  double factor = working_factor(t);
  for (int k = 0; k < 3; ++k, factor *= smaller) {
    Table scaled = t;
    scale_values(scaled, factor);
    any.log_rms = std::fmin(any.log_rms, attempt(scaled, open));
  }
  return any;
}

}  // namespace

std::optional<OtherUnit> other_unit(const Table& t,
                                    const FitOptions& o,
                                    double here,
                                    const TryTable& attempt) {
  constexpr std::size_t large = 100'000;
  constexpr double far_less = 0.5, as_well = 1.05;
  if (!t.list() || t.truth || t.size() > large || o.scale == Scale::free) return {};
  const auto units = units_to_try();
  std::vector<double> left(units.size());
  tbb::parallel_for(std::size_t{0}, units.size(),
                    [&](std::size_t k) { left[k] = attempt(in_unit(t, units[k]), o); });
  const auto less = [](double a, double b) { return a < b || (std::isnan(b) && !std::isnan(a)); };
  const auto best = std::ranges::min_element(left, less);
  const AnyScale any = of_any_scale(t, o, attempt);
  const double most = far_less * here;
  if (*best <= most && !(any.log_rms * as_well < *best)) {
    // The first that does as well: values of a model that takes up a scale say nothing of it.
    const auto first = std::ranges::find_if(left, [&](double x) { return x <= as_well * *best; });
    const TriedUnit& u = units[static_cast<std::size_t>(first - left.begin())];
    return OtherUnit{
        fmt::format(
            "values may be {}: read so, the model is off by a factor of {} instead of {} ({})",
            u.in_words, typical_factor(*first), typical_factor(here),
            reading_command(t,
                            [&](ColumnMap& map) {
                              map.scale *= u.scale;
                              map.cosines = {map.cosines.incident + u.cosines.incident,
                                             map.cosines.outgoing + u.cosines.outgoing};
                            })),
        *first};
  }
  if (!any.is_option || !(any.log_rms <= most)) return {};
  return OtherUnit{
      fmt::format(
          "--scale free fits values known up to one factor: off by a factor of {} instead of {}",
          typical_factor(any.log_rms), typical_factor(here)),
      any.log_rms};
}

}  // namespace gonio
