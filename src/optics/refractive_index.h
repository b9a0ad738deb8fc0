#pragma once
/// \file
/// Measured refractive indices N = n + i k over the visible spectrum.

#include <array>
#include <span>
#include <string_view>

namespace gonio {

struct Index {
  double n, k;
};

/// A metal or a dielectric by its measured index.
struct Material {
  /// Sample as published; between two wavelengths n and k are linear, beyond the ends constant.
  struct Measured {
    double nm, n, k;
  };
  /// n² = a + Σ b λ²/(λ² − c), λ in µm, k = 0                                        [Sellmeier 1871]
  struct Dispersion {
    double a = 1;
    struct Resonance {
      double b, c;
    };
    std::array<Resonance, 4> resonances{};
  };

  std::string_view symbol, name, source;
  std::span<const Measured> measured = {};  ///< by rising wavelength; empty: the formula
  Dispersion dispersion = {};

  Index at(double nm) const;
  /// At 650, 550 and 450 nm, standing for red, green and blue.
  std::array<Index, 3> rgb() const;
};

std::span<const Material> metals();
/// Without absorption.
std::span<const Material> dielectrics();
/// By symbol or name, without regard to case; nullptr if unknown.
const Material* find_metal(std::string_view symbol_or_name);
/// Material found among metals and dielectrics.
const Material* find_material(std::string_view symbol_or_name);

}  // namespace gonio
