#pragma once
/// \file
/// Certificate of a fit as its document shows it.

#include "fitting/result/document.h"
#include "fitting/solve/profile.h"

namespace gonio {

Certificate certificate_of(const Problem&, const Profile&);

}  // namespace gonio
