// RGL's tensor files: what they were made from comes back, at the samples and between them.
#include <algorithm>
#include <cstring>
#include <map>

#include "base/error.h"
#include "base/random.h"
#include "support.h"
#include "table/convert/convert.h"
#include "table/foreign.h"
#include "table/format/formats.h"
#include "table/health/directional_albedo.h"
#include "table/health/health.h"

namespace gonio {
namespace {

using namespace test;
using std::numbers::pi;

Table read(const RglFile& file) {
  const Folder folder;
  return read_table(folder.write("a.bsdf", file.bytes()));
}

double lobe_of_pair(const DirectionPair& p, std::size_t channel) {
  const auto a = angles(p);
  const double q = a.noh * a.noh * 0.25 + a.sin2_theta_h;
  return 0.05 * static_cast<double>(channel + 1) + 0.25 / (pi * q * q) / 4;
}

/// f_r by the format's definition, spelled out: the normalised densities of the incident directions
/// around are mixed into one, by whose areas (below y; in the row at y, left of x) the facet normal is
/// found on the grid of values.  For one phi_i, or phi_i ascending over the whole turn.
class ByDefinition {
 public:
  explicit ByDefinition(const std::string& bytes) {
    std::size_t at = 14;
    const auto next = [&]<class T>(T value) {
      std::memcpy(&value, bytes.data() + at, sizeof value);
      at += sizeof value;
      return value;
    };
    for (auto left = next(std::uint32_t{}); left > 0; --left) {
      const auto length = next(std::uint16_t{});
      Field f;
      const std::string name = bytes.substr(at, length);
      at += length;
      f.shape.resize(next(std::uint16_t{}));
      const auto type = next(std::uint8_t{});
      const auto from = next(std::uint64_t{});
      std::size_t size = 1;
      for (auto& n : f.shape) size *= n = next(std::uint64_t{});
      for (std::size_t i = 0; i < size && (type == 10 || type == 1); ++i) {
        float value = static_cast<float>(bytes[from + i]);
        if (type == 10) std::memcpy(&value, bytes.data() + from + 4 * i, 4);
        f.values.push_back(static_cast<double>(value));
      }
      fields_[name] = f;
    }
  }

  double operator()(const DirectionPair& p, std::size_t channel) const {
    const auto& phis = fields_.at("phi_i").values;
    const double phi = phi_of(p.wi), theta = theta_of(p.wi);
    const Direction m{p.wi.x + p.wo.x, p.wi.y + p.wo.y, p.wi.z + p.wo.z};
    const double turns = (phi_of(m) - (phis.size() > 2 ? 0 : phi)) / (2 * pi) + 0.5;
    const double u = std::sqrt(2 / pi * theta_of(m)), v = turns - std::floor(turns);
    const auto ends_p = phis.size() > 2 ? around(phis, phi) : std::vector{std::pair{0UL, 1.0}};
    const auto ends_t = around(fields_.at("theta_i").values, theta);
    const Field &vndf = fields_.at("vndf"), &data = fields_.at("rgb");
    const std::size_t thetas = vndf.shape[1], h = vndf.shape[2], w = vndf.shape[3];
    std::vector<double> density(h * w);
    for (const auto& [i, part_p] : ends_p)
      for (const auto& [j, part_t] : ends_t) {
        const double* const d = vndf.values.data() + (i * thetas + j) * h * w;
        double all = 0;
        for (std::size_t y = 0; y + 1 < h; ++y)
          for (std::size_t x = 0; x + 1 < w; ++x)
            all += (d[y * w + x] + d[y * w + x + 1] + d[y * w + w + x] + d[y * w + w + x + 1]) / 4;
        for (std::size_t k = 0; k < h * w; ++k) density[k] += part_p * part_t * d[k] / all;
      }
    std::vector<double> row(w), rows(h);
    const double y = v * static_cast<double>(h - 1);
    const auto y0 = std::min(static_cast<std::size_t>(y), h - 2);
    for (std::size_t x = 0; x < w; ++x)
      row[x] = std::lerp(density[y0 * w + x], density[y0 * w + w + x], y - static_cast<double>(y0));
    for (std::size_t k = 0; k < h; ++k)
      rows[k] = area({density.begin() + static_cast<std::ptrdiff_t>(k * w),
                      density.begin() + static_cast<std::ptrdiff_t>(k * w + w)},
                     1);
    const double s = area(row, u) / area(row, 1), t = area(rows, v) / area(rows, 1);
    double value = 0;
    for (const auto& [i, part_p] : ends_p)
      for (const auto& [j, part_t] : ends_t)
        value += part_p * part_t * bilinear(data, (i * thetas + j) * data.shape[2] + channel, s, t);
    if (fields_.at("jacobian").values[0] != 0)
      value *=
          bilinear(fields_.at("ndf"), 0, u, v) /
          (4 * bilinear(fields_.at("sigma"), 0, std::sqrt(2 / pi * theta), phi / (2 * pi) + 0.5));
    return value / p.wo.z;
  }

 private:
  struct Field {
    std::vector<std::uint64_t> shape;
    std::vector<double> values;
  };
  /// The nodes on both sides with their parts.
  static std::vector<std::pair<std::size_t, double>> around(const std::vector<double>& axis,
                                                            double at) {
    std::size_t i = 0;
    while (i + 2 < axis.size() && axis[i + 1] <= at) ++i;
    const double part = (at - axis[i]) / (axis[i + 1] - axis[i]);
    return {{i, 1 - part}, {i + 1, part}};
  }
  /// Integral up to `to` of what is linear between nodes spread evenly over the unit interval.
  static double area(const std::vector<double>& nodes, double to) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      const double x =
          std::clamp(to * static_cast<double>(nodes.size() - 1) - static_cast<double>(i), 0.0, 1.0);
      sum += x * (nodes[i] + std::lerp(nodes[i], nodes[i + 1], x)) / 2;
    }
    return sum;
  }
  static double bilinear(const Field& f, std::size_t slice, double x, double y) {
    const std::size_t w = f.shape.back(), h = f.shape[f.shape.size() - 2];
    double sum = 0;
    for (std::size_t j = 0; j < h; ++j)
      for (std::size_t i = 0; i < w; ++i) {
        const auto hat = [](double at, std::size_t n, std::size_t k) {
          return std::max(0.0,
                          1 - std::abs(at * static_cast<double>(n - 1) - static_cast<double>(k)));
        };
        if (const double part = hat(x, w, i) * hat(y, h, j); part > 0)
          sum += part * f.values[(slice * h + j) * w + i];
      }
    return sum;
  }

  std::map<std::string, Field> fields_;
};

/// Errors of Table::between relative to the definition at directions everywhere up to `reach`, ascending.
std::vector<double> errors_between(const Table& t, const std::string& bytes, double reach) {
  const ByDefinition by_definition(bytes);
  Draws draws(1);
  std::vector<double> errors;
  while (errors.size() < 1000) {
    const auto any = [&] {
      return direction(reach * std::sqrt(draws.uniform()), (2 * draws.uniform() - 1) * pi);
    };
    const DirectionPair p{any(), any()};
    const double f = by_definition(p, errors.size() % 3);
    errors.push_back(std::abs(t.between(p, errors.size() % 3) / f - 1));
  }
  std::ranges::sort(errors);
  return errors;
}

void expect_values(const Table& t, const Brdf& f) {
  const SampleAngles at(t);
  std::size_t above = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto p = at.directions(i);
    if (p.wo.z < least_cosine) {
      EXPECT_TRUE(std::isnan(t.values[0][i]));
      continue;
    }
    ++above;
    for (std::size_t c = 0; c < t.values.size(); ++c) {
      EXPECT_NEAR(t.values[c][i], f(p, c), 1e-6 * f(p, c)) << i;
      EXPECT_NEAR(t.between(p, c), f(p, c), 1e-5 * f(p, c)) << i;
    }
  }
  EXPECT_GT(above, t.size() / 3);
}

TEST(RglFile, GivesBackTheFunctionAtItsOwnDirections) {
  for (const bool jacobian : {true, false})
    for (const bool even : {true, false}) {
      RglFile file{.jacobian = jacobian, .even = even, .f = lobe_of_pair};
      const Table t = read(file);
      EXPECT_EQ(t.format, "rgl");
      EXPECT_EQ(t.channels, (std::vector<std::string>{"r", "g", "b"}));
      EXPECT_EQ(t.size(), 4 * (7 * 7 + 1)) << "each direction once";
      expect_values(t, lobe_of_pair);
    }
}

TEST(RglFile, HoldsWavelengthsAsChannels) {
  const Table t = read({.wavelengths = {400, 550.5F, 700, 1000}, .f = lobe_of_pair});
  EXPECT_EQ(t.channels, (std::vector<std::string>{"400", "550.5", "700", "1000"}));
  expect_values(t, lobe_of_pair);
}

TEST(RglFile, DefinesTheFunctionBetweenItsSamples) {
  RglFile file{.size = 64, .f = lobe_of_pair};
  file.theta_i.clear();
  for (int k = 0; k < 16; ++k) file.theta_i.push_back(0.1F * static_cast<float>(k));
  const Table t = read(file);
  double worst = 0;
  for (const double theta_i : {0.05, 0.3, 0.75, 1.1})
    for (const double theta_o : {0.0, 0.3, 0.7, 1.2})
      for (const double phi : {0.1, 1.5, 3.0, 3.14159}) {
        const DirectionPair p{direction(theta_i, 0.7), direction(theta_o, 0.7 + phi)};
        for (std::size_t c = 0; c < 3; ++c)
          worst = std::max(worst, std::abs(t.between(p, c) / lobe_of_pair(p, c) - 1));
      }
  EXPECT_LT(worst, 0.02);
  EXPECT_TRUE(std::isnan(t.between({direction(0.3, 0), direction(1.6, 0)}, 0)));
}

TEST(RglFile, IsBetweenItsSamplesWhatTheFormatDefines) {
  RglFile file{.size = 12, .f = lobe_of_pair};
  file.theta_i = {0, 0.3F, 0.7F, 1.1F, 1.5F};
  for (const bool anisotropic : {false, true}) {
    if (anisotropic) {
      file.grooved = true;
      file.phi_i.clear();
      for (int k = 0; k <= 8; ++k) file.phi_i.push_back(static_cast<float>(-pi + k * pi / 4));
    }
    const auto errors = errors_between(read(file), file.bytes(), 45 * degree);
    EXPECT_LT(errors[errors.size() / 2], 1e-6) << anisotropic;
    EXPECT_LT(errors[errors.size() * 99 / 100], 1e-5) << anisotropic;
  }
}

TEST(RglFile, IsNearTheHorizonNowhereMoreThanItsSamplesAround) {
  // Values that do not vanish with the cosine, as what an instrument leaves near the horizon.
  RglFile file{.size = 16, .f = [](const DirectionPair& p, std::size_t) {
                 return 0.01 / std::max(p.wo.z, 1e-3);
               }};
  file.theta_i = {0, 0.4F, 0.8F, 1.2F, static_cast<float>(pi / 2)};
  const Table t = read(file);
  const double largest = inspect(t).largest;
  std::size_t values = 0;
  for (double in = 0.5; in < 90; ++in)
    for (double out = 0.5; out < 90; out += in < 60 ? 0.25 : 1)
      for (double phi = 0; phi <= 180; phi += 30) {
        const double f =
            t.between({direction(in * degree, 0), direction(out * degree, phi * degree)}, 0);
        if (out > 89.5) {
          EXPECT_TRUE(std::isnan(f)) << in << " " << out;
        }
        if (std::isnan(f)) continue;
        ++values;
        EXPECT_LE(f, largest * (1 + 1e-6)) << in << " " << out << " " << phi;
      }
  EXPECT_GT(values, 100'000U);
  EXPECT_TRUE(std::isnan(t.between({direction(1.5, 0), direction(0.3, 2)}, 0)))
      << "nearer to 90°, where no sample is valid, than to the last that is";
  file.theta_i.pop_back();
  const Table shorter = read(file);
  EXPECT_TRUE(std::isnan(shorter.between({direction(1.21, 0), direction(0.3, 2)}, 0)));
  EXPECT_FALSE(std::isnan(shorter.between({direction(1.19, 0), direction(0.3, 2)}, 0)));
}

TEST(RglFile, OfAWhiteDiffuserReflectsAll) {
  const RglFile file{.size = 64, .f = [](const auto&, auto) { return 1 / pi; }};
  const Table t = read(file);
  for (const float theta : file.theta_i) {
    const auto a = directional_albedo(t, static_cast<double>(theta) / degree);
    EXPECT_NEAR(a.albedo[0], 1, 0.002) << theta;
    EXPECT_NEAR(a.coverage, 1, 1e-12);
  }
}

TEST(RglFile, IsReciprocalWhereItsFunctionIs) {
  const auto error = [](const Brdf& f) {
    const Table t = read({.size = 32, .f = f});
    return inspect(t).reciprocity_error.value_or(9);
  };
  EXPECT_LT(error(lobe_of_pair), 0.05);
  EXPECT_GT(
      error([](const DirectionPair& p, std::size_t c) { return lobe_of_pair(p, c) * p.wo.z; }), 0.2)
      << "a forgotten cosine";
}

double grooved(const DirectionPair& p, std::size_t) {
  const double x = p.wi.x + p.wo.x, y = p.wi.y + p.wo.y;
  return 0.3 + 0.03 * (x * x - y * y) + 0.05 * p.wi.y * p.wo.y;
}

TEST(RglFile, MayDependOnTheAzimuth) {
  RglFile file{.size = 12, .grooved = true, .f = grooved};
  for (int k = 0; k <= 8; ++k) file.phi_i.push_back(static_cast<float>(-pi + k * pi / 4));
  file.phi_i.erase(file.phi_i.begin());
  const Table t = read(file);
  EXPECT_EQ(t.size(), (3 * 8 + 1) * (11 * 11 + 1)) << "both ends are one azimuth, the pole is one";
  expect_values(t, grooved);
  const DirectionPair p{direction(0.4, pi - 1e-4), direction(0.9, 1)};
  const DirectionPair q{direction(0.4, -pi + 1e-4), direction(0.9, 1)};
  EXPECT_NEAR(t.between(p, 0), t.between(q, 0), 1e-4);
}

TEST(RglFile, OverPartOfATurnIsFoldedIntoIt) {
  for (const int parts : {2, 4}) {
    const auto f = [&](const DirectionPair& p, std::size_t c) {
      // Under a half turn alone a product of coordinates stays; under mirrors it does not.
      return grooved(p, c) + (parts == 2 ? 0.05 * p.wi.x * p.wo.y : 0);
    };
    RglFile file{.size = 12, .f = f};
    file.phi_i.clear();
    for (int k = 0; k <= 4; ++k)
      file.phi_i.push_back(static_cast<float>(-pi + k * 2 * pi / parts / 4));
    const Table t = read(file);
    expect_values(t, f);
    const SampleAngles at(t);
    for (std::size_t i = 0; i < t.size(); i += 7) {
      const auto p = at.directions(i);
      // The ends of the part are each other's images, whose grids differ.
      if (p.wo.z < least_cosine || std::abs(p.wi.x * p.wi.y) < 1e-6) continue;
      const auto turned = [](const Direction& d, double x, double y) {
        return Direction{x * d.x, y * d.y, d.z};
      };
      for (const auto& [x, y] : {std::pair{-1, -1}, std::pair{-1, 1}, std::pair{1, -1}})
        if (x == y || parts == 4) {
          EXPECT_NEAR(t.between({turned(p.wi, x, y), turned(p.wo, x, y)}, 0), f(p, 0), 2e-5)
              << parts << " " << i << " " << x << " " << y;
        }
    }
  }
}

TEST(RglFile, NegativeValuesAreMaskedAsNoise) {
  const Table t = read({.f = [](const auto& p, auto) { return p.wo.x > 0 ? -0.01 : 0.2; }});
  const Health h = inspect(t);
  EXPECT_GT(h.masked[static_cast<std::size_t>(Mask::negative)], 0U);
  EXPECT_TRUE(t.negative_is_noise);
}

TEST(RglFile, OfFeltIsBetweenItsSamplesWhatTheFormatDefines) {
  GONIO_NEEDS_SHARED(path, "data/rgl/acrylic_felt_green_rgb.bsdf");
  const Table t = read_table(path);
  std::ifstream in(path, std::ios::binary);
  const auto errors = errors_between(t, {std::istreambuf_iterator<char>(in), {}}, 70 * degree);
  EXPECT_LT(errors[errors.size() / 2], 1e-6);
  EXPECT_LT(errors[errors.size() * 99 / 100], 1e-5);
  EXPECT_NEAR(t.between({direction(13 * degree, 0), direction(19 * degree, 22.25 * degree)}, 1),
              0.063786, 2e-6);
}

TEST(RglFile, OfFeltHasTheAlbedoOfItsDatabase) {
  GONIO_NEEDS_SHARED(path, "data/rgl/acrylic_felt_green_rgb.bsdf");
  const Table t = read_table(path);
  EXPECT_EQ(t.format, "rgl");
  constexpr std::array<std::array<double, 2>, 5> known{
      {{0, 0.218}, {20, 0.227}, {40, 0.252}, {60, 0.306}, {75, 0.366}}};
  for (const auto& [theta_deg, green] : known)
    EXPECT_NEAR(directional_albedo(t, theta_deg).albedo[1], green, 0.001) << theta_deg;
  ConvertOptions options;
  options.format = "mbsdf";
  const auto made = convert(t, options);
  const Health from = inspect(t), to = inspect(made.table);
  EXPECT_LE(to.largest, from.largest * (1 + 1e-6));
  EXPECT_GT(made.loss.without_data, 0U);
  EXPECT_LT(made.loss.without_data * 5, made.loss.bins);
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); ++i)
    if (mask(at(i), t.values[1][i]) == Mask::valid && at(i).nol > 1e-3 &&
        at(i).sin2_theta_h > 1e-12) {
      EXPECT_NEAR(t.between(at.directions(i), 1), t.values[1][i], 2e-4 * t.values[1][i]) << i;
    }
}

}  // namespace
}  // namespace gonio
