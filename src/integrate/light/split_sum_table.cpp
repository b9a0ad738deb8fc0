#include "integrate/light/split_sum_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/numbers.h"
#include "brdf/catalogue/registry.h"
#include "number/half.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr const char *kHow = "gonio:split_sum", *kMasking = "gonio:masking",
                     *kSamples = "gonio:samples", *kError = "gonio:error";
constexpr std::size_t kLargest = 4096;
constexpr double kSmoothest = 0.01;  ///< roughness of α = 1e-4, the smallest of the catalogue

double centre(std::size_t i, std::size_t n) {
  return (static_cast<double>(i) + 0.5) / static_cast<double>(n);
}
std::vector<double> centres(std::size_t n) {
  std::vector<double> at;
  for (std::size_t i = 0; i < n; ++i) at.push_back(centre(i, n));
  return at;
}

/// The texels on both sides, and how far from the first to the second.
struct Between {
  std::size_t low, high;
  double part;
  Between(double at, std::size_t n) {
    const double last = static_cast<double>(n - 1);
    const double x = std::clamp(at * static_cast<double>(n) - 0.5, 0.0, last);
    low = static_cast<std::size_t>(x);
    high = std::min(low + 1, n - 1);
    part = x - static_cast<double>(low);
  }
};

/// Deviations, one by one.
class Deviations {
 public:
  void add(double a, double b) {
    const double values[] = {a, b, a + b};
    for (std::size_t k = 0; k < 3; ++k) {
      max_[k] = std::max(max_[k], std::abs(values[k]));
      sum2_[k] += values[k] * values[k];
    }
    ++n_;
  }
  SplitSumDeviation all() const {
    const auto one = [&](std::size_t k) {
      return Deviation{max_[k],
                       std::sqrt(sum2_[k] / static_cast<double>(std::max(n_, std::size_t{1})))};
    };
    return {one(0), one(1), one(2), n_};
  }

 private:
  std::array<double, 3> max_{}, sum2_{};
  std::size_t n_ = 0;
};

double number(const std::string& path, const char* name, const std::string& text) {
  const auto value = number_from<double>(text);
  if (!value) throw bad_input(path, name, text, "a number");
  return *value;
}

}  // namespace

std::array<double, 2> SplitSumTable::operator()(double nov, double roughness) const {
  const Between x(nov, width), y(roughness, height);
  const auto of = [&](const std::vector<double>& v) {
    const auto row = [&](std::size_t j) {
      return std::lerp(v[j * width + x.low], v[j * width + x.high], x.part);
    };
    return std::lerp(row(y.low), row(y.high), y.part);
  };
  return {of(a), of(b)};
}

SplitSumTable split_sum_table(std::string_view masking,
                              std::size_t width,
                              std::size_t height,
                              std::size_t samples,
                              const Goal& goal) {
  for (const std::size_t n : {width, height})
    if (n < 1 || n > kLargest)
      throw wrong_usage(fmt::format("a table of {} × {} texels: 1 to {} along each side", width,
                                    height, kLargest));
  const auto nov = centres(width);
  SplitSumTable t;
  t.width = width;
  t.height = height;
  t.samples = samples;
  for (const double center : centres(height)) {
    const double r = std::max(center, kSmoothest);
    if (t.masking.empty())
      t.masking = catalogue()[two_interfaces(masking, r).model.lobes[0].masking.term].about->id;
    for (const auto& s : samples > 0 ? sampled_split_sum(masking, r, nov, samples)
                                     : split_sum(masking, r, nov, goal)) {
      t.a.push_back(s.a);
      t.b.push_back(s.b);
      if (!(s.error <= t.error)) t.error = s.error;
    }
  }
  return t;
}

SplitSumTable stored(SplitSumTable t, Storage storage) {
  for (auto* values : {&t.a, &t.b})
    for (double& v : *values)
      v = storage == Storage::half ? static_cast<double>(Half(static_cast<float>(v)))
                                   : static_cast<double>(static_cast<float>(v));
  return t;
}

void write_split_sum_table(const std::string& path, const SplitSumTable& t, Storage storage) {
  Image image;
  image.width = t.width;
  image.height = t.height;
  image.channels = {"R", "G"};
  image.planes = {{t.a.begin(), t.a.end()}, {t.b.begin(), t.b.end()}};
  image.attributes = {
      {kHow, fmt::format(
                 "GGX under Schlick's Fresnel reflects F0 A + B of an even environment, R = A, "
                 "G = B. Texel (i, j), row 0 first: NoV = (i + 0.5)/{}, roughness = (j + 0.5)/{} "
                 "but at least {}, alpha = roughness^2. Look it up at (NoV, roughness), bilinear, "
                 "clamped.",
                 t.width, t.height, kSmoothest)},
      {kMasking, t.masking},
      {kSamples, fmt::format("{}", t.samples)},
      {kError, fmt::format("{}", t.error)}};
  write_exr(path, image, storage);
}

SplitSumTable read_split_sum_table(const std::string& path) {
  const Image image = read_exr(path, 2 * kLargest * kLargest, {"R", "G"});
  const auto attribute = [&](const char* name) {
    return attribute_of(image, name, path, "a table made by gonio split_sum");
  };
  attribute(kHow);
  SplitSumTable t;
  t.masking = attribute(kMasking);
  t.width = image.width;
  t.height = image.height;
  const double samples = number(path, kSamples, attribute(kSamples));
  if (!(0 <= samples && samples <= std::numeric_limits<std::uint32_t>::max()))
    throw bad_input(path, kSamples, attribute(kSamples), "a count");
  t.samples = static_cast<std::size_t>(samples);
  t.error = number(path, kError, attribute(kError));
  t.a.assign(image.planes[0].begin(), image.planes[0].end());
  t.b.assign(image.planes[1].begin(), image.planes[1].end());
  for (std::size_t k = 0; k < t.a.size(); ++k)
    if (!std::isfinite(t.a[k]) || !std::isfinite(t.b[k]))
      throw bad_input(path, fmt::format("pixel ({}, {})", k % t.width, k / t.width),
                      fmt::format("{}, {}", t.a[k], t.b[k]), "finite numbers");
  return t;
}

SplitSumDeviation difference(const SplitSumTable& found, const SplitSumTable& truth) {
  Deviations d;
  for (std::size_t k = 0; k < truth.a.size(); ++k)
    d.add(found.a[k] - truth.a[k], found.b[k] - truth.b[k]);
  return d.all();
}

LookupError lookup_error(const SplitSumTable& t, std::size_t probes, const Goal& goal) {
  const auto grid = [&](double low) {
    std::vector<double> at;
    for (std::size_t k = 0; k < probes; ++k)
      at.push_back(std::lerp(low, 1.0, static_cast<double>(k) / static_cast<double>(probes - 1)));
    return at;
  };
  const auto between = [](double x, std::size_t n) {
    return centre(0, n) <= x && x <= centre(n - 1, n);
  };
  const auto nov = grid(0.001);
  Deviations all, inner;
  for (const double r : grid(kSmoothest)) {
    const auto truth = split_sum(t.masking, r, nov, goal);
    for (std::size_t i = 0; i < nov.size(); ++i) {
      const auto [a, b] = t(nov[i], r);
      all.add(a - truth[i].a, b - truth[i].b);
      if (between(nov[i], t.width) && between(r, t.height))
        inner.add(a - truth[i].a, b - truth[i].b);
    }
  }
  return {all.all(), inner.all()};
}

}  // namespace gonio
