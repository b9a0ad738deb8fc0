#pragma once
/// \file
/// Choice of a material model that somebody is about to ship, and what it must keep: gonio.choice/1.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/names.h"
#include "brdf/in_number/number.h"
#include "brdf/model/given_parameter.h"
#include "brdf/model/model.h"
#include "brdf/model/spec.h"
#include "reports/measure/surfaces.h"

namespace gonio {

/// Ways to follow light after its first bounce between facets; deterministic is all of it.
enum class Bounces { single, kulla_conty, kulla_conty_linear, turquin, fdez_aguera, deterministic };
template <>
inline constexpr std::array<std::string_view, 6> names_of<Bounces>{
    "single", "kulla_conty", "kulla_conty.linear", "turquin", "fdez_aguera", "deterministic"};

/// Width of a lobe from the roughness that an artist sets.
enum class AlphaMap { linear, square, fourth };
template <>
inline constexpr std::array<std::string_view, 3> names_of<AlphaMap>{"roughness", "roughness^2",
                                                                    "roughness^4"};

/// What a coat leaves of the light for all below it: validate/coat.h
enum class Coating { view, both };
template <>
inline constexpr std::array<std::string_view, 2> names_of<Coating>{"view", "both"};

/// Model as it is shipped, or what it stands for.  Parameters of the reference are its own and those that it shares with the model.
struct Shipped {
  std::string
      model;  ///< spec, or a preset; "coat:" before its last lobe lays that on its diffuse terms
  GivenParameters parameters{};
  Bounces scattering = Bounces::single;
  AlphaMap alpha = AlphaMap::square;
  std::optional<Coating> coating{};  ///< of a coat

  /// The model without the word "coat:".
  ModelSpec spec() const;
  /// The model of that spec, or of the preset's, in three channels.
  Model composed() const;
};

/// Limits, each of the worst that is found in the domain.
struct Budgets {
  struct ColourDifference {
    double limit = 0, quantile = 1;
  };
  struct Time {
    double limit = 0;      ///< times the baseline's
    std::string baseline;  ///< spec
  };
  std::optional<double> albedo_error{};   ///< |E − E of the reference|
  std::optional<double> fresnel_error{};  ///< |F − exact F|
  std::optional<ColourDifference> delta_e_2000{};
  std::optional<double> energy_gain{};  ///< E − 1
  std::optional<double> energy_loss{};  ///< 1 − E of the lobes at F = 1
  std::optional<double> reciprocity{};  ///< |f(l, v) − f(v, l)| over the larger
  std::optional<double> nonfinite{};    ///< inputs without a value in the number
  std::optional<double> operations{};
  std::optional<Time> ns{};
  std::optional<double> table_bytes{};
};

/// What a surface is made of, where the domain says so: a surface of known index, a reflectance, or a fit.
struct Substance {
  std::string name;  ///< "IOR 1.5", "gold", "F0 0.04", the fit's path; may be empty
  std::optional<FresnelSurface> surface{};  ///< dielectric or metal
  std::vector<FresnelForm> forms{};         ///< what stands in for the exact F of the surface
  std::vector<Setting> settings{};          ///< of a reflectance, or of a fit
};

/// Choice as its file has it.
struct Choice {
  using Ends = std::array<double, 2>;
  struct Domain {
    std::optional<Ends> roughness{};  ///< none: what the parameters say
    std::optional<Ends> mu{};         ///< of directions; none: 0.05 to 1
    std::optional<Ends> eta{}, f0{};
    std::vector<std::string> metals{};  ///< symbols or names
    std::vector<std::string> fits{};    ///< paths, beside the choice's
  };

  std::string path;  ///< of the file
  Shipped shipped, reference;
  bool has_reference = false;
  Number number = Number::float_;
  Domain domain;
  Budgets budgets;
  std::vector<Substance>
      substances;  ///< of the domain: of a range both ends and what lies evenly between
};

/// \throws Error  bad_input that names file, place, what was found and expected
Choice read_choice(const std::string& path);
/// \param path  named in errors
Choice parse_choice(const std::string& path, const std::string& bytes);
std::string choice_schema();

inline const std::vector<Substance>& substances(const Choice& c) {
  return c.substances;
}
/// Substance in a range of indices or reflectances, at a part of it in [0, 1].
Substance substance_at(const Choice&, double part);
bool has_range(const Choice&);

/// Names of parameters that set the width of a model's first lobe.
inline constexpr std::string_view width_names[]{"alpha", "roughness", "alpha_x", "alpha_y"};

/// Parameter of one side of a choice, with who sets it.
struct UsedParameter {
  enum class From { choice, domain, default_value };
  std::string name;
  std::vector<double> values;  ///< one, or one per channel; empty where the domain varies them
  From from;
};
template <>
inline constexpr std::array<std::string_view, 3> names_of<UsedParameter::From>{"choice", "domain",
                                                                               "default"};
/// Every parameter of a side, in the model's order.
std::vector<UsedParameter> used_parameters(const Choice&, const Shipped&);

/// Model at one roughness, of one substance.
/// \throws Error  bad_input of the choice's file where the model cannot be so
BoundModel bound(const Choice&, const Shipped&, const Substance&, double roughness);

}  // namespace gonio
