#pragma once
/// \file
/// A model composed at run time: a list of terms and which parameter each of them reads.
///
///   f_c = Σ_l D_l V_l F_{l,c} + Σ diffuse_c + Σ coupled_c (1 − F_{1,c})          [1/sr]

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "brdf/model/spec.h"
#include "number/parameter.h"

namespace gonio {

/// "f0" with its values at [first, first + count): one, or one per channel.
struct ModelParameter {
  std::string name;
  const Parameter* about;
  std::size_t first = 0, count = 1;

  std::size_t slot(std::size_t channel) const { return first + (count > 1 ? channel : 0); }
};

/// A term in a model: an index into catalogue(), and of its parameters into Model::parameters.
struct TermUse {
  std::size_t term;
  std::vector<std::size_t> parameters;
};

struct Lobe {
  TermUse ndf, masking, fresnel;
};

/// D and V of a lobe share the parameters they both name.  Last of an anisotropic model's is `tangent`.
struct Model {
  ModelSpec spec;
  std::size_t channels = 3;
  std::vector<TermUse> diffuse;
  std::vector<Lobe> lobes;
  std::vector<ModelParameter> parameters;
  std::size_t value_count = 0;
  bool anisotropic = false;                         ///< a term of it reads the tangent frame
  std::vector<std::shared_ptr<const void>> held{};  ///< its functions of files

  /// nullptr if it has none of that name
  const ModelParameter* find(std::string_view name) const;
  /// Azimuth of the tangent [°], which all lobes share; nullptr of an isotropic model.  Terms know of no
  /// azimuth but that from the tangent: whoever gives them angles turns the frame (TurnedFrame).
  const ModelParameter* tangent() const { return anisotropic ? find("tangent") : nullptr; }
};

/// \param grey  names of colour parameters that have one value for all channels
Model compose(const ModelSpec&, std::size_t channels, std::span<const std::string> grey = {});
inline Model compose(std::string_view spec,
                     std::size_t channels,
                     std::span<const std::string> grey = {}) {
  return compose(parse_model(spec), channels, grey);
}

/// A model with a value for each parameter.
struct BoundModel {
  Model model;
  std::vector<double> values;      ///< model.value_count of them
  std::vector<std::string> given;  ///< names of the parameters that were set, others have defaults
};

/// Each parameter's name and values: one, or one per channel.
std::vector<std::pair<std::string, std::vector<double>>> named_values(const BoundModel&);

/// Settings resolved: roughness (alpha = roughness²), f0 of a dielectric term (eta), metal=Au (eta
/// and k), and base_color with metallic (f0 and kd, diffuse coupled).  What is not set keeps its
/// default.  Channels: as many as the longest colour has, or three.
BoundModel bind_model(const ModelSpec&,
                      std::vector<Setting> settings,
                      std::optional<std::size_t> channels = {},
                      std::span<const std::string> grey = {});
inline BoundModel bind_model(std::string_view spec,
                             std::vector<Setting> settings,
                             std::optional<std::size_t> channels = {},
                             std::span<const std::string> grey = {}) {
  return bind_model(parse_model(spec), std::move(settings), channels, grey);
}

}  // namespace gonio
