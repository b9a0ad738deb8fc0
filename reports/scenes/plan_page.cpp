#include "reports/scenes/plan_page.h"

#include "reports/page/assets.h"
#include "reports/page/page.h"

namespace gonio {

std::string plan_page_html(std::string_view data) {
  return make_report_page("Plan of a scene", data, assets::plan_js);
}

}  // namespace gonio
