#pragma once
/// \file
/// Audits of one entry, by its kind, and what the kinds share.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "brdf/in_number/number.h"
#include "brdf/model/model.h"
#include "brdf/model/presets.h"
#include "reports/audit/audit.h"

namespace gonio::auditing {

EntryAudit audit_term(std::size_t term);
EntryAudit audit_map(std::size_t map);
EntryAudit audit_model(const Preset&);
/// The table as renderers make it, of 1024 samples, against the integrals; and their sum at F0 = 1.
EntryAudit audit_split_sum();

/// Distance of a term to one that it stands for, over that one's parameters and the directions that
/// terms of this role are looked at in; no value where nothing can be compared.
/// \param number  that the term is computed in; the reference is in double, or in fifty digits where it
///                is the term itself, at every 16th direction then
std::optional<Distance> distance_between(std::size_t term,
                                         std::size_t reference,
                                         Number number = Number::double_);

void raise(std::optional<Worst>& w, double value, auto&& where) {
  if (!w || value > w->value) w = Worst{value, 0, where()};
}
void lower(std::optional<Worst>& w, double value, auto&& where) {
  if (!w || value < w->value) w = Worst{value, 0, where()};
}

/// One value of the entry.
void look(EntryAudit& e, double value, auto&& where) {
  e.not_finite += !std::isfinite(value);
  lower(e.lowest, value, where);
  raise(e.highest, value, where);
}
/// One value and the value with light and view exchanged.
void look_exchanged(EntryAudit& e, double value, double other, auto&& where) {
  if (const double larger = std::max(std::abs(value), std::abs(other)); larger > 0)
    raise(e.reciprocity, std::abs(value - other) / larger, where);
}

/// Collects differences.
class Differences {
 public:
  void add(double difference, auto&& where) {
    const double d = std::abs(difference);
    if (!std::isfinite(d)) return;  // counted as not finite elsewhere
    if (n_ == 0 || d > most_.value) most_ = {d, 0, where()};
    sum_ += d * d;
    ++n_;
  }
  /// No value if there were none.
  std::optional<Distance> distance(std::string_view reference, std::string_view measure) const {
    if (n_ == 0) return {};
    return Distance{reference, measure, most_, std::sqrt(sum_ / static_cast<double>(n_))};
  }

 private:
  Worst most_;
  double sum_ = 0;
  std::size_t n_ = 0;
};

/// Raises `most` to the largest albedo of this model.  \param unit  that it is divided by
void largest_albedo(std::optional<Worst>& most,
                    const BoundModel&,
                    const std::string& where,
                    double unit = 1);

/// Says which laws what was found breaks.
void judge(EntryAudit&);

}  // namespace gonio::auditing
