#include "fitting/fit.h"

#include <ostream>
#include <string>
#include <vector>

#include "data_synth/synth.h"
#include "shaken/seeds.h"

#include <fmt/format.h>

namespace gonio {
namespace {

struct Case {
  const char* model;
  std::vector<std::string> settings;

  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.model; }
};
const Case cases[] = {
    {"lambert", {"kd=0.2,0.1,0.05"}},
    {"lambert+ggx/smith_ggx.correlated/schlick", {"alpha=0.15", "f0=0.05", "kd=0.2,0.1,0.05"}},
    {"lambert.coupled+ggx/smith_ggx.separable/dielectric", {"alpha=0.4", "eta=1.5", "kd=0.3"}},
    {"lambert+gtr/smith_ggx.correlated/schlick", {"alpha=0.15", "gamma=1.5", "f0=0.05", "kd=0.2"}},
    {"ggx/smith_ggx.correlated/conductor", {"alpha=0.2", "eta=0.2,0.9,1.1", "k=3.9,2.4,2.2"}},
    {"lambert+beckmann/smith_beckmann.correlated/schlick", {"alpha=0.3", "f0=0.05", "kd=0.2"}},
};

/// Documents of the fit of a synthesized table, by seed.
std::vector<FitDocument> fits(const Case& c, Metric metric, double noise) {
  const Table t = synthesize(bind_model(c.model, parse_settings(c.settings), 3),
                             {.layout = Layout::random, .samples = 400, .noise = noise});
  FitOptions o;
  o.model = c.model;
  o.metric = metric;
  o.bin_sensitivity = false;
  return test::by_seed([&] { return fit(t, o).document; });
}

/// Fewest digits that fits share in a value and in its standard error, and the most that a value moved in such errors.
struct Kept {
  double value = 99, error = 99, in_errors = 0;

  explicit Kept(const std::vector<FitDocument>& all) {
    for (std::size_t p = 0; p < all[0].parameters.size(); ++p)
      for (std::size_t c = 0; c < all[0].parameters[p].value.size(); ++c) {
        const test::Spread v(all, [&](const FitDocument& d) { return d.parameters[p].value[c]; });
        const test::Spread e(all,
                             [&](const FitDocument& d) { return d.parameters[p].std_error[c]; });
        value = std::min(value, v.digits());
        error = std::min(error, e.digits());
        in_errors = std::max(in_errors, v.width / e.mean);
      }
  }
  void print(const Case& c, Metric metric) const {
    fmt::print("{:52}{:10}{:6.1f} digits, of its error {:.1f}; {:.1e} of the error\n", c.model,
               name_of(metric), value, error, in_errors);
  }
};

class ShakenFit : public testing::TestWithParam<Case> {};

TEST_P(ShakenFit, OfNoisyValuesMovesByATenThousandthOfItsErrorAtMost) {
  GONIO_NEEDS_SHAKEN();
  for (const auto metric : {Metric::log, Metric::l2_cosine}) {
    const auto all = fits(GetParam(), metric, 0.02);
    const Kept kept(all);
    kept.print(GetParam(), metric);
    EXPECT_LT(kept.in_errors, 1e-4);
    EXPECT_GT(kept.error, 5);
    for (const auto& d : all) {
      EXPECT_EQ(d.solver.termination, "converged");
      EXPECT_EQ(d.warnings, all[0].warnings);
      EXPECT_EQ(d.next, all[0].next);
    }
  }
}

/// Its standard errors are then below those of rounding, and no measure.
TEST_P(ShakenFit, OfExactValuesKeepsTenDigits) {
  GONIO_NEEDS_SHAKEN();
  const Kept kept(fits(GetParam(), Metric::log, 0));
  kept.print(GetParam(), Metric::log);
  EXPECT_GT(kept.value, 10);
}

INSTANTIATE_TEST_SUITE_P(Models, ShakenFit, testing::ValuesIn(cases), [](const auto& i) {
  std::string name = i.param.model;
  for (char& c : name)
    if (c == '/' || c == '+' || c == '.') c = '_';
  return name;
});

}  // namespace
}  // namespace gonio
