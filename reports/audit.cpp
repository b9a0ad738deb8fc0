#include "reports/audit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>

#include "base/error.h"
#include "brdf/evaluate.h"
#include "brdf/model.h"
#include "brdf/presets.h"
#include "brdf/registry.h"
#include "brdf/term_in.h"
#include "geometry/half_difference.h"
#include "integrate/directional_albedo.h"
#include "integrate/normalisation.h"
#include "integrate/split_sum.h"
#include "optics/refractive_index.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

constexpr double pi = std::numbers::pi;
using Row = FrameAngles<double>;
using Values = std::vector<double>;

// ---- Where the catalogue is looked at -----------------------------------------------------------

/// Values of a parameter, both ends of its range among them.
Values looked_at(const Parameter& p) {
  Values v{p.legal.low, p.legal.high};
  if (p.name.starts_with("alpha"))
    v.insert(v.end(), {0.01, 0.1, 0.25, 0.5, 0.75, 1});
  else if (p.name == "gamma")
    v.insert(v.end(), {1, 1.5, 2, 4});
  else if (p.name == "eta")
    v.insert(v.end(), {1.05, 1.33, 1.5, 2, 3});
  else
    v.insert(v.end(), {p.start, 0.5 * (p.legal.low + p.legal.high)});
  std::ranges::sort(v);
  const auto twice = std::ranges::unique(v);
  v.erase(twice.begin(), twice.end());
  std::erase_if(v, [&](double x) { return !p.legal.holds(x); });
  return v;
}

/// All combinations.
std::vector<Values> combinations(std::span<const Parameter> parameters) {
  std::vector<Values> all{{}};
  for (const auto& p : parameters) {
    std::vector<Values> more;
    for (const auto& row : all)
      for (const double v : looked_at(p)) {
        more.push_back(row);
        more.back().push_back(v);
      }
    all = std::move(more);
  }
  return all;
}

Values defaults(std::span<const Parameter> parameters) {
  Values v;
  for (const auto& p : parameters) v.push_back(p.start);
  return v;
}

std::string text(std::span<const Parameter> parameters, std::span<const double> values) {
  std::string s;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    s += fmt::format("{}{} {:.4g}", k ? ", " : "", parameters[k].name, values[k]);
  return s;
}
std::string joined(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? a + b : a + ", " + b;
}

Row row(double theta_i, double phi_i, double theta_o, double phi_o) {
  return frame_angles({direction(theta_i, phi_i), direction(theta_o, phi_o)});
}
Row exchanged(Row r) {
  std::swap(r.nol, r.nov);
  std::swap(r.xol, r.xov);
  std::swap(r.yol, r.yov);
  return r;
}
std::string text(const Row& r) {
  return fmt::format("NoL {:.3g}, NoV {:.3g}, NoH {:.4g}, VoH {:.3g}", r.nol, r.nov, r.noh, r.voh);
}

/// Direction pairs over the hemisphere, even in both cosines from 0.05 to 1, some with the surface
/// turned.
const std::vector<Row>& pairs() {
  static const std::vector<Row> rows = [] {
    std::vector<Row> r;
    for (int i = 0; i < 20; ++i)
      for (int o = 0; o < 20; ++o)
        for (const double phi : {0.0, 50.0, 130.0, 180.0})
          for (const double turned : {0.0, 35.0}) {
            const auto theta = [](int k) { return std::acos(0.05 + 0.05 * k); };
            r.push_back(row(theta(i), turned * degree, theta(o), (turned + phi) * degree));
          }
    return r;
  }();
  return rows;
}
/// Half vectors from the peak to the horizon, along the tangent, the bitangent and between.
const std::vector<Row>& half_vectors() {
  static const std::vector<Row> rows = [] {
    std::vector<Row> r;
    for (int i = 0; i <= 200; ++i)
      for (const double phi : {0.0, 45.0, 90.0}) {
        const double t = i / 200.0, theta = 90 * degree * t * t * t;
        r.push_back(row(theta, phi * degree, theta, phi * degree));
        if (i == 200)
          r.back().nol = r.back().nov = r.back().noh = 0;  // not what cos(π/2) rounds to
      }
    return r;
  }();
  return rows;
}
const std::vector<Row>& cosines() {
  static const std::vector<Row> rows = [] {
    std::vector<Row> r;
    for (int i = 0; i <= 200; ++i) {
      const double theta = 90 * degree * i / 200.0, c = i == 200 ? 0 : std::cos(theta);
      r.push_back({{c, c, 1, c, 0}, 0, 0, std::sin(theta), 0, -std::sin(theta), 0});
    }
    return r;
  }();
  return rows;
}
/// Normal, middle and grazing directions with half vectors from the peak to the horizon; but for both
/// directions at the horizon, which is outside the domain.
const std::vector<Row>& ends() {
  static const std::vector<Row> rows = [] {
    std::vector<Row> r;
    for (const double nol : {0.0, 1e-8, 0.5, 1.0})
      for (const double nov : {0.0, 1e-8, 0.5, 1.0})
        for (const double voh : {0.0, 1e-8, 0.5, 1.0})
          for (const auto& [noh, sin2] :
               {std::pair{1.0, 0.0}, {1.0, 1e-16}, {0.6, 0.64}, {1e-8, 1.0}, {0.0, 1.0}}) {
            const double h = std::sqrt(sin2);
            if (nol + nov > 0)
              r.push_back({{nol, nov, noh, voh, sin2},
                           h,
                           0,
                           std::sqrt((1 - nol) * (1 + nol)),
                           0,
                           std::sqrt((1 - nov) * (1 + nov)),
                           0});
          }
    return r;
  }();
  return rows;
}

// ---- What every kind shares ---------------------------------------------------------------------

void raise(std::optional<Worst>& w, double value, auto&& where) {
  if (!w || value > w->value) w = Worst{value, 0, where()};
}
void lower(std::optional<Worst>& w, double value, auto&& where) {
  if (!w || value < w->value) w = Worst{value, 0, where()};
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
  std::optional<Distance> distance(std::string_view reference, std::string_view measure) const {
    if (n_ == 0) return {};
    return Distance{reference, measure, most_, std::sqrt(sum_ / static_cast<double>(n_))};
  }

 private:
  Worst most_;
  double sum_ = 0;
  std::size_t n_ = 0;
};

/// Raises `most` to the largest albedo of this model.
void largest_albedo(std::optional<Worst>& most, const BoundModel& b, const std::string& where) {
  static constexpr std::array mu{0.02, 0.1, 0.3, 0.6, 1.0};
  const auto albedo = directional_albedo(b, mu, 0, {.error = 1e-6});
  for (std::size_t i = 0; i < mu.size(); ++i) {
    if (most && !(albedo[i].value[0] > most->value)) continue;
    most = Worst{albedo[i].value[0], albedo[i].error, joined(where, fmt::format("NoV {}", mu[i]))};
  }
}

/// Rounding and clamps that change nothing stay below it.
constexpr double noticeable = 1e-6;

void judge(EntryAudit& e) {
  if (!e.about->named_for.empty() && e.distance) e.mistake = e.distance->most.value > noticeable;
  const auto violates = [&](std::string_view law, bool does) {
    if (does) e.violates.push_back(law);
  };
  violates("normalisation", e.normalisation && !(std::isfinite(e.normalisation->value) &&
                                                 std::abs(e.normalisation->value - 1) <=
                                                     noticeable + e.normalisation->error));
  violates("reciprocity", e.reciprocity && e.reciprocity->value > 1e-9);
  const auto makes_light = [](const std::optional<Worst>& w) {
    return w && w->value - w->error > 1 + noticeable;
  };
  violates("energy",
           (!e.energy_is_shared && makes_light(e.energy)) || makes_light(e.energy_under_lobe));
  violates("range", (e.lowest && e.lowest->value < 0) ||
                        (e.highest && e.kind != "ndf" && e.kind != "diffuse" && e.kind != "map" &&
                         e.kind != "model" && e.highest->value > 1 + 1e-12));
  violates("finite", e.not_finite > 0);
}

// ---- Terms
// ----------------------------------------------------------------------------------------

class TermAudit {
 public:
  explicit TermAudit(std::size_t term)
      : term_(term),
        about_(*catalogue()[term].about),
        parameters_(catalogue()[term].parameters),
        role_(role_of(about_.id)) {}

  EntryAudit operator()() const {
    static constexpr std::string_view kinds[] = {"ndf", "masking", "fresnel", "diffuse"};
    EntryAudit e;
    e.about = &about_;
    e.kind = kinds[static_cast<std::size_t>(role_)];
    e.operations = operations_of(term_).sample;
    ranges(e);
    grazing(e);
    if (role_ == Role::ndf) normalisation_of(e);
    if (role_ != Role::fresnel) energy(e);
    if (!about_.reference().empty()) distance(e);
    picture(e);
    judge(e);
    return e;
  }

 private:
  /// Of a masking term G2, of others the value.
  static Values values(std::size_t term, const Values& p, std::span<const Row> rows) {
    Values v(rows.size());
    const auto& in = catalogue_in(Number::double_).terms[term];
    (in.g2 ? in.g2 : in.values)(p, rows, v.data());
    return v;
  }
  const std::vector<Row>& rows() const {
    return role_ == Role::ndf ? half_vectors() : role_ == Role::fresnel ? cosines() : pairs();
  }

  void ranges(EntryAudit& e) const {
    for (const auto& p : combinations(parameters_)) {
      const auto where = [&](const Row& r) {
        return [&] { return joined(text(parameters_, p), text(r)); };
      };
      for (const double v : values(term_, p, ends())) e.not_finite += !std::isfinite(v);
      const auto v = values(term_, p, rows());
      for (std::size_t i = 0; i < v.size(); ++i) {
        e.not_finite += !std::isfinite(v[i]);
        lower(e.lowest, v[i], where(rows()[i]));
        raise(e.highest, v[i], where(rows()[i]));
      }
      if (role_ != Role::masking && role_ != Role::diffuse) continue;
      std::vector<Row> other;
      for (const auto& r : rows()) other.push_back(exchanged(r));
      const auto w = values(term_, p, other);
      for (std::size_t i = 0; i < v.size(); ++i)
        if (const double larger = std::max(std::abs(v[i]), std::abs(w[i])); larger > 0)
          raise(e.reciprocity, std::abs(v[i] - w[i]) / larger, where(rows()[i]));
    }
  }

  void grazing(EntryAudit& e) const {
    const Row r = role_ == Role::ndf ? row(90 * degree, 0, 90 * degree, 0)
                                     : row(60 * degree, 0, 89.9999 * degree, 180 * degree);
    Row at = role_ == Role::fresnel ? cosines().back() : r;
    if (role_ == Role::ndf) at.noh = 0, at.sin2_theta_h = 1;
    e.grazing = Worst{values(term_, defaults(parameters_), {&at, 1})[0], 0,
                      text(parameters_, defaults(parameters_))};
  }

  void normalisation_of(EntryAudit& e) const {
    for (const auto& p : combinations(parameters_)) {
      const auto one = normalisation(term_, p);
      const double off = std::abs(one.value - 1);
      if (!e.normalisation || !(off <= std::abs(e.normalisation->value - 1)))
        e.normalisation = Worst{one.value, one.error, text(parameters_, p)};
      if (!std::isfinite(one.value)) break;
    }
  }

  /// The lobe that this term is looked at in: with the masking of its own distribution, or the
  /// distribution of its own masking.
  std::string lobe() const {
    const std::string own(short_id(about_.id));
    const bool beckmann = own.find("beckmann") != own.npos || own.find("blinn") != own.npos;
    const std::string kind = catalogue()[term_].anisotropic ? "_aniso" : "",
                      shape = own.starts_with("gtr") || own.starts_with("smith_gtr") ? "gtr"
                              : beckmann                                             ? "beckmann"
                                                                                     : "ggx";
    return role_ == Role::ndf ? own + "/smith_" + shape + kind + ".correlated"
                              : shape + kind + "/" + own;
  }

  void energy(EntryAudit& e) const {
    if (role_ != Role::diffuse) {
      e.energy_of = lobe() + "/constant";
      e.energy_is_shared = about_.id == "ndf.blinn_phong" || about_.id == "ndf.shape_invariant";
      albedo_in(e.energy_of, 1, e.energy);
      return;
    }
    const std::string own(short_id(about_.id)), under = own + "+ggx/smith_ggx.correlated/schlick";
    if (!catalogue()[term_].coupled) {
      e.energy_of = own;
      albedo_in(own, 1, e.energy);
    }
    albedo_in(under, 0.04, e.energy_under_lobe);
  }
  /// White, at all values of the parameters of this term and of the width of the lobe.
  void albedo_in(const std::string& spec, double f0, std::optional<Worst>& most) const {
    const Model m = compose(spec, 1);
    BoundModel b{m, Values(m.value_count), {}};
    std::vector<Parameter> varied;
    for (const auto& p : m.parameters) {
      b.values[p.first] = p.name == "kd" ? 1 : p.name == "f0" ? f0 : p.about->start;
      const bool own =
          std::ranges::find(parameters_, p.name, &Parameter::name) != parameters_.end();
      if ((own && p.name != "kd") || p.name == "alpha") varied.push_back(*p.about);
    }
    for (const auto& values : combinations(varied)) {
      for (std::size_t k = 0; k < varied.size(); ++k)
        b.values[m.find(varied[k].name)->first] = values[k];
      largest_albedo(most, b, text(varied, values));
    }
  }

  /// The parameters with which this term stands for the reference with those.
  Values standing_for(std::size_t reference, const Values& q) const {
    const auto& of = catalogue()[reference].parameters;
    const auto at = [&](double c) {
      return values(reference, q, std::array{Row{{c, c, 1, c, 0}, 0, 0, 0, 0, 0, 0}})[0];
    };
    Values p;
    for (const auto& own : parameters_) {
      const auto same = std::ranges::find(of, own.name, &Parameter::name);
      if (same != of.end())
        p.push_back(q[static_cast<std::size_t>(same - of.begin())]);
      else if (own.name.starts_with("f0"))
        p.push_back(at(1));
      else if (own.name == "f82_tint")  // relative to Schlick's value there
        p.push_back(std::clamp(at(1.0 / 7) / (at(1) + (1 - at(1)) * std::pow(6.0 / 7, 5)),
                               own.legal.low, 1.0));
      else if ((own.name == "alpha_x" || own.name == "alpha_y") && !of.empty() &&
               of[0].name == "alpha")
        p.push_back(q[0]);
      else
        p.push_back(own.start);
    }
    return p;
  }

  std::vector<Values> reference_parameters(std::size_t reference) const {
    const auto& about = catalogue()[reference];
    if (about.about->id == "fresnel.dielectric")  // from outside: what shipped forms are made for
      return {{1.05}, {1.2}, {1.33}, {1.5}, {1.8}, {2}, {2.5}, {3}};
    if (about.about->id != "fresnel.conductor") return combinations(about.parameters);
    std::vector<Values> all;
    for (const auto& metal : metals())
      for (const auto& index : metal.rgb()) all.push_back({index.n, index.k});
    return all;
  }

  void distance(EntryAudit& e) const {
    const std::size_t reference = find_term(about_.reference());
    Differences all;
    for (const auto& q : reference_parameters(reference)) {
      const auto p = standing_for(reference, q);
      bool legal = true;
      for (std::size_t k = 0; k < p.size(); ++k) legal = legal && parameters_[k].legal.holds(p[k]);
      if (!legal) continue;
      const auto v = values(term_, p, rows()), w = values(reference, q, rows());
      const double peak = role_ == Role::ndf ? *std::ranges::max_element(w) : 1;
      for (std::size_t i = 0; i < v.size(); ++i)
        all.add((v[i] - w[i]) / peak, [&] {
          return joined(text(catalogue()[reference].parameters, q), text(rows()[i]));
        });
    }
    static constexpr std::string_view measures[] = {"D over the reference's peak", "G2", "F", "f"};
    e.distance =
        all.distance(catalogue()[reference].about->id, measures[static_cast<std::size_t>(role_)]);
  }

  /// Defaults, but a surface rough enough for masking to be seen.
  Values shown(std::span<const Parameter> parameters) const {
    Values v = defaults(parameters);
    for (std::size_t k = 0; k < v.size(); ++k)
      if (role_ == Role::masking && parameters[k].name.starts_with("alpha")) v[k] = 0.75;
    return v;
  }

  void picture(EntryAudit& e) const {
    std::vector<Row> line;
    auto& pic = e.picture;
    for (int i = 0; i <= 90; ++i) {
      const double theta = std::min(i, 89) * degree + (i == 90 ? 0.999 * degree : 0);
      pic.at.push_back(i);
      line.push_back(role_ == Role::ndf       ? row(theta, 0, theta, 0)
                     : role_ == Role::fresnel ? cosines()[static_cast<std::size_t>(i * 200 / 90)]
                                              : row(theta, 0, 60 * degree, 180 * degree));
    }
    static constexpr std::string_view x[] = {"theta_h", "theta_i", "theta_d", "theta_i"};
    static constexpr std::string_view y[] = {"D [1/sr]", "G2 at theta_o = 60 deg", "F",
                                             "f at theta_o = 60 deg [1/sr]"};
    pic.x = x[static_cast<std::size_t>(role_)];
    pic.y = y[static_cast<std::size_t>(role_)];
    const std::string_view id = about_.reference();
    if (id.empty()) {
      pic.value = values(term_, shown(parameters_), line);
      return;
    }
    const std::size_t reference = find_term(id);
    const auto q = reference_parameters(reference).size() && id == "fresnel.conductor"
                       ? reference_parameters(reference)[0]
                       : shown(catalogue()[reference].parameters);
    pic.value = values(term_, standing_for(reference, q), line);
    pic.reference = values(reference, q, line);
  }

  std::size_t term_;
  const About& about_;
  std::span<const Parameter> parameters_;
  Role role_;
};

// ---- Maps
// -----------------------------------------------------------------------------------------

std::map<std::string, double> named(std::span<const Parameter> parameters, const Values& values) {
  std::map<std::string, double> m;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    m[std::string(parameters[k].name)] = values[k];
  return m;
}

EntryAudit audit_map(std::size_t map) {
  const auto& m = maps()[map];
  EntryAudit e;
  e.about = m.about;
  e.kind = "map";
  const auto value = [](std::size_t which, const MapEntry& entry, const Values& p) {
    return evaluate_map(which, Number::double_, named(entry.parameters, p), {}).values[0];
  };
  Differences all;
  const auto reference = find_map(m.about->reference());
  for (const auto& p : combinations(m.parameters)) {
    const auto out = value(map, m, p);
    for (std::size_t k = 0; k < out.size(); ++k) {
      const auto where = [&] { return joined(std::string(m.outputs[k]), text(m.parameters, p)); };
      e.not_finite += !std::isfinite(out[k]);
      lower(e.lowest, out[k], where);
      raise(e.highest, out[k], where);
      if (reference) all.add(out[k] - value(*reference, maps()[*reference], p)[k], where);
    }
  }
  if (reference) e.distance = all.distance(maps()[*reference].about->id, m.outputs[0]);
  const auto& first = m.parameters[0];
  e.picture.x = first.name;
  e.picture.y = m.outputs[0];
  const double high = std::min(first.legal.high, 4.0);
  for (int i = 0; i <= 90; ++i) {
    Values p = defaults(m.parameters);
    p[0] = first.legal.low + (high - first.legal.low) * i / 90;
    e.picture.at.push_back(p[0]);
    e.picture.value.push_back(value(map, m, p)[0]);
    if (reference) e.picture.reference.push_back(value(*reference, maps()[*reference], p)[0]);
  }
  judge(e);
  return e;
}

// ---- Whole models
// ---------------------------------------------------------------------------------

BoundModel bound(const Preset& preset, const Values& values) {
  std::vector<Setting> s;
  for (std::size_t k = 0; k < values.size(); ++k)
    s.push_back({std::string(preset.parameters[k].name), {values[k]}});
  return bind_model(preset.about.id, s, 1);
}

EntryAudit audit_model(const Preset& preset) {
  EntryAudit e;
  e.about = &preset.about;
  e.kind = "model";
  e.energy_of = preset.spec;
  const auto& own = preset.parameters;
  const auto is_color = [](const Parameter& p) { return p.per_channel; };
  const auto above = [](const Row& r) { return r.nol > 0 && r.nov > 0; };
  std::vector<Row> rows, other;
  for (const auto& r : pairs())
    if (above(r)) rows.push_back(r), other.push_back(exchanged(r));
  const Preset* reference = find_preset(preset.about.reference());
  Differences all;

  // White, at every corner of the other parameters, and at several roughnesses.
  std::vector<Values> settings{{}};
  for (const auto& p : own) {
    const Values at = is_color(p)             ? Values{1}
                      : p.name == "roughness" ? Values{0.1, 0.3, 0.5, 0.8, 1}
                      : p.legal.low == p.start || p.legal.high == p.start
                          ? Values{p.legal.low, p.legal.high}
                          : Values{p.legal.low, p.start, p.legal.high};
    std::vector<Values> more;
    for (const auto& s : settings)
      for (const double v : at) {
        more.push_back(s);
        more.back().push_back(v);
      }
    settings = std::move(more);
  }
  for (const auto& s : settings) {
    const auto b = bound(preset, s);
    const auto v = evaluate(b, rows)[0], w = evaluate(b, other)[0];
    const auto where = [&](std::size_t i) {
      return [&, i] { return joined(text(own, s), text(rows[i])); };
    };
    for (std::size_t i = 0; i < v.size(); ++i) {
      e.not_finite += !std::isfinite(v[i]);
      lower(e.lowest, v[i], where(i));
      raise(e.highest, v[i], where(i));
      if (const double larger = std::max(std::abs(v[i]), std::abs(w[i])); larger > 0)
        raise(e.reciprocity, std::abs(v[i] - w[i]) / larger, where(i));
    }
    largest_albedo(e.energy, b, text(own, s));
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
      const auto v = evaluate(bound(preset, s), rows)[0], w = evaluate(as_reference(s), rows)[0];
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
  pic.value = evaluate(bound(preset, s), line)[0];
  if (reference) pic.reference = evaluate(as_reference(s), line)[0];
  judge(e);
  return e;
}

/// The table as renderers make it, of 1024 samples, against the integrals; and their sum at F0 = 1.
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

EntryAudit audit_entry(std::string_view id) {
  if (id == split_sum_about.id) return audit_split_sum();
  if (const auto map = find_map(id)) return audit_map(*map);
  if (const auto* preset = find_preset(id)) return audit_model(*preset);
  return TermAudit(find_term(id))();
}

}  // namespace

std::vector<std::string_view> auditable_ids() {
  std::vector<std::string_view> ids;
  for (const auto& t : catalogue()) ids.push_back(t.about->id);
  for (const auto& m : maps()) ids.push_back(m.about->id);
  for (const auto& p : presets()) ids.push_back(p.about.id);
  ids.push_back(split_sum_about.id);
  return ids;
}

std::vector<EntryAudit> audit(const std::vector<std::string>& ids,
                              const std::function<void(std::size_t)>& done) {
  for (const auto& id : ids)  // an unknown one is refused before any work
    if (!find_map(id) && !find_preset(id) && id != split_sum_about.id) find_term(id);
  std::vector<EntryAudit> entries(ids.size());
  std::mutex mutex;
  std::size_t count = 0;
  tbb::parallel_for(std::size_t{0}, ids.size(), [&](std::size_t i) {
    entries[i] = audit_entry(ids[i]);
    const std::lock_guard lock(mutex);
    if (done) done(++count);
  });
  return entries;
}

}  // namespace gonio
