#pragma once
/// \file
/// The numbers of a page as JSON.  Dear to compile: for the .cpp files of this room only.

#include <string>
#include <vector>

#include "reports/cuts.h"
#include "reports/figure.h"

#include <nlohmann/json.hpp>

namespace gonio {

using PageJson = nlohmann::ordered_json;

/// Six digits: more than a page shows, a third of the bytes.  What is not known is null.
PageJson page_json(double);
PageJson page_json(const Figure&, const CurveStyles&);
PageJson page_json(const FigureMap&);
template <class T>
PageJson page_json(const std::vector<T>& v) {
  PageJson out = PageJson::array();
  for (const auto& x : v) out.push_back(page_json(x));
  return out;
}
PageJson page_json(const Cut&);
/// "figures" and "maps".
void put_pictures(PageJson& document, const Pictures&);
/// One line; bytes that are no UTF-8 are replaced.
std::string page_text(const PageJson&);

}  // namespace gonio
