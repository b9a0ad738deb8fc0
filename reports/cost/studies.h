#pragma once
/// \file
/// Studies of light drawn for GGX and of the split sum's table: what is timed, and how far from the truth it is.

#include <string>
#include <string_view>
#include <vector>

#include "reports/cost/cost.h"

namespace gonio::costing {

/// A loop of a study, to be timed.
struct StudySubject {
  std::string id;
  std::string_view kind;  ///< "sampling", "split_sum"
  Timed timed;
};
std::vector<StudySubject> study_subjects(std::string_view instruction_set, std::size_t samples);

/// True of a kind of these.
bool is_study(std::string_view kind);
/// Error of a row of these.
CostError study_error(const CostRow&);

/// The studies without their times.
const Studies& study_errors();
/// The studies with the times of these rows, in the best instruction set.
Studies with_times(Studies, const std::vector<CostRow>&, std::string_view isa);

/// Every whole model as a shader; instructions where glslangValidator and spirv-opt are on PATH.
std::vector<ShaderRow> shader_rows();

}  // namespace gonio::costing
