#include "reports/own/disguises.h"

#include <algorithm>
#include <cmath>

#include "brdf/catalogue/registry.h"
#include "brdf/in_number/number.h"

namespace gonio {
namespace {

using auditing::Row;
using auditing::Values;

/// (1 − VoH)⁵ of Schlick's form.
double fifth(const Row& r) {
  return std::pow(1 - r.voh, 5);
}

constexpr std::array all_disguises{
    Disguise{[](const Row&) { return 1.0; }, ""},
    Disguise{[](const Row& r) { return 1 + fifth(r); }, "", true},
    Disguise{[](const Row& r) { return 4 * r.nol * r.nov; },
             "G stands where V belongs: its highlight lacks the division by 4 NoL NoV"},
    Disguise{[](const Row& r) { return 1 / (4 * r.nol * r.nov); },
             "4 NoL NoV stands below twice: V is divided by it already"},
    Disguise{[](const Row& r) { return r.nol; },
             "its highlight has the cosine NoL in it, which its diffuse part has not"},
    Disguise{[](const Row& r) { return 0.04 + 0.96 * fifth(r); }, f0_after, false, true},
};

std::array<double, 2> sum(const Row& r) {
  return {2 * r.noh * r.voh, 2 * r.voh * r.voh};
}
std::array<double, 2> sum_by_precedence(const Row& r) {
  const double length = 2 * r.voh, lov = length * r.voh - 1;
  return {r.nol + r.nov / length, lov + 1 / length};
}
constexpr const char *is_sum = "its half vector is not normalised: it is L + V",
                     *is_by_precedence = "its half vector is not normalised: it is L + V/|L + V|";
constexpr std::array all_half_vectors{
    HalfVector{nullptr, ""},
    HalfVector{[](const Row& r) {
                 return std::array{r.noh * r.voh, r.voh * r.voh};
               },
               "its half vector is not normalised: it is (L + V)/2"},
    HalfVector{sum, is_sum},
    HalfVector{sum, is_sum, false},
    HalfVector{sum_by_precedence, is_by_precedence},
    HalfVector{sum_by_precedence, is_by_precedence, false},
    HalfVector{[](const Row& r) {
                 const double lov = 2 * r.voh * r.voh - 1, length = std::sqrt(2 + 2 * r.nol);
                 return std::array{length / 2, std::max(0.0, r.nov + lov) / length};
               },
               "its half vector is that of N and L: expected L + V"},
    HalfVector{[](const Row& r) {
                 const double length = std::sqrt(2 + 2 * r.nov);
                 return std::array{length / 2, length / 2};
               },
               "its half vector is that of N and V: expected L + V"},
};

}  // namespace

std::span<const Disguise> disguises() {
  return all_disguises;
}
std::span<const HalfVector> half_vectors() {
  return all_half_vectors;
}

Values Interface::values(std::vector<Row> rows) const {
  Values f;
  if (exact)
    for (const auto& r : rows) f.push_back(exact->value(r.voh, parameter, 0));
  if (exact) return f;
  for (auto& r : rows)
    if (cosine) r.voh = std::clamp(cosine->of(r), 0.0, 1.0);
  return values_in(Number::double_, find_term(id), std::array{parameter}, rows);
}

std::vector<Interface> interfaces(const PartColours& colours,
                                  std::span<const Parameter> parameters) {
  if (!colours.f0.empty()) return {{}};
  constexpr double of_dielectrics = 0.04;
  if (!colours.eta) return {{"fresnel.schlick", of_dielectrics}};
  const double eta = high_of(parameters[*colours.eta]), root = (eta - 1) / (eta + 1);
  std::vector<Interface> all{{"fresnel.dielectric", eta}, {"fresnel.schlick", root * root}};
  for (const auto& s : exact_slips()) all.push_back({"fresnel.dielectric", eta, &s});
  for (const auto& c : other_cosines())
    for (const auto& right : {all[0], all[1]})
      all.push_back({right.id, right.parameter, nullptr, &c});
  return all;
}

}  // namespace gonio
