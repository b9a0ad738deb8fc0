#include "shader/language.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace gonio::shader {
namespace {

/// Keywords, reserved words and types of GLSL, WGSL, HLSL and Slang, and functions of GLSL, each between spaces.
constexpr std::string_view kept_words =
    " abs abstract acos acosh active alias alignas alignof all and any"
    " AppendStructuredBuffer array as asin asinh asm asm_fragment associatedtype async atan"
    " atanh atomic atomic_uint attribute auto await become BlendState bool bool1 bool2"
    " bool3 bool4 break Buffer buffer bvec2 bvec3 bvec4 ByteAddressBuffer case cast catch"
    " cbuffer ceil centroid clamp class co_await co_return co_yield coherent column_major"
    " common compile compile_fragment compute ComputeShader concept const const_assert"
    " const_cast ConstantBuffer consteval constexpr constinit ConsumeStructuredBuffer"
    " continue continuing cos cosh crate cross debugger decltype default defer degrees"
    " delete demote demote_to_helper DepthStencilState DepthStencilView determinant"
    " diagnostic Differential discard distance dmat2 dmat3 dmat4 do DomainShader dot double"
    " double2 double3 double4 dvec2 dvec3 dvec4 dword dynamic_cast dynamic_uniform each"
    " else enable enum equal exp exp2 expand explicit export extends extension extern"
    " external f16 f16vec2 f16vec3 f16vec4 f32 faceforward fallthrough false filter final"
    " finally fixed flat float float1 float16_t float2 float2x2 float3 float32_t float3x3"
    " float4 float4x4 float64_t floor fma fn for fract fragment frexp friend from func"
    " fvec2 fvec3 fvec4 fxgroup GeometryShader get globallycoherent goto greaterThan"
    " groupshared half half1 half2 half3 half4 highp Hullshader hvec2 hvec3 hvec4 i32 if"
    " image2D image3D imageCube impl implements import in indices init inline inout input"
    " InputPatch instanceof int int1 int16_t int2 int3 int32_t int4 int64_t int8_t"
    " interface invariant inverse inversesqrt is isampler2D ivec2 ivec3 ivec4 layout ldexp"
    " length lerp lessThan let line lineadj linear LineStream log log2 long loop lowp macro"
    " macro_rules main mat2 mat2x2 mat2x3 mat2x4 mat3 mat3x2 mat3x3 mat3x4 mat4 mat4x2"
    " mat4x3 mat4x4 match matrix max mediump meta min min10float min12int min16float"
    " min16int min16uint mix mod module move mut mutable namespace new nil no_diff noexcept"
    " noinline nointerpolation non_coherent noncoherent noperspective normalize not"
    " notEqual NULL null nullptr of operator or out outerProduct output OutputPatch"
    " override package packoffset ParameterBlock partition pass patch payload pixelfragment"
    " PixelShader point PointStream pow precise precision premerge primitives priv private"
    " property protected ptr pub public radians RasterizerState readonly ref reflect"
    " refract regardless register reinterpret_cast RenderTargetView require requires"
    " resource restrict return round row_major RWBuffer RWByteAddressBuffer"
    " RWStructuredBuffer RWTexture1D RWTexture2D RWTexture3D sample sampler sampler1D"
    " sampler2D sampler3D SamplerComparisonState samplerCube SamplerState select Self self"
    " set shared short sign sin sinh sizeof smooth smoothstep snorm sqrt stateblock"
    " stateblock_state static static_assert static_cast std step string struct"
    " StructuredBuffer subpassInput subroutine super superp switch tan tanh target tbuffer"
    " technique technique10 technique11 template texture Texture1D texture1D Texture1DArray"
    " Texture2D texture2D Texture2DArray Texture2DMS Texture3D texture3D TextureCube"
    " textureCube This this thread_local throw throws trait transpose triangle triangleadj"
    " TriangleStream true trunc try type typedef typeid typename typeof u32 uint uint1"
    " uint16_t uint2 uint3 uint32_t uint4 uint64_t uint8_t uniform union unless unorm"
    " unsafe unsigned unsized use using uvec2 uvec3 uvec4 var varying vec2 vec3 vec4 vector"
    " vertex vertexfragment VertexShader virtual void volatile wgsl where while with"
    " workgroup writeonly yield ";

}  // namespace

bool is_kept_word(std::string_view name) {
  return name.starts_with("gl_") || kept_words.find(fmt::format(" {} ", name)) != kept_words.npos;
}

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
  return both ? fmt::format("mix(bvec3(false), {}, {})", b, a)
              : fmt::format("mix({}, bvec3(true), {})", b, a);
}

std::string Syntax::of_all_channels(const std::string& mask) const {
  switch (language_) {
    case Language::wgsl:
      return fmt::format("vec3<bool>({})", mask);
    case Language::slang:
      return fmt::format("bool3({})", mask);
    case Language::glsl:
      break;
  }
  return fmt::format("bvec3({})", mask);
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
