// Tables as RGL files: what a renderer evaluates is the table's function, and what it draws by is
// fit to be drawn by.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "base/random.h"
#include "optics/spectrum.h"
#include "refusal.h"
#include "support.h"
#include "table/convert/convert.h"
#include "table/convert/isotropy.h"
#include "table/convert/rgb_spectra.h"
#include "table/example.h"
#include "table/format/rgl/function.h"
#include "table/format/rgl/resample.h"

namespace gonio {
namespace {

using namespace test;

/// A coarse file, which takes little time.
ConvertOptions to_rgl() {
  ConvertOptions o;
  o.format = "rgl";
  o.n_theta = 12;
  o.n_grid = 24;
  return o;
}

Table wide_table(std::vector<std::string> channels = {"f"}) {
  return on_grid(
      mbsdf_grid(45, 90, Bins::centre), "mbsdf", std::move(channels),
      [](const auto& a, std::size_t c) { return lobe(a, 0.4, 0.3) * static_cast<double>(c + 1); });
}

/// A list of what is to be read at every 15°, at several azimuths of light.
template <class F>
Table turned_list(F f, double every_deg = 15) {
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  DirectionList l;
  Values values;
  for (double in = 5; in < 90; in += every_deg)
    for (double out = 5; out < 90; out += every_deg)
      for (double phi = 0; phi < 360; phi += every_deg)
        for (const double turn : {0.0, 30.0, 90.0}) {
          l.theta_i_deg.push_back(in);
          l.phi_i_deg.push_back(turn);
          l.theta_o_deg.push_back(out);
          l.phi_o_deg.push_back(phi + turn);
          values.push_back(f(in, out, phi, turn));
        }
  t.where = std::move(l);
  t.values.push_back(std::move(values));
  return t;
}

/// The values of a field of floats in a tensor file.
std::vector<float> field(const std::string& bytes,
                         const std::string& name,
                         std::size_t dimensions) {
  const auto at = bytes.find(name + std::string{static_cast<char>(dimensions), '\0', '\12'});
  if (at == bytes.npos) return {};
  std::uint64_t from = 0, size = 1;
  std::memcpy(&from, bytes.data() + at + name.size() + 3, 8);
  for (std::size_t d = 0; d < dimensions; ++d) {
    std::uint64_t n = 0;
    std::memcpy(&n, bytes.data() + at + name.size() + 11 + 8 * d, 8);
    size *= n;
  }
  std::vector<float> values(size);
  std::memcpy(values.data(), bytes.data() + from, 4 * size);
  return values;
}

double sum_of(const std::vector<float>& v) {
  double sum = 0;
  for (const float x : v) sum += static_cast<double>(x);
  return sum;
}

TEST(RglWriter, KeepsTheFunctionBetweenTheSamples) {
  const auto f = [](const DirectionPair& p, std::size_t) { return lobe(angles(p), 0.2, 0.1); };
  const RglTable made = rgl_table(f, {"f"}, {.n_theta = 24, .n = 48});
  EXPECT_EQ(made.without_data, 0U);
  const RglFunction g = rgl_function(made.table);
  Draws draws(3);
  std::vector<double> errors;
  while (errors.size() < 4000) {
    const auto any = [&] {
      return direction(80 * degree * std::sqrt(draws.uniform()),
                       2 * std::numbers::pi * draws.uniform());
    };
    const DirectionPair p{any(), any()};
    errors.push_back(std::abs(g(p, 0) / f(p, 0) - 1));
  }
  std::ranges::sort(errors);
  EXPECT_LT(errors[2000], 0.003);
  EXPECT_LT(errors[3960], 0.06);
}

TEST(RglWriter, SaysTrulyHowFarTheValuesAreFromTheTable) {
  const Table t = wide_table();
  const auto [file, loss] = convert(t, to_rgl());
  EXPECT_EQ(loss.method, Loss::Method::interpolated);
  EXPECT_TRUE(loss.replicated);
  EXPECT_TRUE(loss.rounded);
  EXPECT_FALSE(loss.filled);
  EXPECT_EQ(file.channels, (std::vector<std::string>{"r", "g", "b"}));
  const RglFunction f = rgl_function(file);
  const SampleAngles at(t);
  std::vector<double> differences;
  double squares = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto p = at.directions(i);
    if (std::min(p.wi.z, p.wo.z) < least_cosine) continue;
    const double v = t.values[0][i], w = f(p, 1);
    differences.push_back(2 * std::abs(v - w) / (v + w));
    squares += differences.back() * differences.back();
  }
  std::ranges::sort(differences);
  ASSERT_TRUE(loss.most);
  EXPECT_EQ(loss.compared, differences.size());
  EXPECT_NEAR(loss.largest, differences.back(), 1e-12);
  EXPECT_NEAR(loss.rms, std::sqrt(squares / static_cast<double>(differences.size())), 1e-9);
  EXPECT_NEAR(*loss.most, differences[differences.size() * 99 / 100], 1e-3 * *loss.most);
  EXPECT_LT(*loss.most, 0.7) << "so coarse a file, near the horizon";
}

TEST(RglWriter, WritesWhatItsReaderReads) {
  const Folder folder;
  for (const bool spectral : {false, true}) {
    auto o = to_rgl();
    o.spectral = spectral;
    const Table file = convert(wide_table({"r", "g", "b"}), o).table;
    write_table(file, folder / "a.bsdf");
    const Table back = read_table(folder / "a.bsdf");
    EXPECT_EQ(back.format, "rgl");
    EXPECT_EQ(back.channels, file.channels);
    ASSERT_EQ(back.size(), file.size());
    for (std::size_t c = 0; c < back.values.size(); ++c)
      for (std::size_t i = 0; i < back.size(); i += 7) {
        const double v = file.values[c][i];
        if (std::isnan(v)) {
          EXPECT_TRUE(std::isnan(back.values[c][i])) << i;
        } else {
          EXPECT_NEAR(back.values[c][i], v, 1e-5 * v) << i;
        }
      }
    EXPECT_EQ(folder.entries(), 1U) << "nothing to say, no side file";
  }
}

TEST(RglWriter, HasADensityForEveryAngleOfLight) {
  const Folder folder;
  write_table(convert(wide_table(), to_rgl()).table, folder / "a.bsdf");
  const std::string bytes = read_bytes(folder / "a.bsdf");
  // followed f.
  const auto luminance = field(bytes, "luminance", 4);
  ASSERT_EQ(luminance.size(), 12U * 24 * 24);
  for (const float v : luminance) ASSERT_TRUE(v >= 0 && std::isfinite(v));
  for (const std::string name : {"vndf", "luminance"})
    for (std::size_t k = 0; k < 12; ++k) {
      const auto all = field(bytes, name, 4);
      const auto size = static_cast<std::ptrdiff_t>(all.size() / 12);
      const auto first = all.begin() + static_cast<std::ptrdiff_t>(k) * size;
      EXPECT_GT(sum_of({first, first + size}), 0) << name << " " << k;
    }
}

TEST(RglWriter, OfWhatReflectsNothingCanBeDrawnFrom) {
  const Folder folder;
  Table t = wide_table();
  std::ranges::fill(t.values[0], 0);
  write_table(convert(t, to_rgl()).table, folder / "a.bsdf");
  const std::string bytes = read_bytes(folder / "a.bsdf");
  EXPECT_EQ(sum_of(field(bytes, "luminance", 4)), 12 * 24 * 24) << "evenly";
  EXPECT_EQ(sum_of(field(bytes, "rgb", 5)), 0);
  EXPECT_GT(sum_of(field(bytes, "sigma", 2)), 0);
}

TEST(RglWriter, FillsWhatIsMissingFromNearby) {
  Table t = wide_table();
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto p = at.directions(i);
    // Light from beyond 75°, and a hole.
    if (p.wi.z < 0.25 || (p.wi.z < 0.8 && p.wi.z > 0.6 && p.wo.z > 0.5))
      t.values[0][i] = std::nan("");
  }
  const auto [file, loss] = convert(t, to_rgl());
  EXPECT_TRUE(loss.filled);
  EXPECT_GT(loss.without_data, loss.bins / 20);
  const RglFunction f = rgl_function(file);
  for (const double in : {10.0, 45.0, 70.0, 85.0})
    for (const double out : {5.0, 40.0, 70.0}) {
      const DirectionPair p{direction(in * degree, 0), direction(out * degree, 1)};
      const double known = lobe(angles(p), 0.4, 0.3);
      EXPECT_NEAR(f(p, 0), known, 0.6 * known) << in << " " << out;
    }
}

TEST(RglWriter, MarksWhatItMadeUpAndReadersMaskIt) {
  const Folder folder;
  Table t = wide_table();
  write_table(convert(t, to_rgl()).table, folder / "whole.bsdf");
  EXPECT_FALSE(read_bytes(folder / "whole.bsdf").find("gonio_invented") != std::string::npos);
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); ++i)
    if (at.directions(i).wi.z < 0.6) t.values[0][i] = std::nan("");
  const auto [file, loss] = convert(t, to_rgl());
  write_table(file, folder / "part.bsdf");
  const Table back = read_table(folder / "part.bsdf"), whole = read_table(folder / "whole.bsdf");
  EXPECT_TRUE(read_bytes(folder / "part.bsdf").find("gonio_invented") != std::string::npos);
  const SampleAngles there(back);
  std::size_t masked = 0, kept = 0;
  for (std::size_t i = 0; i < back.size(); ++i) {
    const auto p = there.directions(i);
    if (std::min(p.wi.z, p.wo.z) < least_cosine) continue;
    const bool known = mask(there(i), back.values[0][i]) == Mask::valid;
    if (p.wi.z < 0.5) {
      ++masked;
      ASSERT_FALSE(known) << i;
      EXPECT_TRUE(std::isnan(back.between(p, 0))) << i;
    } else if (p.wi.z > 0.65) {
      ++kept;
      ASSERT_TRUE(known) << i;
    }
  }
  EXPECT_GT(masked, 1000U);
  EXPECT_GT(kept, 1000U);
  EXPECT_GE(loss.without_data, masked);
  EXPECT_EQ(back.size(), whole.size()) << "renderers find a value everywhere";
}

TEST(RglWriter, FillsEachChannelForItself) {
  Table t = wide_table({"r", "g", "b"});
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); ++i)
    if (at.directions(i).wo.z > 0.5) t.values[0][i] = std::nan("");
  const auto [file, loss] = convert(t, to_rgl());
  EXPECT_GT(loss.without_data, loss.bins / 10) << "of the channel of most";
  const RglFunction f = rgl_function(file),
                    whole = rgl_function(convert(wide_table({"r", "g", "b"}), to_rgl()).table);
  const DirectionPair p{direction(0.3, 0), direction(0.4, 3)};
  EXPECT_NEAR(f(p, 1), whole(p, 1), 0.05 * whole(p, 1));
  EXPECT_GT(std::abs(f(p, 0) / whole(p, 0) - 1), 0.1);
}

TEST(RglWriter, TakesAListByItsBins) {
  auto o = to_rgl();
  o.reach_deg = 12;
  const auto list = turned_list([](double in, double out, double phi, double) {
    return lobe(angles({direction(in * degree, 0), direction(out * degree, phi * degree)}), 0.6,
                0.3);
  });
  const auto [file, loss] = convert(list, o);
  EXPECT_EQ(loss.method, Loss::Method::gathered);
  ASSERT_TRUE(loss.azimuth);
  EXPECT_LT(*loss.azimuth, 1e-9);
  EXPECT_LT(*loss.most, 0.3);
  o.reach_deg = 1;
  EXPECT_HAS(refusal([&] { convert(list, o); }), "--reach");
}

TEST(RglWriter, RefusesWhatChangesAsItIsTurned) {
  const auto list = turned_list([](double, double, double, double turn) { return 1 + turn / 90; });
  EXPECT_NEAR(*change_with_azimuth(list), 1.0 / (1 + 2 * (4.0 / 3) / 2 + 2.0 / 2 - 0.5), 1e-12);
  EXPECT_HAS(refusal([&] { convert(list, to_rgl()); }), "as the surface is turned");
  // A format that says what lies between: bright where light comes along x.
  Table t = turned_list([](double, double, double, double) { return 1; });
  t.between = [](const DirectionPair& p, std::size_t) { return 1 + std::abs(p.wi.x); };
  EXPECT_HAS(refusal([&] { convert(t, to_rgl()); }), "as the surface is turned");
  t.between = [](const DirectionPair& p, std::size_t) { return 1 + 0.2 * std::abs(p.wi.x); };
  const auto little = convert(t, to_rgl());
  EXPECT_GT(*little.loss.azimuth, 0.01);
  const RglFunction f = rgl_function(little.table);
  const double mean = (1 + std::sqrt(2.0)) / 4;  // of |cos φ| over eight turns from 0°
  EXPECT_NEAR(f({direction(1, 0), direction(0.5, 2)}, 0), 1 + 0.2 * std::sin(1) * mean, 0.008);
  EXPECT_FALSE(change_with_azimuth(wide_table()));
}

TEST(RglWriter, HoldsWavelengthsInTheirOrder) {
  const Table t = wide_table({"650", "450.5", "550"});
  const Table file = convert(t, to_rgl()).table;
  EXPECT_EQ(file.channels, (std::vector<std::string>{"450.5", "550", "650"}));
  const RglFunction f = rgl_function(file);
  const DirectionPair p{direction(0.4, 0), direction(0.7, 1)};
  EXPECT_NEAR(f(p, 0) / f(p, 2), 2, 1e-5);
  EXPECT_NEAR(f(p, 1) / f(p, 2), 3, 1e-5);
  EXPECT_HAS(refusal(
                 [] {
                   convert(wide_table({"550", "550.00001"}), to_rgl());
                 },
                 Exit::usage),
             "550");
  EXPECT_HAS(refusal(
                 [] {
                   convert(wide_table({"a", "b"}), to_rgl());
                 },
                 Exit::usage),
             "wavelengths");
  const auto named = convert(wide_table({"x", "y", "z"}), to_rgl());
  EXPECT_EQ(named.loss.renamed.size(), 3U);
}

TEST(RglWriter, RefusesMoreThanItsReaderReads) {
  auto o = to_rgl();
  o.n_theta = 180;
  o.n_grid = 512;
  EXPECT_HAS(refusal([&] { convert(wide_table(), o); }, Exit::usage), "--grid");
  o.n_grid = 24;
  o.n_theta = 1;
  EXPECT_HAS(refusal([&] { convert(wide_table(), o); }, Exit::usage), "two incident angles");
  const Folder folder;
  Table other = wide_table();
  other.format = "rgl";
  EXPECT_HAS(refusal([&] { write_table(other, folder / "a"); }), "was not resampled");
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(RgbSpectra, HaveTheColoursThatTheyStandFor) {
  const auto bands = waveband_colours();
  ASSERT_EQ(bands.size(), rgb_bands);
  std::array<std::array<double, 3>, 3> colour{};
  for (std::size_t k = 0; k < rgb_bands; ++k) {
    EXPECT_EQ(bands[k].nm, rgb_band_nm(k));
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_GE(rgb_spectra[k][c], 0);
      sum += rgb_spectra[k][c];
      for (std::size_t d = 0; d < 3; ++d) colour[c][d] += rgb_spectra[k][c] * bands[k].rgb[d];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(colour[c][d], c == d, 1e-4) << c << d;
}

}  // namespace
}  // namespace gonio
