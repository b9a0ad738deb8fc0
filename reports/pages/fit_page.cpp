#include "reports/pages/fit_page.h"

#include "base/json/describe.h"
#include "reports/page/assets.h"
#include "reports/page/page.h"
#include "reports/pages/fields.h"
#include "reports/picture/json_numbers.h"

namespace gonio {

FitPage make_fit_page(const Table& table, const BoundModel& fitted) {
  return {table.channels, make_cuts(table, fitted), make_residual_map(table, fitted),
          make_spheres(table, {&fitted, 1})};
}

std::string to_json(const FitPage& page, std::string_view fit_json, std::string_view health_json) {
  return json_line(FitPageDocument{{fit_json}, {health_json}, page}, Digits::six);
}

std::string fit_page_schema() {
  return schema_text<FitPageDocument>("Page of a fit");
}

std::string fit_page_html(std::string_view title, std::string_view data) {
  return make_page(title, data,
                   std::string(assets::table_js).append(assets::spheres_js).append(assets::fit_js));
}

}  // namespace gonio
