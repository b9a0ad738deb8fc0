// gonio export of a map, held against Mitsuba's own code: f of each texel of the scene that was
// written.
#include <cmath>
#include <sstream>

#include "brdf/model/evaluate.h"
#include "cli/outside.h"
#include "cli/program.h"
#include "fitting/export/export.h"
#include "geometry/half_difference.h"
#include "image/exr.h"

#include <fmt/format.h>

namespace gonio::test {
namespace {

constexpr const char* no_mitsuba = "Mitsuba is not in build/targets: run ./check, which fetches it";

/// Map of 3 × 2 texels whose fits Mitsuba's own equations are, exported to m.xml.
struct MapInMitsuba {
  const Folder& folder;
  std::string model;
  std::vector<std::pair<std::string, std::vector<float>>> channels;

  nlohmann::json exported() const {
    Image map{3, 2, {}, {}, {}};
    for (const auto& [name, plane] : channels) {
      map.channels.push_back(name);
      map.planes.push_back(plane);
    }
    map.attributes = {{"gonio:schema", "gonio.map/1"},
                      {"gonio:model", model},
                      {"gonio:stack", "none"},
                      {"gonio:channels", "R,G,B"}};
    write_exr(folder / "maps.exr", map);
    const auto o = gonio(folder, "export maps.exr --to mitsuba -o m.xml --json");
    EXPECT_EQ(o.code, 0) << o.err;
    return o.code == 0 ? o.json() : nlohmann::json{};
  }
  /// f NoL of a texel's fit, the directions turned into the frame of its normal, over NoL of the plane.
  std::vector<std::vector<double>> wanted(std::size_t texel,
                                          std::span<const DirectionPair> pairs,
                                          const Direction& n) const {
    std::vector<Setting> settings;
    for (const auto& [name, plane] : channels) {
      if (name.starts_with("normal")) continue;
      const auto dot = name.find('.');
      const std::string parameter = name.substr(0, dot);
      if (settings.empty() || settings.back().name != parameter)
        settings.push_back({parameter, {}});
      settings.back().values.push_back(double{plane[texel]});
    }
    const double flat = std::hypot(n.z, n.x);
    const Direction s{n.z / flat, 0, -n.x / flat};
    const Direction t{n.y * s.z - n.z * s.y, n.z * s.x - n.x * s.z, n.x * s.y - n.y * s.x};
    const auto in_frame = [&](const Direction& w) {
      const auto along = [&](const Direction& a) { return a.x * w.x + a.y * w.y + a.z * w.z; };
      return Direction{along(s), along(t), along(n)};
    };
    std::vector<FrameAngles<double>> angles;
    for (const auto& [i, o] : pairs) angles.push_back(frame_angles({in_frame(i), in_frame(o)}));
    auto f = evaluate(bind_model(model, settings, 3), angles);
    for (auto& channel : f)
      for (std::size_t k = 0; k < pairs.size(); ++k)
        channel[k] *= in_frame(pairs[k].wi).z / pairs[k].wi.z;
    return f;
  }
  /// Largest distance of Mitsuba's f from it, relative to f or to 0.1.
  double distance_at(std::size_t texel,
                     const Direction& normal = {0, 0, 1},
                     const std::string& variant = "scalar_rgb") const {
    std::vector<DirectionPair> pairs;
    std::string lines;
    for (const auto& d : judged_directions()) {
      if (pairs.size() == 60 || std::min(d.wi.z, d.wo.z) < 0.4) continue;
      pairs.push_back(d);
      lines += fmt::format("{} {} {} {} {} {}\n", d.wi.x, d.wi.y, d.wi.z, d.wo.x, d.wo.y, d.wo.z);
    }
    folder.write("pairs.txt", lines);
    // The top of the image is the plane's.
    const double x = (static_cast<double>(texel % 3) - 1) * 2 / 3;
    const double y = texel < 3 ? 1.0 / 3 : -1.0 / 3;
    const auto o = outside(
        folder, "mitsuba_values.py",
        fmt::format("{} {} {} {} {}", folder / "m.xml", folder / "pairs.txt", variant, x, y));
    EXPECT_EQ(o.code, 0) << o.err;
    std::istringstream in(o.out);
    const auto f = wanted(texel, pairs, normal);
    double most = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) {
        double seen = std::nan("");
        in >> seen;
        most = std::fmax(most, std::abs(seen - f[c][k]) / std::max(f[c][k], 0.1));
        if (std::isnan(seen)) most = 9;
      }
    return most;
  }
};

TEST(ExportToMitsuba, HasEachTexelOfAMapInItsPlace) {
  if (!has_outside("mitsuba")) GTEST_SKIP() << no_mitsuba;
  const Folder f;
  const MapInMitsuba map{f,
                         "lambert+ggx/smith_ggx.separable/dielectric",
                         {{"kd.R", {0.6F, 0.4F, 0.3F, 0.2F, 0.1F, 0}},
                          {"kd.G", {0.2F, 0.2F, 0.8F, 0.2F, 0.2F, 0}},
                          {"kd.B", {0.1F, 0.1F, 0.1F, 0.1F, 0.3F, 0}},
                          {"alpha", {0.25F, 0.16F, 0.3F, 0.4F, 0.5F, 0.2F}},
                          {"eta.R", {1.5F, 1.6F, 1.7F, 1.3F, 1.4F, 1.5F}},
                          {"eta.G", {1.5F, 1.5F, 1.5F, 1.5F, 1.5F, 1.8F}},
                          {"eta.B", {1.5F, 1.4F, 1.3F, 1.3F, 1.2F, 1.2F}},
                          {"normal.X", {0.3F, 0, 0, 0, 0, 0}},
                          {"normal.Y", {0.2F, 0, 0, 0, 0, 0}},
                          {"normal.Z", {std::sqrt(0.87F), 1, 1, 1, 1, 1}}}};
  const auto said = map.exported();
  EXPECT_LT(said["high_residual"], 1e-5) << "Mitsuba's own equations";
  EXPECT_LT(map.distance_at(0, {0.3, 0.2, std::sqrt(0.87)}), 1e-3);
  for (std::size_t t = 1; t < 6; ++t) EXPECT_LT(map.distance_at(t), 1e-3) << t;
  std::string text = read_bytes(f / "m.xml");
  const std::string up = "y=\"-0.6666667\"";
  ASSERT_NE(text.find(up), std::string::npos) << text;
  f.write("m.xml", text.replace(text.find(up), up.size(), "y=\"0.6666667\""));
  EXPECT_GT(map.distance_at(2), 0.1) << "upside down";
}

TEST(ExportToMitsuba, HasLobesWidthsAndTangentsOfAMap) {
  if (!has_outside("mitsuba")) GTEST_SKIP() << no_mitsuba;
  const Folder f;
  const MapInMitsuba map{
      f,
      "ggx_aniso/smith_ggx_aniso.separable/conductor.weighted+ggx/smith_ggx.separable/"
      "dielectric.weighted",
      {{"alpha_x", {0.4F, 0.4F, 0.3F, 0.2F, 0.5F, 0.2F}},
       {"alpha_y", {0.1F, 0.1F, 0.3F, 0.1F, 0.5F, 0.2F}},
       {"tangent", {0, 90, 20, 0, 0, 0}},
       {"eta", {0.2F, 0.2F, 0.2F, 0.2F, 0.2F, 0.2F}},
       {"k", {3.9F, 3.9F, 2.9F, 3.9F, 3.9F, 3.9F}},
       {"weight", {0.7F, 0.6F, 0.5F, 0.7F, 0.7F, 0.7F}},
       {"alpha_2", {0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 0.3F}},
       {"eta_2", {1.5F, 1.6F, 1.5F, 1.5F, 1.5F, 1.5F}},
       {"weight_2", {0.3F, 0.4F, 0.5F, 0.3F, 0.3F, 0.3F}}}};
  const auto said = map.exported();
  EXPECT_LT(said["high_residual"], 1e-5) << "at tangents along an axis";
  EXPECT_NE(said["lost"].dump().find("Tangents between"), std::string::npos);
  for (const std::size_t t : {0, 1, 2}) EXPECT_LT(map.distance_at(t), 1e-3) << t;
  EXPECT_LT(map.distance_at(1, {0, 0, 1}, "scalar_spectral"), 1e-3) << "textures of one channel";
}

}  // namespace
}  // namespace gonio::test
