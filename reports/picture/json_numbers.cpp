#include "reports/picture/json_numbers.h"

#include "base/json/describe.h"
#include "base/text.h"

#include <nlohmann/json.hpp>

namespace gonio {

PageJson page_json(double v) {
  return number_json(v, Digits::six);
}

std::string page_text(const PageJson& j) {
  return printable_json(j.dump(-1, ' ', false, PageJson::error_handler_t::replace));
}

}  // namespace gonio
