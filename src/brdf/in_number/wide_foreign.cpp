// People's own functions in fifty digits.
#include "brdf/function/foreign_function.h"
#include "number/wide.h"

namespace gonio {

GONIO_FOREIGN_ROWS(Wide)

}  // namespace gonio
