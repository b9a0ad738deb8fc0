// People's own functions in every number but fifty digits, and with their operations counted.
#include "brdf/function/foreign_function.h"
#include "number/counted.h"
#include "number/mixed.h"

namespace gonio {

GONIO_FOREIGN_ROWS(double)
GONIO_FOREIGN_ROWS(float)
GONIO_FOREIGN_ROWS(Half)
GONIO_FOREIGN_ROWS(Mixed)
GONIO_FOREIGN_ROWS(Counted<double>)

}  // namespace gonio
