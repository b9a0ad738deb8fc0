#include "scene/surface/evaluate.h"

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "brdf/formula/scattering.h"
#include "geometry/half_vector.h"
#include "integrate/rule/quadrature.h"
#include "integrate/scattering/walk.h"
#include "optics/fresnel_approximate.h"
#include "optics/spectrum.h"
#include "scene/plan/scenes.h"

#include <gtest/gtest.h>

namespace gonio::scene {
namespace {

constexpr std::size_t n = 512;

std::vector<FrameAngles<double>> some_angles() {
  std::vector<FrameAngles<double>> all;
  for (std::size_t i = 0; i < n; ++i) {
    Draws draw(7, i);
    const auto d = [&] {
      const double z = 0.02 + 0.98 * draw.uniform(), phi = 6.3 * draw.uniform();
      const double s = std::sqrt(1 - z * z);
      return Coordinates<double>{s * std::cos(phi), s * std::sin(phi), z};
    };
    const auto l = d(), v = d();
    all.push_back(angles_between<double>(l, v));
  }
  return all;
}

template <class F>
std::array<Column<F>, 3> values(const Surface& s,
                                const std::vector<FrameAngles<double>>& angles,
                                const SurfaceKernels<F>& kernels = {},
                                std::array<Column<F>, 3>* off = nullptr) {
  AngleColumns<F> x(angles.size(), true);
  for (std::size_t i = 0; i < angles.size(); ++i) x.set(i, angles[i]);
  std::array<Column<F>, 3> f{Column<F>(x.padded()), Column<F>(x.padded()), Column<F>(x.padded())};
  const std::array out{f[0].data(), f[1].data(), f[2].data()};
  std::vector<F*> off_out;
  if (off)
    for (auto& column : *off) off_out.push_back((column = Column<F>(x.padded())).data());
  SurfaceEvaluator<F>(s, kernels)(x.block(), out, off_out);
  return f;
}

/// Exact surface of a material, with one effect in another form.
Surface with(const Material& m, Effect e, Form form, bool lean = true) {
  const Look look(m);
  Forms forms = lean ? look.structural() : look.exact();
  forms[e] = form;
  return look.surface(forms);
}

TEST(SurfaceEvaluator, AddsKullaAndContysLobe) {
  const auto none = with(test::satin_gold(), Effect::compensation, Form::uncompensated);
  const auto all = with(test::satin_gold(), Effect::compensation, Form::kulla_conty);
  const auto angles = some_angles();
  const auto f = values<double>(none, angles), g = values<double>(all, angles);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double lobe = all.multiple.strength[c] *
                          (1 - value_at(all.multiple.albedo, angles[i].nol)) *
                          (1 - value_at(all.multiple.albedo, angles[i].nov));
      EXPECT_NEAR(g[c][i], f[c][i] + lobe, 1e-14 + 1e-14 * f[c][i]);
    }
}

/// f of two bounces and more by walks from v, in red, green and blue of a metal's bands.
Rgb walked(const BoundModel& bands,
           std::span<const ColourOfChannel> colour,
           const FrameAngles<double>& a) {
  const auto w = walk_value(bands, {a.xol, a.yol, a.nol}, {a.xov, a.yov, a.nov}, {3, 1 << 18});
  Rgb sum{};
  for (std::size_t b = 0; b < colour.size(); ++b)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += colour[b][c] * (w.value[b] - w.order[b][0]);
  return sum;
}

TEST(SurfaceEvaluator, AddsTheLobeOfWalksInTheColoursOfAMetal) {
  const auto none = with(test::satin_gold(), Effect::compensation, Form::uncompensated);
  const auto all = with(test::satin_gold(), Effect::compensation, Form::tabulated);
  const auto angles = some_angles();
  const auto f = values<double>(none, angles);
  std::array<Column<double>, 3> off;
  const auto g = values<double>(all, angles, {}, &off);
  const auto& metal = *all.spectrum;
  const auto bands = bind_model("ggx/smith_ggx.correlated/conductor",
                                {{"roughness", {0.45}},
                                 {"eta", {metal.eta.begin(), metal.eta.end()}},
                                 {"k", {metal.k.begin(), metal.k.end()}}},
                                metal.bands);
  std::vector<ColourOfChannel> colour;
  for (std::size_t b = 0; b < metal.bands; ++b)
    colour.push_back({metal.weight[0][b], metal.weight[1][b], metal.weight[2][b]});
  for (std::size_t i = 0; i < 10; ++i) {
    const auto lobe = walked(bands, colour, angles[i]);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(g[c][i] - f[c][i], lobe[c], 1.5 * (off[c][i] - g[c][i]) + 0.04 * lobe[c]);
  }
}

TEST(SurfaceEvaluator, BrightensTheLobeAloneByTurquin) {
  const auto none = with(test::red_plastic(), Effect::compensation, Form::uncompensated);
  const auto all = with(test::red_plastic(), Effect::compensation, Form::turquin);
  Surface lobe = none;
  lobe.base.model.diffuse.clear();
  const auto angles = some_angles();
  const auto f = values<double>(none, angles), g = values<double>(all, angles),
             alone = values<double>(lobe, angles);
  const double f0 = all.multiple.strength[0];
  EXPECT_NEAR(f0, std::pow(0.49 / 2.49, 2), 1e-12);
  for (std::size_t i = 0; i < n; ++i) {
    const double e = value_at(all.multiple.albedo, angles[i].nov);
    EXPECT_NEAR(g[0][i], f[0][i] + alone[0][i] * f0 * (1 / e - 1), 1e-13 * (1 + f[0][i]));
  }
}

TEST(SurfaceEvaluator, BrightensByFdezAguera) {
  const auto none = with(test::satin_gold(), Effect::compensation, Form::uncompensated);
  const auto all = with(test::satin_gold(), Effect::compensation, Form::fdez_aguera);
  const auto angles = some_angles();
  const auto f = values<double>(none, angles), g = values<double>(all, angles);
  for (std::size_t i = 0; i < n; ++i) {
    const double lost = 1 - value_at(all.multiple.albedo, angles[i].nov);
    EXPECT_NEAR(g[1][i], f[1][i] / (1 - all.multiple.strength[1] * lost), 1e-13 * (1 + f[1][i]));
  }
}

TEST(SurfaceEvaluator, LosesNothingOfAWhiteLobeWithKullaAndConty) {
  const auto all =
      with(test::material("ggx/smith_ggx.correlated/schlick", {"f0=1,1,0.999999", "alpha=0.7"}),
           Effect::compensation, Form::kulla_conty);
  const Coordinates<double> v{std::sqrt(1 - 0.36), 0, 0.6};
  std::vector<FrameAngles<double>> angles;
  const auto nodes = cosine_hemisphere(64, 128);
  for (const auto& node : nodes)
    angles.push_back(
        angles_between<double>({node.direction.x, node.direction.y, node.direction.z}, v));
  const auto f = values<double>(all, angles);
  double albedo = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) albedo += nodes[i].weight * f[0][i];
  EXPECT_NEAR(albedo, 1, 1e-3);
}

TEST(SurfaceEvaluator, LaysTheCoatOnAllElse) {
  const auto bare = with(test::car_paint(), Effect::coat, Form::uncoated);
  const auto coated = with(test::car_paint(), Effect::coat, Form::coated);
  Surface lobe = bare;  // the coat alone, as a model of its own
  lobe.base = *coated.coat;
  lobe.multiple = {};
  const auto angles = some_angles();
  const auto f = values<double>(bare, angles), g = values<double>(coated, angles),
             alone = values<double>(lobe, angles);
  for (std::size_t i = 0; i < n; ++i) {
    const double fresnel = schlick<double>(0.04, schlick_weight(angles[i].voh));
    EXPECT_NEAR(g[2][i], f[2][i] * (1 - fresnel) + alone[2][i], 1e-13 * (1 + g[2][i]));
  }
}

/// Reflectance of a metal by all of its spectrum.
Rgb reflectance(const char* metal, double voh) {
  return reflectance_rgb(*find_metal(metal), voh);
}

TEST(SurfaceEvaluator, ReflectsTheSpectrumOfAMetal) {
  const auto white =
      with(test::material("ggx/smith_ggx.correlated/schlick", {"roughness=0.45", "f0=1"}),
           Effect::compensation, Form::uncompensated);
  const auto gold = with(test::satin_gold(), Effect::compensation, Form::uncompensated);
  ASSERT_TRUE(gold.spectrum);
  const auto angles = some_angles();
  const auto shape = values<double>(white, angles), f = values<double>(gold, angles);
  for (std::size_t i = 0; i < n; ++i) {
    const auto exact = reflectance("Au", angles[i].voh);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(f[c][i] / shape[c][i], exact[c], 4e-3);
  }
}

TEST(SurfaceEvaluator, LetsTheRestOfTheSpectrumThroughToACoupledDiffuse) {
  const auto made = [](const char* kd) {
    return with(test::material("lambert.coupled+ggx/smith_ggx.correlated/conductor",
                               {"roughness=0.45", "metal=Au", kd}),
                Effect::compensation, Form::uncompensated);
  };
  const auto lit = made("kd=0.5"), dark = made("kd=0");
  ASSERT_TRUE(lit.spectrum && dark.spectrum && dark.base.model.diffuse.empty());
  const auto angles = some_angles();
  const auto f = values<double>(lit, angles), g = values<double>(dark, angles);
  for (std::size_t i = 0; i < n; ++i) {
    const auto exact = reflectance("Au", angles[i].voh);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(f[c][i] - g[c][i], 0.5 / std::numbers::pi * (1 - std::min(exact[c], 1.0)),
                  2e-3 + 1e-13 * g[c][i]);
  }
}

TEST(SurfaceEvaluator, BrightensASpectralLobeAlone) {
  const auto angles = some_angles();
  for (const auto how : {Form::turquin, Form::fdez_aguera}) {
    const auto of = [&](const char* kd) {
      return values<double>(with(test::material("lambert+ggx/smith_ggx.correlated/conductor",
                                                {"roughness=0.6", "metal=Cu", kd}),
                                 Effect::compensation, how),
                            angles);
    };
    const auto f = of("kd=0.3"), g = of("kd=0");
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_NEAR(f[1][i] - g[1][i], 0.3 / std::numbers::pi, 1e-12 * (1 + g[1][i]));
  }
}

TEST(SurfaceEvaluator, ComputesTheSameFusedAndComposed) {
  const Look look(test::satin_gold());
  Forms forms = look.structural();
  forms[Effect::fresnel] = Form::schlick;
  const auto s = look.surface(forms);
  EXPECT_TRUE(SurfaceEvaluator<double>(s).is_fused());
  EXPECT_FALSE((SurfaceEvaluator<double>(s, SurfaceKernels<double>::composed()).is_fused()));
  const auto angles = some_angles();
  const auto f = values<double>(s, angles),
             g = values<double>(s, angles, SurfaceKernels<double>::composed());
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(f[0][i], g[0][i], 1e-13 * f[0][i]);
}

TEST(SurfaceEvaluator, ComputesTheSameBitsInEveryInstructionSet) {
  const auto angles = some_angles();
  for (const auto& s : {with(test::car_paint(), Effect::compensation, Form::turquin),
                        with(test::car_paint(), Effect::compensation, Form::fdez_aguera),
                        with(test::car_paint(), Effect::compensation, Form::kulla_conty),
                        with(test::satin_gold(), Effect::spectrum, Form::spectral)}) {
    const auto in = [&](std::string_view set) {
      SurfaceKernels<float> k{kernels<float>(set), layer_kernels<float>(set)};
      k.terms.fused = {};
      return values<float>(s, angles, k);
    };
    const auto scalar = in("scalar");
    for (const auto& set : instruction_sets()) {
      const auto f = in(set);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_EQ(f[c][i], scalar[c][i]) << set << ' ' << s.spec();
    }
  }
}

TEST(SurfaceEvaluator, LosesLittleInFloat) {
  const auto angles = some_angles();
  for (const auto& m : test::six()) {
    const Look look(m);
    const auto s = look.surface(look.exact());
    const auto f = values<double>(s, angles);
    const auto g = values<float>(s, angles);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(static_cast<double>(g[c][i]) / f[c][i], 1, 1e-4) << s.spec();
  }
}

// Kernels that count how often they are called.
std::size_t called = 0;
MultipleKernel<double> counted_multiple = nullptr;
typename TermKernels<double>::Shade counted_shade = nullptr;
SpectralKernel<double> counted_spectral = nullptr;

TEST(SurfaceEvaluator, NeverCallsTheKernelOfADroppedEffect) {
  SurfaceKernels<double> k = SurfaceKernels<double>::composed();
  counted_multiple = k.layers.kulla_conty;
  k.layers.kulla_conty = [](const Block<double>& x, const AlbedoCurve<double>& a,
                            const std::array<double, max_channels>& s,
                            const MultipleColumns<double>& c) {
    ++called;
    counted_multiple(x, a, s, c);
  };
  std::vector<TermKernels<double>> terms(k.terms.terms.begin(), k.terms.terms.end());
  auto& coat = terms[find_term("schlick.weighted", Role::fresnel)];
  counted_shade = coat.shade[3];
  coat.shade[3] = [](const Block<double>& x, const ChannelColumns<double>& c) {
    ++called;
    counted_shade(x, c);
  };
  k.terms.terms = terms;
  const auto angles = some_angles();
  const Look look(test::car_paint());
  Forms forms = look.structural();
  forms[Effect::compensation] = Form::kulla_conty;
  values<double>(look.surface(forms), angles, k);
  EXPECT_EQ(called, 2 * n / Evaluator<double>::Between::block);  // several bounces, and the coat
  called = 0;
  forms[Effect::compensation] = Form::uncompensated;
  forms[Effect::coat] = Form::uncoated;
  values<double>(look.surface(forms), angles, k);
  EXPECT_EQ(called, 0U);

  counted_spectral = k.layers.spectral;
  k.layers.spectral = [](const Block<double>& x, const SpectralMetal<double>& m,
                         const ChannelColumns<double>& c) {
    ++called;
    counted_spectral(x, m, c);
  };
  values<double>(with(test::satin_gold(), Effect::compensation, Form::uncompensated), angles, k);
  EXPECT_EQ(called, n / Evaluator<double>::Between::block);
  called = 0;
  auto in_rgb = with(test::satin_gold(), Effect::spectrum, Form::rgb);
  in_rgb.multiple = {};
  values<double>(in_rgb, angles, k);
  EXPECT_EQ(called, 0U);
}

TEST(SurfaceEvaluator, DoesNotSeeParametersOfADroppedEffect) {
  const auto angles = some_angles();
  const auto f = [&](const Material& m) {
    return values<double>(with(m, Effect::coat, Form::uncoated), angles);
  };
  Material other = test::car_paint();
  auto& b = std::get<BoundModel>(other.is);
  b.values[b.model.find("alpha_2")->first] = 0.4;
  const auto one = f(test::car_paint()), two = f(other);
  for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(one[0][i], two[0][i]);
}

}  // namespace
}  // namespace gonio::scene
