#include "reports/diffuse/diffuse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/random.h"
#include "base/whole_loop.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/evaluate.h"
#include "geometry/half_difference.h"
#include "integrate/albedo/directional_albedo.h"
#include "reports/audit/audit.h"
#include "reports/diffuse/forms.h"
#include "timing/timing.h"

namespace gonio {
namespace {

using namespace diffusing;

constexpr Goal goal{1e-6, 400'000};

std::vector<double> steps(double from, double step) {
  std::vector<double> out;
  for (int i = 0; from + i * step < 1 + 1e-9; ++i) out.push_back(std::min(from + i * step, 1.0));
  return out;
}

/// Albedos of a form, of a coupled one as the lobe leaves it.
std::vector<DiffuseRow> albedos(const DiffuseForm& f, const DiffuseOptions& o) {
  std::vector<DiffuseRow> out(o.roughness.size() * o.mu.size());
  for_each_whole(o.roughness.size(), [&](std::size_t r) {
    const auto b = bound(f, o.roughness[r], {1}, false);
    const auto at = diffuse_albedo(b, o.mu, 0, goal);
    const double average = hemispherical_average(
                               [&](double mu, double phi, const Goal& each) {
                                 return diffuse_albedo(b, {&mu, 1}, phi, each)[0];
                               },
                               1, false, goal)
                               .value[0];
    for (std::size_t m = 0; m < o.mu.size(); ++m)
      out[r * o.mu.size() + m] = {f.id,           o.roughness[r], o.mu[m],
                                  at[m].value[0], at[m].error,    average};
  });
  return out;
}

/// Columns of a term's kernel, at directions even over the hemisphere.
Timed timed(std::size_t term) {
  constexpr std::size_t samples = 512;
  struct Field {
    AngleColumns<float> x{samples};
    Column<float> out{samples};
    std::array<float, max_parameters> parameters{};
  };
  const auto field = std::make_shared<Field>();
  for (std::size_t i = 0; i < samples; ++i) {
    Draws draw(1, i);
    const auto upper = [&] {
      return direction(std::acos(draw.uniform()), 2 * std::numbers::pi * draw.uniform());
    };
    const auto light = upper();
    field->x.set(i, angles({light, upper()}));
  }
  const auto& parameters = catalogue()[term].parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    field->parameters[k] = static_cast<float>(parameters[k].start);
  return {samples, [field, kernel = kernels<float>().terms[term].shade[1]] {
            ChannelColumns<float> columns;
            columns.parameters[0] = field->parameters.data();
            columns.out[0] = field->out.data();
            kernel(field->x.block(), columns);
          }};
}

void add_times(std::vector<DiffuseForm>& forms) {
  std::vector<Timed> all;
  for (const auto& f : forms) all.push_back(timed(find_term(f.id)));
  const auto times = time_all(all, {15, 1e-3, true});
  for (std::size_t i = 0; i < forms.size(); ++i) {
    forms[i].ns = times[i].ns;
    forms[i].spread_ns = times[i].spread_ns;
  }
}

/// Entries of the forms in the audit of the catalogue.
void add_laws(std::vector<DiffuseForm>& forms) {
  std::vector<std::string> ids;
  for (const auto& f : forms) ids.push_back(f.id);
  const auto entries = audit(ids);
  for (std::size_t i = 0; i < forms.size(); ++i) {
    forms[i].reciprocity = entries[i].reciprocity->value;
    forms[i].operations = entries[i].operations->total();
  }
}

/// Largest albedo of each with the lobe of its own roughness.
void add_lobes(std::vector<DiffuseForm>& forms, const DiffuseOptions& o) {
  for_each_whole(forms.size(), [&](std::size_t i) {
    for (const double r : o.roughness)
      for (const auto& a : directional_albedo(bound(forms[i], r, {1}, true), o.mu, 0, goal))
        forms[i].most_with_lobe = std::max(forms[i].most_with_lobe, a.value[0]);
  });
}

void add_extremes(DiffuseForm& f, const std::vector<DiffuseRow>& rows) {
  const auto& most = *std::ranges::max_element(rows, {}, &DiffuseRow::albedo);
  f.most_albedo = most.albedo;
  f.most_roughness = most.roughness;
  f.most_mu = most.mu;
  f.least_average = std::ranges::min(rows, {}, &DiffuseRow::average).average;
}

}  // namespace

DiffuseOptions diffuse_options(bool full) {
  const double step = full ? 0.05 : 0.1;
  DiffuseOptions o{full, steps(0, step), steps(step, step), full ? 96U : 48U};
  o.mu.insert(o.mu.begin(), {least_diffuse_cosine, 0.05});
  if (full) o.mu.erase(o.mu.begin() + 1);
  return o;
}

DiffuseRows diffuse_rows(const DiffuseOptions& o, const ReportProgress& done) {
  DiffuseRows r;
  r.forms = known_forms();
  if (!o.forms.empty())
    std::erase_if(r.forms, [&](const DiffuseForm& f) {
      return std::ranges::find(o.forms, f.id) == o.forms.end();
    });
  const auto each = part_of(done, "every diffuse form", 0, 0.4);
  for (std::size_t i = 0; i < r.forms.size(); ++i) {
    const auto rows = albedos(r.forms[i], o);
    add_extremes(r.forms[i], rows);
    r.rows.insert(r.rows.end(), rows.begin(), rows.end());
    each(static_cast<double>(i + 1) / static_cast<double>(r.forms.size()));
  }
  add_lobes(r.forms, o);
  add_laws(r.forms);
  r.colours = diffuse_colours(o, r.forms, part_of(done, "balls under lights", 0.5, 0.9));
  add_times(r.forms);
  return r;
}
DiffuseReport diffuse_report(const DiffuseOptions& o, const ReportProgress& done) {
  return report_of(o.full, diffuse_rows(o, done));
}

const DiffuseForm* find_form(const std::vector<DiffuseForm>& forms, std::string_view id) {
  const auto at = std::ranges::find(forms, id, &DiffuseForm::id);
  return at == forms.end() ? nullptr : &*at;
}

std::optional<double> largest_difference(const std::vector<DiffuseColour>& colours,
                                         std::string_view form,
                                         std::string_view surface,
                                         std::optional<double> roughness) {
  std::optional<double> most;
  for (const auto& c : colours)
    if (c.form == form && c.surface == surface && (!roughness || c.roughness == *roughness))
      most = std::max(most.value_or(0), c.delta_e);
  return most;
}

Facts facts(const DiffuseRows& r) {
  Facts f;
  for (const auto& form : r.forms)
    f.diffuse.push_back({form.id, form.most_albedo, form.with_interface, form.most_with_lobe,
                         largest_difference(r.colours, form.id, "matte"),
                         largest_difference(r.colours, form.id, "plastic")});
  return f;
}

}  // namespace gonio
