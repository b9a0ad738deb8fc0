#pragma once
/// \file
/// A model as a user writes it: its spec and its parameters' values.
///
///   SPEC = [DIFFUSE+]LOBE(+LOBE)* or DIFFUSE;   LOBE = NDF/MASKING/FRESNEL
///   SETTINGS = NAME=VALUE[,NAME=VALUE…];        VALUE = number or r,g,b

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gonio {

/// The parts of a spec as written: one name for a diffuse term, three for a lobe.  More than 17 of them are wrong usage.
/// \param document  file that the spec stands in: paths of people's own files are looked for beside it; "": in the working folder
std::vector<std::vector<std::string>> parse_spec(std::string_view spec,
                                                 const std::string& document = {});

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
