// Compiled once per instruction set (GONIO_ARCH): the loops of people's own functions, interpreted,
// a register of samples at a time.
#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/formula/coat.h"
#include "brdf/formula/ndf_ggx.h"
#include "brdf/kernel/lane.h"
#include "foreign/interpret.h"
#include "geometry/frame_of_angles.h"

namespace gonio::inline GONIO_ARCH {
namespace {

/// Samples of a block: columns of the usual function stay in the second cache, and dispatch costs little.
constexpr std::size_t foreign_block = 512;

/// A program ready to run on one thread.
template <class F>
class ForeignRun {
 public:
  using B = Lane<F>;
  ForeignRun(const ForeignTerm& t, const foreign::Program& p, std::size_t most)
      : run_(p, foreign_block / lanes<B>),
        is_turned_(t.function->anisotropic),
        reads_frame_(t.function->reads_frame),
        values_(most),
        id(t.id) {}

  void set(const F* p, std::size_t count) {
    if (is_set_ && std::memcmp(last_.data(), p, count * sizeof(F)) == 0) return;
    last_.assign(p, p + count);
    for (std::size_t k = 0; k < count; ++k) values_[k] = B(p[k]);
    run_.set(values_);
    is_set_ = true;
  }
  /// of: of each channel, those that share a parameter say the same
  void set(const std::array<const F*, max_channels>& of, std::size_t count) {
    std::vector<F> all(values_.size());
    for (std::size_t c = 0; c < of.size(); ++c)
      std::copy_n(of[c], count, all.data() + c * foreign_stride);
    set(all.data(), all.size());
  }
  /// \param out  (output, sample, lanes)
  void operator()(const Block<F>& x, auto&& out) {
    for (std::size_t from = 0; from < x.n; from += foreign_block) {
      const Block<F> part = x.part(from, std::min(foreign_block, x.n - from));
      const std::size_t n = part.n / lanes<B>;
      const bool makes_frame = reads_frame_ && !is_turned_ && !x.frame[0];
      if (makes_frame) make_frame(part, n);
      const std::array<const F*, 5> own{part.nol, part.nov, part.noh, part.voh, part.sin2_theta_h};
      const auto in = [&](std::size_t k, std::size_t j) {
        if (k < own.size()) return load<B>(own[k] + j * lanes<B>);
        return makes_frame ? frame_[k - own.size()][j]
                           : load<B>(part.frame[k - own.size()] + j * lanes<B>);
      };
      run_.run(n, in,
               [&](std::size_t o, std::size_t j, const B& v) { out(o, from + j * lanes<B>, v); });
    }
  }

 private:
  /// Directions for a function that does not care how the surface is turned.
  void make_frame(const Block<F>& x, std::size_t n) {
    for (auto& column : frame_) column.resize(foreign_block / lanes<B>);
    for (std::size_t j = 0; j < n; ++j) {
      const auto f = with_frame(angles<>(x, j * lanes<B>));
      const std::array at{f.xoh, f.yoh, f.xol, f.yol, f.xov, f.yov};
      for (std::size_t k = 0; k < at.size(); ++k) frame_[k][j] = at[k];
    }
  }

  foreign::Interpreter<B> run_;
  std::array<std::vector<B>, 6> frame_;
  bool is_turned_, reads_frame_, is_set_ = false;
  std::vector<B> values_;
  std::vector<F> last_;

 public:
  const std::uint64_t id;  ///< of the term
};

enum class ForeignKind { value, channels, derivatives };

/// The run of a slot on this thread.
template <class F, ForeignKind kind>
ForeignRun<F>& foreign_run(std::size_t slot) {
  thread_local std::array<std::unique_ptr<ForeignRun<F>>, most_foreign_terms> runs;
  auto& r = runs[slot];
  const ForeignTerm& t = *foreign_term(catalogue_size() + slot);
  if (!r || r->id != t.id) {
    const auto& p = kind == ForeignKind::value      ? t.program()
                    : kind == ForeignKind::channels ? t.channels
                                                    : t.derivatives;
    r = std::make_unique<ForeignRun<F>>(
        t, p, kind == ForeignKind::channels ? foreign_stride * max_channels : t.value_count);
  }
  return *r;
}
template <class F>
void foreign_values(std::size_t slot, const Block<F>& x, const F* p, auto&& out) {
  auto& run = foreign_run<F, ForeignKind::value>(slot);
  run.set(p, foreign_term(catalogue_size() + slot)->value_count);
  run(x, [&](std::size_t, std::size_t i, const Lane<F>& v) { out(i, v); });
}

template <class F>
struct ForeignShade {
  const Block<F>& x;
  const ChannelColumns<F>& j;
  bool is_fresnel;

  void operator()(std::size_t c, std::size_t i, const Lane<F>& v) const {
    using B = Lane<F>;
    B value = v;
    if (is_fresnel) {
      const B factor = load<B>(j.factor + i);
      if (!j.base[0] && !j.uniform) {
        value = lobe_on(Zero{}, Zero{}, One{}, factor, v);
      } else {
        const B under = j.base[0] ? load<B>(j.base[c] + i) : B(j.uniform[c]);
        value = j.coupled ? coated_by_facet(under, factor, v)
                          : lobe_on(under, Zero{}, One{}, factor, v);
      }
    }
    store<B>(j.out[c] + i, value);
  }
};

/// What a slot's kernels do: compiled once, not for each slot.
template <class F>
struct ForeignKernels {
  using B = Lane<F>;

  static void start_product(std::size_t slot,
                            const Block<F>& x,
                            const F* p,
                            const ProductColumns<F>& j) {
    foreign_values(slot, x, p, [&](std::size_t i, const B& v) { store<B>(j.out + i, v); });
  }
  static void finish_product(std::size_t slot,
                             const Block<F>& x,
                             const F* p,
                             const ProductColumns<F>& j) {
    foreign_values(slot, x, p, [&](std::size_t i, const B& v) {
      const B num = load<B>(j.num + i) * v;
      store<B>(j.out + i, j.den ? num / load<B>(j.den + i) : num);
    });
  }
  static void add_product(std::size_t slot,
                          const Block<F>& x,
                          const F* p,
                          const ProductColumns<F>& j) {
    foreign_values(slot, x, p, [&](std::size_t i, const B& v) {
      store<B>(j.out + i, lobe_on(load<B>(j.base + i), Zero{}, One{}, load<B>(j.num + i), v));
    });
  }
  static void shade_one(std::size_t slot, const Block<F>& x, const ChannelColumns<F>& j) {
    const ForeignShade<F> shade{x, j, catalogue()[catalogue_size() + slot].role() == Role::fresnel};
    foreign_values(slot, x, j.parameters[0], [&](std::size_t i, const B& v) { shade(0, i, v); });
  }
  static void shade_all(std::size_t slot, const Block<F>& x, const ChannelColumns<F>& j) {
    const ForeignShade<F> shade{x, j, catalogue()[catalogue_size() + slot].role() == Role::fresnel};
    auto& run = foreign_run<F, ForeignKind::channels>(slot);
    run.set(j.parameters, foreign_term(catalogue_size() + slot)->value_count);
    run(x, shade);
  }
  static void derivatives(std::size_t slot, const Block<F>& x, const F* p, F* value, F* const* d) {
    auto& run = foreign_run<F, ForeignKind::derivatives>(slot);
    run.set(p, foreign_term(catalogue_size() + slot)->value_count);
    run(x, [&](std::size_t o, std::size_t i, const B& v) {
      store<B>((o == 0 ? value : d[o - 1]) + i, v);
    });
  }
  /// D V with GGX's D, for evaluators that ask for it by name: of foreign masking terms.
  static void with_ggx(std::size_t slot, const Block<F>& x, const F* ggx, const F* p, F* out) {
    const auto d = bind_value<Ggx, F>(ggx);
    foreign_values(slot, x, p, [&](std::size_t i, const B& v) {
      const auto q = as_quotient<B>(d(angles<>(x, i)));
      store<B>(out + i, q.num * v / q.den);
    });
  }
};

/// A kernel that knows its slot.
template <auto kernel, std::size_t slot, class... Arguments>
void of_slot(Arguments... arguments) {
  kernel(slot, arguments...);
}

template <std::size_t slot, class F>
constexpr TermKernels<F> foreign_entry() {
  using K = ForeignKernels<F>;
  using X = const Block<F>&;
  using Product = const ProductColumns<F>&;
  using Channels = const ChannelColumns<F>&;
  TermKernels<F> k{};
  k.start_product = of_slot<&K::start_product, slot, X, const F*, Product>;
  k.finish_product = of_slot<&K::finish_product, slot, X, const F*, Product>;
  k.add_product = of_slot<&K::add_product, slot, X, const F*, Product>;
  k.shade[1] = of_slot<&K::shade_one, slot, X, Channels>;
  k.shade[3] = of_slot<&K::shade_all, slot, X, Channels>;
  k.derivatives = of_slot<&K::derivatives, slot, X, const F*, F*, F* const*>;
  k.with_ggx = of_slot<&K::with_ggx, slot, X, const F*, const F*, F*>;
  return k;
}

}  // namespace

template <class F>
std::span<const TermKernels<F>> foreign_terms() {
  static constexpr auto table = []<std::size_t... slot>(std::index_sequence<slot...>) {
    return std::array{foreign_entry<slot, F>()...};
  }
  (std::make_index_sequence<most_foreign_terms>{});
  return table;
}
template std::span<const TermKernels<float>> foreign_terms();
template std::span<const TermKernels<double>> foreign_terms();

}  // namespace gonio::inline GONIO_ARCH
