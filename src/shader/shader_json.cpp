// A shader as a document.
#include "base/json/describe.h"
#include "shader/shader.h"

namespace gonio {

template <>
struct Description<shader::Argument> {
  static constexpr auto fields() {
    using A = shader::Argument;
    return FieldList{field("name", &A::name, "in the source"),
                     field("colour", &A::colour, "one value a channel"),
                     field("legal", legal, "ends of its range; null of an angle")};
  }
  static std::optional<std::array<double, 2>> legal(const shader::Argument& a) {
    if (!a.about) return {};
    return std::array{a.about->legal.low, a.about->legal.high};
  }
};

template <>
struct Description<shader::ShaderDocument> {
  static constexpr auto fields() {
    using D = shader::ShaderDocument;
    using F = shader::TracedFormula;
    using W = shader::Writing;
    return FieldList{
        constant_text("schema", "gonio.shader/1"),
        field("id", at(&D::formula, &F::id), "term or map of the catalogue, or a model's spec"),
        field("language", at(&D::writing, &W::language), "glsl, wgsl or slang"),
        field("precision", at(&D::formula, &F::precision), "float or half"),
        field("function", function, "name of the function of cosines"),
        field("of_directions", of_directions,
              "name of the one of directions; null of a term or a map"),
        field("parameters", at(&D::formula, &F::parameters), "arguments, in their order"),
        field("angles", at(&D::formula, &F::angles),
              "arguments of the function of cosines after these"),
        field("constants", at(&D::formula, &F::known), "parameters that are folded in"),
        field("results", results,
              "what the function gives: the value, or a map's outputs, and derivatives"),
        field("operations", operations, "of the function of cosines, by kind"),
        field("remarks", at(&D::writing, &W::remarks), "of the header: the error and its evidence"),
        field("source", &D::source, "")};
  }
  static std::string function(const shader::ShaderDocument& d) {
    return function_of_cosines(d.formula, d.writing);
  }
  static std::optional<std::string> of_directions(const shader::ShaderDocument& d) {
    return d.formula.is_model ? std::optional(d.writing.name) : std::nullopt;
  }
  static std::vector<std::string> results(const shader::ShaderDocument& d) {
    std::vector<std::string> names;
    for (const auto& r : d.formula.results) names.push_back(r.name);
    return names;
  }
  static std::vector<std::pair<std::string, std::size_t>> operations(
      const shader::ShaderDocument& d) {
    std::vector<std::pair<std::string, std::size_t>> kinds;
    const auto counted = d.formula.operations();
    for (std::size_t k = 0; k < operation_names.size(); ++k)
      kinds.emplace_back(operation_names[k], counted.by_kind[k]);
    return kinds;
  }
};

namespace shader {

std::string to_json(const ShaderDocument& d) {
  return json_text(d);
}
std::string shader_schema() {
  return schema_text<ShaderDocument>("gonio shader");
}

}  // namespace shader
}  // namespace gonio
