#include "table/format/wavelengths.h"

#include <algorithm>
#include <cmath>

#include "base/blanks.h"
#include "base/numbers.h"

namespace gonio {

std::optional<double> wavelength_of(std::string_view name) {
  const auto nm = number_from<double>(name);
  return nm && *nm > 0 && std::isfinite(*nm) ? nm : std::nullopt;
}

std::optional<double> wavelength_with_unit(std::string_view name) {
  return wavelength_of(name.ends_with("nm") ? trimmed(name.substr(0, name.size() - 2)) : name);
}

std::vector<double> wavelengths_of(const Table& t) {
  std::vector<double> all;
  for (const auto& name : t.channels)
    if (const auto nm = wavelength_with_unit(name)) all.push_back(*nm);
  if (t.channels == std::vector<std::string>{"f"})
    for (const auto& [name, text] : t.notes)
      if (const auto nm = wavelength_with_unit(text); name == "wavelength" && nm)
        all.assign(1, *nm);
  if (all.size() != t.channels.size()) all.clear();
  return all;
}

}  // namespace gonio
