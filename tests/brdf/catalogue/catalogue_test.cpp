// What holds for every term, whichever it is: a term named in catalogue.h is tested here at once.
#include "brdf/catalogue/catalogue.h"

#include <bit>
#include <cfenv>
#include <set>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/terms.h"
#include "number/archetype.h"
#include "number/batch.h"
#include "number/counted.h"
#include "number/dual.h"

namespace gonio {
namespace {

using test::Parameters;
using test::text;

template <class F>
constexpr F eps = std::numeric_limits<F>::epsilon();

// ---- Every number -------------------------------------------------------------------------------

template <template <class> class Term>
constexpr bool takes_every_number() {
  constexpr std::size_t n = Term<double>::parameters.size();
  return TermOver<Term<double>, double> && TermOver<Term<float>, float> &&
         TermOver<Term<Archetype>, Archetype> && TermOver<Term<Batch<float>>, Batch<float>> &&
         TermOver<Term<Batch<double>>, Batch<double>> &&
         TermOver<Term<Dual<double, n>>, Dual<double, n>> &&
         TermOver<Term<Dual<float, n>>, Dual<float, n>> &&
         TermOver<Term<Dual<Batch<double>, n>>, Dual<Batch<double>, n>>;
}

/// The term in the least of numbers, which is a double that hides it.
template <template <class> class Term>
double least(const Parameters& p, const test::Row& x) {
  std::vector<Archetype> a;
  for (const double v : p) a.emplace_back(v);
  constexpr std::size_t n = Term<Archetype>::parameters.size();
  const Term<Archetype> term{std::span<const Archetype, n>(a)};
  const auto a_ = [](double v) { return Archetype(v); };
  const FrameAngles<Archetype> at{{a_(x.nol), a_(x.nov), a_(x.noh), a_(x.voh), a_(x.sin2_theta_h)},
                                  a_(x.xoh),
                                  a_(x.yoh),
                                  a_(x.xol),
                                  a_(x.yol),
                                  a_(x.xov),
                                  a_(x.yov)};
  return as_value<Archetype>(term(at)).value();
}

/// exp and log of a batch differ from the scalar's by a few eps, and exp is 0 where the scalar's is
/// subnormal; terms without them must not differ.
template <template <class> class Term>
bool has_exp_or_log() {
  using T = Counted<double>;
  const auto done = count_operations([] {
    std::vector<T> p;
    for (const auto& q : Term<T>::parameters) p.emplace_back(q.start);
    const Term<T> term{std::span<const T, Term<T>::parameters.size()>(p)};
    const T half(0.5), most(0.75);
    as_value<T>(
        term(FrameAngles<T>{{half, half, half, half, most}, half, half, half, half, half, half}));
  });
  return done[Operation::exp] + done[Operation::log] > 0;
}
template <template <class> class... Terms>
std::vector<bool> transcendental_terms(TermList<Terms...>) {
  return {has_exp_or_log<Terms>()...};
}

using Least = double (*)(const Parameters&, const test::Row&);
template <template <class> class... Terms>
std::vector<Least> instantiate(TermList<Terms...>) {
  static_assert((takes_every_number<Terms>() && ...));
  return {least<Terms>...};
}

TEST(Catalogue, EveryTermAsksNoMoreThanTheLeastOfNumbersOffers) {
  const auto terms = instantiate(Catalogue{});
  ASSERT_EQ(terms.size(), catalogue().size());
  for (std::size_t t = 0; t < terms.size(); ++t)
    for (const auto& p : test::legal_grid(catalogue()[t].parameters, 3))
      for (const auto& x : test::random_angles(16, 5))
        EXPECT_EQ(terms[t](p, x), test::value_at(t, p, x)) << catalogue()[t].about->id;
}

/// Terms that are held to be finite in F: those that are a shader's arithmetic are in double only, and
/// where NoH is above 0, as it is wherever NoL + NoV is.
template <class F>
std::vector<std::size_t> finite_terms() {
  std::vector<std::size_t> terms;
  for (std::size_t t = 0; t < catalogue().size(); ++t)
    if (!catalogue()[t].as_shipped || std::same_as<F, double>) terms.push_back(t);
  return terms;
}

// ---- What a term says of itself -----------------------------------------------------------------

TEST(Catalogue, EveryTermNamesItselfItsFormulaAndItsSource) {
  std::set<std::string_view> ids;
  for (const auto& t : catalogue()) {
    const auto& a = *t.about;
    EXPECT_TRUE(ids.insert(a.id).second) << a.id << " twice";
    EXPECT_FALSE(a.title.empty() || a.formula.empty() || a.source.empty()) << a.id;
    if (role_of(a.id) == Role::diffuse) {
      EXPECT_TRUE(a.id.starts_with("diffuse.")) << a.id;
    }
    EXPECT_EQ(a.id.find_first_of("+/,= "), a.id.npos) << a.id << " cannot stand in a spec";
  }
}

TEST(Catalogue, EveryParameterStartsWhereAFitMayLookAndAFitLooksWhereItIsLegal) {
  for (const auto& t : catalogue()) {
    EXPECT_LE(t.parameters.size(), 4U)
        << t.about->id;  // what evaluate() and ModelDerivatives gather
    for (const auto& p : t.parameters) {
      EXPECT_TRUE(p.fit.holds(p.start)) << t.about->id << " " << p.name;
      EXPECT_TRUE(p.legal.holds(p.fit.low) && p.legal.holds(p.fit.high))
          << t.about->id << " " << p.name;
      EXPECT_FALSE(p.name.empty() || p.meaning.empty()) << t.about->id;
    }
  }
}

template <class F>
void check_same_order() {
  for (const auto& name : instruction_sets()) {
    const auto& set = kernels<F>(name);
    EXPECT_EQ(set.instruction_set, name);
    EXPECT_EQ(set.terms.size(), catalogue_size() + most_foreign_terms);
  }
}
TEST(Catalogue, IsTheSameInEveryInstructionSet) {
  EXPECT_EQ(instruction_sets().front(), "scalar");
  EXPECT_EQ(kernels<double>().instruction_set, instruction_sets().back());
  check_same_order<float>();
  check_same_order<double>();
  EXPECT_ANY_THROW(kernels<float>("abacus"));
}

// ---- The ends of the domain ---------------------------------------------------------------------

/// All combinations of normal, middle and grazing, near and at; but for both directions at the
/// horizon, which is outside the domain.
std::vector<test::Row> corners(std::size_t term) {
  constexpr double cosines[] = {0, 1e-8, 0.5, 1};
  std::vector<test::Row> rows;
  for (const double nol : cosines)
    for (const double nov : cosines)
      for (const double voh : cosines)
        for (const auto& [noh, sin2] :
             {std::pair{1.0, 0.0}, {1.0, 1e-16}, {0.6, 0.64}, {1e-8, 1.0}, {0.0, 1.0}})
          if (nol + nov > 0 && !(catalogue()[term].as_shipped && noh == 0))
            rows.push_back(test::framed({nol, nov, noh, voh, sin2}));
  return rows;
}

template <class F>
class Everywhere : public testing::Test {};
using Floats = testing::Types<float, double>;
TYPED_TEST_SUITE(Everywhere, Floats);

TYPED_TEST(Everywhere, TermsAreFiniteAndNotNegative) {
  using F = TypeParam;
  for (const auto t : finite_terms<F>())
    for (const auto& p : test::legal_grid(catalogue()[t].parameters, 4)) {
      const auto rows = corners(t);
      const auto v = test::values_of<F>(t, p, rows);
      for (std::size_t i = 0; i < rows.size(); ++i)
        EXPECT_TRUE(std::isfinite(v[i]) && v[i] >= 0)
            << catalogue()[t].about->id << text(p) << " at " << text(rows[i]) << ": " << v[i];
    }
}

TYPED_TEST(Everywhere, DerivativesAreFinite) {
  using F = TypeParam;
  for (const auto t : finite_terms<F>())
    for (const auto& p : test::legal_grid(catalogue()[t].parameters, 4)) {
      const auto rows = corners(t);
      const auto d = test::derivatives_of<F>(t, p, rows);
      const auto v = test::values_of<F>(t, p, rows);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_NEAR(d[0][i], v[i], 4 * eps<F> * v[i]);
        for (std::size_t k = 1; k < d.size(); ++k)
          EXPECT_TRUE(std::isfinite(d[k][i]))
              << catalogue()[t].about->id << text(p) << " at " << text(rows[i]) << ": " << d[k][i];
      }
    }
}

TYPED_TEST(Everywhere, TermsRaiseNoFloatingPointException) {
  using F = TypeParam;
  const auto clean = [] { return std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW) == 0; };
  std::feclearexcept(FE_ALL_EXCEPT);
  const std::vector<test::Row> outside{
      test::framed({0, 0, 0.5, 0.5, 0.75})};  // where this V has no bound
  test::values_of<F>(find_term("masking.smith_ggx.correlated"), {0.5}, outside);
  EXPECT_FALSE(clean()) << "the ruler: a division by zero must be seen";
  for (const auto t : finite_terms<F>())
    for (const auto& p : test::legal_grid(catalogue()[t].parameters, 4)) {
      const auto rows = corners(t);
      std::feclearexcept(FE_ALL_EXCEPT);
      test::values_of<F>(t, p, rows);
      EXPECT_TRUE(clean()) << catalogue()[t].about->id << text(p);
      std::feclearexcept(FE_ALL_EXCEPT);
      test::derivatives_of<F>(t, p, rows);
      EXPECT_TRUE(clean()) << "derivatives of " << catalogue()[t].about->id << text(p);
    }
}

// ---- Derivatives --------------------------------------------------------------------------------

TEST(Catalogue, DerivativesAreThoseOfDifferences) {
  const auto rows = test::random_angles(32, 6);
  for (std::size_t t = 0; t < catalogue().size(); ++t) {
    const auto& about = catalogue()[t].parameters;
    std::vector<Parameter> inner(about.begin(), about.end());
    for (auto& p : inner) {  // half a step in from the ends of where a fit may look
      const auto s = test::spread(p.fit, 6);
      p.legal = {s[1], s[5]};
    }
    for (const auto& p : test::legal_grid(inner, 2)) {
      const auto d = test::derivatives_of(t, p, rows);
      for (std::size_t k = 0; k < p.size(); ++k)
        for (std::size_t i = 0; i < rows.size(); ++i) {
          const auto f = [&](double v) {
            Parameters q = p;
            q[k] = v;
            return test::value_at(t, q, rows[i]);
          };
          // Where a small step of the parameter is a large one of ln f, a smaller one.
          const double steep = d[0][i] > 0 ? std::abs(p[k] * d[1 + k][i] / d[0][i]) : 0;
          const double tolerance =
              catalogue()[t].as_shipped ? 1e-5 : 1e-6;  // what cancels is noisy
          const double expected = test::slope(f, p[k], 1e-3 * p[k] * 20 / std::max(20., steep));
          EXPECT_NEAR(d[1 + k][i], expected,
                      tolerance * std::abs(expected) + 1e-7 * d[0][i] / p[k] +
                          std::numeric_limits<double>::min())
              << catalogue()[t].about->id << text(p) << " by " << about[k].name << " at "
              << text(rows[i]);
        }
    }
  }
}

// ---- Lanes --------------------------------------------------------------------------------------

/// scale: what an error is measured by, beside the value itself.  An error of eps in y is one of
/// eps |y| in eʸ.
template <class F>
void expect_same(
    const F* a, const F* b, std::size_t n, F tolerance, auto&& scale, const std::string& where) {
  F largest = 0;
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::abs(b[i]) + scale(i));
  for (std::size_t i = 0; i < n; ++i) {
    if (a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i]))) continue;
    // What multiplies an exp lost as subnormal: secants, reciprocal widths, the exponent.
    const F subnormal = F(1e12) * largest * std::numeric_limits<F>::min();
    ASSERT_GT(tolerance, 0) << where << " in lane " << i << ": " << a[i] << " and " << b[i];
    const F size = std::abs(b[i]) + scale(i), y = std::abs(std::log(size) - std::log(largest));
    ASSERT_LE(std::abs(a[i] - b[i]),
              (size > 0 ? tolerance * size * std::max(F(1), y) : 0) + subnormal)
        << where << " in lane " << i;
  }
}

TYPED_TEST(Everywhere, EveryInstructionSetGivesTheBitsOfTheScalar) {
  using F = TypeParam;
  const auto rows = test::random_angles(256, 7);
  const auto x = test::columns<F>(rows);
  const auto b = x.block();
  const auto& scalar = kernels<F>("scalar");
  const auto none = [](std::size_t) { return F(0); };
  const auto transcendental = transcendental_terms(Catalogue{});
  std::mt19937_64 random(8);
  Column<F> num(b.n), den(b.n), base(b.n);
  for (std::size_t i = 0; i < b.n; ++i)
    for (auto* c : {&num, &den, &base})
      (*c)[i] = std::uniform_real_distribution<F>(F(0.5), 2)(random);

  for (const auto& name : instruction_sets())
    for (std::size_t t = 0; t < catalogue().size(); ++t)
      for (const auto& parameters : test::legal_grid(catalogue()[t].parameters, 4)) {
        const auto& lane = kernels<F>(name).terms[t];
        const auto& one = scalar.terms[t];
        // ∞ in one and almost ∞ in the other
        if (transcendental[t] && catalogue()[t].as_shipped && std::same_as<F, float>) continue;
        const std::vector<F> p(parameters.begin(), parameters.end());
        const std::string where = name + " " + std::string(catalogue()[t].id()) + text(parameters);
        // An error of eps in log t is one of eps |γ log t| in t^−γ.
        F size = 1;
        for (const double v : parameters)
          if (v > 0) size *= std::max<F>(1, F(v > 1 ? v : -2 * std::log(v)));
        // ndf.student_t is a power, too, 1 + 1/tail, up to where it is an exponential.
        if (catalogue()[t].id() == "ndf.student_t")
          size *= 1 + 1 / std::max<F>(F(parameters[1]), F(0.25));
        if (catalogue()[t].id() == "masking.smith_charlie.correlated")
          size *= 4;  // e^L, L up to 20
        const F few = transcendental[t] ? 8 * eps<F> * size : F(0);
        // Lazányi's correction, of up to 10/4, may leave nothing: it is measured by itself too.
        const auto part = [=](std::size_t) {
          return catalogue()[t].id() == "fresnel.lazanyi" ? F(5) : F(0);
        };

        std::array<Column<F>, 2> out, out_den;
        for (auto* c : {&out[0], &out[1], &out_den[0], &out_den[1]}) *c = Column<F>(b.n);
        const auto run = [&](auto kernel) {
          (lane.*kernel)(b, p.data(),
                         {num.data(), den.data(), base.data(), out[0].data(), out_den[0].data()});
          (one.*kernel)(b, p.data(),
                        {num.data(), den.data(), base.data(), out[1].data(), out_den[1].data()});
          expect_same(out[0].data(), out[1].data(), b.n, few, part, where);
          expect_same(out_den[0].data(), out_den[1].data(), b.n, few, none, where);
        };
        run(&TermKernels<F>::start_product);
        run(&TermKernels<F>::finish_product);
        run(&TermKernels<F>::add_product);

        const auto d = test::derivatives_of<F>(t, parameters, rows, kernels<F>(name));
        const auto e = test::derivatives_of<F>(t, parameters, rows);
        expect_same(d[0].data(), e[0].data(), rows.size(), few, part, where);
        for (std::size_t k = 1; k < d.size(); ++k) {
          // A derivative may vanish between larger parts: it is measured by f/parameter too.
          const auto scale = [&](std::size_t i) {
            return part(i) + std::abs(e[0][i] / (k <= p.size() && p[k - 1] > 0 ? p[k - 1] : 1));
          };
          expect_same(d[k].data(), e[k].data(), rows.size(), 4 * few, scale, where + " derivative");
        }
      }
}

}  // namespace
}  // namespace gonio
