// Slips of Fresnel terms.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "reports/own/slip_forms.h"

namespace gonio {
namespace {

using auditing::Row;

/// (1 − c)ⁿ of Schlick's form and its like.
double darkened(double c, int n = 5) {
  return std::pow(1 - std::min(c, 1.0), n);
}
double schlick(double f0, double c, int n = 5) {
  return f0 + (1 - f0) * darkened(c, n);
}
double eta_of(double f0) {
  const double root = std::sqrt(f0);
  return (1 + root) / (1 - root);
}

/// Forms of F0 and of a cosine that have the values of F along the normal or at the horizon.
constexpr std::array shapes{
    +[](double f0, double c) { return schlick(f0, c); },
    +[](double f0, double c) { return f0 + (1 - f0) * std::exp2((-5.55473 * c - 6.98316) * c); },
    +[](double f0, double c) {
      const auto [s, p] = polarised(c, eta_of(f0));
      return (s + p) / 2;
    }};

struct SlipOfF0 {
  double (*value)(double f0, double voh);
  const char* slip;
};
constexpr std::array of_f0{
    SlipOfF0{[](double f, double c) { return schlick(f, c, 4); },
             "its Fresnel term has the power 4, Schlick's has 5"},
    SlipOfF0{[](double f, double c) { return schlick(f, c, 6); },
             "its Fresnel term has the power 6, Schlick's has 5"},
    SlipOfF0{[](double f, double c) { return schlick(f, c, 3); },
             "its Fresnel term has the power 3, Schlick's has 5"},
    SlipOfF0{[](double f, double c) { return schlick(f, c, 2); },
             "its Fresnel term has the power 2, Schlick's has 5"},
    SlipOfF0{[](double f, double c) { return schlick(f, c, 1); },
             "its Fresnel term has no power: (1 − VoH) stands where (1 − VoH)⁵ belongs"},
    SlipOfF0{[](double f, double c) { return schlick(f, c, 10); },
             "its Fresnel term has the power 10, Schlick's has 5"},
    SlipOfF0{
        [](double f, double c) { return f + (1 - f) * std::exp2((-5.55473 * c + 6.98316) * c); },
        "+ 6.98316 stands where − 6.98316 belongs in its Fresnel term, which exceeds 1"},
    SlipOfF0{
        [](double f, double c) { return f + (1 - f) * std::exp((-5.55473 * c - 6.98316) * c); },
        "exp stands where exp2 belongs in its Fresnel term"},
    SlipOfF0{[](double f, double c) { return f + (1 - f) * std::pow(1 + c, 5); },
             "1 + VoH stands where 1 − VoH belongs in its Fresnel term"},
    SlipOfF0{[](double f, double c) { return f - (1 - f) * darkened(c); },
             "its Fresnel term is F0 − (1 − F0) (1 − VoH)⁵, expected F0 + (1 − F0) (1 − VoH)⁵"},
    SlipOfF0{[](double f, double c) { return f + (1 + f) * darkened(c); },
             "its Fresnel term is F0 + (1 + F0) (1 − VoH)⁵, expected F0 + (1 − F0) (1 − VoH)⁵"},
    SlipOfF0{[](double f, double c) { return f * (1 - f) * darkened(c); },
             "its Fresnel term is F0 (1 − F0) (1 − VoH)⁵, expected F0 + (1 − F0) (1 − VoH)⁵"},
    SlipOfF0{[](double f, double c) { return schlick(f, c * c); },
             "its Fresnel term has VoH² where VoH belongs"},
    SlipOfF0{[](double f, double c) { return f + f * darkened(c); },
             "its Fresnel term is F0 + F0 (1 − VoH)⁵, expected F0 + (1 − F0) (1 − VoH)⁵"},
    SlipOfF0{[](double f, double c) { return f + darkened(c); },
             "its Fresnel term is F0 + (1 − VoH)⁵, expected F0 + (1 − F0) (1 − VoH)⁵"},
    SlipOfF0{[](double f, double c) { return (1 - f) * darkened(c); },
             "its Fresnel term is (1 − F0) (1 − VoH)⁵, expected F0 + (1 − F0) (1 − VoH)⁵"},
    SlipOfF0{[](double f, double c) { return f + (1 - f) * std::pow(c, 5); },
             "its Fresnel term has VoH⁵ where (1 − VoH)⁵ belongs"},
    SlipOfF0{[](double f, double c) { return f + (1 - f) * (1 - std::pow(c, 5)); },
             "its Fresnel term has 1 − VoH⁵ where (1 − VoH)⁵ belongs"},
    SlipOfF0{[](double f, double c) { return 1 + (f - 1) * darkened(c); },
             "its Fresnel term mixes from 1 to F0, expected from F0 to 1"},
    SlipOfF0{[](double f, double c) { return f * schlick(0.04, c); }, f0_after},
};

constexpr std::array of_exact{
    ExactSlip{[](double c, double eta, double k) { return polarised(c, eta, k)[0]; },
              "its Fresnel term is that of light polarised across the plane of incidence (s): "
              "expected the mean of s and p"},
    ExactSlip{[](double c, double eta, double k) { return polarised(c, eta, k)[1]; },
              "its Fresnel term is that of light polarised in the plane of incidence (p): expected "
              "the mean of s and p"},
    ExactSlip{[](double c, double eta, double k) {
                const auto [s, p] = polarised(c, eta, k);
                return s + p;
              },
              "its Fresnel term is the sum of both polarisations: expected their mean, half of it"},
    ExactSlip{[](double c, double eta, double k) {
                const auto [s, p] = polarised(c, eta, k);
                return s * p;
              },
              "its Fresnel term is the product of both polarisations: expected their mean"},
    ExactSlip{[](double c, double eta, double k) {
                const auto [s, p] = polarised(c, eta, k);
                return (std::sqrt(s) + std::sqrt(p)) / 2;
              },
              "the amplitudes of its Fresnel term are not squared"},
};

constexpr std::array of_cosines{
    OtherCosine{[](const Row& r) { return r.noh; }, "its Fresnel term takes NoH where VoH belongs"},
    OtherCosine{[](const Row& r) { return r.nov; }, "its Fresnel term takes NoV where VoH belongs"},
    OtherCosine{[](const Row& r) { return r.nol; }, "its Fresnel term takes NoL where VoH belongs"},
    OtherCosine{[](const Row& r) { return 2 * r.voh * r.voh - 1; },
                "its Fresnel term takes LoV where VoH belongs"},
    OtherCosine{[](const Row& r) { return 2 * r.voh * r.voh; },
                "the half vector of its Fresnel term is not normalised: it is L + V"},
    OtherCosine{[](const Row& r) { return r.voh * r.voh; },
                "its Fresnel term takes VoH², as of the half vector (L + V)/2, where VoH belongs"},
};

}  // namespace

std::span<const ExactSlip> exact_slips() {
  return of_exact;
}
std::span<const OtherCosine> other_cosines() {
  return of_cosines;
}

std::array<double, 2> polarised(double c, double eta, double k) {
  const std::complex<double> n(eta, k), t = std::sqrt(1.0 - (1 - c * c) / (n * n));
  return {std::norm((c - n * t) / (c + n * t)), std::norm((n * c - t) / (n * c + t))};
}

std::string fresnel_slip(double f0,
                         std::span<const Row> rows,
                         std::span<const double> values,
                         bool of_model) {
  constexpr double same = 2e-3;
  const auto is = [&](auto value) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (!(std::abs(values[i] - value(rows[i])) < same)) return false;
    return true;
  };
  for (const auto& s : of_f0)
    if (is([&](const Row& r) { return s.value(f0, r.voh); })) return s.slip;
  for (const auto& s : of_exact)
    if (is([&](const Row& r) { return s.value(r.voh, eta_of(f0), 0); })) return s.slip;
  for (const auto& c : of_cosines)
    for (const auto shape : shapes)
      if (of_model && is([&](const Row& r) { return shape(f0, std::clamp(c.of(r), 0.0, 1.0)); }))
        return c.slip;
  return "";
}

}  // namespace gonio
