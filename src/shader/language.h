#pragma once
/// \file
/// Shading languages: how each writes what a traced formula is made of.

#include <string>
#include <string_view>

#include "shader/traced_formula.h"

namespace gonio::shader {

enum class Language { glsl, wgsl, slang };

/// True of a word that one of the languages keeps for itself, or a function of GLSL.
bool is_kept_word(std::string_view);

/// A language with the number that a formula is computed in.
class Syntax {
 public:
  Syntax(Language language, Precision precision) : language_(language), precision_(precision) {}

  /// What a file that computes in this number must begin with; empty: nothing.
  std::string preamble() const;
  /// "float", "f16vec3", "vec3<f32>"
  std::string type(bool colour) const { return type(colour, precision_); }
  std::string type(bool colour, Precision) const;
  std::string literal(double x) const;
  std::string colour(std::string_view elements) const;
  /// A variable that is set once, whose operations no compiler may regroup where the language can say so.
  std::string variable(const std::string& name, bool colour, const std::string& value) const;
  /// A vector of floats, or one number, that is set once; its operations are free.
  std::string angle(const std::string& name, bool vector, const std::string& value) const;
  std::string parameter(const std::string& type, const std::string& name) const;
  /// Head of a function, up to its brace.
  std::string function(const std::string& result,
                       const std::string& name,
                       const std::string& parameters) const;
  std::string member(const std::string& type, const std::string& name) const;
  /// End of a structure.
  std::string structure_end() const { return language_ == Language::wgsl ? "}" : "};"; }
  /// A value of a structure of these members.
  std::string made(const std::string& structure,
                   const std::string& elements,
                   const std::string& name) const;
  std::string less(const std::string& a, const std::string& b, bool colour) const;
  std::string joined(Trace::Kind kind,
                     const std::string& a,
                     const std::string& b,
                     bool colour) const;
  /// A mask of one number for three channels.
  std::string of_all_channels(const std::string& mask) const;
  std::string opposite(const std::string& mask, bool colour) const;
  std::string choice(const std::string& mask,
                     const std::string& a,
                     const std::string& b,
                     bool colour) const;
  /// A float as this number.
  std::string from_float(const std::string& x) const;

 private:
  Language language_;
  Precision precision_;
};

}  // namespace gonio::shader

namespace gonio {
template <>
inline constexpr std::array<std::string_view, 3> names_of<shader::Language>{"glsl", "wgsl",
                                                                            "slang"};
}  // namespace gonio
