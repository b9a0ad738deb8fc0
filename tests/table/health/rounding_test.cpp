// Digits of a table's values tell what they leave out.
#include "table/health/rounding.h"

#include <cmath>

#include <gtest/gtest.h>

namespace gonio {
namespace {

Table of(const std::vector<double>& values) {
  Table t;
  t.values.emplace_back(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) t.values[0][i] = values[i];
  return t;
}
constexpr double uniform = 0.28867513459481287;  // 1/sqrt(12), of a step of 1

TEST(FileRounding, OfFixedDecimalsIsOneSize) {
  const auto r = rounding_of(of({0.123, 0.05, 12.345, 3}));
  EXPECT_NEAR(r.of(0.05), 1e-3 * uniform, 1e-9);
  EXPECT_NEAR(r.of(3), 1e-3 * uniform, 1e-9);
}

TEST(FileRounding, OfSignificantDigitsIsOfEachValuesOwnDecade) {
  const auto r = rounding_of(of({1.23e-11, 4.5e3, 6.78e-2}));
  EXPECT_NEAR(r.of(2), 1e-2 * uniform, 1e-9);
  EXPECT_NEAR(r.of(9.99), 1e-2 * uniform, 1e-9);
  EXPECT_NEAR(r.of(2e-6), 1e-8 * uniform, 1e-15);
  EXPECT_EQ(r.of(0), 0);
}

TEST(FileRounding, IsThatOfTheDigitsWhereDecimalsWouldHoldAllTooButEndInZeros) {
  const auto r = rounding_of(of({0.00123, 0.0456, 0.789, 0.321, 0.0654}));
  EXPECT_NEAR(r.of(0.5), 1e-3 * uniform, 1e-9);
  EXPECT_NEAR(r.of(0.005), 1e-5 * uniform, 1e-11);
}

TEST(FileRounding, IsThatOfAConvertersStepWhichIsNoPowerOfTen) {
  const auto counts = [](double step, double digits) {
    std::vector<double> values;
    for (int k = 3; k < 4000; k += 1 + k / 3) {
      const double v = k * step, place = std::pow(10, digits - std::ceil(std::log10(v)));
      values.push_back(std::round(v * place) / place);
      values.push_back(std::round((v + step) * place) / place);
    }
    return rounding_of(of(values)).of(1);
  };
  EXPECT_NEAR(counts(0.01233, 12), 0.01233 * uniform, 1e-9);
  EXPECT_NEAR(counts(0.01233, 6), 0.01233 * uniform, 1e-6);
  EXPECT_NEAR(counts(0.0125, 9), 0.0125 * uniform, 1e-9);
  std::vector<double> bytes;  // of 8 bits, in four decimals
  for (int k = 2; k < 250; k += 1 + k / 9) bytes.push_back(std::round(k / 255. * 1e4) / 1e4);
  EXPECT_NEAR(rounding_of(of(bytes)).of(0.5), uniform / 255, 1e-5);
  EXPECT_NEAR(counts(0.001, 9), 0.001 * uniform, 1e-9);
}

TEST(FileRounding, OfBinaryNumbersIsThatOfFloatsOrNone) {
  const std::vector<double> doubles{M_PI, M_E, std::sqrt(2.0)};
  EXPECT_EQ(rounding_of(of(doubles)).of(1), 0);
  std::vector<double> floats;
  for (const double x : doubles) floats.push_back(static_cast<float>(x));
  EXPECT_NEAR(rounding_of(of(floats)).of(1), 1.1920929e-7 * uniform, 1e-12);
  EXPECT_EQ(rounding_of(of({-1, 0, std::nan("")})).of(1), 0);
}

}  // namespace
}  // namespace gonio
