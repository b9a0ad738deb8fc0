#include "explore/surface.h"

#include <cmath>
#include <numeric>

#include "base/error.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/presets.h"
#include "geometry/vector.h"
#include "image/display.h"
#include "integrate/albedo/directional_albedo.h"
#include "refusal.h"
#include "tables.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio::explore {
namespace {

Surface glossy() {
  return {"lambert+ggx/smith_ggx.correlated/schlick",
          "alpha=0.3 kd=0.2,0.1,0.05 f0=0.04,0.05,0.06",
          {}};
}

/// f at directions in degrees, as gonio eval evaluates them.
std::vector<std::vector<double>> f_at(const BoundModel& m,
                                      const std::vector<std::array<double, 4>>& deg) {
  std::vector<FrameAngles<double>> x;
  for (const auto& d : deg)
    x.push_back(frame_angles(DirectionPair{direction(d[0] * degree, d[1] * degree),
                                           direction(d[2] * degree, d[3] * degree)}));
  return evaluate(m, x);
}

TEST(Surface, OfEveryPresetIsCutWhereEvalEvaluates) {
  std::vector<double> theta(179);
  std::iota(theta.begin(), theta.end(), -89);
  for (const auto& p : presets()) {
    const Surface s(p.about.id, "", 3);
    std::vector<std::array<double, 4>> at;
    for (const double t : theta) at.push_back({40, 20, std::abs(t), t < 0 ? 20.0 : 200.0});
    EXPECT_EQ(cut(s, 40, 20, theta), f_at(*s.model(), at)) << p.about.id;
  }
}

TEST(Surface, LobeIsCutInEveryPlane) {
  const Surface s("ggx_aniso/smith_ggx_aniso.correlated/schlick", "alpha_x=0.1 alpha_y=0.4", 3);
  const std::array theta{0.0, 30.0, 60.0}, phi{-90.0, 0.0, 45.0};
  const auto f = lobe(s, 40, 20, theta, phi);
  EXPECT_EQ(f, f_at(*s.model(), {{40, 20, 0, 110},
                                 {40, 20, 0, 200},
                                 {40, 20, 0, 245},
                                 {40, 20, 30, 110},
                                 {40, 20, 30, 200},
                                 {40, 20, 30, 245},
                                 {40, 20, 60, 110},
                                 {40, 20, 60, 200},
                                 {40, 20, 60, 245}}));
}

TEST(Surface, SliceHasItsOwnValueInEachCellAndNoneBelowTheHorizon) {
  const Surface s = glossy();
  const auto f = slice(s, 8, 0);
  std::size_t below = 0;
  for (std::size_t i = 0; i < 64; ++i) {
    const auto at = slice_directions(8, i, 0);
    const auto hd = half_difference(at);
    EXPECT_NEAR(hd.theta_h / degree, (static_cast<double>(i % 8) + 0.5) / 8 * 90, 1e-9);
    EXPECT_NEAR(hd.theta_d / degree, (7.5 - static_cast<double>(i / 8)) / 8 * 90, 1e-9);
    if (at.wi.z > 0 && at.wo.z > 0) {
      EXPECT_EQ(f[2][i], evaluate(*s.model(), std::array{frame_angles(at)})[2][0]);
    } else {
      ++below;
      EXPECT_TRUE(std::isnan(f[0][i]));
    }
  }
  EXPECT_GT(below, 10U);
}

TEST(Surface, PaintedIsWhatADisplayShowsAndTransparentWhereNothingIsKnown) {
  const Channels f{{0.1, 0.5, NAN, 20}};
  std::vector<unsigned char> rgba(16);
  paint(f, 1, false, rgba);
  EXPECT_NEAR(rgba[1], displayed_bytes({0.1, 0.1, 0.1}, 1)[1], 1);
  EXPECT_NEAR(rgba[4], displayed_bytes({0.5, 0, 0}, 1)[0], 1);
  EXPECT_EQ(rgba[11], 0);
  EXPECT_EQ(rgba[12], 255);
  EXPECT_EQ(rgba[15], 255);
  paint(f, 1, true, rgba);
  EXPECT_EQ(rgba[0], std::lround(255 * 0.75));
}

TEST(Surface, OfATableHasItsValuesAtItsSamplesAndNoneWhereItHasNone) {
  Table t = test::filled(page_grid({30, 20, 12}), test::glossy());
  const SampleAngles at(t);
  const std::size_t i = (9 * 20 + 8) * 12 + 5;
  const double value = t.values[1][i];
  const DirectionPair place = at.directions(i);
  EXPECT_NEAR(Surface(t)(std::span(&place, 1))[1][0], value, 1e-12 * value);
  for (auto& channel : t.values) std::fill(channel.begin(), channel.end(), NAN);
  const Surface nothing(std::move(t));
  EXPECT_TRUE(std::isnan(nothing(std::span(&place, 1))[1][0]));
  std::vector<unsigned char> rgba(4 * 32 * 32, 7);
  Sphere(32, std::array{Direction{0, 0, 1}}).draw(nothing, 3, rgba);
  EXPECT_EQ(rgba[4 * (16 * 32 + 16) + 3], 0);
  // Light from the right grazes the middle: little arrives there, and no value is none.
  Sphere(32, std::array{direction(Vector{1, 0, -0.05})}).draw(nothing, 3, rgba);
  EXPECT_EQ(rgba[4 * (16 * 32 + 17) + 3], 255);
  EXPECT_EQ(rgba[4 * (16 * 32 + 28) + 3], 0);
  EXPECT_NE(
      test::refusal([&] { albedo(nothing, std::array{0.0}, false); }, Exit::usage).find("table"),
      std::string::npos);
}

TEST(Surface, DiffersFromATableByTheFactorThatLiesBetweenThem) {
  Table t = test::filled(page_grid({12, 9, 6}), test::glossy());
  const Surface s = glossy();
  const Difference none = difference(s, Surface(t));
  EXPECT_GT(none.values, 1000U);
  EXPECT_NEAR(none.typical_factor, 1, 1e-9);
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto hd = at.half_difference(i);
    const bool there =
        std::abs(hd.theta_h / degree - 12.5) < 2.5 && std::abs(hd.theta_d / degree - 45) < 5;
    for (auto& channel : t.values) channel[i] /= there ? 3 : 1.5;
  }
  const Surface dark(t);
  const Difference d = difference(s, dark);
  EXPECT_GT(d.typical_factor, 1.5);
  EXPECT_LT(d.typical_factor, 1.6);
  EXPECT_NEAR(d.worst_factor, 3, 1e-9);
  EXPECT_EQ(d.worst_theta_h_deg, 12.5);
  EXPECT_NEAR(d.worst_theta_d_deg, 45, 2.5);
  EXPECT_NE(test::refusal([&] { difference(dark, s); }, Exit::usage), "");
  const auto [measured, modelled] = measured_and_modelled(s, dark, 2);
  EXPECT_EQ(measured.size(), t.size());
  std::size_t known = 0;
  for (std::size_t i = 0; i < measured.size(); ++i)
    if (measured[i] > 0) {
      ++known;
      EXPECT_EQ(measured[i], t.values[2][i]);
      EXPECT_GT(modelled[i], 1.49 * measured[i]);
      EXPECT_LT(modelled[i], 3.01 * measured[i]);
    }
  EXPECT_EQ(3 * known, d.values);

  std::vector<unsigned char> rgba(4 * Difference::cells * Difference::cells);
  Difference map{};
  map.log_ratio[0] = std::log(2), map.log_ratio[1] = std::log(0.4), map.log_ratio[2] = NAN;
  paint_ratio(map, rgba);
  EXPECT_EQ(rgba[0], 194);
  EXPECT_EQ(rgba[4], 27);
  EXPECT_EQ(rgba[11], 0);
  EXPECT_EQ(rgba[12], 245);
}

TEST(Surface, AlbedoIsTheIntegralAndTheFurnaceShowsWhatMaskingTakes) {
  const Surface s("ggx/smith_ggx.correlated/schlick", "alpha=0.8 f0=0.5", 1);
  const auto e = albedo(s, std::array{10.0, 70.0}, false),
             all = albedo(s, std::array{10.0, 70.0}, true);
  const auto exact = directional_albedo(*s.model(), std::array{std::cos(70 * degree)}, 0, {1e-6});
  EXPECT_NEAR(e[0][1], exact[0].value[0], 1e-3);
  EXPECT_LT(e[0][0], all[0][0]);
  const Surface with_base("lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.8 kd=0.7", 1);
  EXPECT_NEAR(albedo(with_base, std::array{10.0}, true)[0][0], all[0][0], 1e-3) << "the lobe alone";
  EXPECT_TRUE(std::isnan(albedo(Surface("lambert", "", 1), std::array{10.0}, true)[0][0]));
  EXPECT_NEAR(all[0][0], 0.42915, 1e-3);  // gonio albedo --furnace
}

TEST(Surface, KeepsWhatStaysWhenATermIsSwapped) {
  Surface s = glossy();
  s.swap_model("lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick");
  const auto value = [&](const char* name, std::size_t c) {
    return s.model()->values[s.model()->model.find(name)->slot(c)];
  };
  EXPECT_EQ(value("alpha_x", 0), 0.3);
  EXPECT_EQ(value("alpha_y", 0), 0.3);
  EXPECT_EQ(value("kd", 2), 0.05);
  EXPECT_NE(
      test::refusal([&] { s.swap_model("ggx/none_such/schlick"); }, Exit::usage).find("none_such"),
      std::string::npos);
  EXPECT_EQ(value("alpha_y", 0), 0.3);
  s.swap_model("lambert");
  EXPECT_EQ(value("kd", 1), 0.1);
}

TEST(Surface, IsCalledByItsTermsWhoeverShipsThem) {
  const auto name = [](const char* spec) {
    return nlohmann::json::parse(Surface(spec, "", 1).description())["name"];
  };
  EXPECT_EQ(name("lambert+ggx/smith_ggx.correlated/schlick"), "Lambert + GGX (Schlick)");
  for (const auto& p : presets())
    EXPECT_NE(name(std::string(p.about.id).c_str()), p.about.title) << p.about.id;
}

TEST(Surface, DescribesSlidersThatHoldTheirValuesForEveryTerm) {
  for (const auto& t : catalogue()) {
    const std::string id(short_id(t.id()));
    const std::string spec = t.role() == Role::ndf       ? id + "/none/schlick"
                             : t.role() == Role::masking ? "ggx/" + id + "/schlick"
                             : t.role() == Role::fresnel ? "ggx/none/" + id
                                                         : id + "+ggx/none/schlick";
    const Surface s(spec, "", 3);
    const auto d = nlohmann::json::parse(s.description());
    std::size_t values = 0;
    for (const auto& p : d["parameters"]) {
      EXPECT_LE(double(p["low"]), double(p["from"])) << spec;
      EXPECT_LE(double(p["to"]), double(p["high"])) << spec;
      EXPECT_TRUE(!p["log"] || double(p["from"]) > 0) << spec;
      for (std::size_t i = 0; i < p["count"]; ++i, ++values) {
        EXPECT_LE(double(p["from"]), s.model()->values[values]) << spec;
        EXPECT_GE(double(p["to"]), s.model()->values[values]) << spec;
      }
    }
    EXPECT_EQ(values, s.model()->values.size());
    EXPECT_NE(d["parts"].dump().find("\"" + std::string(t.id()) + "\""), std::string::npos) << spec;
  }
  const auto eta =
      nlohmann::json::parse(Surface("ggx/none/dielectric", "", 1).description())["parameters"];
  EXPECT_TRUE(std::ranges::any_of(eta, [](const auto& p) {
    return p["name"] == "eta" && p["from"] > 0 && p["log"] == false;
  })) << eta;
  const auto alpha = nlohmann::json::parse(glossy().description())["parameters"];
  EXPECT_TRUE(std::ranges::any_of(alpha, [](const auto& p) {
    return p["name"] == "alpha" && p["log"] == true && p["roughness"] == "roughness";
  }));
  EXPECT_TRUE(std::ranges::any_of(
      alpha, [](const auto& p) { return p["name"] == "kd" && p["log"] == false; }));
}

}  // namespace
}  // namespace gonio::explore
