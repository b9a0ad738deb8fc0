// Bits of a corpus of small functions: this program's translation against the compiler's of the
// same text.
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "foreign/compile.h"
#include "foreign/function.h"
#include "foreign/interpret.h"
#include "number/batch.h"
#include "number/dual.h"
#include "support.h"

namespace gonio::foreign {
namespace {

/// The words of GLSL that the corpus uses, over a number.
template <class real>
struct Words {
  struct vec3 {
    real x, y, z;
    explicit vec3(real v) : x(v), y(v), z(v) {}
    vec3(real a, real b, real c) : x(a), y(b), z(c) {}
    real& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
    vec3 zxy_() const { return {z, x, y}; }
    friend vec3 operator+(vec3 a, vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend vec3 operator-(vec3 a, vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend vec3 operator*(vec3 a, vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
    friend vec3 operator*(vec3 a, real s) { return {a.x * s, a.y * s, a.z * s}; }
    friend vec3 operator/(vec3 a, real s) { return {a.x / s, a.y / s, a.z / s}; }
    friend vec3 operator-(vec3 a) { return {-a.x, -a.y, -a.z}; }
  };
  static real min(real a, real b) { return b < a ? b : a; }
  static real max(real a, real b) { return a < b ? b : a; }
  static vec3 min(vec3 a, vec3 b) { return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)}; }
  static vec3 max(vec3 a, vec3 b) { return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)}; }
  static real clamp(real x, real a, real b) { return min(max(x, a), b); }
  static real mix(real a, real b, real t) { return a * (1 - t) + b * t; }
  static vec3 mix(vec3 a, vec3 b, real t) {
    return {mix(a.x, b.x, t), mix(a.y, b.y, t), mix(a.z, b.z, t)};
  }
  static real step(real edge, real x) { return x < edge ? real(0) : real(1); }
  static real smoothstep(real a, real b, real x) {
    const real t = clamp((x - a) / (b - a), 0, 1);
    return t * t * (3 - 2 * t);
  }
  static real sign(real x) { return real(0) < x ? real(1) : x < real(0) ? real(-1) : real(0); }
  static real abs(real x) { return max(x, -x); }
  static real fract(real x) { return x - std::floor(x); }
  static real mod(real a, real b) { return a - b * std::floor(a / b); }
  static real inversesqrt(real x) { return 1 / std::sqrt(x); }
  static real dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  static real length(vec3 a) { return std::sqrt(dot(a, a)); }
  static vec3 normalize(vec3 a) { return a / length(a); }
  static vec3 cross(vec3 a, vec3 b) {
    return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
  }
  static vec3 reflect(vec3 i, vec3 n) { return i - n * (2 * dot(n, i)); }
  static real atan(real y, real x) { return std::atan2(y, x); }
  static real atan(real x) { return std::atan(x); }
  static real sqrt(real x) { return std::sqrt(x); }
  static real floor(real x) { return std::floor(x); }
  static real roundEven(real x) { return std::nearbyint(x); }
  static real exp(real x) { return std::exp(x); }
  static real log(real x) { return std::log(x); }
  static real sin(real x) { return std::sin(x); }
  static real cos(real x) { return std::cos(x); }
  static real asin(real x) { return std::asin(x); }
  static real acos(real x) { return std::acos(x); }
};

template <class real>
struct Corpus : Words<real> {
  using typename Words<real>::vec3;
  using Words<real>::min;
  using Words<real>::max;
  using Words<real>::clamp;
  using Words<real>::mix;
  using Words<real>::step;
  using Words<real>::smoothstep;
  using Words<real>::sign;
  using Words<real>::abs;
  using Words<real>::fract;
  using Words<real>::mod;
  using Words<real>::inversesqrt;
  using Words<real>::dot;
  using Words<real>::length;
  using Words<real>::normalize;
  using Words<real>::cross;
  using Words<real>::reflect;
  using Words<real>::atan;
  using Words<real>::sqrt;
  using Words<real>::floor;
  using Words<real>::roundEven;
  using Words<real>::exp;
  using Words<real>::log;
  using Words<real>::sin;
  using Words<real>::cos;
  using Words<real>::asin;
  using Words<real>::acos;
#define float real
#define zxy zxy_()
#include "foreign/corpus.glsl"
#undef zxy
#undef float
};

const std::string& corpus_file() {
  static const std::string path = test::project_folder() + "/tests/foreign/corpus.glsl";
  return path;
}

template <class F>
std::vector<std::vector<F>> run_function(const std::string& name,
                                         const std::vector<std::vector<F>>& parameters,
                                         const std::vector<std::array<F, 11>>& angles) {
  const auto f =
      read_function(parse_name(corpus_file() + ":" + name + "{includes=nothing}"), Stands::lobe);
  std::vector<std::vector<F>> rows;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    std::vector<F> own;
    for (const auto& p : f.parameters) own.push_back(parameters[i][p.name == "a" ? 0 : 1]);
    auto& row = rows.emplace_back();
    for (const auto& p : f.programs) {
      Interpreter<F> run(p);
      run.set(own);
      run.run(
          1, [&](std::size_t k, std::size_t) { return angles[i][k]; },
          [&](std::size_t, std::size_t, F v) { row.push_back(v); });
    }
  }
  return rows;
}

template <class F>
void expect_bits_of_compiler() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.001, 0.999);
  std::vector<std::vector<F>> p;
  std::vector<std::array<F, 11>> angles;
  for (int i = 0; i < 200; ++i) {
    p.push_back({static_cast<F>(unit(random)), static_cast<F>(unit(random))});
    auto& a = angles.emplace_back();
    for (F& x : a) x = static_cast<F>(unit(random));
  }
  Corpus<F> c;
  const std::map<std::string, F (Corpus<F>::*)(F, F)> compiled{
      {"sums", &Corpus<F>::sums},           {"a_constant", &Corpus<F>::a_constant},
      {"a_branch", &Corpus<F>::a_branch},   {"both_sides", &Corpus<F>::both_sides},
      {"a_choice", &Corpus<F>::a_choice},   {"logic", &Corpus<F>::logic},
      {"a_loop", &Corpus<F>::a_loop},       {"a_way_out", &Corpus<F>::a_way_out},
      {"left_over", &Corpus<F>::left_over}, {"a_float_counter", &Corpus<F>::a_float_counter},
      {"a_table", &Corpus<F>::a_table},     {"roots", &Corpus<F>::roots},
      {"steps", &Corpus<F>::steps},         {"bounds", &Corpus<F>::bounds},
      {"halves", &Corpus<F>::halves},       {"remainders", &Corpus<F>::remainders},
      {"curves", &Corpus<F>::curves},       {"angles_of", &Corpus<F>::angles_of},
      {"calls", &Corpus<F>::calls},         {"by_reference", &Corpus<F>::by_reference},
  };
  for (const auto& [name, f] : compiled) {
    const auto rows = run_function<F>(name, p, angles);
    for (std::size_t i = 0; i < p.size(); ++i)
      EXPECT_EQ(rows[i][0], (c.*f)(p[i][0], p[i][1]))
          << name << " at " << p[i][0] << ' ' << p[i][1];
  }
  using vec3 = typename Corpus<F>::vec3;
  const std::map<std::string, vec3 (Corpus<F>::*)(vec3, vec3, vec3, F)> vectors{
      {"of_vectors", &Corpus<F>::of_vectors}, {"parts_of_vectors", &Corpus<F>::parts_of_vectors}};
  for (const auto& [name, f] : vectors) {
    const auto rows = run_function<F>(name, p, angles);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const auto& a = angles[i];
      const vec3 v = (c.*f)({a[7], a[8], a[0]}, {a[9], a[10], a[1]}, {0, 0, 1}, p[i][0]);
      EXPECT_EQ(rows[i], (std::vector<F>{v.x, v.y, v.z})) << name;
    }
  }
}

#define SKIP_WITHOUT_SHADERS \
  if (!can_compile()) GTEST_SKIP() << "this build reads no shaders"

TEST(Corpus, HasTheCompilersBitsInDouble) {
  SKIP_WITHOUT_SHADERS;
  expect_bits_of_compiler<double>();
}
TEST(Corpus, HasTheCompilersBitsInFloat) {
  SKIP_WITHOUT_SHADERS;
  expect_bits_of_compiler<float>();
}

TEST(Corpus, DerivativesAreDifferences) {
  SKIP_WITHOUT_SHADERS;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.05, 0.95);
  for (const auto& e : list_functions(corpus_file())) {
    if (e.function == "helper") continue;
    const auto f = read_function(
        parse_name(corpus_file() + ":" + e.function + "{includes=nothing}"), Stands::lobe);
    const std::size_t n = f.parameters.size();
    for (std::size_t c = 0; c < f.programs.size(); ++c) {
      const Program d = with_derivatives(f.programs[c], n, true);
      Interpreter<double> run(d), value(f.programs[c]);
      int off = 0;
      constexpr int samples = 50;
      for (int i = 0; i < samples; ++i) {
        std::vector<double> p(n);
        for (double& x : p) x = unit(random);
        std::array<double, 11> a{};
        for (double& x : a) x = unit(random);
        std::vector<double> out;
        run.set(p);
        run.run(
            1, [&](std::size_t k, std::size_t) { return a[k]; },
            [&](std::size_t, std::size_t, double v) { out.push_back(v); });
        const auto at = [&](const std::vector<double>& q, const std::array<double, 11>& b) {
          double v = 0;
          value.set(q);
          value.run(
              1, [&](std::size_t k, std::size_t) { return b[k]; },
              [&](std::size_t, std::size_t, double x) { v = x; });
          return v;
        };
        ASSERT_EQ(out.size(), n + 2);
        bool same = out[0] == at(p, a);
        for (std::size_t k = 0; k < n; ++k) {
          auto up = p, down = p;
          up[k] += 1e-6, down[k] -= 1e-6;
          const double slope = (at(up, a) - at(down, a)) / 2e-6;
          same = same && std::abs(slope - out[1 + k]) <= 1e-6 * (1 + std::abs(slope));
        }
        const auto turned = [&](double degrees) {
          auto b = a;
          const double t = degrees * std::numbers::pi / 180;
          for (std::size_t k = first_of_frame; k < b.size(); k += 2) {
            b[k] = a[k] * std::cos(t) + a[k + 1] * std::sin(t);
            b[k + 1] = a[k + 1] * std::cos(t) - a[k] * std::sin(t);
          }
          return at(p, b);
        };
        const double slope = (turned(1e-4) - turned(-1e-4)) / 2e-4;
        same = same && std::abs(slope - out[n + 1]) <= 1e-6 * (1 + std::abs(slope));
        off += !same;
      }
      EXPECT_LE(off, 1) << e.function;  // a difference may span a step
    }
  }
}

TEST(Corpus, RegistersHaveTheBitsOfOneNumber) {
  SKIP_WITHOUT_SHADERS;
  using B = Batch<double>;
  for (const auto& e : list_functions(corpus_file())) {
    if (e.function == "curves" || e.function == "angles_of" || e.function == "helper")
      continue;  // the registers' exp and sin are their own
    const auto f = read_function(
        parse_name(corpus_file() + ":" + e.function + "{includes=nothing}"), Stands::lobe);
    for (const auto& p : f.programs) {
      Interpreter<double> one(p);
      Interpreter<B> many(p, 3);
      std::vector<double> values{0.37, 0.81};
      values.resize(f.parameters.size());
      std::vector<B> wide(values.begin(), values.end());
      one.set(values);
      many.set(wide);
      const auto angle = [](std::size_t k, std::size_t i) {
        return 0.05 +
               0.9 *
                   std::fmod(0.137 * static_cast<double>(k + 1) * static_cast<double>(i + 3), 1.0);
      };
      constexpr std::size_t registers = 7, n = registers * B::size;
      std::vector<double> a(n), b(n);
      one.run(n, angle, [&](std::size_t, std::size_t i, double v) { a[i] = v; });
      many.run(
          registers,
          [&](std::size_t k, std::size_t j) {
            alignas(64) std::array<double, B::size> x;
            for (std::size_t l = 0; l < x.size(); ++l) x[l] = angle(k, j * B::size + l);
            return B::load_aligned(x.data());
          },
          [&](std::size_t, std::size_t j, const B& v) { v.store_unaligned(&b[j * B::size]); });
      EXPECT_EQ(a, b) << e.function;
    }
  }
}

}  // namespace
}  // namespace gonio::foreign
