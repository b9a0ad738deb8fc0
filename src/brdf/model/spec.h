#pragma once
/// \file
/// A model as a user writes it: its spec and its parameters' values.
///
///   SPEC = [DIFFUSE+]LOBE(+LOBE)*[+coat:LOBE] or DIFFUSE[+coat:LOBE];   LOBE = NDF/MASKING/FRESNEL
///   SETTINGS = NAME=VALUE[,NAME=VALUE…];        VALUE = number or r,g,b

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gonio {

/// Names of a lobe's terms.
struct LobeSpec {
  std::string ndf, masking, fresnel;
  bool operator==(const LobeSpec&) const = default;
};

/// Names of a model's terms.
struct ModelSpec {
  std::string diffuse;  ///< "": none
  std::vector<LobeSpec> lobes;
  std::optional<LobeSpec> coat = {};  ///< a lobe on all else: brdf/formula/coat.h
  bool operator==(const ModelSpec&) const = default;
};

/// A model of one lobe.
ModelSpec model_of_lobe(std::string_view ndf, std::string_view masking, std::string_view fresnel);
/// A spec as parsed; a preset's name is one of a diffuse term.  More than 17 parts are wrong usage.
/// \param document  file that the spec stands in: paths of people's own files are looked for beside it; "": in the working folder
ModelSpec parse_model(std::string_view spec, const std::string& document = {});
/// The spec that parse_model() makes the same of.
std::string to_text(const ModelSpec&);
/// The spec with its coat as the last lobe, whose number the coat's parameters have.
ModelSpec coat_as_lobe(ModelSpec);
/// Calls `f` with the name of each term.
template <class F>
void each_name(ModelSpec& spec, F f) {
  if (!spec.diffuse.empty()) f(spec.diffuse);
  for (auto& l : spec.lobes) f(l.ndf), f(l.masking), f(l.fresnel);
  if (spec.coat) f(spec.coat->ndf), f(spec.coat->masking), f(spec.coat->fresnel);
}

/// A parameter of a model: that of a term, by its lobe.  Diffuse terms have theirs from the first lobe.
struct ParameterId {
  std::string name;
  std::size_t lobe = 0;
};
/// "f0_2" is f0 of the second lobe.
ParameterId parse_parameter(std::string_view);
std::string to_text(const ParameterId&);

struct Setting {
  std::string name;
  std::vector<double> values;  ///< one, or one per channel
  std::string text = {};       ///< what was written, where it is no number (metal=Au)
  bool implied = false;        ///< nobody set it: it follows from a preset's defaults
};

/// "alpha=0.25,f0=0.9,0.6,0.5" or those words apart.  A name given twice is wrong usage.
std::vector<Setting> parse_settings(std::span<const std::string> words);

/// A number with nothing after it; `what` names it in the error.
double parse_number(std::string_view text, const std::string& what);

}  // namespace gonio
