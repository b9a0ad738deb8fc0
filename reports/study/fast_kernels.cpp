// Compiled once per instruction set (GONIO_ARCH), with contraction, as shaders
// are.
#include "number/fast.h"
#include "reports/study/fast_model.h"
#include "reports/study/kernels.h"

namespace gonio::inline GONIO_ARCH {
namespace {

#ifdef GONIO_SCALAR
using Lanes = float;
#else
using Lanes = Batch<float>;
#endif

using fast::Rules;
using fast::Way;

template <class Operation>
void over(const float* x, std::size_t n, float* out, const Operation& operation) {
  for (std::size_t i = 0; i < n; i += lanes<Lanes>)
    store<Lanes>(out + i, operation(load<Lanes>(x + i)));
}

template <Rules rules>
void alone_root(const float* x, std::size_t n, float* out) {
  over(x, n, out, [](const Lanes& v) { return fast::rsqrt<rules.root, rules.root_steps>(v); });
}
template <Rules rules>
void alone_quotient(const float* x, std::size_t n, float* out) {
  over(x, n, out,
       [](const Lanes& v) { return fast::rcp<rules.quotient, rules.quotient_steps>(v); });
}
template <Rules rules>
void alone_exp(const float* x, std::size_t n, float* out) {
  over(x, n, out, [](const Lanes& v) { return exp(Fast<Lanes, rules>(v)).value(); });
}
/// x^−γ as GTR has it.
template <Rules rules>
void alone_power(const float* x, std::size_t n, float* out) {
  using N = Fast<Lanes, rules>;
  over(x, n, out, [](const Lanes& v) { return exp(log(N(v)) * constant<N>(-fast_gamma)).value(); });
}
template <Rules rules, class Weight>
void alone_weight(const float* x, std::size_t n, float* out) {
  over(x, n, out, [](const Lanes& v) { return Weight()(Fast<Lanes, rules>(v)).value(); });
}

template <Rules rules, Facets facets, class Weight = ByProducts>
void shaded(const VectorColumns& x, const float* p, bool by_cosine, float* out) {
  using N = Fast<Lanes, rules>;
  const FastModel<N, facets> model{N(p[0]), N(p[1])};
  const auto at = [](const std::array<const float*, 3>& columns, std::size_t i) {
    return std::array{N(load<Lanes>(columns[0] + i)), N(load<Lanes>(columns[1] + i)),
                      N(load<Lanes>(columns[2] + i))};
  };
  // Two loops: in neither is it asked for at each sample.
  const auto all = [&](auto cosine) {
    for (std::size_t i = 0; i < x.n; i += lanes<Lanes>)
      store<Lanes>(out + i, model(at(x.light, i), at(x.view, i), cosine.value, Weight()).value());
  };
  if (by_cosine)
    all(std::true_type());
  else
    all(std::false_type());
}

constexpr Rules root(Way way, int steps) {
  return {.root = way, .root_steps = steps};
}
constexpr Rules quotient(Way way, int steps) {
  return {.quotient = way, .quotient_steps = steps};
}
constexpr Rules powers(int exp_degree, int log_degree) {
  return {.exp_degree = exp_degree, .log_degree = log_degree};
}

template <Rules r>
constexpr FastKernel of_root(std::string_view id, std::string_view name) {
  return {id,   name, "reciprocal root", "fast.rsqrt.exact",
          0.25, 4,    alone_root<r>,     shaded<r, Facets::ggx>};
}
template <Rules r>
constexpr FastKernel of_quotient(std::string_view id, std::string_view name) {
  return {id,   name, "reciprocal",      "fast.rcp.exact",
          0.25, 4,    alone_quotient<r>, shaded<r, Facets::ggx>};
}
template <Rules r>
constexpr FastKernel of_exp(std::string_view id, std::string_view name) {
  return {id,  name, "exponential", "fast.exp2.exact",
          -20, 0,    alone_exp<r>,  shaded<r, Facets::beckmann>};
}
template <Rules r>
constexpr FastKernel of_power(std::string_view id, std::string_view name) {
  return {id, name, "power", "fast.log2.exact", 1, 1e4, alone_power<r>, shaded<r, Facets::gtr>};
}
template <Rules r, class Weight>
constexpr FastKernel of_weight(std::string_view id, std::string_view name) {
  return {id,   name, "fifth power",           "fast.pow5.products",
          1e-3, 1,    alone_weight<r, Weight>, shaded<r, Facets::ggx, Weight>};
}

constexpr FastKernel table[] = {
    of_root<root(Way::exact, 0)>("fast.rsqrt.exact", "a root and a division"),
    of_root<root(Way::estimate, 0)>("fast.rsqrt.estimate", "the processor's estimate"),
    of_root<root(Way::estimate, 1)>("fast.rsqrt.estimate.1", "the estimate and a Newton step"),
    of_root<root(Way::bits, 0)>("fast.rsqrt.bits", "from the bits alone"),
    of_root<root(Way::bits, 1)>("fast.rsqrt.bits.1", "the bits and a Newton step"),
    of_root<root(Way::bits, 2)>("fast.rsqrt.bits.2", "the bits and two Newton steps"),
    of_quotient<quotient(Way::exact, 0)>("fast.rcp.exact", "a division"),
    of_quotient<quotient(Way::estimate, 0)>("fast.rcp.estimate", "the processor's estimate"),
    of_quotient<quotient(Way::estimate, 1)>("fast.rcp.estimate.1",
                                            "the estimate and a Newton step"),
    of_quotient<quotient(Way::bits, 0)>("fast.rcp.bits", "from the bits alone"),
    of_quotient<quotient(Way::bits, 1)>("fast.rcp.bits.1", "the bits and a Newton step"),
    of_quotient<quotient(Way::bits, 2)>("fast.rcp.bits.2", "the bits and two Newton steps"),
    of_exp<Rules{}>("fast.exp2.exact", "the library's exponential"),
    of_exp<powers(2, 0)>("fast.exp2.2", "a polynomial of degree 2"),
    of_exp<powers(3, 0)>("fast.exp2.3", "a polynomial of degree 3"),
    of_exp<powers(4, 0)>("fast.exp2.4", "a polynomial of degree 4"),
    of_exp<powers(5, 0)>("fast.exp2.5", "a polynomial of degree 5"),
    of_power<Rules{}>("fast.log2.exact", "the library's exponential and logarithm"),
    of_power<powers(3, 2)>("fast.log2.2", "polynomials of degree 3 and 3"),
    of_power<powers(4, 4)>("fast.log2.4", "polynomials of degree 4 and 5"),
    of_power<powers(5, 6)>("fast.log2.6", "polynomials of degree 5 and 7"),
    of_weight<Rules{}, ByProducts>("fast.pow5.products", "three products"),
    of_weight<Rules{}, ByPower>("fast.pow5.power", "the library's power"),
    of_weight<powers(4, 4), ByPower>("fast.pow5.power.4", "a power of polynomials"),
    of_weight<Rules{}, BySphericalGaussian>("fast.pow5.gaussian", "a spherical Gaussian")};

}  // namespace

extern const std::span<const FastKernel> fast_table;
constinit const std::span<const FastKernel> fast_table{table};

}  // namespace gonio::inline GONIO_ARCH
