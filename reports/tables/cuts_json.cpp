#include "reports/tables/cuts_json.h"

namespace gonio {

PageJson page_json(const Cut& c) {
  return {{"at", c.at},
          {"at_deg", page_json(c.at_deg)},
          {"within_deg", page_json(c.within_deg)},
          {"along", c.along},
          {"deg", page_json(c.deg)},
          {"data", page_json(c.data)},
          {"model", page_json(c.model)}};
}

}  // namespace gonio
