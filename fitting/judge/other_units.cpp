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
  double of_any_scale = std::nan("");
  try {
    Table scaled = t;
    scale_values(scaled, working_factor(t));
    of_any_scale = attempt(scaled, with_weights(o));
  } catch (const Error&) {  // its lobes have no weights
  }
  const auto less = [](double a, double b) { return a < b || (std::isnan(b) && !std::isnan(a)); };
  const auto best = std::ranges::min_element(left, less);
  const double most = far_less * here;
  if (*best <= most && !(of_any_scale * as_well < *best)) {
    const TriedUnit& u = units[static_cast<std::size_t>(best - left.begin())];
    return OtherUnit{
        fmt::format(
            "values may be {}: read so, the model is off by a factor of {} instead of {} ({})",
            u.in_words, typical_factor(*best), typical_factor(here),
            reading_command(t,
                            [&](ColumnMap& map) {
                              map.scale *= u.scale;
                              map.cosines = {map.cosines.incident + u.cosines.incident,
                                             map.cosines.outgoing + u.cosines.outgoing};
                            })),
        *best};
  }
  if (!(of_any_scale <= most)) return {};
  return OtherUnit{
      fmt::format(
          "--scale free fits values known up to one factor: off by a factor of {} instead of {}",
          typical_factor(of_any_scale), typical_factor(here)),
      of_any_scale};
}

}  // namespace gonio
