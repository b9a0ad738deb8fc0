// Which direction or cosine an argument stands for.
#include "foreign/directions.h"

#include <array>

#include "foreign/written.h"

namespace gonio::foreign {
namespace {

TEST(Directions, CosinesAreKnownByTheirUsualNames) {
  SKIP_WITHOUT_SHADERS;
  for (const std::string noh :
       {"NoH", "NdotH", "dotNH", "n_dot_h", "NH", "HdotN", "costhetah", "cos_theta_m"}) {
    const Written w("// alpha 0.01 1 0.2\nfloat D(float " + noh + ", float alpha) { return " + noh +
                    " * alpha; }\n");
    const auto f = w.function();
    EXPECT_EQ(f.stands, Stands::distribution) << noh;
    ASSERT_EQ(f.parameters.size(), 1U) << noh;
    EXPECT_EQ(f.parameters[0].name, "alpha");
    EXPECT_EQ(f.parameters[0].start, 0.2);
    EXPECT_EQ(f.line, 2);
  }
}

TEST(Directions, DirectionsAreKnownWhateverSpaceTheirNamesSay) {
  SKIP_WITHOUT_SHADERS;
  for (const auto& [n, l, v] :
       {std::array<std::string, 3>{"normalWS", "lightDirectionWS", "viewDirectionWS"},
        {"world_normal", "to_light", "eyeVec"},
        {"nrm", "lightVector", "view_dir_vs"}}) {
    const Written w("float f(vec3 " + n + ", vec3 " + l + ", vec3 " + v + ") { return dot(" + n +
                    ", normalize(" + l + " + " + v + ")); }\n");
    const auto f = w.function();
    EXPECT_TRUE(f.parameters.empty()) << n << f.parameters[0].name;
    ASSERT_EQ(f.arguments.size(), 3U);
    EXPECT_EQ(f.arguments[1].stands_for, "L") << l;
  }
}

TEST(Directions, ARoleIsAParametersAndARefusalNamesAllRoles) {
  SKIP_WITHOUT_SHADERS;
  const Written w(
      "// k 0 1 0.5\nfloat f(vec3 L, vec3 V, vec3 N, vec3 t, float k) { return t.x * k * dot(N, "
      "normalize(L + V)); }\n");
  EXPECT_EQ(w.function("{argument.k=f0;argument.t=basecolor}").parameters.size(), 2U);
  EXPECT_HAS(w.refused("{argument.k=colour}", Exit::usage),
             "of a parameter its role: f0, alpha, roughness, smoothness");
}

TEST(Directions, AnArgumentIsWhatItsReaderSays) {
  SKIP_WITHOUT_SHADERS;
  const Written w("// k 0 1\nfloat D(float c, float k) { return c * k; }\n");
  EXPECT_EQ(w.function().parameters.size(), 2U);  // c is one, too
  const auto f = w.function("{argument.c=noh}");
  EXPECT_EQ(f.parameters.size(), 1U);
  EXPECT_EQ(f.stands, Stands::distribution);
  EXPECT_HAS(w.refused("{argument.d=noh}", Exit::usage), "no argument 'd'");
  EXPECT_HAS(w.refused("{argument.c=up}", Exit::usage), "expected nol, nov");
}

}  // namespace
}  // namespace gonio::foreign
