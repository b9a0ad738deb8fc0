#include "brdf/model/own_files.h"

#include <algorithm>

#include "base/error.h"
#include "base/file.h"
#include "brdf/model/spec.h"
#include "foreign/function.h"

namespace gonio {

bool names_own_file(std::string_view spec) {
  try {
    return std::ranges::any_of(parse_spec(spec), [](const auto& part) {
      return std::ranges::any_of(part, [](const auto& name) { return foreign::is_name(name); });
    });
  } catch (const Error&) {
    return false;  // no model: whoever reads it says where that stands
  }
}

void expect_own_files_below(const std::string& document, std::string_view spec) {
  if (!names_own_file(spec)) return;
  for (const auto& part : parse_spec(spec))
    for (const auto& name : part)
      if (foreign::is_name(name)) {
        try {
          path_beside("document", foreign::parse_name(name).file);
        } catch (const Error&) {
          throw bad_input(document, "model", name,
                          "a shader below the folder that gonio runs in, or --follow-paths");
        }
      }
}

}  // namespace gonio
