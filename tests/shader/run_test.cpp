// Emitted terms, compiled by each language's own compiler and run on Vulkan.
#include <algorithm>
#include <bit>

#include "base/error.h"
#include "brdf/catalogue/registry.h"
#include "number/enclosure.h"
#include "shader/running.h"
#include "shader/shader.h"
#include "stability/value_over.h"

#include <fmt/format.h>

namespace gonio::shader {
namespace {

using test::Folder;
using test::Vulkan;

std::size_t row_count() {
  return std::getenv("GONIO_LONG") ? 1 << 18 : 1 << 12;
}

/// A term at many inputs.
template <class F>
struct Rows {
  std::size_t term;
  TracedFormula formula;
  std::vector<std::vector<F>> parameters;
  std::vector<FrameAngles<F>> angles;
  std::vector<float> inputs;  ///< of the function, row by row

  Rows(std::size_t index, TracedFormula traced) : term(index), formula(std::move(traced)) {
    const auto about = catalogue()[term].parameters;
    Draw<F> draw;
    for (std::size_t i = 0; i < row_count(); ++i) {
      auto& p = parameters.emplace_back();
      for (const auto& parameter : about) p.push_back(draw(parameter.fit));
      angles.push_back(draw.angles());
      for (const auto& q : formula.parameters)
        inputs.push_back(static_cast<float>(p[static_cast<std::size_t>(q.about - about.data())]));
      for (const auto& q : formula.angles)
        inputs.push_back(static_cast<float>(angle_of(angles.back(), q.name)));
    }
    if (inputs.empty()) inputs.push_back(0);
  }
  F expected(std::size_t i) const {
    return term_function<F>(term)(parameters[i], angles[i]).value();
  }

  /// True of what Vulkan's rules allow a device, operation by operation.
  bool allows(std::size_t i, float x) const {
    const RoundingScope rules(Rounding::vulkan());
    const auto e = [](const F& y) { return Enclosure<F>::between(y, y); };
    std::vector<Enclosure<F>> p;
    for (const auto& y : parameters[i]) p.push_back(e(y));
    const auto& a = angles[i];
    return term_function<Enclosure<F>>(term)(
               p, {{e(a.nol), e(a.nov), e(a.noh), e(a.voh), e(a.sin2_theta_h)},
                   e(a.xoh),
                   e(a.yoh),
                   e(a.xol),
                   e(a.yol),
                   e(a.xov),
                   e(a.yov)})
        .value()
        .holds(static_cast<double>(x));
  }
  /// Same bits; where exp or log are in it, what Vulkan's rules allow.  So, too, where there is no value: of min(NaN, x) GLSL leaves
  /// open which it is.
  void expect_exact(std::span<const float> out, Language language) const {
    const auto o = formula.operations();
    const bool is_algebraic = o[Operation::exp] + o[Operation::log] == 0;
    expect(out, language, [&](std::size_t i) {
      const auto wanted = static_cast<float>(expected(i));
      return same_bits(out[i], wanted) ||
             ((!is_algebraic || std::isnan(wanted)) && allows(i, out[i]));
    });
  }
  void expect(std::span<const float> out, Language language, auto&& right) const {
    ASSERT_EQ(out.size(), angles.size());
    std::size_t wrong = 0, first = 0;
    for (std::size_t i = 0; i < out.size(); ++i)
      if (!right(i) && wrong++ == 0) first = i;
    if (wrong == 0) return;
    std::string at;
    for (const auto& x : parameters[first]) at += fmt::format(" {}", static_cast<double>(x));
    ADD_FAILURE() << formula.id << " in " << name_of(formula.precision) << ", " << name_of(language)
                  << ": " << wrong << " of " << out.size() << " are wrong, first " << out[first]
                  << " for " << static_cast<double>(expected(first)) << " with" << at << "\n"
                  << shader_source(formula, {language, "brdf", {}});
  }
};

/// Terms that have no shader in half: quadratures, with nodes that are none.
bool is_refused(std::size_t term, Precision precision) {
  return precision == Precision::half && catalogue()[term].id().starts_with("masking.smith_gtr.");
}

template <class F>
std::vector<Rows<F>> rows_of_every_term() {
  std::vector<Rows<F>> all;
  for (std::size_t term = 0; term < catalogue().size(); ++term) {
    if (is_refused(term, precision_of<F>))
      EXPECT_THROW(trace_term(term, precision_of<F>, {}), Error) << catalogue()[term].id();
    else
      all.emplace_back(term, trace_term(term, precision_of<F>, {}));
  }
  return all;
}

template <class F>
void run_glsl(Vulkan& vulkan) {
  const Folder folder;
  for (const auto& rows : rows_of_every_term<F>()) {
    const auto code = compiled_glsl(folder, compute_program(rows.formula, Language::glsl));
    if (::testing::Test::HasFailure()) return;
    const std::size_t n = rows.angles.size();
    rows.expect_exact(vulkan.run(code, rows.inputs, n, n), Language::glsl);
  }
}

TEST(EmittedGlsl, OfEveryTermGivesTheSameBitsInFloat) {
  GONIO_NEEDS_VULKAN(vulkan);
  run_glsl<float>(*vulkan);
}

TEST(EmittedGlsl, OfEveryTermGivesTheSameBitsInHalf) {
  GONIO_NEEDS_VULKAN(vulkan);
  run_glsl<Half>(*vulkan);
}

template <class F>
void run_slang(Vulkan& vulkan) {
  const Folder folder;
  const auto all = rows_of_every_term<F>();
  std::vector<std::string> names;
  for (const auto& rows : all) {
    names.push_back(rows.formula.id);
    folder.write(names.back() + ".slang", compute_program(rows.formula, Language::slang));
  }
  run_languages(folder, names);
  if (::testing::Test::HasFailure()) return;
  for (const auto& rows : all) {
    const auto code = compiled_glsl(folder, test::read_bytes(folder / (rows.formula.id + ".comp")));
    if (::testing::Test::HasFailure()) return;
    const std::size_t n = rows.angles.size();
    rows.expect_exact(vulkan.run(code, rows.inputs, n, n), Language::slang);
  }
}

// By way of GLSL, which keeps the word precise; the compiler's own SPIR-V drops it.
TEST(EmittedSlang, OfEveryTermGivesTheSameBitsInFloat) {
  GONIO_NEEDS_SHADING;
  GONIO_NEEDS_VULKAN(vulkan);
  run_slang<float>(*vulkan);
}

TEST(EmittedSlang, OfEveryTermGivesTheSameBitsInHalf) {
  GONIO_NEEDS_SHADING;
  GONIO_NEEDS_VULKAN(vulkan);
  run_slang<Half>(*vulkan);
}

template <class F>
void run_wgsl(double tolerance) {
  const Folder folder;
  const auto all = rows_of_every_term<F>();
  std::vector<std::string> names;
  for (const auto& rows : all) {
    const auto& name = names.emplace_back(rows.formula.id);
    const std::size_t n = rows.angles.size();
    folder.write(name + ".wgsl", compute_program(rows.formula, Language::wgsl));
    folder.write(name + ".json", fmt::format("{{\"invocations\": {}, \"results\": {}}}", n, n));
    folder.write(name + ".in", std::string(reinterpret_cast<const char*>(rows.inputs.data()),
                                           rows.inputs.size() * sizeof(float)));
  }
  run_languages(folder, names);
  if (::testing::Test::HasFailure()) return;
  for (const auto& rows : all) {
    const auto bits = words_of(folder / (rows.formula.id + ".out"));
    std::vector<float> out;
    for (const auto word : bits) out.push_back(std::bit_cast<float>(word));
    rows.expect(out, Language::wgsl, [&](std::size_t i) {
      const auto expected = static_cast<double>(rows.expected(i));
      return same_bits(out[i], static_cast<float>(expected)) ||
             std::abs(static_cast<double>(out[i]) - expected) <=
                 tolerance *
                     std::max(std::abs(expected), std::is_same_v<F, Half> ? 0x1p-14 : 0x1p-64) ||
             rows.allows(i, out[i]);
    });
  }
}

// Its compilers may regroup, and so they do: what that moves is bounded here by what it moves in
// the worst term.
TEST(EmittedWgsl, OfEveryTermGivesNearlyTheSameInFloat) {
  GONIO_NEEDS_SHADING;
  std::string why;
  if (!Vulkan::open(why)) GTEST_SKIP() << why;
  run_wgsl<float>(1e-4);
}

TEST(EmittedWgsl, OfEveryTermGivesNearlyTheSameInHalf) {
  GONIO_NEEDS_SHADING;
  std::string why;
  if (!Vulkan::open(why)) GTEST_SKIP() << why;
  run_wgsl<Half>(0.05);
}

}  // namespace
}  // namespace gonio::shader
