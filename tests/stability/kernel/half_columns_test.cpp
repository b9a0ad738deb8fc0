#include "stability/kernel/half_columns.h"

#include <bit>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/catalogue/registry.h"
#include "brdf/in_number/number.h"

namespace gonio::stability {
namespace {

constexpr std::size_t samples = 512;

struct Columns {
  struct alignas(64) Column {
    std::array<float, samples> at;
  };
  std::array<Column, 11> angle;
  Block<float> block() const {
    const auto& a = angle;
    const auto column = [&](std::size_t k) { return a[k].at.data(); };
    return {column(0),
            column(1),
            column(2),
            column(3),
            column(4),
            samples,
            {column(5), column(6), column(7), column(8), column(9), column(10)}};
  }
};

/// Halves in [0, 1], every exponent alike: from a hash of a place.
float half_in_unit(std::mt19937& random) {
  const auto bits = random() % 0x3c01;
  const int exponent = static_cast<int>(bits >> 10), digits = static_cast<int>(bits & 1023);
  return static_cast<float>(exponent == 0 ? std::ldexp(digits, -24)
                                          : std::ldexp(1024 + digits, exponent - 25));
}
Columns some_columns(std::mt19937& random) {
  Columns c;
  for (auto& column : c.angle)
    for (float& x : column.at) x = half_in_unit(random);
  return c;
}

std::vector<float> some_parameters(const TermEntry& t, std::mt19937& random) {
  std::vector<float> p;
  for (const auto& q : t.parameters) {
    const double low = q.legal.low, x = static_cast<double>(half_in_unit(random));
    p.push_back(static_cast<float>(Half(low + (std::min(q.legal.high, 60.0) - low) * x)));
  }
  p.resize(max_parameters);
  return p;
}

bool same(float a, float b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

TEST(HalfColumns, EqualTheTermsOfSingleHalvesBitForBit) {
  std::mt19937 random(1);
  const auto& scalar = half_kernels("scalar");
  ASSERT_EQ(scalar.terms.size(), catalogue_size() + most_foreign_terms);
  for (std::size_t t = 0; t < catalogue().size(); ++t) {
    const auto columns = some_columns(random);
    const auto p = some_parameters(catalogue()[t], random);
    alignas(64) std::array<float, samples> out;
    scalar.terms[t][index_of({})](columns.block(), p.data(), out.data());
    const std::vector<double> parameters(
        p.begin(), p.begin() + static_cast<std::ptrdiff_t>(catalogue()[t].parameters.size()));
    for (std::size_t i = 0; i < samples; ++i) {
      const auto at = [&](std::size_t k) { return static_cast<double>(columns.angle[k].at[i]); };
      const FrameAngles<double> a{
          {at(0), at(1), at(2), at(3), at(4)}, at(5), at(6), at(7), at(8), at(9), at(10)};
      const double one = values_in(Number::half, t, parameters, {&a, 1})[0];
      ASSERT_TRUE(same(out[i], static_cast<float>(one)))
          << catalogue()[t].id() << " " << i << ": " << out[i] << " " << one;
    }
  }
}

TEST(HalfColumns, AreTheSameBitForBitOnEveryInstructionSetAndByAllRules) {
  std::mt19937 random(2);
  const auto& scalar = half_kernels("scalar");
  for (const auto& name : instruction_sets())
    for (std::size_t t = 0; t < catalogue().size(); ++t)
      for (std::size_t rules = 0; rules < all_rules.size(); ++rules) {
        const auto columns = some_columns(random);
        const auto p = some_parameters(catalogue()[t], random);
        alignas(64) std::array<float, samples> out, expected;
        half_kernels(name).terms[t][rules](columns.block(), p.data(), out.data());
        scalar.terms[t][rules](columns.block(), p.data(), expected.data());
        for (std::size_t i = 0; i < samples; ++i)
          ASSERT_TRUE(same(out[i], expected[i])) << name << " " << catalogue()[t].id() << " "
                                                 << rules << ": " << out[i] << " " << expected[i];
      }
}

TEST(HalfColumns, AnglesFollowFromWhatIsGivenAsInSingleHalves) {
  std::mt19937 random(3);
  for (const auto& name : instruction_sets())
    for (std::size_t given = 0; given < names_of<Given>.size(); ++given) {
      const auto in = some_columns(random);
      const auto n = std::array<std::size_t, 7>{1, 1, 2, 1, 2, 3, 4}[given];
      std::vector<const float*> columns;
      for (std::size_t k = 0; k < n; ++k) columns.push_back(in.angle[k].at.data());
      Columns out;
      AngleColumns<float> to;
      for (std::size_t k = 0; k < to.size(); ++k) to[k] = out.angle[k].at.data();
      half_kernels(name).angles[index_of({true, true})](static_cast<Given>(given), samples, columns,
                                                        to);
      using H = HalfOver<float, HalfRules{true, true}>;
      for (std::size_t i = 0; i < samples; ++i) {
        std::vector<H> single;
        for (const auto* column : columns) single.emplace_back(column[i]);
        const auto a = angles_of<H>(static_cast<Given>(given), std::span<const H>(single));
        const std::array expected{a.nol, a.nov, a.noh, a.voh, a.sin2_theta_h, a.xoh,
                                  a.yoh, a.xol, a.yol, a.xov, a.yov};
        for (std::size_t k = 0; k < expected.size(); ++k)
          ASSERT_TRUE(same(out.angle[k].at[i], static_cast<float>(expected[k])))
              << name << " " << given << " " << k;
      }
    }
}

TEST(HalfColumns, AreComparedWithDoublesByWhatBecameOfThem) {
  constexpr float none = std::numeric_limits<float>::quiet_NaN(),
                  infinite = std::numeric_limits<float>::infinity();
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  const auto compare = [&](float x, double f) {
    alignas(64) std::array<float, padding> got{};
    alignas(64) std::array<double, padding> want;
    want.fill(nothing);
    got[3] = x, want[3] = f;
    std::vector<Compared> all;
    for (const auto& name : instruction_sets()) {
      all.emplace_back();
      half_kernels(name).compare(padding, got.data(), want.data(), 0.02, all.back());
      EXPECT_EQ(all.back(), all.front()) << name;
    }
    return all.front();
  };
  EXPECT_EQ(compare(1, 1), Compared{});
  EXPECT_EQ(compare(none, nothing), (Compared{0, 0, 0, 0, 0, 0, 0, 1, 0}));
  EXPECT_EQ(compare(1, nothing), Compared{});
  EXPECT_EQ(compare(1.0009765625F, 1), (Compared{0, 0, 0, 0, 0, 0x1p-10, 1}));
  EXPECT_EQ(compare(1.5F, 1.25), (Compared{0, 0, 0, 0, 1, 0.2, 256}));
  EXPECT_EQ(compare(-1.25F, 1.25), (Compared{0, 1, 0, 0, 1, 2, 2560}));
  EXPECT_EQ(compare(-1.25F, -1.25), (Compared{0, 0, 0, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(compare(none, 1), (Compared{1, 0, 0, 0, 1, 0, 0}));
  EXPECT_EQ(compare(infinite, 65519), (Compared{1, 0, 0, 0, 1, 0, 0}));
  EXPECT_EQ(compare(infinite, 1e9), (Compared{0, 0, 1, 0, 1, 0, 0}));
  EXPECT_EQ(compare(none, static_cast<double>(infinite)), (Compared{0, 0, 1, 0, 1, 0, 0}));
  EXPECT_EQ(compare(0, 0x1p-14), (Compared{0, 0, 0, 1, 1, 0, 1024}));
  EXPECT_EQ(compare(0, 0x1p-20), (Compared{0, 0, 0, 0, 0, 0, 16}));
  EXPECT_EQ(compare(1, 0x1p-20).beyond_tolerance, 1U);
  EXPECT_EQ(compare(1, 0x1p-20).relative, 0);
}

}  // namespace
}  // namespace gonio::stability
