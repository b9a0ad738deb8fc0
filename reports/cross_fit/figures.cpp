// The cross fit report in pictures: truth × form, and shifts over roughness.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "reports/cross_fit/cases.h"
#include "reports/finding/names.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// A number that is shown of a case.
struct Quantity {
  std::string_view name, label, unit;
  std::string_view parameter;  ///< empty: the residual
  double scale;                ///< of the unit
};
constexpr std::array quantities{
    Quantity{"roughness", "fitted − true roughness", "", "roughness", 1},
    Quantity{"F0", "fitted/true F0 − 1", " [%]", "f0", 100},
    Quantity{"gamma", "fitted − true gamma", "", "gamma", 1},
    Quantity{"residual", "RMS of ln f − ln truth", "", "", 1}};

struct Seen {
  double value = no_value, error = 0;
};
/// The mean over channels that are determined.
Seen seen(const CrossCase& c, const Quantity& q) {
  if (q.parameter.empty()) return {c.log_rms, 0};
  double sum = 0, error = 0;
  int n = 0;
  for (const auto& v : c.values)
    if (v.parameter == q.parameter && c.is_determined(v)) {
      sum += v.shift();
      error += v.error / (q.parameter == "f0" ? v.truth : 1);
      ++n;
    }
  return n == 0 ? Seen{} : Seen{q.scale * sum / n, q.scale * error / n};
}

bool is_main(const CrossCase& c) {
  return c.metric == Metric::log && c.layout == cross_layouts[0].name;
}
/// Materials whose shifts are drawn over roughness; the rows have all.
constexpr std::array shown{"IOR 1.5", "gold", "aluminium"};

std::vector<std::string_view> truths_of(const CrossFitRows& r) {
  std::vector<std::string_view> out;
  for (const auto& c : r.cases)
    if (std::ranges::find(out, c.truth) == out.end()) out.push_back(c.truth);
  return out;
}

// ---- Truth × form -------------------------------------------------------------------------------

constexpr std::array kinds{"exact", "fresnel", "masking", "distribution", "combination", "model"};
struct Surfaces {
  std::string_view name;
  bool dielectric;
};
constexpr std::array groups{Surfaces{"dielectrics", true}, Surfaces{"metals", false}};

/// Forms by kind, in the order in which they were fitted.
std::vector<std::string> forms_of(const CrossFitRows& r, const Quantity& q) {
  std::vector<std::string> out;
  for (const std::string_view kind : kinds)
    for (const auto& c : r.cases)
      if (c.kind == kind && std::ranges::find(out, c.fitted) == out.end() &&
          (q.parameter != "gamma" || c.find("gamma")))
        out.push_back(c.fitted);
  return out;
}

/// Size below which there is nothing but rounding.
constexpr double nothing = 1e-7;

/// \param roughness  0: RMS over all of them
FigureMap matrix(const CrossFitRows& r, const Quantity& q, double roughness) {
  const bool all = roughness == 0;
  auto m = make_map("matrix", {{"quantity", std::string(q.name)},
                               {"roughness", all ? "all" : fmt::format("{:g}", roughness)}});
  m.title = fmt::format("Truth × form: {}", q.name);
  m.note = all ? "RMS over materials and roughnesses"
               : fmt::format("mean over materials at roughness {:g}", roughness);
  m.value = fmt::format("{}{}{}", all && !q.parameter.empty() ? "RMS of " : "", q.label, q.unit);
  m.diverging = !all && !q.parameter.empty();
  m.scale = FigureMap::Scale::root;
  m.x.label = "truth";
  m.y.label = "fitted form";
  auto forms = forms_of(r, q);
  std::ranges::reverse(forms);  // the first at the top
  for (const auto& f : forms) m.y.names.push_back(brief_name(f));
  for (const auto truth : truths_of(r))
    for (const auto& group : groups) {
      m.x.names.push_back(fmt::format("{}: {}", truth, group.name));
      for (const auto& form : forms) {
        double sum = 0, squares = 0;
        std::size_t n = 0, missing = 0;
        for (const auto& c : r.cases) {
          if (c.truth != truth || c.fitted != form || !is_main(c) ||
              c.is_dielectric() != group.dielectric || (!all && c.roughness != roughness))
            continue;
          const double v = seen(c, q).value;
          if (std::isfinite(v))
            sum += v, squares += v * v, ++n;
          else
            ++missing;
        }
        // of what ends at its bound for the most part a mean of the rest says nothing
        const double count = static_cast<double>(n);
        const double value = all ? std::sqrt(squares / count) : sum / count;
        m.values.push_back(n == 0 || missing > n       ? no_value
                           : std::abs(value) < nothing ? 0
                                                       : value);
      }
    }
  return m;
}

// ---- Over roughness -----------------------------------------------------------------------------

Figure shifts_figure(const CrossFitRows& r,
                     std::string_view truth,
                     std::string_view kind,
                     std::string_view material,
                     const Quantity& q) {
  auto f = make_figure("shifts", {{"truth", std::string(truth)},
                                  {"kind", std::string(kind)},
                                  {"material", std::string(material)},
                                  {"quantity", std::string(q.name)}});
  f.title = q.parameter.empty() ? "Residual" : fmt::format("Shift of {}", q.name);
  f.note = fmt::format("{}, {}", truth, material);
  f.x = over_roughness();
  f.y = {fmt::format("{}{}", q.label, q.unit)};
  std::size_t left_out = 0;
  FigureCurve noise{"noise of the random walks", {}, {}, FigureCurve::Kind::line, true};
  for (const auto& c : r.cases) {
    if (c.truth != truth || (c.kind != kind && c.kind != "exact") || c.material != material ||
        !is_main(c) || (q.parameter == "gamma" && !c.find("gamma")))
      continue;
    auto& curve = curve_named(f, short_form(c.fitted), FigureCurve::Kind::both);
    curve.label = name_of_form(c.fitted);
    curve.dashed = c.kind == "exact";
    const auto [value, error] = seen(c, q);
    curve.x.push_back(c.roughness);
    curve.y.push_back(value);
    curve.y_error.push_back(error);
    left_out += !std::isfinite(value);
    if (q.parameter.empty() && c.kind == "exact" && c.log_rms_truth > 0) {
      noise.x.push_back(c.roughness);
      noise.y.push_back(c.log_rms_truth);
    }
  }
  if (!noise.x.empty()) f.curves.push_back(std::move(noise));
  if (left_out > 0) f.note += fmt::format("; {} without an interval are left out", left_out);
  return f;
}

// ---- Metric and directions ----------------------------------------------------------------------

/// A form by each metric and over each layout.
Figure compared_figure(const CrossFitRows& r,
                       std::string_view form,
                       std::string_view material,
                       const Quantity& q) {
  auto f = make_figure("compared", {{"form", std::string(short_form(form))},
                                    {"material", std::string(material)},
                                    {"quantity", std::string(q.name)}});
  f.title = fmt::format("Shift of {}", q.name);
  f.note = fmt::format("{}, {}", name_of_form(form), material);
  f.x = over_roughness();
  f.y = {fmt::format("{}{}", q.label, q.unit)};
  const auto add = [&](std::string name, Metric metric, std::string_view layout) {
    FigureCurve curve{std::move(name), {}, {}, FigureCurve::Kind::both};
    for (const auto& c : r.cases) {
      if (c.truth != "GGX" || c.fitted != form || c.material != material || c.metric != metric ||
          c.layout != layout)
        continue;
      curve.x.push_back(c.roughness);
      curve.y.push_back(seen(c, q).value);
    }
    if (!curve.x.empty()) f.curves.push_back(std::move(curve));
  };
  for (const auto& layout : cross_layouts)
    for (const Metric metric : {Metric::log, Metric::l2_cosine})
      add(fmt::format("{}, {}", name_of(metric), layout.what), metric, layout.name);
  return f;
}

}  // namespace

Pictures pictures(const CrossFitRows& r) {
  Pictures out;
  std::vector<double> chosen{0};
  for (const double want : {0.2, 0.5, 0.8})
    if (std::ranges::find(r.roughness, want) != r.roughness.end()) chosen.push_back(want);
  for (const auto& q : quantities)
    for (const double roughness : chosen) out.maps.push_back(matrix(r, q, roughness));

  for (const auto truth : truths_of(r))
    for (const std::string_view kind : kinds)
      for (const std::string_view material : shown) {
        if (kind == "exact") continue;
        for (const auto& q : quantities) {
          auto f = shifts_figure(r, truth, kind, material, q);
          const auto is_form = [](const FigureCurve& c) { return !c.dashed; };
          if (std::ranges::any_of(f.curves, is_form)) out.figures.push_back(std::move(f));
        }
      }
  for (const auto& form : forms_of(r, quantities[0]))
    for (const std::string_view material : shown)
      for (const auto& q : quantities) {
        if (form == "exact" || q.parameter.empty() || q.parameter == "gamma") continue;
        auto f = compared_figure(r, form, material, q);
        if (f.curves.size() > 1) out.figures.push_back(std::move(f));
      }
  // First what the headline is of.
  const auto headline = picture_id(
      "shifts",
      {{"truth", "GGX"}, {"kind", "masking"}, {"material", "IOR 1.5"}, {"quantity", "F0"}});
  if (const auto at = std::ranges::find(out.figures, headline, &Figure::id);
      at != out.figures.end())
    std::rotate(out.figures.begin(), at, at + 1);
  return out;
}

}  // namespace gonio
