#include "reports/own/row_columns.h"

#include <array>

namespace gonio {

RowColumns::RowColumns(std::span<const auditing::Row> rows) : count_(rows.size()) {
  const auto columns = block_.resize(count_);
  for (std::size_t i = 0; i < count_; ++i) {
    const auto& r = rows[i];
    const std::array at{r.nol, r.nov, r.noh, r.voh, r.sin2_theta_h, r.xoh,
                        r.yoh, r.xol, r.yol, r.xov, r.yov};
    for (std::size_t k = 0; k < at.size(); ++k) columns[k][i] = at[k];
  }
}

auditing::Values RowColumns::values(std::size_t term, std::span<const double> parameters) {
  if (count_ == 0) return {};
  double* const out = block_.extra(0);
  term_values(term, parameters, block_.block(), out);
  return {out, out + count_};
}

}  // namespace gonio
