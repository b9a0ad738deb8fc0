// Compiled once per instruction set (GONIO_ARCH): people's own functions over texels, interpreted.
#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/kernel/lane.h"
#include "brdf/model/derivatives.h"
#include "foreign/interpret.h"
#include "geometry/frame_of_angles.h"

namespace gonio::inline GONIO_ARCH {
namespace {

/// A function of a file with its derivatives, ready to run on one thread: a register holds a texel a lane.
struct TexelRun {
  using B = Lane<float>;
  const ForeignTerm& term;
  std::uint64_t id;
  foreign::Interpreter<B> run;
  std::vector<B> parameters;

  explicit TexelRun(const ForeignTerm& t)
      : term(t), id(t.id), run(t.derivatives, 64), parameters(t.value_count) {}

  void operator()(const Block<float>& x, const float* p, float* value, float* const* d) {
    using Way = TexelsAsLanes<false>;
    for (std::size_t k = 0; k < parameters.size(); ++k) parameters[k] = Way::parameter(p, k);
    run.set(parameters);
    const std::array<const float*, 5> own{x.nol, x.nov, x.noh, x.voh, x.sin2_theta_h};
    const bool makes_frame = term.function->reads_frame && !x.frame[0];
    const auto in = [&](std::size_t k, std::size_t j) -> B {
      const std::size_t i = j * lanes<B>;
      if (k < own.size()) return load<B>(own[k] + i);
      if (!makes_frame) return load<B>(x.frame[k - own.size()] + i);
      // Directions for a function that does not care how the surface is turned.
      const auto f = with_frame(angles<>(x, i));
      const std::array at{f.xoh, f.yoh, f.xol, f.yol, f.xov, f.yov};
      return at[k - own.size()];
    };
    run.run(x.n / lanes<B>, in, [&](std::size_t o, std::size_t j, const B& v) {
      store<B>((o == 0 ? value : d[o - 1]) + j * lanes<B>, v);
    });
  }
};

template <std::size_t slot>
void of_file(const Block<float>& x, const float* p, float* value, float* const* d) {
  thread_local std::unique_ptr<TexelRun> run;
  const auto& term = *foreign_term(catalogue_size() + slot);
  if (!run || run->id != term.id) run = std::make_unique<TexelRun>(term);
  (*run)(x, p, value, d);
}

template <std::size_t... slot>
constexpr std::array<TexelTerms<float>::Derivatives, sizeof...(slot)> table_of_files(
    std::index_sequence<slot...>) {
  return {of_file<slot>...};
}

}  // namespace

std::span<const TexelTerms<float>::Derivatives> texel_terms_of_files();
std::span<const TexelTerms<float>::Derivatives> texel_terms_of_files() {
  static constexpr auto table = table_of_files(std::make_index_sequence<most_foreign_terms>{});
  return table;
}

}  // namespace gonio::inline GONIO_ARCH
