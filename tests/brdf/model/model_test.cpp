// What a user writes about a model: the spec, the settings, and what they become.
#include "brdf/model/model.h"

#include <source_location>

#include "base/error.h"
#include "brdf/in_number/one_term.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/presets.h"
#include "brdf/terms.h"
#include "constants.h"
#include "geometry/half_difference.h"
#include "refusal.h"

namespace gonio {
namespace {

using test::eps;

/// Wrong usage, answered by one line that names each of `parts`.
void expect_refused(auto&& call,
                    std::initializer_list<std::string> parts,
                    std::source_location where = std::source_location::current()) {
  const testing::ScopedTrace trace(where.file_name(), static_cast<int>(where.line()),
                                   "called here");
  const std::string line = test::refusal(call, Exit::usage);
  EXPECT_NE(line, "") << "not refused";
  for (const auto& part : parts) EXPECT_HAS(line, part);
}

const std::string ggx = "ggx/smith_ggx.correlated/schlick";
const std::string glass = "ggx/smith_ggx.correlated/dielectric";
const std::string metal = "ggx/smith_ggx.correlated/conductor";

std::vector<Setting> settings(const std::string& words) {
  const std::vector<std::string> list{words};
  return words.empty() ? std::vector<Setting>{} : parse_settings(list);
}
BoundModel bound(const std::string& spec, const std::string& words) {
  return bind_model(spec, settings(words));
}

std::vector<double> values(const BoundModel& b, std::string_view name) {
  const auto* p = b.model.find(name);
  if (!p) {
    ADD_FAILURE() << "no " << name;
    return {};
  }
  const auto first = b.values.begin() + static_cast<std::ptrdiff_t>(p->first);
  return {first, first + static_cast<std::ptrdiff_t>(p->count)};
}
using Values = std::vector<double>;

// ---- Spec ---------------------------------------------------------------------------------------

TEST(Spec, IsADiffuseTermAndLobesInAnyNumber) {
  for (const auto& [text, model] :
       {std::pair<std::string, ModelSpec>{"lambert", {"lambert", {}}},
        {"a/b/c", {"", {{"a", "b", "c"}}}},
        {"d+a/b.x/c+e/f/g", {"d", {{"a", "b.x", "c"}, {"e", "f", "g"}}}},
        {"d+coat:a/b/c", {"d", {}, LobeSpec{"a", "b", "c"}}},
        {"a/b/c+coat:d/e/f", {"", {{"a", "b", "c"}}, LobeSpec{"d", "e", "f"}}}}) {
    EXPECT_EQ(parse_model(text), model) << text;
    EXPECT_EQ(to_text(model), text);
  }
  EXPECT_EQ(to_text(coat_as_lobe(parse_model("d+coat:a/b/c"))), "d+a/b/c");
}

TEST(Spec, WithACoatIsNoModelByItself) {
  expect_refused([&] { compose("lambert+coat:" + ggx, 1); }, {"a coat"});
}

TEST(Spec, NamesAParameterByItsLobe) {
  for (const auto& [text, name, lobe] :
       {std::tuple<std::string, std::string, std::size_t>{"f0", "f0", 0},
        {"f0_2", "f0", 1},
        {"alpha_x_10", "alpha_x", 9},
        {"alpha_x", "alpha_x", 0},
        {"a_1", "a_1", 0},
        {"a_02", "a_02", 0},
        {"a_", "a_", 0}}) {
    const auto p = parse_parameter(text);
    EXPECT_EQ(p.name, name);
    EXPECT_EQ(p.lobe, lobe);
    EXPECT_EQ(to_text(p), text);
  }
}

TEST(Spec, HasSixteenLobesAtMost) {
  std::string most = "lambert";
  for (int i = 0; i < 16; ++i) most += "+" + ggx;
  EXPECT_EQ(parse_model(most).lobes.size(), 16u);
  expect_refused([&] { parse_model(most + "+" + ggx); }, {"18 parts", "16 lobes"});
}

TEST(Spec, OfAnotherFormIsRefused) {
  for (const std::string bad :
       {"", "+", "lambert+", "+a/b/c", "a/b", "a/b/c/d", "a//c", "/b/c", "a/b/", "lambert+lambert",
        "a/b/c+lambert", "lambert+a/b/c+lambert", "a/b/c++d/e/f", "a/b/c+coat:lambert"})
    expect_refused([&] { parse_model(bad); }, {"model '" + bad + "'"});
}

TEST(Spec, WithAnUnknownNameOffersTheNearestOfItsRole) {
  expect_refused([&] { compose("gxx/smith_ggx.correlated/schlick", 3); },
                 {"no normal distribution 'gxx'", "ggx"});
  expect_refused([&] { compose("ggx/smith_ggx.corelated/schlick", 3); },
                 {"no masking", "smith_ggx.correlated"});
  expect_refused([&] { compose("ggx/smith_ggx.correlated/shlick", 3); },
                 {"no Fresnel term 'shlick'", "schlick"});
  expect_refused([&] { compose("lambret+" + ggx, 3); }, {"no diffuse term 'lambret'", "lambert"});
  expect_refused([&] { compose("schlick/ggx/lambert", 3); }, {"no normal distribution 'schlick'"});
  expect_refused([&] { compose("fresnel.schlick/smith_ggx.correlated/schlick", 3); },
                 {"no normal distribution 'fresnel.schlick'"});
  EXPECT_NO_THROW(compose("ndf.ggx/smith_ggx.correlated/schlick", 3));  // whole ids are as good
  expect_refused([&] { compose("GGX/smith_ggx.correlated/schlick", 3); }, {"'GGX'", "ggx"});
}

TEST(Spec, WithACoupledDiffuseNeedsALobe) {
  expect_refused([&] { compose("lambert.coupled", 3); }, {"lambert.coupled", "lobe"});
}

// ---- Model --------------------------------------------------------------------------------------

TEST(Model, SharesAParameterWithinALobeAndNumbersThoseOfLaterLobes) {
  const Model m = compose("lambert+" + ggx + "+gtr/smith_ggx.separable/conductor+" + glass, 3);
  std::vector<std::string> names;
  for (const auto& p : m.parameters) names.push_back(p.name);
  EXPECT_EQ(names, (std::vector<std::string>{"kd", "alpha", "f0", "alpha_2", "gamma_2", "eta_2",
                                             "k_2", "alpha_3", "eta_3"}));
  EXPECT_EQ(m.value_count, 3U + 1 + 3 + 1 + 1 + 3 + 3 + 1 + 3);
  EXPECT_EQ(m.lobes[0].ndf.parameters, m.lobes[0].masking.parameters);
  EXPECT_NE(m.lobes[0].ndf.parameters, m.lobes[1].masking.parameters);
  EXPECT_EQ(m.find("alpha_4"), nullptr);
}

TEST(Model, TakesOfASharedParameterWhatIsLegalInAllTerms) {
  const auto legal = [](const std::string& spec) {
    return compose(spec, 1).find("alpha")->about->legal;
  };
  EXPECT_EQ(legal("disney+ggx_aniso/disney_remap/schlick").low, 1e-12);
  EXPECT_EQ(legal("disney+ggx/disney_remap/schlick").low, 1e-4);
  EXPECT_EQ(legal("ggx/disney_remap/schlick").low, 1e-4);
}

TEST(Model, GivesEachValueASlotOfItsOwn) {
  const Model m = compose("lambert.coupled+" + glass + "+" + metal, 4);
  std::vector<int> used(m.value_count);
  for (const auto& p : m.parameters) {
    EXPECT_EQ(p.count, p.about->per_channel ? 4U : 1U) << p.name;
    for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(p.slot(c), p.first + (p.count > 1 ? c : 0));
    for (std::size_t i = 0; i < p.count; ++i) ++used[p.first + i];
  }
  EXPECT_EQ(used, std::vector<int>(m.value_count, 1));
}

TEST(Model, RefusesAGreyParameterThatItHasNot) {
  const std::vector<std::string> grey{"eta"};
  expect_refused([&] { compose(ggx, 3, grey); }, {"no parameter 'eta'"});
}

// ---- Settings -----------------------------------------------------------------------------------

TEST(Settings, AreNamesWithOneNumberOrAColour) {
  const auto s = settings("alpha=0.25,f0=0.9,0.6,0.5,kd=1e-2");
  ASSERT_EQ(s.size(), 3U);
  EXPECT_EQ(s[0].name, "alpha");
  EXPECT_EQ(s[0].values, Values{0.25});
  EXPECT_EQ(s[1].name, "f0");
  EXPECT_EQ(s[1].values, (Values{0.9, 0.6, 0.5}));
  EXPECT_EQ(s[2].values, Values{0.01});
}

TEST(Settings, MayComeAsWordsApart) {
  const std::vector<std::string> words{"alpha=0.25", "f0=0.9,0.6,0.5", "metal=Au"};
  const auto s = parse_settings(words);
  ASSERT_EQ(s.size(), 3U);
  EXPECT_EQ(s[1].values.size(), 3U);
  EXPECT_EQ(s[2].text, "Au");
  EXPECT_TRUE(parse_settings({}).empty());
}

TEST(Settings, ThatAreNoneAreRefused) {
  expect_refused([&] { settings("0.3"); }, {"0.3", "NAME=VALUE"});
  expect_refused([&] { settings("alpha"); }, {"alpha", "NAME=VALUE"});
  expect_refused([&] { settings("alpha="); }, {"alpha"});
  expect_refused([&] { settings("alpha=x"); }, {"alpha", "'x'"});
  expect_refused([&] { settings("alpha=0.3x"); }, {"alpha", "'0.3x'"});
  expect_refused([&] { settings("alpha=nan"); }, {"alpha", "'nan'"});
  expect_refused([&] { settings("alpha=inf"); }, {"alpha", "'inf'"});
  expect_refused([&] { settings("alpha=0.3,"); }, {"alpha"});
  expect_refused([&] { settings("alpha=0.3,alpha=0.4"); }, {"'alpha'", "twice"});
}

TEST(Settings, NumbersAreReadWhole) {
  EXPECT_EQ(parse_number("-1.5e-3", "x"), -1.5e-3);
  expect_refused([&] { parse_number(" 1", "x"); }, {"x"});
  expect_refused([&] { parse_number("1e999", "x"); }, {"x"});
  expect_refused([&] { parse_number("", "what"); }, {"what"});
}

// ---- Binding ------------------------------------------------------------------------------------

TEST(Binding, KeepsTheDefaultOfWhatIsNotSet) {
  const auto b = bound("lambert+" + ggx, "alpha=0.5");
  EXPECT_EQ(b.model.channels, 3U);
  EXPECT_EQ(values(b, "alpha"), Values{0.5});
  EXPECT_EQ(values(b, "f0"), Values(3, b.model.find("f0")->about->start));
  EXPECT_EQ(values(b, "kd"), Values(3, b.model.find("kd")->about->start));
  EXPECT_EQ(b.given, std::vector<std::string>{"alpha"});
}

TEST(Binding, HasAsManyChannelsAsTheLongestColour) {
  EXPECT_EQ(bound(ggx, "f0=0.1,0.2").model.channels, 2U);
  EXPECT_EQ(bound(ggx, "f0=0.1").model.channels, 3U);
  EXPECT_EQ(values(bound(ggx, "f0=0.1"), "f0"), Values(3, 0.1));
  EXPECT_EQ(bind_model(ggx, settings("f0=0.1"), 1).values.size(), 2U);
  expect_refused([&] { bind_model(ggx, settings("f0=0.1,0.2,0.3"), 1); }, {"f0", "3 values"});
  expect_refused([&] { bound("lambert+" + ggx, "f0=0.1,0.2,0.3,kd=0.1,0.2"); }, {"kd", "2 values"});
  expect_refused([&] { bound(ggx, "alpha=0.1,0.2,0.3"); }, {"alpha", "3 values", "one"});
}

TEST(Binding, SquaresRoughness) {
  EXPECT_EQ(values(bound(ggx, "roughness=0.5"), "alpha"), Values{0.25});
  const auto two = bound(ggx + "+" + ggx, "roughness=0.5,roughness_2=0.9");
  EXPECT_EQ(values(two, "alpha"), Values{0.25});
  EXPECT_EQ(values(two, "alpha_2"), Values{0.9 * 0.9});
  expect_refused([&] { bound(ggx, "roughness=0.5,alpha=0.25"); }, {"roughness", "alpha"});
  expect_refused([&] { bound(ggx, "alpha=0.25,roughness=0.5"); }, {"roughness", "alpha"});
  expect_refused([&] { bound(ggx, "roughness=-0.5"); }, {"outside"});
  expect_refused([&] { bound(ggx, "roughness=1.01"); }, {"outside"});
  expect_refused([&] { bound("oren_nayar", "sigma=20"); },
                 {"outside [0, 1.57", " rad ", "20° would be 0.349"});
  expect_refused([&] { bound(ggx, "roughness_2=0.5"); }, {"no parameter 'roughness_2'"});
}

TEST(Binding, TurnsTheF0OfADielectricIntoItsIndex) {
  EXPECT_NEAR(values(bound(glass, "f0=0.04"), "eta")[0], 1.5, 4 * eps);
  EXPECT_EQ(values(bound(glass, "f0=0"), "eta")[0], 1);
  const auto b = bound(ggx + "+" + glass, "f0=0.5,f0_2=0.04");
  EXPECT_EQ(values(b, "f0")[0], 0.5);
  EXPECT_NEAR(values(b, "eta_2")[0], 1.5, 4 * eps);
  for (const double eta : {1.1, 1.5, 2.0, 4.0}) {
    const double r = (eta - 1) / (eta + 1);
    const auto back = bind_model(glass, {{"f0", {r * r}}});
    EXPECT_NEAR(values(back, "eta")[0], eta, 16 * eps * eta);
  }
  expect_refused([&] { bound(glass, "f0=0.04,eta=1.5"); }, {"f0", "eta"});
  expect_refused([&] { bound(glass, "eta=1.5,f0=0.04"); }, {"f0", "eta"});
  expect_refused([&] { bound(ggx, "f0=0.04,eta=1.5"); }, {"f0", "eta"});
  expect_refused([&] { bound(ggx + "+" + glass, "f0_2=0.04,eta_2=1.5"); }, {"f0_2", "eta_2"});
  expect_refused([&] { bound(glass, "f0=1"); }, {"f0 = 1", "[0, 1)"});
  expect_refused([&] { bound(glass, "f0=-0.1"); }, {"f0", "[0, 1)"});
  expect_refused([&] { parse_settings(std::vector<std::string>{"metal=Au,Ag"}); },
                 {"metal: found Au and Ag, expected one"});
  expect_refused([&] { bound(metal, "f0=0.9"); },
                 {"no parameter 'f0'"});  // a conductor has two unknowns
}

TEST(Binding, KnowsMetals) {
  const auto b = bound(metal, "metal=Au");
  EXPECT_EQ(b.model.channels, 3U);
  const Values eta{0.1556, 0.4241, 1.3831}, k{3.6024, 2.4721, 1.9155};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(values(b, "eta").at(c), eta[c], 5e-5);
    EXPECT_NEAR(values(b, "k").at(c), k[c], 5e-5);
  }
  EXPECT_EQ(values(bound(metal, "metal=gold"), "k"), values(b, "k"));
  expect_refused([&] { bound(metal, "metal=Unobtainium"); },
                 {"no metal 'Unobtainium'", "Au", "Ag", "W"});
  expect_refused([&] { bound(metal, "metal=Au,k=3"); }, {"metal", "k"});
  expect_refused([&] { bound(metal, "metal=Au,eta=3"); }, {"metal", "eta"});
  expect_refused([&] { bound(ggx, "metal=Au"); }, {"metal", "conductor"});
  expect_refused([&] { bound(glass, "metal=Au"); }, {"metal", "conductor"});
}

TEST(Binding, MixesBaseColorByMetallic) {
  const auto b = bound("lambert+" + ggx, "base_color=0.8,0.5,0.1,metallic=0.25,roughness=0.5");
  EXPECT_TRUE(catalogue()[b.model.diffuse.at(0).term].coupled);
  const double colour[] = {0.8, 0.5, 0.1};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(values(b, "f0")[c], 0.75 * 0.04 + 0.25 * colour[c], 2 * eps);
    EXPECT_NEAR(values(b, "kd")[c], 0.75 * colour[c], 2 * eps);
  }
  EXPECT_EQ(values(bound("lambert+" + ggx, "base_color=0.5"), "f0"), Values(3, 0.04));
  EXPECT_EQ(values(bound("lambert+" + ggx, "base_color=0.5,metallic=1"), "kd"), Values(3, 0));
  EXPECT_EQ(values(bound("lambert+" + ggx, "base_color=0.5,metallic=1"), "f0"), Values(3, 0.5));
  const auto coupled = bound("lambert.coupled+" + ggx, "base_color=0.5");
  EXPECT_EQ(values(coupled, "kd"), Values(3, 0.5));
}

TEST(Binding, LeavesAnUncoupledDiffuseUncoupledWithoutBaseColor) {
  EXPECT_FALSE(catalogue()[bound("lambert+" + ggx, "f0=0.04").model.diffuse.at(0).term].coupled);
}

TEST(Binding, RefusesBaseColorWithWhatItSets) {
  const std::string spec = "lambert+" + ggx;
  for (const std::string other : {"f0=0.04", "kd=0.5", "eta=1.5", "k=3", "metal=Au"}) {
    expect_refused([&] { bound(spec, "base_color=0.5," + other); },
                   {"base_color", other.substr(0, other.find('='))});
    expect_refused([&] { bound(spec, other + ",metallic=0.5"); },
                   {"metallic", other.substr(0, other.find('='))});
  }
  expect_refused([&] { bound(spec, "metallic=0.5"); }, {"metallic needs base_color"});
  expect_refused([&] { bound(spec, "base_color=1.1"); }, {"[0, 1]"});
  expect_refused([&] { bound(spec, "base_color=0.5,metallic=-0.1"); }, {"[0, 1]"});
  expect_refused([&] { bound(spec, "base_color=0.5,metallic=0.1,0.2,0.3"); }, {"metallic"});
  expect_refused([&] { bound(ggx, "base_color=0.5"); }, {"no parameter 'kd'"});
}

TEST(Binding, RefusesWhatIsUnknownAndSaysWhatThereIs) {
  expect_refused([&] { bound("lambert+" + ggx, "alhpa=0.5"); },
                 {"no parameter 'alhpa'", "kd", "alpha", "f0"});
  expect_refused([&] { bound(ggx, "f0_2=0.5"); }, {"no parameter 'f0_2'"});
  expect_refused([&] { bound(ggx, "gamma=2"); }, {"no parameter 'gamma'"});
}

TEST(Binding, RefusesWhatIsOutOfRangeAndSaysTheRange) {
  for (const auto& t : catalogue())
    for (const auto& p : t.parameters) {
      const std::string name(p.name);
      expect_refused([&] { check_range(p, name, std::nextafter(p.legal.high, 1e300)); },
                     {name, "outside ["});
      expect_refused([&] { check_range(p, name, std::nextafter(p.legal.low, -1e300)); },
                     {name, "outside ["});
      expect_refused([&] { check_range(p, name, std::nan("")); }, {name, "outside ["});
      EXPECT_NO_THROW(check_range(p, name, p.legal.low));
      EXPECT_NO_THROW(check_range(p, name, p.legal.high));
    }
  expect_refused([&] { bound(ggx, "alpha=0"); }, {"alpha = 0", "[0.0001, 1]"});
  expect_refused([&] { bound(ggx, "f0=0.5,0.5,1.5"); }, {"f0 = 1.5", "[0, 1]"});
  expect_refused([&] { bound("gtr/smith_ggx.correlated/schlick", "gamma=11"); },
                 {"gamma = 11", "[0.5, 10]"});
}

// ---- One term alone -----------------------------------------------------------------------------

using At = std::map<std::string, std::vector<double>>;

TEST(Term, IsFoundByItsIdOrWithinItsRoleByTheShortOne) {
  for (std::size_t i = 0; i < catalogue().size(); ++i) {
    const auto id = catalogue()[i].about->id;
    EXPECT_EQ(find_term(id), i);
    EXPECT_EQ(find_term(short_id(id), role_of(id)), i);
  }
  expect_refused([&] { find_term("ndf.gggx"); }, {"no term 'ndf.gggx'", "ndf.ggx"});
  expect_refused([&] { find_term(""); }, {"no term ''"});
  expect_refused([&] { find_term("ggx", Role::fresnel); }, {"no Fresnel term 'ggx'"});
}

TEST(Term, AloneGivesItsValues) {
  const auto v =
      evaluate_term(find_term("ndf.ggx"), Number::double_, {{"alpha", 0.25}}, {{"noh", {1, 0.9}}});
  ASSERT_EQ(v.values.size(), 2U);
  EXPECT_NEAR(v.values[0], 5.092958178940651, 1e-14);  // 16/π
  const double t = 0.81 * (0.0625 - 1) + 1;
  EXPECT_NEAR(v.values[1], 0.0625 / (3.141592653589793 * t * t), 1e-14);
  EXPECT_EQ(v.parameters, (std::vector<std::pair<std::string, double>>{{"alpha", 0.25}}));
}

TEST(Term, AloneGivesMaskingAsG2OrG1) {
  for (const auto& id : {"masking.smith_ggx.correlated", "masking.smith_ggx.separable"}) {
    const auto term = find_term(id);
    const auto g1 =
        evaluate_term(term, Number::double_, {{"alpha", 0.25}}, {{"nov", {0.1, 1}}}).values;
    EXPECT_NEAR(g1[0], 2 / (1 + std::sqrt(1 + 99.0 / 16)), 4 * eps);
    EXPECT_NEAR(g1[1], 1, 4 * eps);
    const At both{{"nol", {0.1}}, {"nov", {0.1}}};
    const double g2 = evaluate_term(term, Number::double_, {{"alpha", 0.25}}, both).values[0];
    const double lambda = 1 / g1[0] - 1;
    EXPECT_NEAR(
        g2, term == find_term("masking.smith_ggx.separable") ? g1[0] * g1[0] : 1 / (1 + 2 * lambda),
        8 * eps);
  }
}

TEST(Term, AloneIsFiniteAtGrazing) {
  const At grazing{{"nol", {0, 0, 0.5}}, {"nov", {0, 0.5, 0}}, {"voh", {0.7}}};
  for (const auto m : test::terms_of(Role::masking))
    for (const auto number : {Number::double_, Number::float_})
      for (const double g : evaluate_term(m, number, {}, grazing).values) EXPECT_EQ(g, 0);
}

TEST(Term, AloneTakesOneColumnOrColumnsOfOneLength) {
  const auto term = find_term("masking.smith_ggx.correlated");
  const auto with = [&](const At& at) {
    return evaluate_term(term, Number::double_, {}, at).values;
  };
  EXPECT_EQ(with({}).size(), 1U);
  const auto three = with({{"nol", {0.5}}, {"nov", {0.1, 0.2, 0.3}}});
  ASSERT_EQ(three.size(), 3U);
  EXPECT_EQ(three[1], with({{"nol", {0.5}}, {"nov", {0.2}}})[0]);
  expect_refused([&] { with({{"nol", {0.5, 0.6}}, {"nov", {0.1, 0.2, 0.3}}}); }, {"3 values", "2"});
  expect_refused([&] { with({{"theta", {0.5}}}); }, {"unknown angle 'theta'", "nov"});
  expect_refused([&] { with({{"nov", {1.1}}}); }, {"nov = 1.1", "[0, 1]"});
  expect_refused([&] { with({{"nov", {std::nan("")}}}); }, {"nov", "[0, 1]"});
  expect_refused([&] { with({{"cos", {0.5}}, {"voh", {0.5}}}); }, {"same angle"});
}

TEST(Term, AloneTakesTheCosineOfFresnelByEitherName) {
  const auto term = find_term("fresnel.schlick");
  const auto with = [&](const At& at) {
    return evaluate_term(term, Number::double_, {{"f0", 0.04}}, at).values;
  };
  EXPECT_EQ(with({{"cos", {0.5, 0, 1}}}), with({{"voh", {0.5, 0, 1}}}));
  EXPECT_EQ(with({{"cos", {0}}})[0], 1);
  EXPECT_EQ(with({{"cos", {1}}})[0], 0.04);
}

TEST(Term, AloneTakesSinSquaredWhereTheCosineHasLostIt) {
  const auto ggx_term = find_term("ndf.ggx");
  const double alpha = 1e-4, sin2 = 1e-16;
  const auto v = evaluate_term(ggx_term, Number::double_, {{"alpha", alpha}},
                               {{"noh", {1}}, {"sin2_theta_h", {sin2}}});
  const double t = alpha * alpha + sin2, expected = alpha * alpha / (3.141592653589793 * t * t);
  EXPECT_NEAR(v.values[0], expected, 8 * eps * expected);
}

TEST(Term, AloneInFloatIsTheFloatFormula) {
  for (std::size_t t = 0; t < catalogue().size(); ++t) {
    const At at{{"noh", {0.95}}, {"nol", {0.3}}, {"nov", {0.6}}, {"voh", {0.7}}};
    const double d = evaluate_term(t, Number::double_, {}, at).values[0];
    const double f = evaluate_term(t, Number::float_, {}, at).values[0];
    EXPECT_NEAR(f, d, 3e-6 * d) << catalogue()[t].about->id;
    EXPECT_EQ(f, static_cast<double>(static_cast<float>(f))) << "a float";
  }
}

/// Every term beside others that are told, and what the model's value says of it.
TEST(Term, AloneIsWhatAModelHasOfItOverTheCatalogue) {
  const auto near = [](double got, double want, const About& about) {
    EXPECT_NEAR(got, want, 1e-7 * std::abs(want) + 1e-12) << about.id;
  };
  for (const auto& [l, v] : {std::pair(direction(0.9, 0.3), direction(0.5, 2.1)),
                             {direction(0.2, 1), direction(1.1, 5)}}) {
    const auto x = frame_angles({l, v});
    const At directions{{"nol", {x.nol}}, {"nov", {x.nov}}}, facing{{"voh", {x.voh}}};
    At half{{"noh", {x.noh}}, {"sin2_theta_h", {x.sin2_theta_h}}}, two = directions,
                                                                   frame = directions;
    two.merge(At(facing));
    frame.merge(At{{"xol", {x.xol}}, {"yol", {x.yol}}, {"xov", {x.xov}}, {"yov", {x.yov}}});
    for (std::size_t t = 0; t < catalogue().size(); ++t) {
      const auto& about = *catalogue()[t].about;
      const std::string own(short_id(about.id));
      if (find_preset(own)) continue;  // as "disney", which is a whole model there
      const auto model = [&](const std::string& spec, std::vector<Setting> set) {
        return bind_model(spec, std::move(set), 1);
      };
      const auto value = [&](const BoundModel& b) { return evaluate(b, std::vector{x})[0][0]; };
      const auto alone = [&](std::string_view id, const BoundModel& b, const At& at) {
        const auto term = find_term(id);
        std::map<std::string, double> p;
        for (const auto& q : catalogue()[term].parameters)
          p[std::string(q.name)] = b.values[b.model.find(q.name)->first];
        return evaluate_term(term, Number::double_, p, at).values[0];
      };
      const double uncompensated = 4 * x.nol * x.nov;
      switch (catalogue()[t].role()) {
        case Role::ndf: {
          At at = half;
          if (catalogue()[t].anisotropic) at.merge(At{{"xoh", {x.xoh}}, {"yoh", {x.yoh}}});
          const auto b = model(own + "/none/schlick", {{"f0", {1}}});
          near(alone(about.id, b, at), value(b) * uncompensated, about);
          break;
        }
        case Role::masking: {
          const auto b = model("ggx/" + own + "/schlick", {{"f0", {1}}});
          const auto& at = catalogue()[t].anisotropic ? frame : two;
          near(alone(about.id, b, at), value(b) * uncompensated / alone("ndf.ggx", b, half), about);
          break;
        }
        case Role::fresnel: {
          const auto b = model("ggx/none/" + own, {});
          near(alone(about.id, b, facing), value(b) * uncompensated / alone("ndf.ggx", b, half),
               about);
          break;
        }
        case Role::diffuse: {
          if (!catalogue()[t].coupled) {
            const auto b = model(own, {});
            near(alone(about.id, b, two), value(b), about);
            break;
          }
          const auto b = model(own + "+ggx/none/schlick", {});
          auto lobe = b;
          lobe.model.diffuse.clear();
          near(alone(about.id, b, two) * (1 - alone("fresnel.schlick", b, facing)),
               value(b) - value(lobe), about);
        }
      }
    }
  }
}

TEST(Term, AloneAsksForTheHalfVectorWhereItDoesNotFollow) {
  const auto hammon = find_term("diffuse.hammon");
  const auto with = [&](const At& at) {
    return evaluate_term(hammon, Number::double_, {{"alpha", 0.5}, {"kd", 0.6}}, at).values[0];
  };
  expect_refused([&] { with({{"nol", {0.4}}, {"nov", {0.7}}}); }, {"voh or noh"});
  expect_refused(
      [&] {
        with({{"nol", {0.9}}, {"nov", {0.9}}, {"voh", {0.1}}});
      },
      {"no two directions"});
  // Light along the normal: both cosines of the half vector are that of half the angle.
  const double middle = std::sqrt(0.85);
  EXPECT_NEAR(with({{"nov", {0.7}}}), with({{"nol", {1}}, {"nov", {0.7}}, {"noh", {middle}}}),
              1e-15);
  // 2 VoH NoH = NoL + NoV
  EXPECT_NEAR(with({{"nol", {0.4}}, {"nov", {0.7}}, {"voh", {0.8}}}),
              with({{"nol", {0.4}}, {"nov", {0.7}}, {"noh", {1.1 / 1.6}}}), 1e-15);
  EXPECT_GT(std::abs(with({{"nol", {0.4}}, {"nov", {0.7}}, {"voh", {0.8}}}) -
                     with({{"nol", {0.4}}, {"nov", {0.7}}, {"voh", {0.8}}, {"noh", {1}}})),
            1e-3);
}

TEST(Term, AloneRefusesParametersThatItHasNotOrNotThere) {
  const auto with = [](const std::map<std::string, double>& p) {
    return evaluate_term(find_term("ndf.ggx"), Number::double_, p, {});
  };
  expect_refused([&] { with({{"beta", 1}}); }, {"ndf.ggx", "'beta'"});
  expect_refused([&] { with({{"alpha", 2}}); }, {"alpha = 2", "[0.0001, 1]"});
  EXPECT_EQ(with({}).parameters[0].second, catalogue()[find_term("ndf.ggx")].parameters[0].start);
}

}  // namespace
}  // namespace gonio
