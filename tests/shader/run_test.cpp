// Emitted shaders, compiled by each language's own compiler and run on Vulkan.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <map>
#include <random>

#include "base/error.h"
#include "base/process.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/evaluate.h"
#include "number/enclosure.h"
#include "shader/program.h"
#include "shader/shader.h"
#include "shader/vulkan.h"
#include "stability/value_over.h"
#include "support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gonio::shader {
namespace {

using test::Folder;
using test::Vulkan;

const std::string python = test::project_folder() + "/build/shading/bin/python";

bool runs(const std::string& program, const char* word) {
  const std::array<std::string, 1> words{word};
  const auto result = run_program(program, words, "", 60);
  return result && result->status == 0;
}

std::vector<std::uint32_t> words_of(const std::string& path) {
  const std::string bytes = test::read_bytes(path);
  std::vector<std::uint32_t> words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), words.size() * 4);
  return words;
}

void expect_valid(const std::string& path) {
  const std::array<std::string, 3> words{"--target-env", "vulkan1.2", path};
  const auto result = run_program("spirv-val", words, "", 60);
  EXPECT_EQ(result->status, 0) << result->output;
}

std::vector<std::uint32_t> compiled_glsl(const Folder& folder, const std::string& source) {
  folder.write("shader.comp", source);
  const std::array<std::string, 6> words{
      "-V", "--target-env", "vulkan1.2", folder / "shader.comp", "-o", folder / "shader.spv"};
  const auto result = run_program("glslangValidator", words, "", 60);
  EXPECT_EQ(result->status, 0) << result->output << source;
  expect_valid(folder / "shader.spv");
  return words_of(folder / "shader.spv");
}

/// Numbers of a shader's kind.
template <class F>
class Draw {
 public:
  /// Within a range, of positive ones in logarithms.
  F operator()(const Range& r) {
    const double u = std::ldexp(static_cast<double>(random_() >> 11), -53);
    const double x = r.low > 0 ? r.low * std::pow(r.high / r.low, u) : r.low + (r.high - r.low) * u;
    const auto less = [](const F& a, const F& b) { return a < b; };
    return std::clamp(static_cast<F>(x), static_cast<F>(r.low), static_cast<F>(r.high), less);
  }
  /// Angles of two directions above the surface.
  FrameAngles<F> angles() {
    const auto direction = [&] {
      const auto z = static_cast<double>((*this)({0.02, 1}));
      const auto phi = static_cast<double>((*this)({0, 6.28}));
      const double s = std::sqrt(1 - z * z);
      return std::array{s * std::cos(phi), s * std::sin(phi), z};
    };
    const auto l = direction(), v = direction();
    std::array<double, 3> h{l[0] + v[0], l[1] + v[1], l[2] + v[2]};
    const double length = std::hypot(h[0], h[1], h[2]);
    for (auto& x : h) x /= length;
    const double voh = v[0] * h[0] + v[1] * h[1] + v[2] * h[2];
    const auto f = [](double x) { return static_cast<F>(std::min(x, 1.0)); };
    return {{f(l[2]), f(v[2]), f(h[2]), f(voh), f(h[0] * h[0] + h[1] * h[1])},
            f(h[0]),
            f(h[1]),
            f(l[0]),
            f(l[1]),
            f(v[0]),
            f(v[1])};
  }

 private:
  std::mt19937_64 random_{7};
};

template <class F>
F angle_of(const FrameAngles<F>& a, const std::string& name) {
  const std::pair<const char*, F> all[] = {{"NoL", a.nol},
                                           {"NoV", a.nov},
                                           {"NoH", a.noh},
                                           {"VoH", a.voh},
                                           {"sin2_theta_h", a.sin2_theta_h},
                                           {"XoH", a.xoh},
                                           {"YoH", a.yoh},
                                           {"XoL", a.xol},
                                           {"YoL", a.yol},
                                           {"XoV", a.xov},
                                           {"YoV", a.yov}};
  for (const auto& [n, x] : all)
    if (name == n) return x;
  ADD_FAILURE() << name;
  return F(0);
}

std::size_t row_count() {
  return std::getenv("GONIO_LONG") ? 1 << 18 : 1 << 12;
}

bool same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (a == 0 && b == 0) ||
         (std::isnan(a) && std::isnan(b));
}

/// A term at many inputs.
template <class F>
struct Rows {
  std::size_t term;
  TracedFormula formula;
  std::vector<std::vector<F>> parameters;
  std::vector<FrameAngles<F>> angles;
  std::vector<float> inputs;  ///< of the function, row by row

  Rows(std::size_t index, TracedFormula traced) : term(index), formula(std::move(traced)) {
    const auto about = catalogue()[term].parameters;
    Draw<F> draw;
    for (std::size_t i = 0; i < row_count(); ++i) {
      auto& p = parameters.emplace_back();
      for (const auto& parameter : about) p.push_back(draw(parameter.fit));
      angles.push_back(draw.angles());
      for (const auto& q : formula.parameters)
        inputs.push_back(static_cast<float>(p[static_cast<std::size_t>(q.about - about.data())]));
      for (const auto& q : formula.angles)
        inputs.push_back(static_cast<float>(angle_of(angles.back(), q.name)));
    }
    if (inputs.empty()) inputs.push_back(0);
  }
  F expected(std::size_t i) const {
    return term_function<F>(term)(parameters[i], angles[i]).value();
  }

  /// True of what Vulkan's rules allow a device, operation by operation.
  bool allows(std::size_t i, float x) const {
    const RoundingScope rules(Rounding::vulkan());
    const auto e = [](const F& y) { return Enclosure<F>::between(y, y); };
    std::vector<Enclosure<F>> p;
    for (const auto& y : parameters[i]) p.push_back(e(y));
    const auto& a = angles[i];
    return term_function<Enclosure<F>>(term)(
               p, {{e(a.nol), e(a.nov), e(a.noh), e(a.voh), e(a.sin2_theta_h)},
                   e(a.xoh),
                   e(a.yoh),
                   e(a.xol),
                   e(a.yol),
                   e(a.xov),
                   e(a.yov)})
        .value()
        .holds(static_cast<double>(x));
  }
  /// Same bits; where exp or log are in it, what Vulkan's rules allow.
  void expect_exact(std::span<const float> out, Language language) const {
    const auto o = formula.operations();
    const bool is_algebraic = o[Operation::exp] + o[Operation::log] == 0;
    expect(out, language, [&](std::size_t i) {
      return same_bits(out[i], static_cast<float>(expected(i))) ||
             (!is_algebraic && allows(i, out[i]));
    });
  }
  void expect(std::span<const float> out, Language language, auto&& right) const {
    ASSERT_EQ(out.size(), angles.size());
    std::size_t wrong = 0, first = 0;
    for (std::size_t i = 0; i < out.size(); ++i)
      if (!right(i) && wrong++ == 0) first = i;
    if (wrong == 0) return;
    std::string at;
    for (const auto& x : parameters[first]) at += fmt::format(" {}", static_cast<double>(x));
    ADD_FAILURE() << formula.id << " in " << name_of(formula.precision) << ", " << name_of(language)
                  << ": " << wrong << " of " << out.size() << " are wrong, first " << out[first]
                  << " for " << static_cast<double>(expected(first)) << " with" << at << "\n"
                  << shader_source(formula, {language, "brdf", {}});
  }
};

template <class F>
constexpr Precision precision_of = std::same_as<F, Half> ? Precision::half : Precision::float_;

/// Terms that have no shader in half: quadratures, with nodes that are none.
bool is_refused(std::size_t term, Precision precision) {
  return precision == Precision::half && catalogue()[term].id().starts_with("masking.smith_gtr.");
}

template <class F>
std::vector<Rows<F>> rows_of_every_term() {
  std::vector<Rows<F>> all;
  for (std::size_t term = 0; term < catalogue().size(); ++term) {
    if (is_refused(term, precision_of<F>))
      EXPECT_THROW(trace_term(term, precision_of<F>, {}), Error) << catalogue()[term].id();
    else
      all.emplace_back(term, trace_term(term, precision_of<F>, {}));
  }
  return all;
}

std::unique_ptr<Vulkan> device(std::string& why) {
  if (!runs("glslangValidator", "--version") || !runs("spirv-val", "--version")) {
    why = "glslangValidator or spirv-val is not there";
    return nullptr;
  }
  return Vulkan::open(why);
}
#define GONIO_NEEDS_VULKAN(variable) \
  std::string why;                   \
  const auto variable = device(why); \
  if (!variable) GTEST_SKIP() << why << ": run ./check, which installs it"

template <class F>
void run_glsl(Vulkan& vulkan) {
  const Folder folder;
  for (const auto& rows : rows_of_every_term<F>()) {
    const auto code = compiled_glsl(folder, compute_program(rows.formula, Language::glsl));
    if (::testing::Test::HasFailure()) return;
    const std::size_t n = rows.angles.size();
    rows.expect_exact(vulkan.run(code, rows.inputs, n, n), Language::glsl);
  }
}

TEST(EmittedGlsl, OfEveryTermGivesTheSameBitsInFloat) {
  GONIO_NEEDS_VULKAN(vulkan);
  run_glsl<float>(*vulkan);
}

TEST(EmittedGlsl, OfEveryTermGivesTheSameBitsInHalf) {
  GONIO_NEEDS_VULKAN(vulkan);
  run_glsl<Half>(*vulkan);
}

/// Runs the compilers over a folder of programs and says what they did not take.
void run_languages(const Folder& folder, const std::vector<std::string>& names) {
  const std::array<std::string, 2> words{test::project_folder() + "/tests/shader/languages.py",
                                         folder / ""};
  const auto result = run_program(python, words, "", 580);
  if (result && result->status == 0) return;
  ADD_FAILURE() << (result ? result->output : "not started");
  for (const auto& name : names) {
    const auto said = test::read_bytes(folder / (name + ".said"));
    if (!said.empty()) {
      ADD_FAILURE() << name << ": " << said.substr(0, 2000);
      return;
    }
  }
}
#define GONIO_NEEDS_SHADING       \
  if (!runs(python, "--version")) \
  GTEST_SKIP() << "wgpu and slangpy are not there: run ./check, which fetches them"

template <class F>
void run_slang(Vulkan& vulkan) {
  const Folder folder;
  const auto all = rows_of_every_term<F>();
  std::vector<std::string> names;
  for (const auto& rows : all) {
    names.push_back(rows.formula.id);
    folder.write(names.back() + ".slang", compute_program(rows.formula, Language::slang));
  }
  run_languages(folder, names);
  if (::testing::Test::HasFailure()) return;
  for (const auto& rows : all) {
    const auto code = compiled_glsl(folder, test::read_bytes(folder / (rows.formula.id + ".comp")));
    if (::testing::Test::HasFailure()) return;
    const std::size_t n = rows.angles.size();
    rows.expect_exact(vulkan.run(code, rows.inputs, n, n), Language::slang);
  }
}

// By way of GLSL, which keeps the word precise; the compiler's own SPIR-V drops it.
TEST(EmittedSlang, OfEveryTermGivesTheSameBitsInFloat) {
  GONIO_NEEDS_SHADING;
  GONIO_NEEDS_VULKAN(vulkan);
  run_slang<float>(*vulkan);
}

TEST(EmittedSlang, OfEveryTermGivesTheSameBitsInHalf) {
  GONIO_NEEDS_SHADING;
  GONIO_NEEDS_VULKAN(vulkan);
  run_slang<Half>(*vulkan);
}

template <class F>
void run_wgsl(double tolerance) {
  const Folder folder;
  const auto all = rows_of_every_term<F>();
  std::vector<std::string> names;
  for (const auto& rows : all) {
    const auto& name = names.emplace_back(rows.formula.id);
    const std::size_t n = rows.angles.size();
    folder.write(name + ".wgsl", compute_program(rows.formula, Language::wgsl));
    folder.write(name + ".json", fmt::format("{{\"invocations\": {}, \"results\": {}}}", n, n));
    folder.write(name + ".in", std::string(reinterpret_cast<const char*>(rows.inputs.data()),
                                           rows.inputs.size() * sizeof(float)));
  }
  run_languages(folder, names);
  if (::testing::Test::HasFailure()) return;
  for (const auto& rows : all) {
    const auto bits = words_of(folder / (rows.formula.id + ".out"));
    std::vector<float> out;
    for (const auto word : bits) out.push_back(std::bit_cast<float>(word));
    rows.expect(out, Language::wgsl, [&](std::size_t i) {
      const auto expected = static_cast<double>(rows.expected(i));
      return same_bits(out[i], static_cast<float>(expected)) ||
             std::abs(static_cast<double>(out[i]) - expected) <=
                 tolerance *
                     std::max(std::abs(expected), std::is_same_v<F, Half> ? 0x1p-14 : 0x1p-64) ||
             rows.allows(i, out[i]);
    });
  }
}

// Its compilers may regroup, and so they do: what that moves is bounded here by what it moves in
// the worst term.
TEST(EmittedWgsl, OfEveryTermGivesNearlyTheSameInFloat) {
  GONIO_NEEDS_SHADING;
  std::string why;
  if (!Vulkan::open(why)) GTEST_SKIP() << why;
  run_wgsl<float>(1e-4);
}

TEST(EmittedWgsl, OfEveryTermGivesNearlyTheSameInHalf) {
  GONIO_NEEDS_SHADING;
  std::string why;
  if (!Vulkan::open(why)) GTEST_SKIP() << why;
  run_wgsl<Half>(0.05);
}

/// Results of programs over their inputs, each in its language.
std::vector<std::vector<float>> run_all(Vulkan& vulkan,
                                        Language language,
                                        const std::vector<std::string>& programs,
                                        const std::vector<std::vector<float>>& inputs,
                                        std::size_t rows,
                                        const std::vector<std::size_t>& results) {
  const Folder folder;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < programs.size(); ++k) {
    const auto& name = names.emplace_back(fmt::format("program{}", k));
    const auto file = name + "." + std::string(name_of(language));
    folder.write(file, programs[k]);
    if (language != Language::wgsl) continue;
    folder.write(name + ".json",
                 fmt::format("{{\"invocations\": {}, \"results\": {}}}", rows, rows * results[k]));
    folder.write(name + ".in", std::string(reinterpret_cast<const char*>(inputs[k].data()),
                                           inputs[k].size() * sizeof(float)));
  }
  if (language != Language::glsl) run_languages(folder, names);
  std::vector<std::vector<float>> all;
  for (std::size_t k = 0; k < programs.size() && !::testing::Test::HasFailure(); ++k) {
    auto& out = all.emplace_back();
    if (language == Language::wgsl) {
      for (const auto word : words_of(folder / (names[k] + ".out")))
        out.push_back(std::bit_cast<float>(word));
      continue;
    }
    const auto code = compiled_glsl(folder, language == Language::glsl
                                                ? programs[k]
                                                : test::read_bytes(folder / (names[k] + ".comp")));
    if (!::testing::Test::HasFailure()) out = vulkan.run(code, inputs[k], rows, rows * results[k]);
  }
  return all;
}

/// Models with colours, known and not, two lobes, a tangent frame, derivatives.
std::vector<TracedFormula> some_models(bool derived) {
  const auto traced = [&](const char* spec, std::vector<std::string> set,
                          std::vector<std::string> derivatives) {
    if (!derived) derivatives.clear();
    return trace_model(bind_model(spec, parse_settings(set)), Precision::float_, {}, derivatives);
  };
  std::vector<TracedFormula> all;
  all.push_back(traced("lambert.coupled+ggx/smith_ggx.correlated/schlick", {}, {"alpha", "f0"}));
  all.push_back(traced("ggx/smith_ggx.correlated/dielectric", {"alpha=0.3"}, {"eta"}));
  all.push_back(traced("ggx/smith_ggx.separable/conductor", {"metal=Au"}, {"alpha"}));
  all.push_back(traced("disney+ggx/smith_ggx.correlated/f82+gtr/smith_ggx.separable/schlick",
                       {"f0_2=0.04"}, {"f82_tint", "gamma_2"}));
  all.push_back(
      traced("ggx_aniso/smith_ggx_aniso.correlated/schlick", {"tangent=30"}, {"alpha_x"}));
  all.push_back(trace_model(bind_model("ggx/smith_ggx.correlated/schlick", {}), Precision::float_,
                            {}, {}, Compensating{Compensation::turquin, AlbedoFrom::fit}));
  all.push_back(trace_model(bind_model("ggx/smith_ggx.separable/dielectric", {}), Precision::float_,
                            {}, {}, Compensating{Compensation::kulla_conty, AlbedoFrom::table}));
  return all;
}

/// Rows of a formula's arguments, and one of the graph's inputs for each channel.
struct ModelRows {
  std::vector<float> inputs;
  std::vector<std::array<std::vector<float>, 3>> channels;
};
ModelRows rows_of(const TracedFormula& f, std::size_t rows) {
  ModelRows all;
  Draw<float> draw;
  for (std::size_t i = 0; i < rows; ++i) {
    std::map<int, std::array<float, 3>> values;
    for (const auto& p : f.parameters)
      for (std::size_t c = 0; c < (p.colour ? 3U : 1U); ++c) {
        values[p.node][c] = draw(p.about->fit);
        all.inputs.push_back(values[p.node][c]);
        if (!p.colour) values[p.node].fill(values[p.node][0]);
      }
    for (const auto& k : f.colours)
      for (std::size_t c = 0; c < 3; ++c) values[k.node][c] = static_cast<float>(k.value[c]);
    const auto a = draw.angles();
    for (const auto& angle : f.angles) {
      values[angle.node].fill(angle_of(a, angle.name));
      all.inputs.push_back(values[angle.node][0]);
    }
    auto& row = all.channels.emplace_back();
    for (std::size_t k = 0; k < f.trace.nodes().size(); ++k)
      if (f.trace.nodes()[k].kind == Trace::Kind::input)
        for (std::size_t c = 0; c < 3; ++c) row[c].push_back(values[static_cast<int>(k)][c]);
  }
  return all;
}

/// Colours and derivatives are the graph's own, replayed in C++.
TEST(EmittedModels, GiveTheGraphsValuesAndSlopesInEachLanguage) {
  GONIO_NEEDS_SHADING;
  GONIO_NEEDS_VULKAN(vulkan);
  constexpr std::size_t n = 1024;
  const auto models = some_models(true);
  for (const auto language : {Language::glsl, Language::slang, Language::wgsl}) {
    std::vector<std::string> programs;
    std::vector<ModelRows> rows;
    std::vector<std::vector<float>> inputs;
    std::vector<std::size_t> results;
    for (const auto& f : models) {
      programs.push_back(compute_program(f, language));
      rows.push_back(rows_of(f, n));
      inputs.push_back(rows.back().inputs);
      results.push_back(f.results.size() * 3);
    }
    const auto out = run_all(*vulkan, language, programs, inputs, n, results);
    if (HasFailure()) return;
    for (std::size_t m = 0; m < models.size(); ++m) {
      const auto& f = models[m];
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
          const auto expected = replay<float>(f.trace, rows[m].channels[i][c]);
          for (std::size_t r = 0; r < f.results.size(); ++r) {
            const float x = out[m][(i * f.results.size() + r) * 3 + c],
                        y = expected[static_cast<std::size_t>(f.results[r].node)];
            const bool near = std::abs(x - y) <= 1e-3F * std::max(std::abs(y), 1e-3F);
            wrong += !same_bits(x, y) && !(language == Language::wgsl && near) &&
                     !(f.id.find("gtr") != std::string::npos && near);  // exp and log
          }
        }
      EXPECT_LE(wrong, language == Language::wgsl ? n / 100 : 0)
          << f.id << " in " << name_of(language) << "\n"
          << programs[m];
    }
  }
}

/// The function of directions against the model in double.
TEST(EmittedModels, TakeDirections) {
  GONIO_NEEDS_SHADING;
  GONIO_NEEDS_VULKAN(vulkan);
  constexpr std::size_t n = 64;
  const auto f = trace_model(
      bind_model("lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick",
                 parse_settings(std::vector<std::string>{"tangent=30", "alpha_x=0.5", "alpha_y=0.2",
                                                         "f0=0.9,0.6,0.4", "kd=0.2,0.1,0.1"})),
      Precision::float_, {}, {});
  const auto half = [](double x) { return x * x; };
  std::vector<float> inputs;
  std::vector<FrameAngles<double>> angles;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> in(0, 1);
  // The frame is turned in space: the function must not lean on axes.
  const double c = std::cos(0.7), s = std::sin(0.7);
  const auto put = [&](double x, double y, double z) {
    for (const double v : {x * c - z * s, y, x * s + z * c})
      inputs.push_back(static_cast<float>(v));
  };
  for (std::size_t i = 0; i < n; ++i) {
    std::array<std::array<double, 3>, 2> d;
    for (auto& w : d) {
      const double z = 0.1 + 0.9 * in(random), phi = 6.28 * in(random), r = std::sqrt(1 - half(z));
      w = {r * std::cos(phi), r * std::sin(phi), z};
    }
    if (i == 0) d[0][2] = -d[0][2];  // from below
    put(0, 0, 1);
    put(d[0][0], d[0][1], d[0][2]);
    put(d[1][0], d[1][1], d[1][2]);
    put(1, 0, 0);
    put(0, 1, 0);
    std::array<double, 3> h;
    for (std::size_t k = 0; k < 3; ++k) h[k] = d[0][k] + d[1][k];
    const double length = std::hypot(h[0], h[1], h[2]);
    for (auto& x : h) x /= length;
    angles.push_back({{d[0][2], d[1][2], h[2], h[0] * d[0][0] + h[1] * d[0][1] + h[2] * d[0][2],
                       h[0] * h[0] + h[1] * h[1]},
                      h[0],
                      h[1],
                      d[0][0],
                      d[0][1],
                      d[1][0],
                      d[1][1]});
  }
  const auto expected = evaluate(
      bind_model("lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick",
                 parse_settings(std::vector<std::string>{"tangent=30", "alpha_x=0.5", "alpha_y=0.2",
                                                         "f0=0.9,0.6,0.4", "kd=0.2,0.1,0.1"})),
      std::span<const FrameAngles<double>>(angles));
  for (const auto language : {Language::glsl, Language::slang, Language::wgsl}) {
    const auto out =
        run_all(*vulkan, language, {compute_program(f, language, true)}, {inputs}, n, {3});
    if (HasFailure()) return;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(out[0][i * 3 + k], expected[k][i], 2e-5 * std::max(expected[k][i], 0.1))
            << name_of(language) << ", row " << i;
    EXPECT_EQ(out[0][0], 0) << "from below";
  }
}

}  // namespace
}  // namespace gonio::shader
