// Emitted models and maps, compiled by each language's own compiler and run on Vulkan.
#include <array>
#include <map>
#include <random>

#include "brdf/catalogue/registry.h"
#include "brdf/in_number/number.h"
#include "brdf/model/evaluate.h"
#include "shader/running.h"
#include "shader/shader.h"

namespace gonio::shader {
namespace {

using test::Vulkan;

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

/// Maps at many inputs, against what `gonio term` says in that number.
template <class F>
void run_maps(Vulkan& vulkan) {
  constexpr std::size_t n = 1024;
  constexpr Number number = std::same_as<F, Half> ? Number::half : Number::float_;
  std::vector<TracedFormula> formulas;
  std::vector<std::vector<float>> inputs;
  std::vector<std::vector<std::vector<double>>> expected;
  std::vector<std::size_t> results;
  for (std::size_t map = 0; map < maps().size(); ++map) {
    const auto& f = formulas.emplace_back(trace_map(map, precision_of<F>, {}));
    const auto about = maps()[map].parameters;
    Draw<F> draw;
    auto& in = inputs.emplace_back();
    auto& out = expected.emplace_back();
    for (std::size_t i = 0; i < n; ++i) {
      std::vector<double> p;
      for (const auto& parameter : about) p.push_back(static_cast<double>(draw(parameter.fit)));
      for (const auto& q : f.parameters)
        in.push_back(static_cast<float>(p[static_cast<std::size_t>(q.about - about.data())]));
      out.push_back(map_in(number, map, p));
    }
    results.push_back(f.results.size());
    EXPECT_EQ(f.results.size(), maps()[map].outputs.size()) << f.id;
  }
  for (const auto language : {Language::glsl, Language::slang, Language::wgsl}) {
    std::vector<std::string> programs;
    for (const auto& f : formulas) programs.push_back(compute_program(f, language));
    const auto out = run_all(vulkan, language, programs, inputs, n, results);
    if (::testing::Test::HasFailure()) return;
    for (std::size_t k = 0; k < formulas.size(); ++k) {
      const auto o = formulas[k].operations();
      const bool is_exact =
          language != Language::wgsl && o[Operation::exp] + o[Operation::log] == 0;
      const double tolerance = is_exact ? 0 : std::same_as<F, Half> ? 0.02 : 1e-4;
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t r = 0; r < results[k]; ++r) {
          const float x = out[k][i * results[k] + r];
          const auto y = static_cast<float>(expected[k][i][r]);
          wrong +=
              !same_bits(x, y) && !(double{std::abs(x - y)} <= tolerance * double{std::abs(y)});
        }
      EXPECT_EQ(wrong, 0U) << formulas[k].id << " in " << name_of(language) << "\n" << programs[k];
    }
  }
}

TEST(EmittedMaps, GiveTheSameBitsInFloat) {
  GONIO_NEEDS_SHADING;
  GONIO_NEEDS_VULKAN(vulkan);
  run_maps<float>(*vulkan);
}

TEST(EmittedMaps, GiveTheSameBitsInHalf) {
  GONIO_NEEDS_SHADING;
  GONIO_NEEDS_VULKAN(vulkan);
  run_maps<Half>(*vulkan);
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
