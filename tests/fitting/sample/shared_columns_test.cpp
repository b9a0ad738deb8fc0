// Columns of a table that several fits read, made once.
#include "fitting/sample/shared_columns.h"

#include <array>

#include "fitting/fit.h"
#include "fitting/support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr std::array<std::size_t, 1> levels{100};

TEST(SharedColumns, AreReadAgainOnlyForAnotherLook) {
  const test::Case c = test::small();
  const Table other = c.table;
  const Sampling s = c.sampling(Metric::log);
  SharedColumns columns;
  const auto first = columns.levels<double>(s, levels);
  EXPECT_EQ(columns.levels<double>(Sampling(s), levels), first);
  const std::vector<Sampling> others{c.sampling(Metric::l2_cosine),
                                     s.by(Metric::log, 0.1),
                                     s.without(std::vector<bool>(c.table.size())),
                                     {c.table, c.table.bins(), Metric::log, 0, true},
                                     {c.table, Bins::edge, Metric::log, 0, false},
                                     {c.table, c.table.bins(), Metric::log, 0, false, true},
                                     {c.table, c.table.bins(), Metric::log, 0, false, false, true},
                                     {other, other.bins(), Metric::log, 0, false}};
  for (const auto& o : others) {
    ASSERT_EQ(columns.levels<double>(s, levels), columns.levels<double>(s, levels));
    EXPECT_NE(columns.levels<double>(s, levels), columns.levels<double>(o, levels));
  }
  EXPECT_NE(columns.levels<double>(s, levels),
            columns.levels<double>(s, std::array<std::size_t, 1>{50}));
}

TEST(SharedColumns, LeaveAFitWhatItIsAlone) {
  const Table t = test::small().table;
  SharedColumns columns;
  for (const char* model : {"lambert", "lambert+ggx/smith_ggx.correlated/schlick",
                            "lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick",
                            "ggx/smith_ggx.correlated/schlick"}) {
    FitOptions o;
    o.model = model;
    EXPECT_EQ(fit(t, o, columns).model.values, fit(t, o).model.values) << model;
  }
}

}  // namespace
}  // namespace gonio
