#pragma once
/// \file
/// Documents of pages: what is described as JSON, pictures among it.  Dear to compile: for .cpp files only.

#include <string>
#include <string_view>

#include "base/csv_describe.h"
#include "base/json/describe.h"
#include "reports/picture/figure.h"

namespace gonio {

inline constexpr std::string_view setting_meaning = "finer in roughness and angle",
                                  findings_meaning = "sentences, made only from the rows";

Json figures_json(const Pictures&);
Json maps_json(const Pictures&);
template <>
inline constexpr auto description<Pictures> =
    FieldList{Field{"figures", figures_json, "curves that the page draws"},
              Field{"maps", maps_json, "maps that the page draws"}};

/// Text of what is described.  Six digits: more than a page shows, a third of the bytes.
template <class T>
std::string page_document(const T& of) {
  return json_line(of, Digits::six);
}

}  // namespace gonio
