#pragma once
/// \file
/// The numbers of a page as JSON.  Dear to compile: for .cpp files only.

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace gonio {

using PageJson = nlohmann::ordered_json;

/// Six digits: more than a page shows, a third of the bytes.  What is not known is null.
PageJson page_json(double);
template <class T>
PageJson page_json(const std::vector<T>& v) {
  PageJson out = PageJson::array();
  for (const auto& x : v) out.push_back(page_json(x));
  return out;
}
/// One line; bytes that are no UTF-8 are replaced.
std::string page_text(const PageJson&);

}  // namespace gonio
