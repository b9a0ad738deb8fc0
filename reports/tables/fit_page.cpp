#include "reports/tables/fit_page.h"

#include "reports/page/assets.h"
#include "reports/page/page.h"
#include "reports/tables/cuts_json.h"

namespace gonio {

FitPage make_fit_page(const Table& table, const BoundModel& fitted) {
  return {table.channels, make_cuts(table, fitted), make_residual_map(table, fitted)};
}

std::string to_json(const FitPage& page, std::string_view fit_json, std::string_view health_json) {
  const ResidualMap& map = page.residual_map;
  return page_text({{"fit", PageJson::parse(fit_json)},
                    {"health", PageJson::parse(health_json)},
                    {"channels", page.channels},
                    {"curves", page_json(page.curves)},
                    {"residual_map",
                     {{"theta_h_deg", page_json(map.theta_h_deg)},
                      {"theta_d_deg", page_json(map.theta_d_deg)},
                      {"mean", page_json(map.mean)},
                      {"rms", page_json(map.rms)},
                      {"count", map.count}}}});
}

std::string fit_page_html(std::string_view title, std::string_view data) {
  return make_page(title, data, std::string(assets::table_js).append(assets::fit_js));
}

}  // namespace gonio
