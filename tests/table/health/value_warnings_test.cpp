// Values that are no f in 1/sr are said to be what they are, and those that are f are left alone.
#include "table/health/value_warnings.h"

#include <cmath>
#include <functional>
#include <random>

#include "brdf/model/evaluate.h"
#include "table/example.h"
#include "table/format/measured_by.h"
#include "tables.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

/// Paint on ten incident angles × ten zenith angles × azimuths to `turn`, or in the plane of incidence.
/// \param first  incident angle: from 4° on no sample has a reciprocal partner
Table painted(double turn, double kd = 0.3, double alpha = 0.3, double first = 0) {
  DirectionList l;
  const auto add = [&](double in, double out, double phi) {
    l.theta_i_deg.push_back(in);
    l.phi_i_deg.push_back(0);
    l.theta_o_deg.push_back(out);
    l.phi_o_deg.push_back(phi);
  };
  for (double in = first; in < 80; in += 8)
    for (double out = 0; out < 88; out += 8)
      for (double phi = 0; phi <= turn; phi += turn < 360 ? 180 / 12 : 15)
        if ((out > 0 || phi == 0) && (turn > 0 ? phi < 360 : true)) add(in, out, phi);
  if (turn == 0)
    for (std::size_t i = 0, n = l.theta_i_deg.size(); i < n; ++i)
      if (l.theta_o_deg[i] > 0) add(l.theta_i_deg[i], l.theta_o_deg[i], 180);
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  t.where = std::move(l);
  const auto model = bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                                {{"alpha", {alpha}}, {"f0", {0.05}}, {"kd", {kd}}}, 1);
  test::put_values(t, model);
  return t;
}

/// The sentences after the values were changed.
std::vector<ValueWarning> warnings_of(
    Table t, const std::function<double(const Angles<double>&, double)>& change) {
  const SampleAngles at(t);
  for (auto& plane : t.values)
    for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = change(at(i), plane[i]);
  TableFacts facts(t);
  return value_warnings(facts);
}
std::vector<std::string> said_of(
    Table t, const std::function<double(const Angles<double>&, double)>& change) {
  std::vector<std::string> all;
  for (auto& w : warnings_of(std::move(t), change)) all.push_back(std::move(w.text));
  return all;
}
bool says(const std::vector<std::string>& all, std::string_view words) {
  return std::ranges::any_of(all, [&](const auto& s) { return s.find(words) != s.npos; });
}
double as_it_is(const Angles<double>&, double f) {
  return f;
}

TEST(ValueWarnings, SayNothingOfAPaint) {
  for (const double turn : {0.0, 180.0, 360.0})
    EXPECT_TRUE(said_of(painted(turn), as_it_is).empty())
        << turn << " " << said_of(painted(turn), as_it_is)[0];
  EXPECT_TRUE(said_of(painted(180, 0.01, 0.15), as_it_is).empty());
}

TEST(ValueWarnings, SayThatMoreLightLeavesThanArrivesHoweverFarRoundTheSamplesGo) {
  for (const double turn : {180.0, 360.0})
    EXPECT_TRUE(says(said_of(painted(turn), [](const auto&, double f) { return 3 * M_PI * f; }),
                     "times the light at theta_i"))
        << turn;
  EXPECT_TRUE(
      says(said_of(painted(0, 0.6), [](const auto&, double f) { return M_PI * f; }), "probably"));
  EXPECT_TRUE(says(said_of(painted(180, 0.6), [](const auto&, double f) { return M_PI * f; }),
                   "a radiance factor? (gonio columns FILE --scale 0.3183099)"));
  EXPECT_TRUE(says(said_of(painted(180), [](const auto&, double f) { return 100 * M_PI * f; }),
                   "in percent? (gonio columns FILE --scale 0.003183099)"));
  EXPECT_TRUE(
      says(said_of(painted(180), [](const auto&, double f) { return 1e5 * f; }), "counts?"));
  EXPECT_TRUE(says(said_of(painted(180), [](const auto&, double f) { return 1e-4 * f; }),
                   "relative scale?"));
}

TEST(ValueWarnings, SayThatMoreLightLeavesThanArrivesWhereNoDirectionRepeats) {
  Table t = painted(180);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> apart(0, 1e-3);
  auto& list = std::get<DirectionList>(t.where);
  for (auto& theta : list.theta_i_deg) theta += apart(random);
  EXPECT_TRUE(said_of(t, [](const auto&, double f) { return f; }).empty());
  EXPECT_TRUE(says(said_of(t, [](const auto&, double f) { return 1e5 * f; }), "counts?"));
}

TEST(ValueWarnings, NameTheReferenceOfValuesInPercentOfATarget) {
  Table t = painted(180);
  for (double& f : t.values[0])
    f *= 100 * M_PI / 0.99;  // what a target of 0.99 is worth, in percent
  take_reference(t, 0.99);
  EXPECT_TRUE(
      says(said_of(t, as_it_is), "in percent of the target? (gonio fit FILE --reference 0.0099)"));
  EXPECT_FALSE(says(said_of(t, as_it_is), "--scale"));
}

TEST(ValueWarnings, SayWhichCosineIsLeftIn) {
  const auto said = [](double incident, double outgoing) {
    return said_of(painted(180), [=](const auto& a, double f) {
      return f * std::pow(a.nol, incident) * std::pow(a.nov, outgoing);
    });
  };
  EXPECT_TRUE(says(said(0, 1), "they look like f cos(theta_o) (gonio columns FILE --cosine)"));
  EXPECT_TRUE(says(said(1, 0), "they look like f cos(theta_i)"));
  EXPECT_TRUE(
      says(said(-1, 0), "they look like f/cos(theta_i) (gonio columns FILE --cosines=-1,0)"));
  EXPECT_TRUE(says(said(0, -1), "they look like f/cos(theta_o)"));
  EXPECT_TRUE(says(said(1, 1), "probably they are f cos(theta_i) cos(theta_o)"));
}

TEST(ValueWarnings, SayWhichCosineIsLeftInWhereNoSampleHasAPartner) {
  const auto said = [](double incident, double outgoing) {
    const auto change = [=](const auto& a, double f) {
      return f * std::pow(a.nol, incident) * std::pow(a.nov, outgoing);
    };
    return said_of(painted(180, 0.3, 0.3, 4), change);
  };
  EXPECT_TRUE(said(0, 0).empty());
  EXPECT_TRUE(says(said(0, 1), "they look like f cos(theta_o) (gonio columns FILE --cosine)"));
  EXPECT_TRUE(says(said(1, 0), "they look like f cos(theta_i)"));
  EXPECT_TRUE(says(said(-1, 0), "they look like f/cos(theta_i)"));
  EXPECT_TRUE(says(said(0, -1), "they look like f/cos(theta_o)"));
  EXPECT_FALSE(says(said(-1, -1), "radiance factor")) << "the cosines make the light";
  // At one incident angle only the other cosine can be told.
  const auto of_one = [](double cosine) {
    return said_of(painted(180, 0.3, 0.3, 4), [cosine](const auto& a, double f) {
      return std::abs(a.nol - std::cos(44 * degree)) < 1e-9 ? f * std::pow(a.nov, cosine)
                                                            : std::nan("");
    });
  };
  EXPECT_TRUE(of_one(0).empty());
  EXPECT_TRUE(says(of_one(1), "probably they are f cos(theta_o)"));
  // A metal's tail falls, too.
  for (const double alpha : {0.2, 0.5, 0.9})
    EXPECT_TRUE(said_of(painted(180, 0, alpha, 4), as_it_is).empty()) << alpha;
}

/// The directions of painted() with the values of another model.
Table as_painted(double turn, double first, const char* model, const std::vector<Setting>& with) {
  Table t = painted(turn, 0.3, 0.3, first);
  test::put_values(t, bind_model(model, with, 1));
  return t;
}

TEST(ValueWarnings, NameBothCosinesWhereNoExchangeTellsThemApart) {
  // Sheen changes with the angles as a cosine does.
  const auto sheen = as_painted(0, 0, "charlie/smith_charlie.correlated/schlick",
                                {{"alpha", {0.5}}, {"f0", {0.05}}});
  const auto all = said_of(sheen, [](const auto& a, double f) { return f * a.nov; });
  EXPECT_TRUE(says(all, "f/cos(theta_i)"));
  EXPECT_TRUE(says(all, "f cos(theta_o)"));
}

TEST(ValueWarnings, TakeNoMatteSurfaceTimesBothCosinesForElevations) {
  for (const double turn : {0.0, 180.0}) {
    const auto matte = as_painted(turn, 4, "oren_nayar", {{"kd", {0.5}}, {"sigma", {0.5}}});
    const auto all = said_of(matte, [](const auto& a, double f) { return f * a.nol * a.nov; });
    EXPECT_TRUE(says(all, "f cos(theta_i) cos(theta_o) (gonio columns FILE --cosines=1,1)"))
        << turn;
    EXPECT_FALSE(says(all, "90-theta")) << turn;
  }
}

TEST(ValueWarnings, DoNotRefuseAnAnisotropicSurface) {
  const auto all = warnings_of(painted(180),
                               [](const auto& a, double f) { return a.nol > a.nov ? 1.5 * f : f; });
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NE(all[0].text.find("an anisotropic surface"), std::string::npos) << all[0].text;
  EXPECT_FALSE(all[0].of_unit) << "an anisotropic model may be right";
}

TEST(ValueWarnings, SayThatExchangedDirectionsChangeValuesByFarMoreThanNoise) {
  EXPECT_TRUE(says(
      said_of(painted(180), [](const auto& a, double f) { return a.nol > a.nov ? 1.5 * f : f; }),
      "exchanging the directions"));
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  EXPECT_FALSE(
      says(said_of(painted(180),
                   [&](const auto&, double f) { return f * std::exp(0.1 * normal(random)); }),
           "exchanging the directions"));
}

TEST(ValueWarnings, LeaveAModelInPlayWhereTheInstrumentChangesValuesAnExchangeKeeps) {
  for (const auto& [share, told] : {std::pair{0.08, true}, {0.03, false}}) {
    const double more = 1 + share;
    const auto all = warnings_of(
        painted(180), [more](const auto& a, double f) { return a.nol > a.nov ? more * f : f; });
    ASSERT_EQ(all.size(), told ? 1u : 0u) << share;
    EXPECT_FALSE(told && all[0].of_unit) << "a model may still be chosen by them";
  }
}

TEST(ValueWarnings, SayThatValuesAreRoundedCoarsely) {
  const auto rounded = [](double step) {
    return said_of(painted(180),
                   [=](const auto&, double f) { return step * std::round(f / step); });
  };
  EXPECT_TRUE(says(rounded(0.01), "rounded to steps of 0.01 1/sr, typically 2.9 % of a value"));
  EXPECT_TRUE(rounded(0.001).empty());
  const auto one_digit = [](const auto&, double f) {
    const double place = std::pow(10, std::floor(std::log10(f)));
    return place * std::round(f / place);
  };
  EXPECT_TRUE(says(said_of(painted(180, 0.1, 0.15), one_digit), "1 significant digit,"));
}

TEST(ValueWarnings, SayThatZerosAreLeftOut) {
  const auto clipped =
      said_of(painted(180, 0.05), [](const auto& a, double f) { return a.nov < 0.3 ? 0 : f; });
  EXPECT_TRUE(says(clipped, "values are 0, clipped noise"));
  const auto rounded = said_of(painted(180, 0.005, 0.15),
                               [](const auto&, double f) { return std::round(f * 1000) / 1000; });
  EXPECT_TRUE(says(rounded, "values are rounded to one digit or to 0"));
  const auto nearly_all = said_of(painted(180, 0.005, 0.3),
                                  [](const auto&, double f) { return std::round(f * 100) / 100; });
  EXPECT_TRUE(says(nearly_all, "values are rounded to one digit or to 0"));
  EXPECT_FALSE(says(nearly_all, "clipped"));
}

TEST(ValueWarnings, KnowHowLargeValuesAreThatNoiseTookAway) {
  const Table clean = painted(180, 0.005, 0.15);
  TableFacts of_clean(clean);
  EXPECT_EQ(lost_below(of_clean), 0);
  Table clipped = clean, rounded = clean;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (double& f : clipped.values[0]) f = std::max(f + 0.003 * normal(random), 0.0);
  for (double& f : rounded.values[0]) f = std::round(f * 100) / 100;
  TableFacts of_clipped(clipped), of_rounded(rounded);
  EXPECT_GT(lost_below(of_clipped), 0.002);
  EXPECT_LT(lost_below(of_clipped), 0.008);
  EXPECT_NEAR(lost_below(of_rounded), 0.005, 1e-6);
}

TEST(ValueWarnings, SayThatADetectorWasFull) {
  const auto said = said_of(painted(180), [](const auto&, double f) { return std::min(f, 0.12); });
  EXPECT_TRUE(says(said, "values of channel f are 0.12, and none is more: a full detector?"));
  EXPECT_TRUE(says(said, "(--mask 'f >= 0.12' leaves them out)"));
  // Few in each channel, but of one detector.
  Table t = painted(180);
  t.channels = {"r", "g", "b"};
  t.values.resize(3, t.values[0]);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto three = said_of(t, [&](const auto&, double f) {
    return std::min(f * std::exp(0.01 * normal(random)), 0.33);
  });
  EXPECT_TRUE(says(three, "values of channel r, g, b are 0.33, and none is more"));
  EXPECT_TRUE(says(three, "(--mask 'f_r >= 0.33 or f_g >= 0.33 or f_b >= 0.33' leaves them out)"));
  // A spectrum has thousands of channels: a sentence lists a few.
  Table many = painted(180);
  many.channels.clear();
  for (int c = 0; c < 1000; ++c)
    many.channels.push_back("a channel of a long name " + std::to_string(c));
  many.values.resize(1000, many.values[0]);
  for (const auto& sentence :
       said_of(many, [](const auto&, double f) { return std::min(f, 0.12); }))
    EXPECT_LT(sentence.size(), 1500U) << sentence;
  // Short numbers are shared by many samples, the greatest by no more than others.
  EXPECT_FALSE(
      says(said_of(painted(180), [](const auto&, double f) { return std::round(f * 100) / 100; }),
           "full detector"));
  EXPECT_FALSE(says(said_of(painted(180), [](const auto&, double) { return 0.2; }), "detector"));
}

TEST(ValueWarnings, TellAChannelThatIsNegativeByItselfFromANoiseFloor) {
  const auto table = [](bool one, double noise) {
    Table t = painted(180, 0.01, 0.1);
    t.channels = {"r", "g", "b"};
    t.values.resize(3, t.values[0]);
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    for (std::size_t c = 0; c < 3; ++c)
      for (double& v : t.values[c])
        v = v * std::exp(0.01 * normal(random)) + noise * normal(random) -
            (one && c == 0 ? 0.005
             : c > 0       ? -0.01
                           : 0);
    return t;
  };
  const Table gamut = table(true, 0);
  TableFacts facts(gamut);
  EXPECT_TRUE(std::ranges::any_of(value_warnings(facts), [](const ValueWarning& w) {
    return w.text.starts_with("all negative values are of channel r");
  }));
  EXPECT_EQ(facts.negative_channel(), std::size_t{0});
  EXPECT_EQ(facts.noise_floor(), 0);
  const Table dark = table(false, 0.004);
  EXPECT_FALSE(TableFacts(dark).negative_channel());
  EXPECT_GT(noise_floor(dark), 0);
}

TEST(Uncertainties, FarBelowTheOthersAreNamed) {
  Table t = painted(360);
  const auto said = [&] {
    TableFacts facts(t);
    const auto all = value_warnings(facts);
    return std::ranges::any_of(
        all, [](const ValueWarning& w) { return w.text.find("stated uncert") != w.text.npos; });
  };
  // Twice a part of the value, and once the same for all, though the highlight is then far surer.
  for (const double of_value : {0.02, 0.3, 0.0}) {
    t.errors = t.values;
    for (double& u : t.errors[0]) u = of_value > 0 ? of_value * u : 1e-3;
    EXPECT_FALSE(said()) << of_value;
    t.errors[0][16] = 1e-9;
    EXPECT_TRUE(said()) << of_value;
  }
}

/// Zenith angles, of light or viewer or both, as elevations above the surface.
Table as_elevations(Table t, bool incident, bool outgoing) {
  auto& l = std::get<DirectionList>(t.where);
  for (auto& [theta, turns] : {std::pair(&l.theta_i_deg, incident), {&l.theta_o_deg, outgoing}})
    if (turns)
      for (double& deg : *theta) deg = 90 - deg;
  return t;
}

TEST(ValueWarnings, SayThatZenithAnglesAreElevations) {
  for (const double alpha : {0.1, 0.2, 0.4}) {
    const Table t = painted(180, 0.1, alpha, 4);
    EXPECT_TRUE(
        says(said_of(as_elevations(t, true, true), as_it_is), "are zenith angles elevations?"))
        << alpha;
    EXPECT_TRUE(says(said_of(as_elevations(t, false, true), as_it_is), "is theta_o an elevation?"))
        << alpha;
    EXPECT_TRUE(says(said_of(as_elevations(t, true, false), as_it_is), "is theta_i an elevation?"))
        << alpha;
    for (const double kd : {0.0, 0.02, 0.6})
      for (const double turn : {0.0, 180.0})
        EXPECT_FALSE(says(said_of(painted(turn, kd, alpha, 4), as_it_is), "elevation"))
            << alpha << " " << kd;
  }
}

TEST(ValueWarnings, BlameNoBrightMirrorForItsNarrowHighlight) {
  for (const double alpha : {0.01, 0.02, 0.05}) {
    Table t = painted(360, 0, alpha);
    test::put_values(
        t, bind_model("ggx/smith_ggx.correlated/schlick", {{"alpha", {alpha}}, {"f0", {1}}}, 1));
    EXPECT_FALSE(says(said_of(t, as_it_is), "the light")) << alpha;
  }
}

TEST(ValueWarnings, NameTheOnlyChannelWithAnotherScale) {
  const auto said = [](std::array<double, 3> scale) {
    Table t = painted(180, 0.1);
    t.channels = {"r", "g", "b"};
    t.values.resize(3, t.values[0]);
    for (std::size_t c = 0; c < 3; ++c)
      for (double& f : t.values[c]) f *= scale[c];
    return said_of(t, as_it_is);
  };
  EXPECT_TRUE(says(said({1, 100, 1}), "channel g returns"));
  EXPECT_TRUE(says(said({1, 100, 1}), "(gonio fit FILE --channels r b leaves it out)"));
  EXPECT_FALSE(says(said({100, 100, 100}), "channel"));
  EXPECT_FALSE(says(said({20, 2, 2}), "channel")) << "a red pigment in other units";
  EXPECT_TRUE(says(said({1, 0, 1}), "no value of channel g is above 0"));
}

TEST(ValueWarnings, TellAnOffsetBelowZeroFromNoise) {
  const auto said = [](double offset, double noise) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    return said_of(painted(180, 0.05, 0.15), [&](const auto&, double f) {
      return f * std::exp(0.01 * normal(random)) + noise * normal(random) - offset;
    });
  };
  EXPECT_TRUE(says(said(0.018, 0), "rather an offset than noise"));
  EXPECT_FALSE(says(said(0.018, 0.01), "rather an offset than noise"));
  EXPECT_FALSE(says(said(0, 0.02), "rather an offset than noise"));
}

TEST(ValueWarnings, SayThatNoiseWasClippedToALeastValue) {
  const auto said = [](double noise, double least) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    return said_of(painted(180, 0.002, 0.15), [&](const auto&, double f) {
      return std::max(f + noise * normal(random), least);
    });
  };
  EXPECT_TRUE(says(said(0.002, 1e-4), "are 0.0001, and none is less: clipped noise?"));
  EXPECT_FALSE(says(said(0, 1e-4), "clipped noise?"));
  Table matt = painted(0);  // in plane, and computed: its base is shared
  test::put_values(matt, bind_model("oren_nayar", {{"kd", {0.5}}, {"sigma", {0.5}}}, 1));
  EXPECT_FALSE(says(said_of(matt, as_it_is), "clipped noise?"));
  // Far from a computed highlight all values may be those of its base.
  EXPECT_FALSE(says(said_of(painted(180), [](const auto&, double f) { return std::max(f, 0.1); }),
                    "clipped noise?"));
}

TEST(Reciprocity, KnowsNoAzimuthAtTheNormal) {
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  t.where = DirectionList{{0, 45}, {0, 0}, {45, 0}, {180, 0}};
  t.values.emplace_back(2);
  t.values[0][0] = 0.3182;
  t.values[0][1] = 0.3208;
  ASSERT_TRUE(reciprocity(t).error);
  EXPECT_NEAR(*reciprocity(t).error, 0.0026 / 0.3195, 1e-4);
}

}  // namespace
}  // namespace gonio
