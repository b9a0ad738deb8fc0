#include "fitting/export/export.h"

#include "base/error.h"
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
    EXPECT_LT(e.written.rms, 0.8 * e.renamed.rms) << name_of(to);
    EXPECT_LT(e.written.rms, 0.05) << name_of(to);
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
