#pragma once
/// \file
/// The options of a fit: what is free, how values are compared, how intervals are made.

#include <array>
#include <string>
#include <vector>

#include "base/describe.h"
#include "base/names.h"
#include "brdf/model/model.h"
#include "fitting/sample/sampling.h"

namespace gonio {

enum class Intervals {
  automatic,  ///< by_angle for measured tables with enough incident angles, else independent
  independent,
  by_angle,  ///< values of one incident angle share their errors; needs two angles
  bootstrap  ///< from fits of tables drawn from this one's values, or incident angles where
             ///< automatic takes these
};
template <>
inline constexpr std::array<std::string_view, 4> names_of<Intervals>{"automatic", "independent",
                                                                     "by_angle", "bootstrap"};

/// Certificate of the optimum: a search of the cost over the widths for anything lower.
enum class Certify { none, automatic };
template <>
inline constexpr std::array<std::string_view, 2> names_of<Certify>{"none", "auto"};

struct FitOptions {
  std::string model = "lambert+ggx/smith_ggx.correlated/schlick";
  std::vector<Setting> fixed;  ///< parameters held at a value
  std::vector<Setting>
      bounds;  ///< NAME=low,high instead of the parameter's own range; roughness too
  std::vector<std::string> grey;  ///< colour parameters with one value for all channels
  Metric metric = Metric::log;
  bool robust = false;  ///< Huber's loss beyond 1.345 robust standard deviations
  Intervals intervals = Intervals::automatic;
  bool copies = false;          ///< fit also what only repeats another angle
  bool bin_sensitivity = true;  ///< fit again under the other bin convention
  Certify certificate = Certify::none;
};

template <>
inline constexpr auto description<Setting> =
    std::tuple{Field{"name", &Setting::name, ""},
               Field{"values", per_channel(&Setting::values), "one, or one per channel"},
               Field{"text", &Setting::text, "what was written, where it is no number"},
               Field{"implied", &Setting::implied, "whether it follows from a preset"}};
static_assert(describes_every_member<Setting>());

template <>
inline constexpr auto description<FitOptions> = std::tuple{
    Field{"model", &FitOptions::model, ""},
    Field{"fix", &FitOptions::fixed, "parameters held at a value"},
    Field{"bounds", &FitOptions::bounds, "where parameters are looked for"},
    Field{"grey", &FitOptions::grey, "colours with one value for all channels"},
    Field{"metric", &FitOptions::metric, "how values are compared"},
    Field{"robust", &FitOptions::robust, "whether outliers count less"},
    Field{"intervals", &FitOptions::intervals, "which values share their errors"},
    Field{"copies", &FitOptions::copies, "whether angles that only repeat another are fitted, too"},
    Field{"bin_sensitivity", &FitOptions::bin_sensitivity,
          "whether there is a fit under the other bin convention, too"},
    Field{"certificate", &FitOptions::certificate,
          "whether other valleys of the cost are looked for"}};
/// A kept result is found by these: none may be forgotten.
static_assert(describes_every_member<FitOptions>());

}  // namespace gonio
