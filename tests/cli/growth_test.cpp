// Work that a file asks for grows as its size: instructions are counted, by valgrind, where it is
// there.
#include <functional>

#include "cli/program.h"

namespace gonio::test {
namespace {

/// Instructions of a run.
double instructions(const Folder& f, const std::string& words) {
  const auto o = gonio(f, words,
                       "GONIO_INSTRUCTION_SET=sse2 valgrind --tool=cachegrind --cache-sim=no "
                       "--cachegrind-out-file=/dev/null --log-file=.count ");
  EXPECT_LE(o.code, 3) << o.err;
  const std::string log = read_bytes(f / ".count"), before = "refs:";
  std::filesystem::remove(f / ".count");
  const auto at = log.find(before);
  EXPECT_NE(at, log.npos) << log;
  std::string digits;
  for (const char c : log.substr(at + before.size(), log.find('\n', at) - at))
    if (c >= '0' && c <= '9') digits += c;
  return std::stod("0" + digits);
}

/// The step from 2 n to 4 n costs twice the step from n to 2 n where the work is linear, and four times where it is quadratic.
void expect_linear_work(const std::function<std::string(const Folder&, int)>& words_of, int n) {
  if (std::system("valgrind --version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "valgrind, which counts instructions, is not there";
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "valgrind runs no program that has the sanitizer";
#endif
  const Folder f;
  const auto work = [&](int k) { return instructions(f, words_of(f, k)); };
  const double one = work(n), two = work(2 * n), four = work(4 * n);
  EXPECT_GT(two, one) << "the size is seen";
  EXPECT_LT(four - two, 2.8 * (two - one)) << one << " " << two << " " << four;
}
void expect_linear(const std::function<void(const Folder&, int)>& write,
                   const std::string& words,
                   int n) {
  expect_linear_work(
      [&](const Folder& f, int k) {
        write(f, k);
        return words;
      },
      n);
}
void expect_linear_words(const std::function<std::string(int)>& words, int n) {
  expect_linear_work([&](const Folder&, int k) { return words(k); }, n);
}

std::string repeated(int n, const std::function<std::string(int)>& text) {
  std::string all;
  for (int i = 0; i < n; ++i) all += text(i);
  return all;
}

TEST(Growth, OfTablesThatShareANameIsLinear) {
  expect_linear(
      [](const Folder& f, int n) {
        std::filesystem::create_directory(f / "r");
        f.write("l", repeated(n, [](int i) { return "d" + std::to_string(i) + "/a.csv\n"; }));
      },
      "gather r @l", 500);
}

TEST(Growth, OfTheColumnsOfAnAstmFileIsLinear) {
  expect_linear(
      [](const Folder& f, int n) {
        f.write("t", "VARS theta_i,phi_i,theta_s,phi_s" +
                         repeated(n, [](int i) { return ",c" + std::to_string(i); }) +
                         "\n0.5,0,0.4,3" + repeated(n, [](int) { return ",0.1"; }) + "\n");
      },
      "inspect t", 500);
}

TEST(Growth, OfTheColumnsOfACsvFileIsLinear) {
  expect_linear(
      [](const Folder& f, int n) {
        f.write("t.csv", "theta_i,theta_o" +
                             repeated(n, [](int i) { return ",f_" + std::to_string(i); }) +
                             "\n30,20" + repeated(n, [](int) { return ",0.1"; }) + "\n");
      },
      "columns t.csv", 1000);
}

/// Where each channel has an index of its own, each has valleys of its own.
TEST(Growth, OfIndicesWithTheChannelsOfATableIsLinear) {
  expect_linear(
      [](const Folder& f, int n) {
        f.write("t.csv",
                "theta_i,theta_o" + repeated(n, [](int i) { return ",f_" + std::to_string(i); }) +
                    "\n" + repeated(6, [n](int row) {
                      return "30," + std::to_string(15 * row) +
                             repeated(n,
                                      [row](int i) {
                                        return "," + std::to_string(0.1 + 0.01 * row + 1e-4 * i);
                                      }) +
                             "\n";
                    }));
      },
      "fit t.csv --model ggx/smith_ggx.correlated/dielectric --fix alpha=0.5 --certificate none"
      " --jobs 1 -o fit.json",
      64);
}

TEST(Growth, OfAFitWithTheChannelsOfATableIsLinear) {
  expect_linear(
      [](const Folder& f, int n) {
        f.write("t.csv", "theta_i,theta_o" +
                             repeated(n, [](int i) { return ",f_" + std::to_string(i); }) + "\n" +
                             repeated(6, [n](int row) {
                               return "30," + std::to_string(10 * row) +
                                      repeated(n, [](int) { return ",0.1"; }) + "\n";
                             }));
      },
      "fit t.csv --model lambert --jobs 1 -o fit.json", 150);
}

TEST(Growth, OfTheFunctionsOfAShaderIsLinear) {
  expect_linear(
      [](const Folder& f, int n) {
        f.write("m.glsl", repeated(n, [](int i) {
                  const auto k = std::to_string(i);
                  return "float D" + k + "(float NoH, float alpha) { return NoH * " + k +
                         ".5 + alpha; }\n";
                }));
      },
      "models m.glsl --json", 100);
}

TEST(Growth, OfTheParametersThatAShaderDeclaresIsLinear) {
  expect_linear(
      [](const Folder& f, int n) {
        f.write("m.glsl",
                "float D(float NoH, float alpha) { return NoH + alpha; }\n" +
                    repeated(n, [](int i) { return "// a" + std::to_string(i) + " 0.1 1 0.2\n"; }));
      },
      "models m.glsl --json", 1500);
}

TEST(Growth, OfTheHyphensOfAnExportedFitIsLinear) {
  expect_linear(
      [](const Folder& f, int n) {
        f.write("fit.json", R"({"schema": "gonio.fit/1", "model": "lambert", "channels": ["f"],
          "note": ")" + std::string(static_cast<std::size_t>(n), '-') +
                                R"(", "parameters": {"kd": {"value": 0.2}}})");
      },
      "export fit.json --to mitsuba -o m.xml", 100'000);
}

/// A scene of objects of one material.
std::string scene_of(const std::string& objects) {
  return R"({"schema": "gonio.scene/1", "materials": {"m": {"model": "lambert"}}, "objects": [)" +
         objects +
         R"(], "lights": [{"type": "directional", "direction": [0, 0, 1], "irradiance": [1, 1, 1]}],)"
         R"( "view": {"position": [0, 0, 10], "target": [0, 0, 0], "fov_deg": 20},)"
         R"( "tolerance": {"metric": "delta_e_2000", "quantile": 0.99, "limit": 1, "max": 4}})";
}

TEST(Growth, OfSmallSpheresIsLinear) {
  expect_linear(
      [](const Folder& f, int n) {
        f.write("s.json", scene_of(repeated(n, [](int i) {
                  return std::string(i > 0 ? "," : "") +
                         R"({"shape": "sphere", "material": "m", "radius": 0.05, "center": [)" +
                         std::to_string(i * 0.001) + ", 0, 0]}";
                })));
      },
      "render s.json --width 4 --height 4 --samples 1 --jobs 1 -o p.exr", 500);
}

TEST(Growth, OfTrianglesThatNearlyCoincideIsLinear) {
  expect_linear(
      [](const Folder& f, int n) {
        std::string positions, normals;
        const auto put = [](std::string& to, std::initializer_list<float> x) {
          for (const float v : x) to.append(reinterpret_cast<const char*>(&v), sizeof v);
        };
        for (int i = 0; i < n; ++i) {
          const float z = 1e-6F * static_cast<float>(i);
          put(positions, {-1, -1, z, 1, -1, z, 0, 1, z});
          put(normals, {0, 0, 1, 0, 0, 1, 0, 0, 1});
        }
        f.write("b.bin", positions + normals);
        const std::string bytes = std::to_string(positions.size()), count = std::to_string(3 * n);
        const std::string vectors =
            R"(, "componentType": 5126, "count": )" + count + R"(, "type": "VEC3"})";
        f.write("g.gltf",
                R"({"asset": {"version": "2.0"}, "buffers": [{"uri": "b.bin", "byteLength": )" +
                    std::to_string(2 * positions.size()) +
                    R"(}], "bufferViews": [{"buffer": 0, "byteLength": )" + bytes +
                    R"(}, {"buffer": 0, "byteOffset": )" + bytes + R"(, "byteLength": )" + bytes +
                    R"(}], "accessors": [{"bufferView": 0)" + vectors + R"(, {"bufferView": 1)" +
                    vectors +
                    R"(], "meshes": [{"primitives": [{"attributes": {"POSITION": 0,)"
                    R"( "NORMAL": 1}}]}], "nodes": [{"name": "n", "mesh": 0}]})");
        f.write("s.json",
                scene_of(R"({"shape": "mesh", "gltf": "g.gltf", "node": "n", "material": "m"})"));
      },
      "render s.json --width 4 --height 4 --samples 1 --jobs 1 -o p.exr", 2000);
}

/// Specs that differ, of models that exist.
std::string specs(int n) {
  constexpr const char *diffuse[] = {"lambert", "eon", "oren_nayar", "disney", "lambert.coupled"},
                       *ndf[] = {"ggx", "beckmann", "gtr"},
                       *fresnel[] = {"schlick", "dielectric", "conductor", "schlick.f90",
                                     "schlick.weighted"};
  return repeated(n, [&](int i) {
    std::string spec = std::string(i ? "," : "") + diffuse[i % 5];
    for (int k = 1 + i / 5, lobe = 0; lobe == 0 || k > 0; k /= 15, ++lobe)
      spec += std::string("+") + ndf[k % 3] + "/smith_ggx.correlated/" + fresnel[k / 3 % 5];
    return spec;
  });
}

TEST(Growth, OfModelsThatAreAskedIsLinear) {
  expect_linear_words([](int n) { return "fit none.csv --models " + specs(n); }, 150);
}

TEST(Growth, OfBoundsThatAreTooManyIsLinear) {
  expect_linear_words(
      [](int n) {
        return "fit none.csv --bounds" +
               repeated(n, [](int i) { return " a" + std::to_string(i) + "=0,1"; });
      },
      1000);
}

TEST(Growth, OfAMaskThatIsTooLongIsLinear) {
  expect_linear_words(
      [](int n) {
        return "inspect none.csv --mask 'f > 1" +
               repeated(n, [](int i) { return " or theta_o > " + std::to_string(i); }) + "'";
      },
      1000);
}

TEST(Growth, OfColumnsUnderPatternsIsLinear) {
  expect_linear(
      [](const Folder& f, int n) {
        f.write("t.csv", "theta_i,theta_o" +
                             repeated(n, [](int i) { return ",c" + std::to_string(i); }) +
                             "\n30,20" + repeated(n, [](int) { return ",0.1"; }) + "\n");
      },
      "columns t.csv --map" + repeated(60,
                                       [](int i) {
                                         const auto k = std::to_string(i);
                                         return " f_a" + k + "_*=c" + k + "*";
                                       }),
      2000);
}

}  // namespace
}  // namespace gonio::test
