#pragma once
/// \file
/// The parts of a whole function of a person's file, each by itself: highlight, diffuse part and coat.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reports/own/energy.h"
#include "reports/own/nearest_model.h"

namespace gonio {

struct PartsAudit {
  /// Albedo of the highlight along the normal, F0 being 1, at the narrowest width: 1 of a right one.
  std::optional<FoundAt> highlight;
  std::vector<std::string> slips, to_check;
};
/// \param model       ours that it is, where there is one
/// \param is_sheen    its highlight is none that a smooth surface has
/// \param guessed_pi  that its value includes π is a guess
PartsAudit audit_parts(std::size_t foreign_term,
                       const OwnAlbedo&,
                       const std::optional<NearestModel>& model,
                       bool is_sheen,
                       bool guessed_pi);

}  // namespace gonio
