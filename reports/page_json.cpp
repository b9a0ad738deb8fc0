#include "reports/page_json.h"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace gonio {

PageJson page_json(double v) {
  if (!std::isfinite(v)) return nullptr;
  return std::strtod(fmt::format("{:.6g}", v).c_str(), nullptr);
}

PageJson page_json(const Cut& c) {
  return {{"at", c.at},
          {"at_deg", page_json(c.at_deg)},
          {"within_deg", page_json(c.within_deg)},
          {"along", c.along},
          {"deg", page_json(c.deg)},
          {"data", page_json(c.data)},
          {"model", page_json(c.model)}};
}

std::string page_text(const PageJson& j) {
  return j.dump(-1, ' ', false, PageJson::error_handler_t::replace);
}

}  // namespace gonio
