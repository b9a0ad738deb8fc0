#include "reports/picture/json_numbers.h"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace gonio {

PageJson page_json(double v) {
  if (!std::isfinite(v)) return nullptr;
  return std::strtod(fmt::format("{:.6g}", v).c_str(), nullptr);
}

std::string page_text(const PageJson& j) {
  return j.dump(-1, ' ', false, PageJson::error_handler_t::replace);
}

}  // namespace gonio
