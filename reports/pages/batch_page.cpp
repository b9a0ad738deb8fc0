#include "reports/pages/batch_page.h"

#include "reports/page/assets.h"
#include "reports/page/page.h"

namespace gonio {

std::string batch_page_html(std::string_view title, std::string_view data) {
  return make_page(title, data, assets::batch_js);
}

}  // namespace gonio
