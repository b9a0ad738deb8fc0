#include "optics/refractive_index.h"

#include <algorithm>
#include <cctype>

namespace gonio {
namespace {

constexpr std::string_view johnson_1972 = "Johnson and Christy 1972, doi:10.1103/PhysRevB.6.4370";
constexpr std::string_view johnson_1974 = "Johnson and Christy 1974, doi:10.1103/PhysRevB.9.5056";

// Linear interpolation of the published tables at 650, 550 and 450 nm, as collected in the
// refractiveindex.info database (public domain).
constexpr Metal table[] = {
    {"Ag", "silver", {0.0522, 0.0596, 0.0400}, {4.4094, 3.5974, 2.6484}, johnson_1972},
    {"Al",
     "aluminium",
     {1.5580, 1.0152, 0.6332},
     {7.7124, 6.6273, 5.4544},
     "Rakić 1995, doi:10.1364/AO.34.004755"},
    {"Au", "gold", {0.1556, 0.4241, 1.3831}, {3.6024, 2.4721, 1.9155}, johnson_1972},
    {"Cr", "chromium", {3.1071, 3.1812, 2.3230}, {3.3314, 3.3291, 3.1350}, johnson_1974},
    {"Cu", "copper", {0.2378, 1.0066, 1.2404}, {3.6264, 2.5823, 2.3929}, johnson_1972},
    {"Fe", "iron", {2.9114, 2.9497, 2.5845}, {3.0893, 2.9318, 2.7670}, johnson_1974},
    {"Ni", "nickel", {1.9900, 1.9212, 1.7290}, {4.2086, 3.6158, 2.9435}, johnson_1974},
    {"Ti", "titanium", {2.7407, 2.5418, 2.2670}, {3.8143, 3.4345, 3.0385}, johnson_1974},
    {"W",
     "tungsten",
     {3.6714, 3.5221, 3.3149},
     {2.9325, 2.7414, 2.5160},
     "Weaver, Olson and Lynch 1975, doi:10.1103/PhysRevB.12.1293"},
};

bool same(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::ranges::equal(a, b, {}, lower, lower);
}

}  // namespace

std::span<const Metal> metals() {
  return table;
}

const Metal* find_metal(std::string_view s) {
  for (const auto& m : table)
    if (same(m.symbol, s) || same(m.name, s)) return &m;
  return nullptr;
}

}  // namespace gonio
