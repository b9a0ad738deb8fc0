#include "base/nearest_names.h"

#include "base/error.h"
#include "base/nearest.h"
#include "base/text.h"

#include <fmt/format.h>

namespace gonio {

void refuse_name(std::string_view name,
                 std::span<const std::string_view> known,
                 std::string_view what) {
  throw wrong_usage(fmt::format("no {} '{}'; nearest: {}", what, printable(name, 80),
                                fmt::join(nearest(name, known), ", ")));
}

}  // namespace gonio
