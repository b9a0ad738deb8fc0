#pragma once
/// \file
/// A term, a map or a model as a graph of its operations, with what it is given and what it gives.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/names.h"
#include "brdf/model/model.h"
#include "number/counted.h"
#include "number/traced.h"

namespace gonio::shader {

enum class Precision { float_, half };

/// What gives back the light that the first lobe's single scattering loses, a map of the catalogue: "scattering." before
/// each name.
enum class Compensation { turquin, fdez_aguera, kulla_conty };
/// Where a compensation has the lobe's albedo at F = 1 from: arguments, which a shader looks up, or the catalogue's fit.
enum class AlbedoFrom { table, fit };
struct Compensating {
  Compensation by;
  AlbedoFrom albedo = AlbedoFrom::table;
};

/// A parameter or an angle that a shader's function is given.
struct Argument {
  std::string name;  ///< as the shader calls it: f0, NoL
  int node;
  bool colour = false;               ///< one value a channel
  const Parameter* about = nullptr;  ///< none of an angle
};

/// A colour that is known: written down once, above the formula.
struct KnownColour {
  std::string name;
  int node;
  std::array<double, 3> value;
};

struct Result {
  std::string name;  ///< value, by_alpha …
  int node;
};

/// A term of the formula.
struct UsedTerm {
  std::size_t term;                          ///< index into catalogue()
  std::string part;                          ///< what its variables are called: D, V, F2 …
  std::vector<std::optional<double>> known;  ///< values of its parameters that are folded in
};

struct TracedFormula {
  std::string id;  ///< of a term or a map, or a model's spec
  Precision precision;
  bool is_model = false;     ///< also of directions
  bool colour = false;       ///< its results are colours
  bool anisotropic = false;  ///< reads the tangent frame
  double tangent = 0;        ///< azimuth of the tangent [°]
  Trace trace;
  std::vector<Argument> parameters, angles;  ///< that its results depend on
  std::vector<KnownColour> colours;
  std::vector<std::pair<std::string, std::vector<double>>>
      known;  ///< parameters that are folded in
  std::vector<UsedTerm> terms;
  std::vector<const About*> maps;  ///< that are used beside the terms
  std::vector<Result> results;     ///< the value [1/sr], or outputs of a map; then derivatives
  std::size_t derivatives = 0;     ///< number of these

  /// True of nodes that a result depends on.
  std::vector<bool> live() const;
  /// True of nodes that have one value a channel.
  std::vector<bool> coloured() const;
  /// Operations of what is live; on a colour three.
  Operations operations() const;
};

/// One channel of a model, or a colour of three.
///
/// \param model        of one channel or three
/// \param arguments    names of parameters that the function is given although they have a value; those that nobody set are
///                     given always
/// \param derivatives  names of parameters among those, by which the value is derived
/// \param compensating  adds arguments E_view, E_light, E_average, F_average as the map reads them; F₀ and F_average of
///                      Schlick's Fresnel are made here
/// \throws Error  wrong usage of other names, of other numbers of channels, and of a lobe that there is no fit for
TracedFormula trace_model(const BoundModel& model,
                          Precision precision,
                          std::span<const std::string> arguments,
                          std::span<const std::string> derivatives,
                          const std::optional<Compensating>& compensating = {});
/// A term on its own: D, V, F or a diffuse term, all its parameters arguments.
TracedFormula trace_term(std::size_t term,
                         Precision precision,
                         std::span<const std::string> derivatives);
/// A map, by its index in maps(): all its parameters are arguments, its outputs results.
/// \throws Error  wrong usage of derivatives where there are two outputs
TracedFormula trace_map(std::size_t map,
                        Precision precision,
                        std::span<const std::string> derivatives);

}  // namespace gonio::shader

namespace gonio {
template <>
inline constexpr std::array<std::string_view, 2> names_of<shader::Precision>{"float", "half"};
template <>
inline constexpr std::array<std::string_view, 3> names_of<shader::Compensation>{
    "turquin", "fdez_aguera", "kulla_conty"};
template <>
inline constexpr std::array<std::string_view, 2> names_of<shader::AlbedoFrom>{"table", "fit"};
}  // namespace gonio
