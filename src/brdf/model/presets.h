#pragma once
/// \file
/// Whole models as they are shipped: a spec and how their own parameters become those of its terms.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/model/spec.h"
#include "number/parameter.h"

namespace gonio {

/// A preset's own parameters with the values given, the others at their defaults.
class PresetValues {
 public:
  PresetValues(std::span<const Parameter> parameters, std::span<const Setting> given);
  double number(std::string_view name) const;
  /// One value per channel.
  std::vector<double> colour(std::string_view name) const;
  std::size_t channels() const { return channels_; }

 private:
  std::span<const Parameter> parameters_;
  std::vector<std::vector<double>> values_;
  std::size_t channels_ = 1;
};

struct Preset {
  About about;
  std::string_view spec;
  std::span<const Parameter> parameters;
  /// The settings of `spec`.
  std::vector<Setting> (*resolve)(const PresetValues&);
  /// Those that no parameter of the preset moves: a fit holds them.
  std::span<const std::string_view> held = {};
  /// Spec of the same model whose terms read the preset's own parameters, for fits: these stay within what the preset can say.  Empty:
  /// there is none, and a fit leaves the parameters of `spec` free.
  std::string_view own_spec = {};
};

/// Every whole model that composes of terms.
std::span<const Preset> presets();
/// By id ("model.gltf") or without its prefix ("gltf"); nullptr if there is none.
const Preset* find_preset(std::string_view name);

/// A preset's name becomes its spec, and its own parameters among the settings those of the spec.  If
/// none of its own is set, what follows from their defaults is marked as implied, but for what the
/// preset holds, and the spec's parameters may be set instead.  A spec that names no preset stays.
ModelSpec resolve_preset(const ModelSpec&, std::vector<Setting>& settings);

}  // namespace gonio
