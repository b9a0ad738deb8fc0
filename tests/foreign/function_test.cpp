// Functions of people's files: their parameters, what is refused and at which line.
#include "foreign/function.h"

#include <cmath>

#include "base/sha256.h"
#include "foreign/written.h"

namespace gonio::foreign {
namespace {

using test::Folder;
using test::refusal;

TEST(Function, BoundsAreReadAsGonioWritesThem) {
  SKIP_WITHOUT_SHADERS;
  const Written w(
      "// parameter alpha in [0.05, 0.5]: width of the lobe\nfloat D(float NoH, float alpha) { "
      "return alpha * NoH; }\n");
  const auto f = w.function();
  ASSERT_EQ(f.parameters.size(), 1U);
  EXPECT_TRUE(f.parameters[0].bounded);
  EXPECT_EQ(f.parameters[0].range.low, 0.05);
  EXPECT_EQ(f.parameters[0].range.high, 0.5);
}

TEST(Function, ACommentWithOneValueForBothBoundsFixesAParameter) {
  SKIP_WITHOUT_SHADERS;
  const Written w("// f90 0.5 0.5 0.5\nfloat F(float VoH, float f90) { return f90 * VoH; }\n");
  const auto f = w.function();
  EXPECT_TRUE(f.parameters.empty());
  EXPECT_EQ(value_of(f, {}, {1, 1, 1, 1})[0], 0.5);
}

TEST(Function, AColourThatEachChannelReadsForItselfIsOneParameter) {
  SKIP_WITHOUT_SHADERS;
  const Written own("vec3 f(vec3 L, vec3 V, vec3 kd, vec3 N) { return kd / 3.14159265358979; }\n");
  const auto f = own.function();
  ASSERT_EQ(f.parameters.size(), 1U);
  EXPECT_TRUE(f.parameters[0].per_channel);
  EXPECT_EQ(f.programs.size(), 1U);
  const Written mixed(
      "vec3 f(vec3 L, vec3 V, vec3 kd) { return kd / 3.0 + vec3(dot(kd, vec3(0.1))); }\n");
  const auto g = mixed.function();
  ASSERT_EQ(g.parameters.size(), 3U);
  EXPECT_EQ(g.parameters[1].name, "kd_g");
  EXPECT_EQ(g.programs.size(), 3U);
  const auto v = value_of(g, {0.3, 0.6, 0.9}, {});
  EXPECT_NEAR(v[2], 0.3 + 0.18, 1e-15);
}

TEST(Function, ConstantsOfGlslKeepTheirDigitsAndThoseOfHlslAreFloats) {
  SKIP_WITHOUT_SHADERS;
  const std::string body = "float f(float NoH) { return NoH * 0.1; }\n";
  const auto a = Written(body).function(), b = Written(body, "my.hlsl").function();
  const std::array<double, 11> one{1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(value_of(a, {}, one)[0], 0.1);
  EXPECT_EQ(value_of(b, {}, one)[0], static_cast<double>(0.1F));
  EXPECT_TRUE(b.float_constants);
}

TEST(Function, AnExplorersFileHasItsBoundsAndItsBoolsAreKnown) {
  SKIP_WITHOUT_SHADERS;
  const Written w(
      "analytic\n::begin parameters\ncolor tint 0.2 0.4 0.6\nfloat n 1 100 20\nbool halved "
      "1\n::end "
      "parameters\n::begin shader\nvec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y) {\n  float s "
      "= "
      "pow(max(0.0, dot(N, normalize(L + V))), n);\n  return tint * (halved ? s / 2.0 : "
      "s);\n}\n::end "
      "shader\n",
      "my.brdf");
  const auto f = w.function();
  ASSERT_EQ(f.parameters.size(), 2U);
  EXPECT_EQ(f.parameters[0].name, "tint");
  EXPECT_EQ(f.parameters[0].colour, (std::array{0.2, 0.4, 0.6}));
  EXPECT_EQ(f.parameters[1].range.high, 100);
  EXPECT_EQ(f.line, 8);
  const auto at = [&](const std::string& rest) {
    return value_of(w.function(rest), {1, 2},
                    {0.8, 0.8, 0.9, 0.8, 0.19, 0, 0.435889894354067, 0, 0, 0, 0})[0];
  };
  EXPECT_NEAR(2 * at(""), at("{halved=0}"), 1e-15);
  EXPECT_HAS(Written("::begin parameters\nfloat n 1\n::end parameters\n", "a.brdf").refused(),
             "line 2");
  EXPECT_HAS(Written("::begin parameters\n::end parameters\n", "a.brdf").refused(), "no shader");
}

TEST(Function, VariablesThatItDoesNotReadAreNoArguments) {
  SKIP_WITHOUT_SHADERS;
  const Written w(
      "uniform vec3 l, v;\nfloat f(vec3 L, vec3 N) { return dot(L, N) * l.z; }\nfloat D(float NoH) "
      "{ return NoH + 0.0 * dot(vec3(0.0), v); }\n");
  for (const auto& a : w.function(":f").arguments) EXPECT_NE(a.name, "l") << "L is the same";
}

TEST(Function, AStructOfFourNumbersIsNoColour) {
  SKIP_WITHOUT_SHADERS;
  const Written w(
      "struct A { float a, b, c, d; };\nA angles(vec3 N, vec3 L, vec3 V) { A x; x.a = dot(N, L); "
      "x.b = dot(N, V); x.c = 1.0; x.d = 1.0; return x; }\n"
      "float f(float NoL, float NoV, float NoH) { return 0.1 * NoL; }\n");
  EXPECT_EQ(list_functions(w.path).size(), 1U);
}

TEST(Function, DeclarationsBetweenStagesAreReadHoweverTheyAreWritten) {
  SKIP_WITHOUT_SHADERS;
  const Written w(
      "#version 450\nlayout(location = 0) in vec3 vN; layout(location = 0) out vec4 o;  // in; "
      "out\n"
      "in highp vec3 vL, vV; flat out vec4 p;\nfloat D(in float NoH) { return NoH; }\n");
  EXPECT_EQ(w.function(":D").stands, Stands::distribution);
  EXPECT_HAS(
      Written("layout(location = 0) out vec4 o;\nfloat D(float NoH) {\n  return NoH }\n").refused(),
      "line 3");
}

TEST(Function, AVariableThatOneBranchWroteHasNoValueElsewhere) {
  SKIP_WITHOUT_SHADERS;
  const Written w("float f(float NoL) {\n  float x;\n  if (NoL > 0.5) x = NoL;\n  return x;\n}\n");
  const auto f = w.function("{includes=nothing}");
  ASSERT_EQ(f.notes.size(), 1U);
  EXPECT_EQ(f.notes[0].line, 4);
  std::array<double, 11> angles{0.75};
  EXPECT_EQ(value_of(f, {}, angles)[0], 0.75);
  angles[0] = 0.25;
  EXPECT_TRUE(std::isnan(value_of(f, {}, angles)[0]));
  const Written both(
      "float f(float NoL) {\n  float x;\n  if (NoL > 0.5) x = NoL; else x = 1.0;\n  return "
      "x;\n}\n");
  EXPECT_TRUE(both.function("{includes=nothing}").notes.empty());
}

TEST(Function, RefusalsNameThePersonsLine) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& body, const std::string& before = "") {
    return Written(before + "float f(float NoL, float a) {\n" + body + "}\n").refused(":f");
  };
  EXPECT_HAS(of("  return b;\n"), "line 2");
  EXPECT_HAS(of("  return f(NoL, a);\n"), "line 1: found recursion: f calls itself");
  EXPECT_HAS(of("  return h(a);\n",
                "float h(float x);\nfloat g(float x) { return h(x); }\nfloat h(float x) {\n  "
                "return g(x);\n}\n"),
             "found recursion");
  EXPECT_HAS(of("  return h(a);\n",
                "float h(float x);\nfloat g(float x) { return h(x); }\nfloat h(float x) {\n  "
                "return g(x);\n}\n"),
             "line ");
  const auto slope = of("  return dFdx(NoL);\n");
  EXPECT_HAS(slope, "line 2: found 'dFdx' : a difference between pixels");
  EXPECT_EQ(slope.find("GL_NV"), slope.npos) << slope;
  EXPECT_HAS(of("  float x[50000];\n  x[1] = a;\n  return x[1];\n"), "line 2: found an array of");
  EXPECT_HAS(of("  float x = a;\n  while (x > 0.1) x *= 0.5;\n  return x;\n"),
             "line 3: found a loop that");
  EXPECT_HAS(of("  return texture(t, vec2(NoL)).x;\n", "uniform sampler2D t;\n"),
             "a texture is read");
  EXPECT_EQ(Written("uniform sampler2D t;\nfloat g() { return texture(t, vec2(0.5)).x; }\nfloat "
                    "f(float NoL) { return NoL; }\n")
                .function(":f")
                .line,
            3);
  EXPECT_HAS(Written("float f(float NoL) { return NoL").refused(), "the end of the text");
  EXPECT_HAS(of("  discard;\n"), "line 2: found 'discard' : a pixel's shader has it");
  EXPECT_HAS(of("  int i = int(NoL * 3.0);\n  return float(i);\n"), "line 2: found an integer");
  EXPECT_HAS(of("  float x[3];\n  x[5] = a;\n  return x[0];\n"), "line 3");
  EXPECT_HAS(of("  return a;\n", "#include \"other.glsl\"\n"), "line 1");
  EXPECT_HAS(of("  float x;\n  return x;\n"), "never written");
  EXPECT_HAS(Written("void f() {}\n").refused(), "no function");
  EXPECT_HAS(Written("float f(float NoL) { return NoL; }\n").refused(":g", Exit::usage), "f");
  EXPECT_HAS(Written("float g(float n) { return n; }\nfloat f(float n) { return n; }\n")
                 .refused("", Exit::usage),
             "which function? it has: f, g");
  EXPECT_HAS(Written(std::string("float f\0", 8)).refused(), "no text");
  EXPECT_HAS(Written("not words", "my.spv").refused(), "SPIR-V");
  EXPECT_HAS(refusal([] { read_function(parse_name("nowhere.glsl")); }), "nowhere.glsl");
  EXPECT_HAS(
      Written("float f(float NoL, int n) { return NoL * float(n); }\n").refused("", Exit::usage),
      "n=1");
}

TEST(Function, AMainIsListedWithWhatItCannotBeRunFor) {
  SKIP_WITHOUT_SHADERS;
  const auto main_of = [](const std::string& text, const std::string& name) {
    const Written w(text, name);
    for (auto& e : list_functions(w.path))
      if (e.function == "main") {
        e.refused = w.refused(":main");
        return e;
      }
    return Entry{};
  };
  const std::string d = "float D(float NoH) { return NoH; }\n";
  const auto textured = main_of(
      "uniform sampler2D tex;\nin vec3 N; in vec3 L; in vec3 V; in vec2 uv;\nout vec4 color;\n" +
          d + "void main() {\n  color = vec4(texture(tex, uv).rgb * D(dot(N, L)), 1.0);\n}\n",
      "my.frag");
  EXPECT_HAS(textured.refused, "line 6: found a texture is read");
  EXPECT_EQ(textured.line, 5);
  const auto plain_main = main_of("in vec3 N; in vec3 L;\nout vec4 color;\n" + d +
                                      "void main() {\n  color = vec4(D(dot(N, L)));\n}\n",
                                  "my.frag");
  EXPECT_HAS(plain_main.refused, "line 4: found no value that it returns");
  const auto hlsl = main_of(
      "Texture2D tex; SamplerState smp;\n" + d +
          "float4 main(float3 N : NORMAL, float3 L : TEXCOORD0, float3 V : TEXCOORD1, Texture2D t) "
          ": SV_Target {\n  return float4(t.Sample(smp, V.xy).rgb * D(dot(N, L)), 1);\n}\n",
      "my.hlsl");
  EXPECT_HAS(hlsl.refused, "line 3: found a texture");
  const Written taken("vec3 f(vec3 N, vec3 L, sampler2D t) {\n  return texture(t, N.xy).rgb;\n}\n");
  EXPECT_HAS(taken.refused(":f"), "line 1: found a texture");
  EXPECT_HAS(Written("void main() {}\n").refused(":main"), "no value that it returns");
}

TEST(Function, WhatIsTooMuchForTheCompilerIsOneLine) {
  SKIP_WITHOUT_SHADERS;
  std::string sum = "float f(float NoL) { return NoL";
  for (int k = 0; k < 1 << 17; ++k) sum += "+NoL";
  EXPECT_NE(Written(sum + "; }\n").refused(), "");
  std::string branches = "float f(float NoL, float a) {\n  float x = 0.0;\n";
  for (int k = 0; k < 20000; ++k) branches += "  if (NoL > a) x += a;\n";
  EXPECT_HAS(
      Written("float g(float NoL) { return NoL; }\n" + branches + "  return x;\n}\n").refused(),
      "line 3: found more than 400000 words");
  EXPECT_HAS(Written(std::string((1 << 20) + 1, ' ')).refused(), "");
}

TEST(Function, MoreThanSixteenParametersAreRefusedAndCanBeFixed) {
  SKIP_WITHOUT_SHADERS;
  std::string head = "float f(float NoL", body = "0.0", fixed;
  for (int k = 0; k < 17; ++k) {
    head += ", float p" + std::to_string(k);
    body += " + p" + std::to_string(k);
  }
  const Written w(head + ") { return NoL * (" + body + "); }\n");
  EXPECT_HAS(w.refused(), "17 parameters");
  EXPECT_EQ(w.function("{p3=0.5}").parameters.size(), 16U);
}

TEST(Function, SpirvIsReadAsItIs) {
  SKIP_WITHOUT_SHADERS;
  const std::string text =
      "float f(float NoH, float a) { float s = 0.0; for (int i = 0; i < 4; ++i) { if (s > a) "
      "break; s += NoH; } return s; }\n";
  const auto words = compile(source_of("my.glsl", text));
  const Written spv({reinterpret_cast<const char*>(words.data()), words.size() * 4}, "my.spv");
  const auto f = spv.function(":f{a=0.9}"), g = Written(text).function(":f{a=0.9}");
  for (const double noh : {0.2, 0.25, 0.5, 0.95}) {
    std::array<double, 11> angles{};
    angles[2] = noh;
    EXPECT_EQ(value_of(f, {}, angles), value_of(g, {}, angles));
  }
  auto damaged = words;
  damaged[7] ^= 0x30000U;
  EXPECT_NE(Written({reinterpret_cast<const char*>(damaged.data()), damaged.size() * 4}, "bad.spv")
                .refused(),
            "");
}

TEST(Function, SpirvOfEmptyStructsThatDoubleIsRefused) {
  SKIP_WITHOUT_SHADERS;
  const auto line = [](std::uint32_t times) {
    constexpr std::uint32_t function = 54, structure = 30;
    auto words = compile(source_of("my.glsl", "float f(float NoH) { return NoH; }\n"));
    std::size_t at = 5;
    while ((words[at] & 0xffffU) != function) at += words[at] >> 16U;
    std::vector<std::uint32_t> types{2U << 16U | structure, words[3]};
    for (; times > 0; --times) {
      const std::uint32_t before = words[3]++;
      types.insert(types.end(), {4U << 16U | structure, before + 1, before, before});
    }
    ++words[3];
    words.insert(words.begin() + static_cast<std::ptrdiff_t>(at), types.begin(), types.end());
    return Written({reinterpret_cast<const char*>(words.data()), words.size() * 4}, "my.spv")
        .refused();
  };
  EXPECT_EQ(line(15), "");
  EXPECT_HAS(line(16), "a struct of more than 65536 parts");
}

TEST(FunctionName, IsReadAndWritten) {
  EXPECT_HAS(refusal([] { parse_name("z\nint evil;\n.glsl"); }), "letters that cannot be seen");
  EXPECT_HAS(refusal([] { parse_name("z\x1b[31m.glsl:f"); }), "z\\x1b[31m.glsl");
  const auto n = parse_name("a/b.glsl:f{argument.x=noh;includes=pi;alpha=0.1,1,0.5}");
  EXPECT_EQ(n.file, "a/b.glsl");
  EXPECT_EQ(n.function, "f");
  EXPECT_EQ(n.reading.arguments.at("x"), "noh");
  EXPECT_EQ(text_of(n), "a/b.glsl:f{argument.x=noh;includes=pi;alpha=0.1,1,0.5}");
  EXPECT_EQ(parse_name(text_of(n)).reading, n.reading);
  EXPECT_TRUE(is_name("my.brdf"));
  EXPECT_TRUE(is_name("C:/my.hlsl:f"));
  EXPECT_FALSE(is_name("my.glsl:D/smith_ggx.correlated/schlick"));
  EXPECT_FALSE(is_name("fit.json"));
  for (const auto* bad :
       {"a.txt", "a.glsl:f{x}", "a.glsl:f{x=1,0}", "a.glsl:f{x=1", "a.glsl:f{x=q}"})
    EXPECT_NE(refusal([&] { parse_name(bad); }, Exit::usage), "") << bad;
}

TEST(Function, AFileMeansItsOnlyWholeModelAndOneOfSeveralIsToBeNamed) {
  SKIP_WITHOUT_SHADERS;
  const std::string masking =
      "float smith(vec3 n, vec3 v, vec3 l) { return dot(n, v) * dot(n, l); }\n";
  const std::string first = "float a(vec3 n, vec3 v, vec3 l) { return smith(n, v, l) + 1.0; }\n";
  EXPECT_EQ(Written(masking + first).function().name.function, "a") << "what it calls is a part";
  const auto why =
      Written(masking + first + "float b(vec3 n, vec3 v, vec3 l) { return dot(n, l) + 2.0; }\n")
          .refused("", Exit::usage);
  EXPECT_HAS(why, "which function? its whole models are a, b; name one, as ");
  EXPECT_EQ(Written("float g(vec3 n, vec3 v, vec3 l) { return dot(n, v); }\n" + masking +
                    "float brdf(vec3 n, vec3 v, vec3 l) { return dot(n, l); }\n")
                .function()
                .name.function,
            "brdf");
}

TEST(Function, OneWhoseNameALaterOneHasIsListedAsSuch) {
  SKIP_WITHOUT_SHADERS;
  const Written w(
      "float D(float NoH, float a) { return a * NoH; }\nfloat D(float NoH, float ax, float ay) { "
      "return D(NoH, ax * ay); }\n");
  const auto all = list_functions(w.path);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_TRUE(all[0].is_shadowed);
  EXPECT_HAS(all[0].refused, "line 1: found a function whose name another has");
  EXPECT_HAS(all[0].refused, "D means the one in line 2");
  EXPECT_FALSE(all[1].is_shadowed);
}

TEST(Function, AMarkOfUtf8BeforeATextIsNoPartOfIt) {
  SKIP_WITHOUT_SHADERS;
  EXPECT_EQ(Written("\xEF\xBB\xBF// a 0 1 0.3\nfloat D(float NoH, float a) { return a * NoH; }\n")
                .function()
                .parameters[0]
                .start,
            0.3);
}

TEST(Function, ChannelsThatMixAColourWithANumberAreOneProgram) {
  SKIP_WITHOUT_SHADERS;
  const auto f = Written(
                     "// base 0 1 0.5\n// metallic 0 1 0\nvec3 f(vec3 n, vec3 v, vec3 l, vec3 "
                     "base, float metallic) { return mix(vec3(0.04), base, metallic); }\n")
                     .function();
  EXPECT_EQ(f.programs.size(), 1U);
  const auto apart = Written(
                         "// base 0 1 0.5\nvec3 f(vec3 n, vec3 v, vec3 l, vec3 base) { return "
                         "base * vec3(0.1, 0.2, 0.1); }\n")
                         .function();
  EXPECT_EQ(apart.programs.size(), 3U);
}

}  // namespace
}  // namespace gonio::foreign
