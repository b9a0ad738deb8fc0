#include "base/json/describe.h"
#include "table/health/health_fields.h"

namespace gonio {

std::string to_json(const Table& t,
                    const Health& h,
                    std::optional<std::vector<NextDirection>> next) {
  return json_text(TableHealth{t, h, std::move(next)});
}

std::string health_schema() {
  return schema_text<TableHealth>("What a table can be trusted for");
}

}  // namespace gonio
