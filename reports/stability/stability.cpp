#include "reports/stability/stability.h"

#include <algorithm>
#include <cmath>

#include "brdf/catalogue/registry.h"
#include "brdf/in_number/number.h"
#include "reports/stability/measure.h"
#include "stability/answer.h"
#include "stability/evaluate.h"
#include "stability/exhaustive.h"
#include "stability/prove.h"
#include "stability/prove_relative.h"
#include "stability/search.h"

#include <fmt/format.h>

namespace gonio {

using Depth = StabilityOptions::Setting;

std::vector<std::string> stabilities::forms(const StabilityOptions& o) {
  if (!o.ids.empty()) return o.ids;
  if (o.setting == Depth::brief)
    return {"ndf.ggx",
            "ndf.ggx.ue_mobile",
            "ndf.ggx.mobile",
            "ndf.ggx.mobile.cross",
            "ndf.gtr",
            "ndf.gtr1",
            "ndf.beckmann",
            "ndf.blinn_phong",
            "masking.smith_ggx.separable",
            "masking.smith_ggx.correlated",
            "masking.schlick_ggx.direct",
            "masking.ue_joint",
            "masking.ue_joint.clamped",
            "fresnel.schlick",
            "fresnel.f82",
            "fresnel.dielectric",
            "fresnel.conductor"};
  std::vector<std::string> all;
  for (const auto& entry : catalogue()) all.emplace_back(entry.id());
  return all;
}

namespace {

using namespace stability;

constexpr std::uint64_t seed = 1;

/// Arithmetics in which a subject is looked at; the liberties of half where every half is looked at, or with all the time.
std::vector<Arithmetic> arithmetics(const Subject& s, Depth setting) {
  std::vector<Arithmetic> all{{Number::half}, {Number::mixed}, {Number::float_}};
  if (setting == Depth::full || can_be_exhausted(s)) {
    all.push_back({Number::half, true, false});
    if (setting != Depth::brief) all.push_back({Number::half, false, true});
  }
  if (setting != Depth::brief) all.push_back({Number::double_});
  return all;
}
/// Least value of the parameter that decides from which on every input is proved to have a value.  Forms of many operations
/// get fewer boxes: the time is that of operations.
std::optional<double> finite_from(const Subject& s, const Arithmetic& a, Depth setting) {
  if (a.number == Number::mixed) return {};
  const std::size_t most = setting == Depth::brief ? 300 : 2000,
                    operations = std::max<std::size_t>(1, operations_of(*s.term).sample.total());
  return proved_from(s, a.number, rounding_of(a), finite_values(a.number),
                     {.boxes = std::max<std::size_t>(100, std::min(most, 40 * most / operations))});
}

/// Bound of the relative error in float, and with all the time also in half.
std::optional<double> proved_rel(const Subject& s, const Arithmetic& a, Depth setting) {
  const bool full = setting == Depth::full;
  if (setting == Depth::brief || a.flush || a.contract) return {};
  if (a.number != Number::float_ && !(full && a.number == Number::half)) return {};
  return prove_relative(s, a.number, rounding_of(a), full ? 10 : 2).bound;
}

StabilityRow row_of(const Subject& s, const Arithmetic& a, Depth setting) {
  const auto& entry = catalogue()[*s.term];
  const bool few_bits = a.number == Number::half || a.number == Number::mixed,
             is_absolute = few_bits && entry.role() == Role::fresnel;
  const Tolerance tolerance =
      is_absolute ? Tolerance(0, usual_absolute) : usual_tolerance(a.number);
  const Looked l = look(s, a, tolerance, seed);
  StabilityRow r{s.id,
                 std::string(s.form()),
                 stability::text_of(a),
                 l.evidence,
                 l.ulp.value,
                 l.beyond.value,
                 l.relative.value,
                 proved_rel(s, a, setting),
                 l.condition,
                 stability::text_of(s, l.relative.at),
                 hex_of(s, a.number, l.relative.at),
                 stabilities::text_of(l.flags),
                 l.no_value.count,
                 stability::text_of(s, l.no_value.count ? l.no_value.first : std::vector<double>{}),
                 l.negative.count,
                 l.overflow.count,
                 l.vanished.count,
                 l.irreciprocal.count,
                 l.not_monotone.count,
                 s.decides ? s.inputs[*s.decides].name : "",
                 l.safe_from,
                 is_absolute ? tolerance.absolute : tolerance.relative,
                 is_absolute,
                 l.lost.count,
                 finite_from(s, a, setting),
                 l.evaluations,
                 l.settled,
                 entry.as_shipped ? std::string(entry.about->reference()) : "",
                 operations_of(*s.term).sample.total(),
                 0,
                 false,
                 {},
                 {}};
  r.misses = stabilities::misses_target(r, a.number);
  if (r.misses) r.reason = stabilities::reason_of(r, a.number);
  if (r.misses && few_bits && entry.role() == Role::ndf && r.decides == "alpha") {
    Subject usual = s;
    set_domain(usual, r.decides, {stabilities::usual_width, 1});
    r.worst_from_usual = look(usual, a, tolerance, seed).relative.value;
  }
  if (!r.stable.empty()) r.stable_operations = operations_of(find_term(r.stable)).sample.total();
  return r;
}

}  // namespace

StabilityRows stability_rows(const StabilityOptions& o, const ReportProgress& done) {
  StabilityRows r;
  struct Job {
    Subject subject;
    Arithmetic arithmetic;
  };
  std::vector<Job> jobs;
  for (const auto& id : stabilities::forms(o))
    for (const auto& s : subjects_of(id))
      for (const auto& a : arithmetics(s, o.setting)) jobs.push_back({s, a});
  for (const auto& job : jobs) {
    if (done)
      done("every form in every number",
           0.9 * static_cast<double>(r.rows.size()) / static_cast<double>(jobs.size()));
    r.rows.push_back(row_of(job.subject, job.arithmetic, o.setting));
  }
  const bool all = o.setting != Depth::brief;
  if (done) done("any GPU, and pictures", 0.9);
  r.any_gpu = any_gpu_rows(o);
  r.orders = order_rows(o);
  r.by_alpha = errors_by_alpha(all);
  r.maps = error_maps(all);
  r.clamps = clamp_rows();
  r.highlights = highlight_rows();
  return r;
}

StabilityReport stability_report(const StabilityOptions& o, const ReportProgress& done) {
  return report_of(o.setting == Depth::full, stability_rows(o, done));
}

}  // namespace gonio
