#include "brdf/model/model.h"

#include "brdf/model/evaluate.h"
#include "brdf/model/presets.h"
#include "geometry/half_difference.h"
#include "integrate/light/split_sum.h"
#include "reports/audit/entry.h"
#include "reports/measure/light_unit.h"
#include "reports/measure/samples.h"

#include <fmt/format.h>

namespace gonio::auditing {
namespace {

BoundModel bound(const Preset& preset, const Values& values) {
  std::vector<Setting> s;
  for (std::size_t k = 0; k < values.size(); ++k)
    s.push_back({std::string(preset.parameters[k].name), {values[k]}});
  return bind_model(preset.about.id, s, 1);
}

}  // namespace

EntryAudit audit_model(const Preset& preset) {
  EntryAudit e;
  e.about = &preset.about;
  e.kind = "model";
  e.energy_of = preset.spec;
  e.light_unit = light_unit(preset.about.id);
  const auto& own = preset.parameters;
  const auto is_color = [](const Parameter& p) { return p.per_channel; };
  const auto above = [](const Row& r) { return r.nol > 0 && r.nov > 0; };
  std::vector<Row> rows, other;
  const auto values_of = [](const Preset& p, const BoundModel& b, std::span<const Row> at) {
    auto v = evaluate(b, at)[0];
    for (double& x : v) x /= light_unit(p.about.id);
    return v;
  };
  for (const auto& r : pairs())
    if (above(r)) rows.push_back(r), other.push_back(exchanged(r));
  const Preset* reference = find_preset(preset.about.reference());
  Differences all;

  // White, at every corner of the other parameters, and at several roughnesses.
  const auto settings = combinations(own, [&](const Parameter& p) {
    return is_color(p)             ? Values{1}
           : p.name == "roughness" ? Values{0.1, 0.3, 0.5, 0.8, 1}
           : p.legal.low == p.start || p.legal.high == p.start
               ? Values{p.legal.low, p.legal.high}
               : Values{p.legal.low, p.start, p.legal.high};
  });
  for (const auto& s : settings) {
    const auto b = bound(preset, s);
    const auto v = values_of(preset, b, rows), w = values_of(preset, b, other);
    const auto where = [&](std::size_t i) {
      return [&, i] { return joined(text(own, s), text(rows[i])); };
    };
    for (std::size_t i = 0; i < v.size(); ++i) {
      look(e, v[i], where(i));
      look_exchanged(e, v[i], w[i], where(i));
    }
    largest_albedo(e.energy, b, text(own, s), e.light_unit);
  }

  // The same colours and roughness in the reference: a specular colour is that of a metal.
  const auto as_reference = [&](const Values& s) {
    Values q;
    for (const auto& p : reference->parameters) {
      const auto same = std::ranges::find(own, p.name, &Parameter::name);
      const auto color = std::ranges::find_if(own, is_color);
      q.push_back(same != own.end()      ? s[static_cast<std::size_t>(same - own.begin())]
                  : is_color(p)          ? s[static_cast<std::size_t>(color - own.begin())]
                  : p.name == "metallic" ? 1
                                         : p.start);
    }
    return bound(*reference, q);
  };
  if (reference) {
    for (const auto& s : settings) {
      const auto v = values_of(preset, bound(preset, s), rows),
                 w = values_of(*reference, as_reference(s), rows);
      for (std::size_t i = 0; i < v.size(); ++i)
        if (w[i] > 0) all.add(v[i] / w[i] - 1, [&] { return joined(text(own, s), text(rows[i])); });
    }
    e.distance = all.distance(reference->about.id, "f over the reference's f, less 1");
  }

  auto& pic = e.picture;
  pic.x = "theta_o";
  pic.y = "f at theta_i = 30 deg [1/sr]";
  std::vector<Row> line;
  for (int o = -89; o <= 89; ++o) {
    pic.at.push_back(o);
    line.push_back(row(30 * degree, 0, std::abs(o) * degree, o > 0 ? 180 * degree : 0));
  }
  const auto s = defaults(own);
  pic.value = values_of(preset, bound(preset, s), line);
  if (reference) pic.reference = values_of(*reference, as_reference(s), line);
  judge(e);
  return e;
}

EntryAudit audit_split_sum() {
  constexpr std::string_view masking = "smith_ggx.correlated";
  EntryAudit e;
  e.about = &split_sum_about;
  e.kind = "model";
  e.energy_of = "A + B of ggx/smith_ggx.correlated/schlick";
  Differences all;
  Values nov;
  for (int i = 1; i <= 30; ++i) nov.push_back(i / 30.0);
  for (const double r : {0.1, 0.2, 0.4, 0.6, 0.8, 1.0}) {
    const auto truth = split_sum(masking, r, nov), table = sampled_split_sum(masking, r, nov, 1024);
    for (std::size_t i = 0; i < nov.size(); ++i) {
      const auto where = [&] { return fmt::format("roughness {}, NoV {:.3g}", r, nov[i]); };
      all.add(table[i].a - truth[i].a, where);
      all.add(table[i].b - truth[i].b, where);
      const double sum = truth[i].a + truth[i].b;
      if (!e.energy || sum > e.energy->value) e.energy = Worst{sum, 2 * truth[i].error, where()};
      e.not_finite += !std::isfinite(sum);
      if (r == 0.6) {
        e.picture.at.push_back(nov[i]);
        e.picture.value.push_back(table[i].a);
        e.picture.reference.push_back(truth[i].a);
      }
    }
  }
  e.picture.x = "NoV";
  e.picture.y = "A at roughness 0.6";
  e.distance = all.distance("quadrature", "A and B of 1024 samples");
  judge(e);
  return e;
}

}  // namespace gonio::auditing
