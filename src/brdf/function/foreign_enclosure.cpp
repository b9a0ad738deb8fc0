// People's own functions in enclosures, and in halves that are flushed or contracted.
#include "brdf/function/foreign_function.h"
#include "number/enclosure.h"

namespace gonio {

GONIO_FOREIGN_ROWS(Enclosure<Half>)
GONIO_FOREIGN_ROWS(Enclosure<float>)
GONIO_FOREIGN_ROWS(Enclosure<double>)
GONIO_FOREIGN_ROWS(FlushedHalf)
GONIO_FOREIGN_ROWS(ContractedHalf)
GONIO_FOREIGN_ROWS(FlushedContractedHalf)

}  // namespace gonio
