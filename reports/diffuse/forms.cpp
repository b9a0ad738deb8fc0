#include "reports/diffuse/forms.h"

#include <algorithm>
#include <array>

#include "brdf/catalogue/registry.h"

#include <fmt/format.h>

namespace gonio::diffusing {
namespace {

/// How a form takes the slider's roughness r.
enum class Takes { nothing, alpha, sigma, r };
constexpr std::array parameter_text{"", "α = r²", "σ = r", "r"};

struct Known {
  std::string_view id, name;
  Takes takes;
  bool with_interface;
};
constexpr std::array known{
    Known{"diffuse.lambert", "Lambert", Takes::nothing, false},
    Known{"diffuse.lambert.coupled", "Lambert, coupled", Takes::nothing, true},
    Known{"diffuse.disney", "Disney", Takes::alpha, true},
    Known{"diffuse.disney.coupled", "Disney, coupled", Takes::alpha, true},
    Known{"diffuse.frostbite", "Frostbite", Takes::alpha, true},
    Known{"diffuse.hammon", "Hammon", Takes::alpha, true},
    Known{"diffuse.oren_nayar", "Oren–Nayar", Takes::sigma, false},
    Known{"diffuse.oren_nayar.fujii", "Fujii's Oren–Nayar", Takes::r, false},
    Known{"diffuse.eon", "EON", Takes::r, false}};

}  // namespace

std::vector<DiffuseForm> known_forms() {
  std::vector<DiffuseForm> out;
  for (const auto& k : known) {
    DiffuseForm f{};
    f.id = k.id;
    f.name = k.name;
    f.parameter = parameter_text[static_cast<std::size_t>(k.takes)];
    f.coupled = catalogue()[find_term(k.id)].coupled;
    f.with_interface = k.with_interface;
    out.push_back(std::move(f));
  }
  return out;
}

double alpha_of_slider(double roughness) {
  return std::max(roughness * roughness, 1e-4);
}

BoundModel bound(const DiffuseForm& f, double roughness, std::vector<double> kd, bool with_lobe) {
  const bool lobe = with_lobe || f.coupled;
  // By its terms: "disney" alone would be a preset.
  const std::string own(short_id(f.id));
  BoundModel b{compose(lobe ? fmt::format("{}+{}", own, lobe_spec) : own, kd.size()), {}, {}};
  b.values.resize(b.model.value_count);
  for (const auto& p : b.model.parameters)
    for (std::size_t c = 0; c < p.count; ++c)
      b.values[p.slot(c)] = p.name == "kd"      ? kd[c]
                            : p.name == "alpha" ? alpha_of_slider(roughness)
                            : p.name == "f0"    ? lobe_f0
                                                : roughness;  // σ, r
  return b;
}

}  // namespace gonio::diffusing
