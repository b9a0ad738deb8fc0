#pragma once
/// \file
/// Shader source of a term, a map or a model: its own formula, run once with numbers that write down what is done to them.
///
/// Two functions: one of the cosines between the directions, which is the formula, and of a model one of the directions
/// themselves, which makes the cosines in float: |n × h|² of the cross product, where 1 − NoH² would cancel.

#include <string>
#include <vector>

#include "shader/language.h"
#include "shader/traced_formula.h"

namespace gonio::shader {

struct Writing {
  Language language = Language::glsl;
  std::string name = "brdf";         ///< of the functions
  std::vector<std::string> remarks;  ///< lines of the header beside what the formula says of itself
};

/// Refuses a name that some language does not take: wrong usage.
void check_function_name(const std::string&);
/// \throws Error  of such a name
std::string shader_source(const TracedFormula&, const Writing&);

/// A person's own text under the header: what is known of its functions goes above it, below its #version.
/// \param operations  of a sample   \param text  of the file
std::string own_shader_source(const TracedFormula&,
                              const Writing&,
                              const Operations& operations,
                              const std::string& text);

/// Name of the function of cosines: what is called NAME of directions is NAME_of_cosines.
std::string function_of_cosines(const TracedFormula&, const Writing&);

/// Name of the structure that both functions give where there is more than one result.
std::string structure_name(const TracedFormula&, const Writing&);

/// What was written, for programs (gonio.shader/1).
struct ShaderDocument {
  std::string source;
  TracedFormula formula;
  Writing writing;
};
std::string to_json(const ShaderDocument&);
std::string shader_schema();

}  // namespace gonio::shader
