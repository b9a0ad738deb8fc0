#include "fitting/result/document.h"

#include "base/json/describe.h"
#include "fitting/result/document_fields.h"

namespace gonio {

std::string to_json(const FitDocument& d) {
  return json_text(d);
}

std::string to_json(const Comparison& c) {
  return json_text(c);
}

std::string comparison_schema() {
  return schema_text<Comparison>("How far a model is from a table");
}

}  // namespace gonio
