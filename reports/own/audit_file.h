#pragma once
/// \file
/// The audit of a person's file: which laws each function keeps, where it fails in half, what it costs, which form it is.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "answer/file_functions.h"
#include "reports/own/cost.h"
#include "reports/own/energy.h"
#include "reports/own/laws.h"
#include "reports/own/nearest.h"
#include "reports/own/nearest_model.h"

namespace gonio {

struct FunctionAudit {
  FileFunction of;
  Laws laws{};
  std::size_t operations_in_one = 0;  ///< in one channel
  std::optional<Energy> energy{};     ///< of a whole model
  /// Albedo of the highlight along the normal, F0 being 1, at the narrowest width: 1 of a right one.
  std::optional<FoundAt> highlight{};
  std::string half{};  ///< what it keeps in half, in a sentence
  std::optional<NearestForm> nearest{};
  std::optional<NearestModel> model{};  ///< of a whole model
  std::string width_of_model{};         ///< the parameter's name
  std::string no_model{};               ///< why none of ours is beside it
  std::optional<OfTheKind>
      of_the_kind{};  ///< ours to compare the cost with, where it is no form of ours
  std::vector<std::string> slips{};
  std::vector<std::string> to_check{};       ///< right or wrong by what the caller passes
  std::vector<std::string> not_looked_at{};  ///< what could not be, and why
};

/// False of a function that takes no light: an argument of another name may be a cosine.
bool is_audited(const foreign::Function&);
/// Every function of a file, or the one that is named.
/// \param begins  called with the name of each function before it is audited
/// \param looks_in_half  which takes most of the time; false: `half` stays empty
std::vector<FunctionAudit> audit_file(
    const std::string& name,
    const std::function<void(const std::string& function)>& begins = {},
    bool looks_in_half = true);
std::string to_json(const std::vector<FunctionAudit>&);
std::string text_of(const FunctionAudit&);

}  // namespace gonio
