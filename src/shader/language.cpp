#include "shader/language.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace gonio::shader {

std::string Syntax::preamble() const {
  if (precision_ == Precision::float_) return {};
  switch (language_) {
    case Language::glsl:
      return "#extension GL_EXT_shader_explicit_arithmetic_types_float16 : require\n";
    case Language::wgsl:
      return "enable f16;\n";
    case Language::slang:
      break;
  }
  return {};
}

std::string Syntax::type(bool colour, Precision precision) const {
  const bool half = precision == Precision::half;
  switch (language_) {
    case Language::glsl:
      return colour ? (half ? "f16vec3" : "vec3") : (half ? "float16_t" : "float");
    case Language::wgsl:
      return colour ? (half ? "vec3<f16>" : "vec3<f32>") : (half ? "f16" : "f32");
    case Language::slang:
      break;
  }
  return colour ? (half ? "half3" : "float3") : (half ? "half" : "float");
}

std::string Syntax::literal(double x) const {
  // A half's own digits end; of a float the fewest that no other float is nearest to.
  std::array<char, 64> digits;
  char* const begin = digits.data();
  const auto end = precision_ == Precision::half
                       ? std::to_chars(begin, begin + digits.size(), x)
                       : std::to_chars(begin, begin + digits.size(), static_cast<float>(x));
  std::string text(begin, end.ptr);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  if (precision_ == Precision::half) text += language_ == Language::glsl ? "hf" : "h";
  return text;
}

std::string Syntax::colour(std::string_view elements) const {
  return fmt::format("{}({})", type(true), elements);
}

std::string Syntax::variable(const std::string& name, bool colour, const std::string& value) const {
  if (language_ == Language::wgsl) return fmt::format("let {} = {};", name, value);
  return fmt::format("precise {} {} = {};", type(colour), name, value);
}

std::string Syntax::angle(const std::string& name, bool vector, const std::string& value) const {
  if (language_ == Language::wgsl) return fmt::format("let {} = {};", name, value);
  return fmt::format("{} {} = {};", type(vector, Precision::float_), name, value);
}

std::string Syntax::parameter(const std::string& type, const std::string& name) const {
  return language_ == Language::wgsl ? fmt::format("{}: {}", name, type)
                                     : fmt::format("{} {}", type, name);
}

std::string Syntax::function(const std::string& result,
                             const std::string& name,
                             const std::string& parameters) const {
  if (language_ == Language::wgsl) return fmt::format("fn {}({}) -> {}", name, parameters, result);
  return fmt::format("{} {}({})", result, name, parameters);
}

std::string Syntax::member(const std::string& type, const std::string& name) const {
  return parameter(type, name) + (language_ == Language::wgsl ? "," : ";");
}

std::string Syntax::made(const std::string& structure,
                         const std::string& elements,
                         const std::string& name) const {
  if (language_ == Language::slang)
    return fmt::format("{} {} = {{{}}};", structure, name, elements);
  if (language_ == Language::wgsl)
    return fmt::format("let {} = {}({});", name, structure, elements);
  return fmt::format("{0} {2} = {0}({1});", structure, elements, name);
}

std::string Syntax::less(const std::string& a, const std::string& b, bool colour) const {
  if (colour && language_ == Language::glsl) return fmt::format("lessThan({}, {})", a, b);
  return fmt::format("({} < {})", a, b);
}

std::string Syntax::joined(Trace::Kind kind,
                           const std::string& a,
                           const std::string& b,
                           bool colour) const {
  const bool both = kind == Trace::Kind::both;
  if (!colour) return fmt::format("({} {} {})", a, both ? "&&" : "||", b);
  switch (language_) {
    case Language::wgsl:
      return fmt::format("({} {} {})", a, both ? "&" : "|", b);
    case Language::slang:
      return fmt::format("{}({}, {})", both ? "and" : "or", a, b);
    case Language::glsl:
      break;
  }
  // Vectors of booleans have no && there.
  return both ? fmt::format("bvec3(uvec3({}) & uvec3({}))", a, b)
              : fmt::format("bvec3(uvec3({}) | uvec3({}))", a, b);
}

std::string Syntax::opposite(const std::string& mask, bool colour) const {
  if (colour && language_ == Language::glsl) return fmt::format("not({})", mask);
  return fmt::format("!{}", mask);
}

std::string Syntax::choice(const std::string& mask,
                           const std::string& a,
                           const std::string& b,
                           bool colour) const {
  switch (language_) {
    case Language::wgsl:
      return fmt::format("select({}, {}, {})", b, a, mask);
    case Language::slang:
      return fmt::format("select({}, {}, {})", mask, a, b);
    case Language::glsl:
      break;
  }
  if (colour) return fmt::format("mix({}, {}, {})", b, a, mask);
  return fmt::format("({} ? {} : {})", mask, a, b);
}

std::string Syntax::from_float(const std::string& x) const {
  if (precision_ == Precision::float_) return x;
  return fmt::format("{}({})", type(false), x);
}

}  // namespace gonio::shader
