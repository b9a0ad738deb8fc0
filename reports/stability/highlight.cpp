// A whole highlight in few bits: D V F of light and view, and then NoL.
#include <algorithm>
#include <cmath>

#include "geometry/direction.h"
#include "reports/stability/stability.h"
#include "stability/answer.h"
#include "stability/search.h"

namespace gonio {

std::vector<HighlightRow> highlight_rows() {
  using namespace stability;
  constexpr double zenith_deg = 88, metal_f0 = 0.5;
  Question q;
  q.subject = subjects_of("ggx/smith_ggx.correlated/schlick").front();
  const double least_cosine = std::cos(zenith_deg * degree);
  for (const char* cosine : {"nol", "nov"}) set_domain(q.subject, cosine, {least_cosine, 1});
  set_domain(q.subject, "f0", {metal_f0, 1});
  std::vector<HighlightRow> rows;
  for (const bool flush : {false, true}) {
    q.arithmetic = {Number::half, flush};
    const double tolerance = usual_tolerance(Number::half);
    // The product with NoL rounds once more.
    q.requirement = {Requirement::Kind::relative, tolerance - 0x1p-11};
    // A search misses worse inputs: what is claimed is a tenth more than what it finds.
    constexpr double missed = 1.1;
    HighlightRow row{
        q.subject.id, text_of(q.arithmetic), zenith_deg, metal_f0, missed * tolerance, {}, {}};
    const auto searched = answer(q).safe_from;
    q.requirement = {};
    row.finite_from = answer(q).looked.finite_from;
    if (searched && searched->value && row.finite_from)
      row.safe_from = std::max(*searched->value, *row.finite_from);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace gonio
