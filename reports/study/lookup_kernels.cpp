// Compiled once per instruction set (GONIO_ARCH), with contraction, as shaders
// are.
#include <algorithm>
#include <cmath>

#include "brdf/formula/scattering.h"
#include "brdf/formula/split_sum.h"
#include "number/batch.h"
#include "reports/study/kernels.h"

namespace gonio::inline GONIO_ARCH {
namespace {

#ifdef GONIO_SCALAR
using Lanes = float;
#else
using Lanes = Batch<float>;
#endif

struct Karis {
  template <class T>
  static std::array<T, 2> at(const T& nov, const T& roughness) {
    return split_sum_karis<T>(roughness, nov);
  }
};
struct Lazarov {
  template <class T>
  static std::array<T, 2> at(const T& nov, const T& roughness) {
    return split_sum_lazarov<T>(roughness, nov);
  }
};
struct Materialx {
  template <class T>
  static std::array<T, 2> at(const T& nov, const T& roughness) {
    const auto found = AlbedoFitMaterialx<T>::apply(std::array{roughness * roughness, nov});
    return {found[1], found[2]};
  }
};
/// A + B alone, as A.
struct Ours {
  template <class T>
  static std::array<T, 2> at(const T& nov, const T& roughness) {
    return {AlbedoFit<T>::apply(std::array{roughness * roughness, nov})[0], T(0)};
  }
};

template <class Form>
void formula(const float* nov,
             const float* roughness,
             std::size_t n,
             const LookupTable&,
             float* a,
             float* b) {
  for (std::size_t i = 0; i < n; i += lanes<Lanes>) {
    const auto found = Form::template at<Lanes>(load<Lanes>(nov + i), load<Lanes>(roughness + i));
    store<Lanes>(a + i, found[0]);
    store<Lanes>(b + i, found[1]);
  }
}
template <class Form>
std::array<double, 2> in_double(double nov, double roughness) {
  return Form::template at<double>(nov, roughness);
}

/// Bilinear between texels' centres, as a texture unit does it; texels are
/// fetched one by one.
void bilinear(const float* nov,
              const float* roughness,
              std::size_t n,
              const LookupTable& t,
              float* a,
              float* b) {
  const auto size = static_cast<float>(t.size);
  const auto last = static_cast<int>(t.size) - 2;
  for (std::size_t i = 0; i < n; ++i) {
    const float x = std::clamp(nov[i] * size - 0.5F, 0.0F, size - 1),
                y = std::clamp(roughness[i] * size - 0.5F, 0.0F, size - 1);
    const int left = std::min(static_cast<int>(x), last), low = std::min(static_cast<int>(y), last);
    const float u = x - static_cast<float>(left), v = y - static_cast<float>(low);
    const float* const p =
        t.texels + 2 * (static_cast<std::size_t>(low) * t.size + static_cast<std::size_t>(left));
    const float* const q = p + 2 * t.size;
    const float a0 = p[0] + u * (p[2] - p[0]), a1 = q[0] + u * (q[2] - q[0]);
    const float b0 = p[1] + u * (p[3] - p[1]), b1 = q[1] + u * (q[3] - q[1]);
    a[i] = a0 + v * (a1 - a0);
    b[i] = b0 + v * (b1 - b0);
  }
}

template <class Form>
constexpr LookupKernel of(std::string_view id, std::string_view name) {
  return {id, name, false, formula<Form>, in_double<Form>};
}
constexpr LookupKernel table[] = {{"split_sum.table", "table", true, bilinear, nullptr},
                                  of<Karis>("split_sum.karis", "Karis's formula"),
                                  of<Lazarov>("split_sum.lazarov", "Lazarov's formula"),
                                  of<Materialx>("split_sum.materialx", "MaterialX's formula"),
                                  of<Ours>("split_sum.ours", "our formula, only of A + B")};

}  // namespace

extern const std::span<const LookupKernel> lookup_table;
constinit const std::span<const LookupKernel> lookup_table{table};

}  // namespace gonio::inline GONIO_ARCH
