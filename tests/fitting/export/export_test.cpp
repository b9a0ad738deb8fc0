#include "fitting/export/export.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "base/error.h"
#include "brdf/model/evaluate.h"
#include "fitting/export/target.h"
#include "fitting/export/xml.h"
#include "geometry/half_difference.h"

namespace gonio {
namespace {

BoundModel bound(const char* spec, const char* settings) {
  return bind_model(spec, parse_settings(std::vector<std::string>{settings}), 3);
}

TEST(ExportedFit, IsExactWhereTheModelIsTheTargets) {
  const auto largest = [](ExportTarget to, const char* spec, const char* settings) {
    const auto e = export_fit(to, "fit.json", bound(spec, settings), 0.02);
    EXPECT_FALSE(e.refitted);
    return e.written.largest;
  };
  EXPECT_LT(largest(ExportTarget::gltf, "gltf", "base_color=0.5,0.2,0.1,metallic=1,roughness=0.4"),
            1e-9);
  EXPECT_LT(largest(ExportTarget::mitsuba, "lambert+ggx/smith_ggx.separable/dielectric",
                    "kd=0.5,0.2,0.1,alpha=0.2,eta=1.5"),
            1e-9);
  EXPECT_LT(largest(ExportTarget::mitsuba, "ggx_aniso/smith_ggx_aniso.separable/conductor",
                    "alpha_x=0.1,alpha_y=0.4,tangent=0,eta=0.2,0.9,1.1,k=3.9,2.4,2.2"),
            1e-9);
  for (const auto to : {ExportTarget::mitsuba, ExportTarget::standard_surface})
    EXPECT_LT(largest(to, "lambert", "kd=0.5,0.2,0.1"), 1e-9) << name_of(to);
}

TEST(ExportedFit, IsNearerAfterARefitInEveryTarget) {
  const auto fit =
      bound("lambert+ggx/smith_ggx.correlated/schlick", "kd=0.5,0.2,0.1,alpha=0.4,f0=0.1");
  for (std::size_t i = 0; i < names_of<ExportTarget>.size(); ++i) {
    const auto to = static_cast<ExportTarget>(i);
    const auto e = export_fit(to, "fit.json", fit, 0);
    EXPECT_TRUE(e.refitted) << name_of(to);
    EXPECT_LT(e.written.rms, 0.9 * e.renamed.rms) << name_of(to);
    EXPECT_LT(e.written.rms, 0.1) << name_of(to);
  }
}

TEST(ExportedFit, NamesWhereItIsWorstUpToNearTheHorizon) {
  // Gold under correlated masking, which Mitsuba's separable one darkens most where both graze.
  const auto gold = bound("ggx/smith_ggx.correlated/conductor", "alpha=0.3,metal=Au");
  const auto e = export_fit(ExportTarget::mitsuba, "fit.json", gold, 1e9);
  EXPECT_GT(e.renamed.largest, 0.15);
  const auto& at = e.renamed.largest_at;
  EXPECT_GT(std::min(at.theta_i, at.theta_o), 80);
  EXPECT_LE(std::max(at.theta_i, at.theta_o), 88);
  double most_zenith = 0, most_azimuth = 0;
  for (const auto& [i, o] : judged_directions()) {
    most_zenith = std::max({most_zenith, std::acos(i.z) / degree, std::acos(o.z) / degree});
    most_azimuth = std::max(most_azimuth, std::abs(std::atan2(i.y, i.x) / degree));
  }
  EXPECT_NEAR(most_zenith, 88, 0.1);
  EXPECT_LE(std::abs(at.phi_i), 180);
  // The place gives the distance.
  const auto there = [&](const BoundModel& b) {
    return evaluate(b,
                    std::vector{frame_angles({direction(at.theta_i * degree, at.phi_i * degree),
                                              direction(at.theta_o * degree, at.phi_o * degree)})});
  };
  const auto wanted = there(gold),
             found = there(bound("ggx/smith_ggx.separable/conductor", "alpha=0.3,metal=Au"));
  double most = 0;
  for (std::size_t c = 0; c < 3; ++c)
    most = std::max(most, std::abs(found[c][0] / wanted[c][0] - 1));
  EXPECT_NEAR(most, e.renamed.largest, 1e-3);
}

TEST(ExportedFit, HasTheDiffuseRoughnessOfTargetsThatKnowIt) {
  for (const auto& [to, spec, settings, name] :
       {std::tuple{ExportTarget::open_pbr, "eon+ggx/smith_ggx.correlated/dielectric",
                   "kd=0.5,0.2,0.1,r=0.8,alpha=0.2,eta=1.5", "base_diffuse_roughness"},
        {ExportTarget::standard_surface, "oren_nayar+ggx/smith_ggx.correlated/dielectric",
         "kd=0.5,0.2,0.1,sigma=0.8,alpha=0.2,eta=1.5", "diffuse_roughness"}}) {
    const auto e = export_fit(to, "fit.json", bound(spec, settings), 1e9);
    const auto at = std::ranges::find(e.parameters, name, [](const auto& p) { return p.first; });
    ASSERT_NE(at, e.parameters.end()) << name;
    EXPECT_EQ(at->second[0], 0.8);
    for (const auto& lost : e.lost) EXPECT_EQ(lost.find("diffuse term"), lost.npos) << lost;
    const auto flat = export_fit(
        to, "fit.json",
        bound("lambert+ggx/smith_ggx.correlated/dielectric", "kd=0.5,0.2,0.1,alpha=0.2,eta=1.5"),
        1e9);
    EXPECT_LT(e.written.rms, flat.written.rms + 0.02)
        << "as near as Lambert's, whose layers are the same";
  }
}

TEST(ExportedFit, NamesDiffuseLightThatTheTargetTakesForTheHighlight) {
  const auto names = [](ExportTarget to, const std::string& diffuse, const std::string& kd) {
    const auto e = export_fit(to, "fit.json",
                              bound((diffuse + "ggx/smith_ggx.separable/schlick").c_str(),
                                    (kd + "alpha=0.3,f0=0.04").c_str()),
                              1e9);
    return std::ranges::any_of(e.lost, [](const auto& lost) {
      return lost.starts_with("The plain sum of diffuse light");
    });
  };
  for (const auto to : {ExportTarget::gltf, ExportTarget::open_pbr, ExportTarget::standard_surface,
                        ExportTarget::usd_preview}) {
    EXPECT_TRUE(names(to, "lambert+", "kd=0.5,")) << int(to);
    EXPECT_FALSE(names(to, "", "")) << int(to);
  }
  EXPECT_FALSE(names(ExportTarget::gltf, "lambert.coupled+", "kd=0.5,")) << "it is multiplied so";
}

TEST(ExportedFit, TakesAnExtinctionOfOneChannelToMitsuba) {
  for (const char* k : {"k=0.5,0,0", "k=0,0.5,0", "k=0,0,0.5"}) {
    const auto fit = bound("ggx/smith_ggx.separable/conductor",
                           (std::string("alpha=0.3,eta=1.5,1.4,1.5,") + k).c_str());
    const auto e = export_fit(ExportTarget::mitsuba, "fit.json", fit, 1e9);
    EXPECT_LT(e.renamed.rms, 0.05) << k;
  }
}

TEST(ExportedFit, KeepsAnIndexAtTheEndOfItsRangeInMitsubasColours) {
  for (const char* eta : {"20,20,19", "20,19,18", "19,20,20"})
    EXPECT_NO_THROW(export_fit(ExportTarget::mitsuba, "fit.json",
                               bound("ggx/smith_ggx.separable/conductor",
                                     (std::string("alpha=0.3,k=0,eta=") + eta).c_str()),
                               1e9))
        << eta;
}

TEST(ExportedFit, WritesSpectraForMitsubaWhoseColourIsTheIndexs) {
  const auto e = export_fit(ExportTarget::mitsuba, "fit.json",
                            bound("ggx/smith_ggx.separable/conductor", "alpha=0.3,metal=Au"), 0.02);
  ASSERT_EQ(e.variants.size(), 2U);
  EXPECT_LT(e.variants[0].residual.largest, 1e-9) << "scalar_rgb";
  EXPECT_GT(e.variants[1].residual.largest, 1e-5) << "F of a spectrum is not that of r, g, b";
  EXPECT_LT(e.variants[1].residual.largest, 0.02);
  const auto file = file_of(e, R"({"schema": "gonio.fit/1"})");
  EXPECT_EQ(file.find("<rgb"), file.npos) << "an index is no reflectance";
  EXPECT_NE(file.find("<spectrum name=\"eta\" value=\"360:"), file.npos) << file;
}

TEST(ExportedFit, OfDarkGlossyPlasticIsNoMetalInAnyTarget) {
  // The mean of f is that of the highlight: beside it the base would count as nothing.
  for (const std::string alpha : {"0.02", "0.05", "0.1"})
    for (std::size_t i = 0; i < names_of<ExportTarget>.size(); ++i) {
      const auto to = static_cast<ExportTarget>(i);
      const auto e = export_fit(to, "fit.json",
                                bound("lambert+ggx/smith_ggx.correlated/schlick",
                                      ("kd=0.03,0.03,0.03,f0=0.05,alpha=" + alpha).c_str()),
                                0.02);
      SCOPED_TRACE(std::string(name_of(to)) + " " + alpha);
      for (const auto& [name, values] : e.parameters) {
        if (name == "metallic" || name == "base_metalness" || name == "metalness") {
          EXPECT_EQ(values[0], 0);
        }
        if (name == "base_color" || name == "diffuseColor" || name == "reflectance") {
          EXPECT_NEAR(values[0], 0.03, 0.01) << name;
        }
      }
      EXPECT_LT(e.written.rms, 0.1);
    }
}

TEST(ExportedFit, IsRefusedWithTwoChannels) {
  EXPECT_THROW(export_fit(ExportTarget::gltf, "fit.json",
                          bind_model("lambert", {{"kd", {0.1, 0.2}}}, 2), 0.02),
               Error);
}

TEST(Refit, FindsParametersWithinTheirRangesAndLeavesWhatIsHeld) {
  // f = a nol + b + c
  const TargetValues line = [](const TargetParameters& p, std::span<const FrameAngles<double>> at) {
    std::vector<double> f;
    for (const auto& a : at)
      f.push_back(parameter_in(p, "a") * a.nol + parameter_in(p, "b") + parameter_in(p, "c"));
    return std::vector<std::vector<double>>{f};
  };
  std::vector<FrameAngles<double>> angles;
  for (const auto& d : judged_directions()) angles.push_back(frame_angles(d));
  const TargetParameters truth{{"a", {0.7}}, {"b", {0.2}}, {"c", {0.1}, {0, 1}, false}};
  const auto wanted = line(truth, angles);
  const std::vector scale(1, std::vector<double>(angles.size(), 1.0));
  auto begin = truth;
  begin[0].values[0] = 0.1, begin[1].values[0] = 0.9;
  auto found = refitted(begin, line, angles, wanted, scale);
  EXPECT_NEAR(parameter_in(found, "a"), 0.7, 1e-5);
  EXPECT_NEAR(parameter_in(found, "b"), 0.2, 1e-5);
  EXPECT_EQ(parameter_in(found, "c"), 0.1);
  begin[0].legal = {0, 0.5};
  found = refitted(begin, line, angles, wanted, scale);
  EXPECT_NEAR(parameter_in(found, "a"), 0.5, 1e-6);
}

TEST(XmlOfAnExport, KeepsACommentACommentAndTheDocumentReadable) {
  const std::string file = xml_file("<a>\n<b/>\n</a>\n", exported_fit, R"({"x": "-- ---> --"})");
  const auto end = file.find("-->");
  EXPECT_EQ(file.substr(end), "-->\n<a>\n  <b/>\n</a>\n");
  EXPECT_EQ(file.substr(0, end).find("--", file.find("<!--") + 4), file.npos);
}

}  // namespace
}  // namespace gonio
