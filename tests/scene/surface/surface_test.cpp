#include "scene/surface/surface.h"

#include <cmath>

#include "base/random.h"
#include "brdf/model/evaluate.h"
#include "geometry/half_vector.h"
#include "scene/plan/scenes.h"
#include "scene/surface/evaluate.h"

#include <gtest/gtest.h>

namespace gonio::scene {
namespace {

FrameAngles<double> random_angles(std::uint64_t i) {
  Draws draw(1, i);
  const auto d = [&] {
    const double z = 0.05 + 0.95 * draw.uniform(), phi = 6.3 * draw.uniform();
    const double s = std::sqrt(1 - z * z);
    return Coordinates<double>{s * std::cos(phi), s * std::sin(phi), z};
  };
  const auto l = d(), v = d();
  return angles_between<double>(l, v);
}

/// f at one pair of directions.
Rgb value(const Surface& s, const FrameAngles<double>& a) {
  AngleColumns<double> x(1, true);
  x.set(0, a);
  std::array<Column<double>, 3> f{Column<double>(x.padded()), Column<double>(x.padded()),
                                  Column<double>(x.padded())};
  const std::array out{f[0].data(), f[1].data(), f[2].data()};
  SurfaceEvaluator<double> evaluate(s);
  evaluate(x.block(), out);
  return {f[0][0], f[1][0], f[2][0]};
}

TEST(Look, TakesAMetalForFresnelsEquationsUnderCorrelatedSmith) {
  const Look look(test::satin_gold());
  EXPECT_EQ(look.surface(look.structural()).spec(), "ggx/smith_ggx.correlated/conductor");
  EXPECT_EQ(look.exact()[Effect::compensation], Form::tabulated);
  EXPECT_TRUE(look.is_bounded());
  EXPECT_EQ(look.everything()[Effect::compensation], Form::kulla_conty);
}

TEST(Look, KnowsNoBoundWhereItKnowsNoWalk) {
  const Look gtr(test::material("gtr/smith_gtr.correlated/schlick", {"gamma=1.5"}));
  EXPECT_EQ(gtr.exact()[Effect::compensation], Form::kulla_conty);
  EXPECT_FALSE(gtr.is_bounded());
  EXPECT_FALSE(gtr.surface(gtr.exact()).multiple.lobe);
  const Look ggx(test::material("gtr/smith_gtr.correlated/schlick", {"gamma=2"}));
  EXPECT_TRUE(ggx.is_bounded()) << "gamma 2 is GGX, whose walks are known";
  EXPECT_TRUE(ggx.surface(ggx.exact()).multiple.lobe);
  EXPECT_FALSE(
      Look(test::material("student_t/smith_student_t.correlated/schlick", {})).is_bounded());
  EXPECT_TRUE(Look(test::material("lambert", {"kd=0.5"})).is_bounded()) << "nothing bounces there";
}

TEST(Look, LiftsWhatAModelApproximates) {
  const Look look(test::material("lambert.coupled+ggx/schlick_ggx.half_alpha/schlick",
                                 {"f0=0.04", "alpha=0.3", "kd=0.5"}));
  const auto s = look.surface(look.structural());
  EXPECT_EQ(s.spec(), "lambert.coupled+ggx/smith_ggx.correlated/dielectric");
  EXPECT_NEAR(s.base.values[s.base.model.find("eta")->first], 1.5, 1e-12);
}

TEST(Look, OfAWorkflowsOwnTermsIsThatOfTheReflectancesTheyStandFor) {
  const Look look(
      test::material("lambert.metallic.coupled+ggx/smith_ggx.separable/schlick.metallic",
                     {"base_color=0.5,0.4,0.1", "alpha=0.3"}));
  const auto s = look.surface(look.structural());
  EXPECT_EQ(s.spec(), "lambert.coupled+ggx/smith_ggx.correlated/dielectric");
  EXPECT_NEAR(s.base.values[s.base.model.find("kd")->slot(2)], 0.1, 1e-12);
}

TEST(Look, KnowsTheSpectrumOfAMetalThatIsNamed) {
  const Look gold(test::satin_gold());
  EXPECT_EQ(gold.exact()[Effect::spectrum], Form::spectral);
  EXPECT_TRUE(gold.surface(gold.exact()).spectrum);
  const auto values_of = [&](Form fresnel, Form spectrum) {
    Forms f = gold.structural();
    f[Effect::fresnel] = fresnel;
    f[Effect::spectrum] = spectrum;
    return gold.surface(f);
  };
  const auto schlick = values_of(Form::schlick, Form::rgb);
  EXPECT_FALSE(schlick.spectrum);
  const auto* f0 = &schlick.base.values[schlick.base.model.find("f0")->first];
  EXPECT_EQ(f0[0], 1) << "its red is 1.0376";
  EXPECT_NEAR(f0[1], 0.7284 / std::sqrt(1.0376), 4e-3);
  EXPECT_NEAR(f0[2], 0.3646 / std::sqrt(1.0376), 4e-3);
  EXPECT_FALSE(values_of(Form::exact_fresnel, Form::rgb).spectrum);
  EXPECT_FALSE(values_of(Form::schlick, Form::spectral).spectrum) << "Schlick's form has none";

  const Look by_index(test::material("ggx/smith_ggx.correlated/conductor", {"eta=0.2", "k=3"}));
  EXPECT_EQ(by_index.offer(Effect::spectrum).forms, std::vector{Form::rgb});
  EXPECT_FALSE(by_index.offer(Effect::spectrum).why.empty());
}

TEST(Look, LeavesAColouredF0Schlick) {
  const Look look(test::material("ggx/smith_ggx.correlated/schlick", {"f0=0.9,0.6,0.2"}));
  EXPECT_EQ(look.offer(Effect::fresnel).forms, std::vector{Form::schlick});
  EXPECT_FALSE(look.offer(Effect::fresnel).why.empty());
}

TEST(Look, LeavesTermsThatNoFormStandsForAsTheyAre) {
  const Look look(test::material("eon+student_t/smith_student_t.correlated/conductor",
                                 {"kd=0.5,0.3,0.1", "r=0.7", "alpha=0.3", "tail=0.4"}));
  for (const auto& forms : {look.structural(), look.exact()}) {
    const auto s = look.surface(forms);
    EXPECT_EQ(to_text(s.base.model.spec), "eon+student_t/smith_student_t.correlated/conductor");
    const auto is = [&](const char* name) { return s.base.values[s.base.model.find(name)->first]; };
    EXPECT_EQ(is("kd"), 0.5);
    EXPECT_EQ(is("r"), 0.7);
    EXPECT_EQ(is("tail"), 0.4);
  }
  EXPECT_EQ(look.offer(Effect::diffuse).why, "its diffuse term is of another kind");
  EXPECT_EQ(look.offer(Effect::diffuse).forms, std::vector{Form::given_diffuse});
  const Look mixed(test::material("ggx/smith_student_t.correlated/conductor", {"tail=0.4"}));
  EXPECT_EQ(mixed.surface(mixed.structural()).spec(), "ggx/smith_student_t.correlated/conductor");
}

TEST(Look, KeepsTheParametersOfALobeBehindOneWithoutWeight) {
  const std::string weighted = "+beckmann/smith_beckmann.correlated/schlick.weighted";
  const Look look(test::material("ggx/smith_ggx.correlated/schlick" + weighted + weighted,
                                 {"weight_2=0", "alpha_3=0.37", "weight_3=0.5"}));
  const auto& base = look.surface(look.structural()).base;
  ASSERT_EQ(base.model.lobes.size(), 2U);
  EXPECT_EQ(base.values[base.model.find("alpha_2")->first], 0.37);
  EXPECT_EQ(base.values[base.model.find("weight_2")->first], 0.5);
}

TEST(Look, GivesTheExactFormLast) {
  for (const auto& m : test::six()) {
    const Look look(m);
    for (std::size_t e = 0; e < effect_count; ++e) {
      const auto& forms = look.offer(static_cast<Effect>(e)).forms;
      ASSERT_FALSE(forms.empty());
      EXPECT_TRUE(std::ranges::is_sorted(forms));
      EXPECT_EQ(look.exact().form[e], forms.back());
    }
  }
}

TEST(Look, ChangesNothingByWhatItCallsTheSame) {
  const Look needy(test::everything());
  const auto everything = needy.surface(needy.exact()).spec();
  for (const auto& m : test::six()) {
    const Look look(m);
    const auto exact = look.surface(look.exact()), same = look.surface(look.structural());
    EXPECT_EQ(exact.spec() == same.spec(), same.spec() == everything);
    for (std::uint64_t i = 0; i < 200; ++i) {
      const auto a = random_angles(i);
      const auto f = value(exact, a), g = value(same, a);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(g[c] / f[c], 1, 1e-11) << exact.spec();
    }
  }
}

TEST(Look, ComputesEveryFormThatItOffers) {
  for (const auto& m : test::six()) {
    const Look look(m);
    for (std::size_t e = 0; e < effect_count; ++e)
      for (const auto form : look.offer(static_cast<Effect>(e)).forms) {
        Forms forms = look.exact();
        forms.form[e] = form;
        const auto f = value(look.surface(forms), random_angles(3));
        for (const double x : f) EXPECT_TRUE(std::isfinite(x) && x >= 0);
      }
  }
}

TEST(Look, ReadsGltfsMaterialAsItsSpecificationDoes) {
  GltfMaterial m;
  m.base_color = {0.8, 0.5, 0.2};
  m.metallic = 0;
  m.roughness = 0.5;
  m.clearcoat = 0.6;
  m.clearcoat_roughness = 0.2;
  const Look look({"it", FromGltf{}, m});
  const auto s = look.surface(look.structural());
  EXPECT_EQ(s.spec(),
            "lambert.coupled+ggx/smith_ggx.correlated/dielectric+coat:ggx/smith_ggx.correlated/"
            "schlick.weighted");
  const auto of = [&](const char* name) {
    for (const auto& [n, v] : s.parameters())
      if (n == name) return v[0];
    return std::nan("");
  };
  EXPECT_DOUBLE_EQ(of("alpha"), 0.25);
  EXPECT_DOUBLE_EQ(of("kd"), 0.8);
  EXPECT_NEAR(of("eta"), 1.5, 1e-12);
  EXPECT_NEAR(of("alpha_2"), 0.04, 1e-15);
  EXPECT_DOUBLE_EQ(of("weight_2"), 0.6);
}

TEST(Look, TakesMetalsOfGltfByTheirF0) {
  GltfMaterial m;
  m.base_color = {0.9, 0.6, 0.3};
  m.roughness = 0.4;
  m.anisotropy = 0.5;
  const Look look({"it", FromGltf{}, m});
  const auto s = look.surface(look.structural());
  EXPECT_EQ(s.spec(), "ggx_aniso/smith_ggx_aniso.correlated/schlick");
  EXPECT_NEAR(s.base.values[s.base.model.find("alpha_x")->first], 0.16 + 0.84 * 0.25, 1e-12);
  EXPECT_NEAR(s.base.values[s.base.model.find("alpha_y")->first], 0.16, 1e-12);
}

TEST(Look, IsTurnedToTheTangentOfItsModel) {
  const Look look(test::material("ggx_aniso/smith_ggx_aniso.correlated/schlick",
                                 {"alpha_x=0.4", "alpha_y=0.1", "tangent=30", "f0=0.5"}));
  EXPECT_NEAR(look.turn(), 30 * degree, 1e-15);
  const auto base = look.surface(look.structural()).base;
  EXPECT_EQ(base.values[base.model.tangent()->first], 0);
}

TEST(Look, LeavesOutALobeOfNoWeight) {
  const Look look(test::material("disney", {"base_color=0.5", "roughness=0.4"}));
  EXPECT_EQ(look.surface(look.exact()).base.model.lobes.size(), 1U);
}

TEST(Look, HasNoEffectsOfALobeWhereThereIsNone) {
  const Look look(test::material("lambert", {"kd=0.5"}));
  for (const auto e : {Effect::fresnel, Effect::masking, Effect::compensation, Effect::coupling})
    EXPECT_FALSE(look.structural().keeps(e));
  EXPECT_EQ(look.surface(look.structural()).spec(), "lambert");
}

TEST(Look, TakesALaterLobeAsGiven) {
  const Look look(
      test::material("ggx/smith_ggx.correlated/schlick+beckmann/smith_beckmann.correlated/schlick",
                     {"f0=0.9,0.5,0.2", "alpha_2=0.4", "f0_2=0.1"}));
  EXPECT_EQ(look.surface(look.structural()).spec(),
            "ggx/smith_ggx.correlated/schlick+beckmann/smith_beckmann.correlated/schlick");
}

}  // namespace
}  // namespace gonio::scene
