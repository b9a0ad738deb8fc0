#include "fitting/judge/next_steps.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "brdf/model/model.h"
#include "brdf/model/roughness.h"
#include "brdf/model/spec.h"
#include "fitting/judge/seen.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

constexpr std::size_t most = 5;

std::string with_diffuse(ModelSpec spec, std::string_view name) {
  spec.diffuse = name;
  return to_text(spec);
}
/// The model without a lobe; "" where nothing would be left.
std::string without_lobe(ModelSpec spec, std::size_t l) {
  spec.lobes.erase(spec.lobes.begin() + static_cast<std::ptrdiff_t>(l));
  if (spec.lobes.empty() && !spec.diffuse.empty()) spec.diffuse = "lambert";  // coupled to no lobe
  return to_text(spec);
}

/// Number of a lobe of which nothing is known though it was fitted.
std::optional<std::size_t> unknown_lobe(const FitDocument& d) {
  const Model m = compose(d.model, std::max<std::size_t>(d.channels.size(), 1));
  const auto in_all = [&](const Lobe& l, ParameterStatus status, ParameterStatus or_this) {
    for (const auto* t : {&l.ndf, &l.masking, &l.fresnel})
      for (const std::size_t k : t->parameters) {
        const auto p =
            std::ranges::find(d.parameters, m.parameters[k].name, &FittedParameter::name);
        if (p == d.parameters.end()) return false;
        for (const auto s : p->status)
          if (s != status && s != or_this) return false;
      }
    return true;
  };
  using enum ParameterStatus;
  for (std::size_t l = 0; l < m.lobes.size(); ++l)
    if (in_all(m.lobes[l], not_identifiable, fixed) && !in_all(m.lobes[l], fixed, fixed)) return l;
  return {};
}

/// Free parameters that are hardly known: their errors are half of their values or more.  What is known
/// to be next to nothing is known well: all of them are shares, widths or indices.
std::vector<std::string> hardly_known(const FitDocument& d) {
  std::vector<std::string> names;
  for (const auto& p : d.parameters) {
    if (p.name.starts_with("roughness")) continue;  // is alpha
    for (std::size_t c = 0; c < p.value.size(); ++c) {
      if (c < p.reason.size() && p.reason[c] == no_value_of_channel) continue;  // it is dark
      if (p.status[c] == ParameterStatus::not_identifiable ||
          (p.std_error[c] > std::abs(p.value[c]) / 2 && p.ci95_high[c] - p.ci95_low[c] > 0.1)) {
        names.push_back(p.name);
        break;
      }
    }
  }
  return names;
}

/// Names of the two parameters that the data tell apart least, where they hardly do; else "".
std::pair<std::string, std::string> hardly_told_apart(const FitDocument& d) {
  const auto bare = [](const std::string& name) { return name.substr(0, name.find('.')); };
  double strongest = 0.95;
  std::pair<std::string, std::string> pair;
  for (std::size_t i = 0; i < d.correlations.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (std::abs(d.correlations[i][k]) > strongest) {
        strongest = std::abs(d.correlations[i][k]);
        pair = {bare(d.free_names[k]), bare(d.free_names[i])};
      }
  return pair;
}

/// Steps as they are found, no model named twice.
class Steps {
 public:
  void add(std::string_view sentence) { all_.emplace_back(sentence); }
  bool empty() const { return all_.empty(); }
  void add_model(const std::string& spec, const std::string& why) {
    if (spec.empty() || std::ranges::find(models_, spec) != models_.end()) return;
    models_.push_back(spec);
    add("--model " + spec + " " + why);
  }
  std::vector<std::string> first() && {
    if (all_.size() > most) all_.resize(most);
    return std::move(all_);
  }

 private:
  std::vector<std::string> all_, models_;
};

/// Models that may follow what this one leaves over.
std::vector<std::string> others_of(const ModelSpec& spec) {
  const std::string& diffuse = spec.diffuse;
  std::vector<std::string> all;
  if (diffuse.empty()) all.push_back(with_diffuse(spec, "lambert"));
  if (diffuse == "lambert" || diffuse == "lambert.coupled")
    for (const std::string_view other : {"eon", "disney", "lambert.coupled"})
      if (diffuse != other && (!spec.lobes.empty() || other != "lambert.coupled"))
        all.push_back(with_diffuse(spec, other));
  if (spec.lobes.size() < 2) {
    ModelSpec more = spec;
    more.lobes.push_back(spec.lobes.empty() ? LobeSpec{"ggx", "smith_ggx.correlated", "schlick"}
                                            : spec.lobes.back());
    all.push_back(to_text(more));
  }
  if (spec.lobes.empty()) return all;
  const auto& [ndf, masking, fresnel] = spec.lobes[0];
  const auto add_lobe = [&](const std::string& d, const std::string& v, const std::string& f) {
    ModelSpec other = spec;
    other.lobes[0] = {d, v, f};
    all.push_back(to_text(other));
  };
  if (ndf != "gtr") add_lobe("gtr", masking, fresnel);
  const auto dot = std::min(masking.find('.'), masking.size());
  const std::string shape = masking.substr(0, dot), form = masking.substr(dot);
  if (shape == "smith_ggx") {
    add_lobe("gtr", "smith_gtr" + form, fresnel);
    add_lobe("charlie", "smith_charlie" + form, fresnel);
    if (ndf == "ggx") add_lobe("ggx_aniso", "smith_ggx_aniso" + form, fresnel);
  }
  if (ndf == "beckmann" && shape == "smith_beckmann") add_lobe("ggx", "smith_ggx" + form, fresnel);
  if (ndf == "ggx" && shape == "smith_ggx") add_lobe("beckmann", "smith_beckmann" + form, fresnel);
  if (fresnel == "schlick")
    for (const char* other : {"schlick.f90", "schlick.weighted"}) add_lobe(ndf, masking, other);
  if (fresnel == "dielectric" || fresnel == "conductor")
    add_lobe(ndf, masking, fresnel + ".weighted");
  else
    add_lobe(ndf, masking, diffuse.empty() ? "conductor" : "dielectric");
  if (shape.starts_with("smith_") && !form.empty())
    add_lobe(ndf, shape + (form == ".correlated" ? ".separable" : ".correlated"), fresnel);
  return all;
}

/// Tries them, and names those that take up most of a misfit, and so that it shows.  False where none does.
/// \param otherwise  gets what to say of them then, where nothing else helps
/// \param units     tried, too: one stands first where no model leaves less
/// \param less      the model without a lobe of which nothing is known; if that does as well as the best, no other is named
/// \param needless  whether the fit is that one's
bool add_models(Steps& steps,
                const ModelSpec& spec,
                const FitDocument& d,
                const TryModel& attempt,
                const TryUnits& units,
                const std::string& less,
                bool needless,
                std::string& otherwise) {
  constexpr double worth = 1 / 3.0;             // of the misfit's square
  constexpr double as_well = 1.02;              // log RMS, of the least
  constexpr double shows = 0.9, little = 0.95;  // log RMS, of what it is
  constexpr double near_best = 1.25;  // log RMS, of the least: what leaves more mends less
  constexpr std::size_t few = 3;
  const double here = attempt(needless ? less : d.model), misfit = d.misfit.size * d.misfit.size;
  auto others = others_of(spec);
  if (!less.empty()) {
    std::ranges::copy(others_of(parse_model(less)), std::back_inserter(others));
    others.push_back(less);
  }
  std::vector<double> left(others.size());
  tbb::parallel_for(std::size_t{0}, left.size(),
                    [&](std::size_t k) { left[k] = attempt(others[k]); });
  const auto least = [](double a, double b) { return a < b || (std::isnan(b) && !std::isnan(a)); };
  constexpr double much_less = 1.05;  // log RMS
  auto unit = units ? units(here) : std::nullopt;
  if (unit && *std::ranges::min_element(left, least) * much_less < unit->log_rms) unit.reset();
  if (unit) steps.add(unit->step);
  std::vector<std::pair<double, std::string>> found;
  for (std::size_t k = 0; k < left.size(); ++k)
    if (left[k] < shows * here && here * here - left[k] * left[k] > worth * misfit)
      found.emplace_back(left[k], others[k]);
  if (found.empty()) {
    if (unit) return true;
    const auto nearest = std::ranges::min_element(left, least);
    if (nearest == left.end() || std::isnan(*nearest)) return false;
    otherwise =
        *nearest < little * here
            ? fmt::format(
                  "--model {} misses, too, but less: by {} instead of {} on a part of the table",
                  others[static_cast<std::size_t>(nearest - left.begin())],
                  typical_factor(*nearest), typical_factor(here))
            : fmt::format("none of {} other models is clearly nearer; --models all compares more",
                          left.size());
    return false;
  }
  std::ranges::stable_sort(found, {}, [](const auto& f) { return f.first; });
  const double best = unit ? std::min(unit->log_rms, found[0].first) : found[0].first;
  std::erase_if(
      found, [most = std::max(near_best * best, 1e-6)](const auto& f) { return f.first > most; });
  const auto simplest = std::ranges::find(found, less, [](const auto& f) { return f.second; });
  if (simplest != found.end() && simplest->first <= as_well * found[0].first) found = {*simplest};
  for (std::size_t k = 0; k < std::min(few, found.size()); ++k)
    steps.add_model(
        found[k].second,
        fmt::format("is typically off by a factor of {} instead of {} on a part of the table",
                    typical_factor(found[k].first), typical_factor(here)));
  return true;
}

}  // namespace

std::vector<std::string> next_steps(const FitOptions& o,
                                    const FitDocument& d,
                                    const FitFacts& f,
                                    const TryModel& attempt,
                                    const TryUnits& units) {
  Steps steps;
  const ModelSpec spec = parse_model(d.model);

  if (d.solver.termination != "converged")
    for (const auto& p : d.parameters)
      if (is_alpha(p.name) && p.status[0] != ParameterStatus::fixed && p.value[0] > 0)
        steps.add(fmt::format("--bounds {}={:.2g},{:.2g} may let the solver end", p.name,
                              std::max(p.value[0] / 4, 1e-4), std::min(4 * p.value[0], 1.0)));
  if (f.outliers && !f.outliers->retro)
    steps.add("--robust huber gives outliers less weight" + f.without_outliers);
  if (f.outliers && f.outliers->retro && !f.retro)
    steps.add("--mask 'retro < 15': no microfacet model has a highlight at wo = wi");
  if (o.copies && f.copies)
    steps.add("fit without --copies keep: angles that only repeat another are no measurements");
  const auto unknown = unknown_lobe(d);
  const std::string less = unknown ? without_lobe(spec, *unknown) : "";
  std::string otherwise;
  if (d.misfit.told && (f.no_scale || f.no_f) && units)
    if (const auto unit = units(attempt(d.model))) steps.add(unit->step);
  const bool mended = d.misfit.told && !f.no_f &&
                      add_models(steps, spec, d, attempt, units, less, f.needless, otherwise);
  if (f.retro && !mended) {
    constexpr double of_it = 3,
                     widest = 45;  // half widths, beyond which a lobe has next to nothing
    const double wide = std::max(10.0, std::ceil(2 * of_it * f.retro->half_width_deg));
    if (wide <= widest)
      steps.add(fmt::format(
          "--mask 'retro < {:.0f}': no microfacet model has a highlight at wo = wi", wide));
  }
  if (f.cost_of_fewer < d.cost &&
      std::ranges::count(spec.lobes, spec.lobes[0]) == std::ssize(spec.lobes))
    steps.add_model(without_lobe(spec, 0), "meets the table better");
  else if (constexpr double as_well = 1.05;  // log RMS
           unknown && !mended && !f.no_f && !d.misfit.told &&
           !(attempt(less) > as_well * attempt(d.model)))
    steps.add_model(less, f.needless ? "does as well: nothing is known of the lobe"
                                     : "says all that is known: of the lobe nothing is");
  if (f.unresolved)
    steps.add(
        fmt::format("outgoing angles {:.1g}° apart or less around the mirror direction may resolve "
                    "the highlight",
                    2 * f.unresolved->half_width_deg / 3));
  if (returns_too_much(d.physics) && spec.diffuse == "lambert" && !spec.lobes.empty() && !f.no_f) {
    constexpr double as_well = 1.25;  // log RMS
    const auto coupled = with_diffuse(spec, "lambert.coupled");
    if (attempt(coupled) <= as_well * attempt(d.model))
      steps.add_model(coupled, "may return less light: its diffuse is what the lobe lets through");
  }

  for (const auto& s : d.sensitivity)
    if (s.log_rms < 0.95 * s.log_rms_here)
      steps.add(fmt::format("--bins {} meets the table better: log RMS {:.3g} for {:.3g}", s.other,
                            s.log_rms, s.log_rms_here));

  for (const auto& b : o.bounds) {
    const auto p = std::ranges::find(d.parameters, b.name, &FittedParameter::name);
    if (p != d.parameters.end() &&
        std::ranges::find(p->status, ParameterStatus::at_bound) != p->status.end())
      steps.add("wider --bounds " + b.name + " may hold a better fit: the data push beyond these");
  }
  const auto hardly = hardly_known(d);
  if (!hardly.empty() && !d.misfit.told && !f.retro && !unknown) {
    if (const auto [a, b] = hardly_told_apart(d); !a.empty() && a != b)
      steps.add(fmt::format(
          "hold {} or {} (--fix) if it is known from elsewhere: these data hardly tell them apart",
          a, b));
    else
      steps.add(
          fmt::format("hold {} (--fix) if it is known from elsewhere: these data hardly tell it",
                      hardly.front()));
  }
  const bool is_dark_noisy = f.dark_bias > 0 && !f.clipped;
  if ((is_dark_noisy || d.log_offset > 0) && !d.misfit.told)  // other weights mend no model
    steps.add(fmt::format("--metric l2_cosine gives dark values, {}, less weight",
                          is_dark_noisy ? "whose logarithms noise lowers"
                          : f.offset    ? "which the offset lowers"
                                        : "which the noise floor lifts"));
  if (f.few_angles)
    steps.add("8 incident angles or more would show errors common to all values of one angle");
  if (steps.empty() && !otherwise.empty()) steps.add(otherwise);
  return std::move(steps).first();
}

}  // namespace gonio
