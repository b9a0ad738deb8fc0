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

/// What the table's values are: f, or known up to one factor.
enum class Scale { held, free };
template <>
inline constexpr std::array<std::string_view, 2> names_of<Scale>{"held", "free"};

template <>
inline constexpr auto description<Setting> =
    FieldList{Field{"name", &Setting::name, ""},
              Field{"values", per_channel(&Setting::values), "one, or one per channel"},
              Field{"text", &Setting::text, "what was written, where it is no number"},
              Field{"implied", &Setting::implied, "whether it follows from a preset"}};
static_assert(describes_every_member<Setting>());
template <>
inline constexpr auto from_words<std::vector<Setting>> = &parse_settings;

/// Options of a fit.  From its description follow the options of `gonio fit` and `gonio batch`, the keywords of Python's `fit`, and
/// the key of a kept result.
struct FitOptions {
  std::string model = "lambert+ggx/smith_ggx.correlated/schlick";
  std::vector<Setting> fixed = {};
  std::vector<Setting> bounds = {};  ///< NAME=low,high instead of the parameter's own range
  std::vector<std::string> grey = {};
  Metric metric = Metric::log;
  bool robust = false;  ///< Huber's loss beyond 1.345 robust standard deviations
  Intervals intervals = Intervals::automatic;
  bool copies = false;          ///< fit also what only repeats another angle
  bool bin_sensitivity = true;  ///< fit again under the other bin convention
  Certify certificate = Certify::none;
  Scale scale = Scale::held;
};

/// Fields of what is fitted and how values are compared, which fits of tables and of texels share.
template <class Options>
inline constexpr auto model_fields = FieldList{
    Field{"model", &Options::model, "model; all its parameters are fitted"},
    Field{"fix", &Options::fixed, "parameters held at a value: NAME=VALUE …", Entries{0, 64}},
    Field{"bounds", &Options::bounds, "where a parameter is looked for: NAME=LOW,HIGH …",
          Entries{0, 64}},
    Field{"grey", &Options::grey, "colour parameters with one value for all channels: NAME …",
          Entries{0, 64}},
    Field{"metric", &Options::metric, "how values are compared"}};

template <>
inline constexpr auto description<FitOptions> = joined(
    model_fields<FitOptions>,
    FieldList{
        Field{"robust", &FitOptions::robust, "huber: outliers count less", Either{"none", "huber"}},
        Field{"intervals", &FitOptions::intervals,
              "whether the values of one incident angle share their errors: independent, by_angle, "
              "or automatic (by_angle for measured tables); or bootstrap, from 400 fits of tables "
              "drawn from this one, which takes as long"},
        Field{"copies", &FitOptions::copies,
              "angles of the table that only repeat another, value for value: leave_out, or keep",
              Either{"leave_out", "keep"}},
        Field{"bin_sensitivity", &FitOptions::bin_sensitivity,
              "whether there is a fit under the other bin convention, too", not_asked},
        Field{"certificate", &FitOptions::certificate,
              "auto: after the fit its cost is looked at over the widths, for anything lower; or "
              "none, which is faster"},
        Field{"scale", &FitOptions::scale,
              "free: values are known up to one factor, as counts are. Each lobe gets a weight; kd "
              "and weights are then known relative to each other only"}});
/// A kept result is found by these: none may be forgotten.
static_assert(describes_every_member<FitOptions>());

}  // namespace gonio
