// UTIA's files: where each number goes, what it is, and what lies between.
#include "table/format/utia.h"

#include <cmath>
#include <cstring>

#include "table/complaint.h"
#include "table/example.h"

namespace gonio {
namespace {

using namespace test;

constexpr std::size_t kRow = 288, kPlane = kRow * kRow;

/// Numbers of a file, each what f says of plane, row and column.
template <class F>
std::string utia_file(F f) {
  std::vector<double> all;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t in = 0; in < kRow; ++in)
      for (std::size_t out = 0; out < kRow; ++out) all.push_back(f(c, in, out));
  return {reinterpret_cast<const char*>(all.data()), all.size() * sizeof(double)};
}

/// A BRDF that is linear in each of the four angles, so that what lies between is known: by hand.
double f(double theta_i, double phi_i, double theta_o, double phi_o) {
  return (1 + theta_i * (1 + phi_i / 100)) * (2 + theta_o * (3 + phi_o / 200));
}
double linear_value(std::size_t c, std::size_t in, std::size_t out) {
  const auto theta = [](std::size_t k) { return 15 * static_cast<double>(k / 48); };
  const auto phi = [](std::size_t k) { return 7.5 * static_cast<double>(k % 48); };
  return static_cast<double>(c + 1) * f(theta(in), phi(in), theta(out), phi(out));
}
/// With θ = 0 and the φ of the file's columns, a direction that is not the pole.
DirectionPair at(double theta_i, double phi_i, double theta_o, double phi_o) {
  return {direction(theta_i * degree, phi_i * degree), direction(theta_o * degree, phi_o * degree)};
}

TEST(UtiaFile, HasItsRowsTowardsTheLightAndItsPlanesAsColours) {
  const Folder folder;
  const Table t = read_table(folder.write("m.bin", utia_file(linear_value)));
  EXPECT_EQ(t.format, "utia");
  EXPECT_EQ(t.channels, (std::vector<std::string>{"r", "g", "b"}));
  ASSERT_EQ(t.size(), 241U * 241U);
  const DirectionList& l = *t.list();
  // Row 48·2 + 3: light at (30°, 22.5°); column 48·5 + 47: viewer at (75°, 352.5°).
  const std::size_t i = 241 * (1 + 48 + 3) + 1 + 4 * 48 + 47;
  EXPECT_EQ(l.theta_i_deg[i], 30);
  EXPECT_EQ(l.phi_i_deg[i], 22.5);
  EXPECT_EQ(l.theta_o_deg[i], 75);
  EXPECT_EQ(l.phi_o_deg[i], 352.5);
  // (1 + 30·1.225) (2 + 75·4.7625) = 37.75 · 359.1875
  EXPECT_DOUBLE_EQ(t.values[0][i], 13559.328125);
  EXPECT_DOUBLE_EQ(t.values[2][i], 3 * 13559.328125);
  EXPECT_DOUBLE_EQ(t.values[1][0], 4) << "light and viewer at the pole: 2 · 1 · 2";
  EXPECT_TRUE(t.negative_is_noise);
}

TEST(UtiaFile, NamesThePoleManyTimesAndTheTableOnce) {
  const Folder folder;
  // The light at the pole under 48 names: 1 … 48, on average 24.5; at θ_o = 0 besides 0 … 47.
  const Table t = read_table(
      folder.write("m.bin", utia_file([](std::size_t, std::size_t in, std::size_t out) {
                     return in < 48 ? static_cast<double>(in + 1 + (out < 48 ? out : 0)) : 7;
                   })));
  EXPECT_DOUBLE_EQ(t.values[0][1], 24.5);
  EXPECT_DOUBLE_EQ(t.values[0][0], 48);
  EXPECT_EQ(t.values[0][241], 7) << "equal ones are that value, to the last digit";
  const auto d = *t.list();
  for (std::size_t i = 0; i < t.size(); ++i)
    ASSERT_TRUE(d.theta_i_deg[i] > 0 || d.phi_i_deg[i] == 0) << i;
}

TEST(UtiaFile, IsLinearBetweenItsAnglesAndHasNothingBeyond75Degrees) {
  const Folder folder;
  const Table t = read_table(folder.write("m.bin", utia_file(linear_value)));
  const Interpolator g(t);
  EXPECT_NEAR(g(at(20, 10, 50, 200), 1) / (2 * f(20, 10, 50, 200)), 1, 1e-12);
  EXPECT_NEAR(g(at(75, 352.5, 75, 0), 0) / f(75, 352.5, 75, 0), 1, 1e-12);
  // Between 352.5° and 360°: half of the one and half of the other.
  EXPECT_NEAR(g(at(30, 356.25, 30, 15), 0) / ((f(30, 352.5, 30, 15) + f(30, 0, 30, 15)) / 2), 1,
              1e-12);
  EXPECT_TRUE(std::isnan(g(at(75.01, 0, 30, 0), 0)));
  EXPECT_TRUE(std::isnan(g(at(30, 0, 80, 0), 0)));
}

TEST(UtiaFile, HasNoValueBetweenWhereMostAroundHaveNone) {
  const Folder folder;
  // Of light at 30° nothing is known, at 45° it is 3.
  const Table t =
      read_table(folder.write("m.bin", utia_file([](std::size_t, std::size_t in, std::size_t) {
                                return in / 48 == 2 ? -1.0 : 3.0;
                              })));
  const Interpolator g(t);
  EXPECT_NEAR(g(at(40, 10, 50, 200), 0), 3, 1e-12);
  EXPECT_TRUE(std::isnan(g(at(35, 10, 50, 200), 0)));
}

TEST(UtiaFile, IsTakenAsFrWithAWarningUntilItsSideFileSaysWhatItIs) {
  const Folder folder;
  const auto file =
      folder.write("m.bin", utia_file([](std::size_t c, std::size_t, std::size_t) {
                     return std::array<double, 3>{0.5, 0.02, -0.02}[c];  // NOLINT: c is 0, 1 or 2
                   }));
  const auto values = [&](const std::string& meaning) {
    folder.write("m.bin.gonio.json",
                 R"({"schema": "gonio.table/1", "values": ")" + meaning + "\"}");
    const Table t = read_table(file);
    EXPECT_TRUE(t.warnings.empty());
    const Interpolator g(t);
    EXPECT_NEAR(g(at(10, 0, 10, 0), 0), t.values[0][0], 1e-12) << "what lies between too";
    return std::array{t.values[0][77], t.values[1][77], t.values[2][77]};
  };
  const Table silent = read_table(file);
  ASSERT_EQ(silent.warnings.size(), 1U);
  EXPECT_NE(silent.warnings[0].find("taken as f_r in 1/sr"), std::string::npos);
  EXPECT_EQ(silent.values[0][77], 0.5);
  EXPECT_EQ(values("f_r")[0], 0.5);
  const auto srgb = values("srgb");
  EXPECT_NEAR(srgb[0], 0.214041140, 1e-9);  // ((0.5 + 0.055)/1.055)^2.4
  EXPECT_NEAR(srgb[1], 0.02 / 12.92, 1e-15);
  EXPECT_NEAR(srgb[2], -0.02 / 12.92, 1e-15) << "negative stays so";
  const auto dj = values("dj_brdf");
  EXPECT_NEAR(dj[0], 100 * 0.5 / 140 / 12.92, 1e-12);
  EXPECT_EQ(values("xyz")[0], 0.5);
  EXPECT_EQ(read_table(file).channels, (std::vector<std::string>{"x", "y", "z"}));
  folder.write("m.bin.gonio.json", R"({"schema": "gonio.table/1", "values": "lab"})");
  EXPECT_COMPLAINT(file, "expected \"f_r\", \"srgb\", \"dj_brdf\" or \"xyz\"");
  write_table(mbsdf_example(1, 2), folder / "o");
  folder.write("o.gonio.json", R"({"schema": "gonio.table/1", "values": "f_r"})");
  EXPECT_COMPLAINT(folder / "o", "none: this table is not UTIA's");
}

TEST(UtiaFile, ReadsBackWhatItWrote) {
  const Folder folder;
  Table t = read_table(folder.write("m.bin", utia_file(linear_value)));
  t.values[1][4242] = -0.25;
  t.truth = truth_example();
  write_table(t, folder / "back.bin");
  const Table back = read_table(folder / "back.bin");
  EXPECT_EQ(back.values, t.values);
  EXPECT_TRUE(back.warnings.empty()) << "its side file says that it is f_r";
  EXPECT_EQ(back.truth->parameters, t.truth->parameters);
  const auto bytes = utia_file(linear_value);
  write_table(read_table(folder / "m.bin"), folder / "same.bin");
  const auto wrong = [&](std::size_t in, std::size_t out) {
    const std::size_t k = 8 * (kRow * in + out);
    return std::memcmp(bytes.data() + k, read_bytes(folder / "same.bin").data() + k, 8);
  };
  EXPECT_EQ(wrong(100, 200), 0);
  EXPECT_EQ(wrong(287, 287), 0);
  EXPECT_EQ(wrong(0, 0), 0);
  t.channels = {"f"};
  t.values.resize(1);
  write_table(t, folder / "grey.bin");
  const Table grey = read_table(folder / "grey.bin");
  EXPECT_EQ(grey.values[2], t.values[0]);
  std::get<DirectionList>(t.where).phi_o_deg[9] += 1e-6;
  EXPECT_THROW(write_table(t, folder / "else.bin"), Error);
}

TEST(UtiaFile, IsKnownByItsSizeAndNothingElse) {
  const Folder folder;
  const std::string good = utia_file(linear_value);
  EXPECT_COMPLAINT(folder.write("m.bin", good.substr(0, good.size() - 1)), "an unknown format");
  EXPECT_COMPLAINT(folder.write("m.bin", good + '\0'), "an unknown format");
  InputFile shorter(folder.write("s.bin", good.substr(8)));
  EXPECT_HAS(refusal([&] { read_utia(shorter); }),
             "size: found 1990648 bytes, expected 1990656 bytes");
  std::string csv = "theta_i,phi_i,theta_o,phi_o,f\n1,2,3,4,5\n";
  csv.resize(good.size(), '\n');
  EXPECT_EQ(read_table(folder.write("t.csv", csv)).format, "csv");
}

}  // namespace
}  // namespace gonio
