#pragma once
/// \file
/// Evaluation of a model over columns again and again, which is what its time is told of.

#include <functional>
#include <memory>

#include "brdf/model/evaluate.h"

namespace gonio {

/// Run of the model over the columns, in float, one thread: each call writes the same f.  It owns what it reads and writes.
std::function<void()> column_run(const BoundModel&, std::shared_ptr<const AngleColumns<float>>);

}  // namespace gonio
