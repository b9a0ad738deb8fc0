#include "table/format/wavelengths.h"

#include <algorithm>

#include "base/blanks.h"
#include "base/numbers.h"

namespace gonio {

std::optional<double> wavelength_of(std::string_view name) {
  if (name.ends_with("nm")) name = trimmed(name.substr(0, name.size() - 2));
  const auto nm = number_from<double>(name);
  return nm && *nm > 0 ? nm : std::nullopt;
}

std::vector<double> wavelengths_of(const Table& t) {
  std::vector<double> all;
  for (const auto& name : t.channels)
    if (const auto nm = wavelength_of(name)) all.push_back(*nm);
  if (t.channels == std::vector<std::string>{"f"})
    for (const auto& [name, text] : t.notes)
      if (const auto nm = wavelength_of(text); name == "wavelength" && nm) all.assign(1, *nm);
  if (all.size() != t.channels.size()) all.clear();
  return all;
}

}  // namespace gonio
