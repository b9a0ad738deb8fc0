#include "brdf/model/model.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "brdf/catalogue/foreign_terms.h"
#include "brdf/catalogue/registry.h"
#include "brdf/formula/widths.h"
#include "brdf/model/presets.h"
#include "brdf/model/roughness.h"
#include "brdf/model/takes_parameter.h"
#include "optics/f0.h"
#include "optics/refractive_index.h"

#include <fmt/format.h>

namespace gonio {
namespace {

TermUse use(Model& m, std::size_t term, std::size_t lobe, std::span<const std::string> grey) {
  TermUse t{term, {}};
  m.anisotropic |= catalogue()[term].anisotropic;
  for (const auto& p : catalogue()[term].parameters) {
    const auto name = to_text({std::string(p.name), lobe});
    const auto known = std::ranges::find(m.parameters, name, &ModelParameter::name);
    if (known == m.parameters.end()) {
      const bool coloured = p.per_channel && std::ranges::find(grey, name) == grey.end();
      const std::size_t count = coloured ? m.channels : 1;
      t.parameters.push_back(m.parameters.size());
      m.parameters.push_back({name, &p, m.value_count, count});
      m.value_count += count;
    } else {
      t.parameters.push_back(static_cast<std::size_t>(known - m.parameters.begin()));
      const Range& legal = known->about->legal;
      if (legal.holds(p.legal.low) && legal.holds(p.legal.high))
        known->about = &p;  // legal in both
    }
  }
  return t;
}

const Setting* find(const std::vector<Setting>& s, std::string_view name) {
  const auto it = std::ranges::find(s, name, &Setting::name);
  return it == s.end() ? nullptr : &*it;
}
void forget(std::vector<Setting>& s, std::string_view name) {
  std::erase_if(s, [&](const Setting& x) { return x.name == name; });
}

/// base_color and metallic become f0 and kd under a coupled diffuse; returns the spec to use.
ModelSpec resolve_base_color(ModelSpec spec, std::vector<Setting>& settings) {
  const Setting* base = find(settings, "base_color");
  const Setting* metallic = find(settings, "metallic");
  if (!base && !metallic) return spec;
  const Model own = compose(spec, 1);
  if (own.find("base_color") || own.find("metallic")) return spec;  // its terms read them
  for (const char* other : {"f0", "kd", "eta", "k", "metal"})
    if (find(settings, other))
      throw wrong_usage(fmt::format("base_color and metallic set {} themselves", other));
  if (!base) throw wrong_usage("metallic needs base_color");
  if (metallic && metallic->values.size() != 1) throw wrong_usage("metallic is one number");
  const double m = metallic ? metallic->values[0] : 0;
  Setting f0{"f0", {}}, kd{"kd", {}};
  for (const double b : base->values) {
    if (!(0 <= b && b <= 1 && 0 <= m && m <= 1))
      throw wrong_usage("base_color and metallic lie in [0, 1]");
    const auto mapped = F0Metallic<double>::apply(std::array{b, m});
    f0.values.push_back(mapped[0]);
    kd.values.push_back(mapped[1]);
  }
  forget(settings, "base_color");
  forget(settings, "metallic");
  settings.insert(settings.end(), {f0, kd});
  if (spec.diffuse == "lambert" && !spec.lobes.empty()) spec.diffuse = "lambert.coupled";
  return spec;
}

/// Parameter that a name sets by another measure: alpha by roughness, eta of a dielectric by f0; empty: none.
std::string aliased(const Model& m, const std::string& name) {
  if (m.find(name)) return "";
  if (is_roughness(name) && m.find(alpha_name(name))) return alpha_name(name);
  const auto [stem, lobe] = parse_parameter(name);
  const auto eta = to_text({"eta", lobe});
  const bool dielectric = m.find(eta) && !m.find(to_text({"k", lobe}));
  return stem == "f0" && dielectric ? eta : "";
}

void divide_mixed_colours(const Model& m, std::vector<Setting>& settings) {
  std::vector<Setting> all;
  for (auto& s : settings) {
    if (!is_mixed_colour(m, s.name)) {
      all.push_back(std::move(s));
      continue;
    }
    if (s.values.size() != 1 && s.values.size() != 3)
      throw wrong_usage(fmt::format("{}: {} values where one or 3 fit", s.name, s.values.size()));
    for (std::size_t c = 0; c < 3; ++c) {
      Setting one = s;
      one.name = fmt::format("{}_{}", s.name, "rgb"[c]);
      one.values = {s.values[s.values.size() == 1 ? 0 : c]};
      if (find(settings, one.name))
        throw wrong_usage(fmt::format("{} and {} are the same parameter", s.name, one.name));
      all.push_back(std::move(one));
    }
  }
  settings = std::move(all);
}

/// Sets the colours that a file gives for defaults.
void start_colours(BoundModel& b) {
  const auto& m = b.model;
  std::vector<const TermUse*> uses;
  for (const auto& t : m.diffuse) uses.push_back(&t);
  for (const auto& l : m.lobes) uses.insert(uses.end(), {&l.ndf, &l.masking, &l.fresnel});
  for (const auto* t : uses) {
    const auto* f = foreign_term(t->term);
    for (std::size_t k = 0; f && k < f->function->parameters.size(); ++k)
      if (const auto& p = m.parameters[t->parameters[k]];
          p.count == 3 && f->function->parameters[k].colour)
        std::ranges::copy(*f->function->parameters[k].colour,
                          b.values.begin() + static_cast<std::ptrdiff_t>(p.first));
  }
}

/// Names that stand for others: roughness, f0 of a dielectric, metal.
void resolve_aliases(const Model& m, std::vector<Setting>& settings) {
  divide_mixed_colours(m, settings);
  for (auto& s : settings) {
    const auto of = aliased(m, s.name);
    const auto replace = [&](const std::string& by, auto&& map) {
      if (find(settings, by))
        throw wrong_usage(fmt::format("{} and {} are the same parameter", s.name, by));
      s.name = by;
      for (auto& v : s.values) v = map(v);
    };
    if (of.empty()) continue;
    if (is_roughness(s.name))
      replace(of, alpha_of);
    else
      replace(of, [](double f0) {
        if (!(0 <= f0 && f0 < 1)) throw wrong_usage(fmt::format("f0 = {} is outside [0, 1)", f0));
        return IorFromF0<double>::apply(std::array{f0})[0];
      });
  }
  if (const Setting* s = find(settings, "metal"); s && !m.find("metal")) {
    const Material* metal = find_metal(s->text);
    if (!metal) {
      std::vector<std::string_view> names;
      for (const auto& x : metals()) names.push_back(x.symbol);
      throw wrong_usage(fmt::format("no metal '{}'; known: {}", s->text, fmt::join(names, ", ")));
    }
    if (find(settings, "eta") || find(settings, "k")) throw wrong_usage("metal sets eta and k");
    if (!m.find("eta") || !m.find("k"))
      throw wrong_usage(
          fmt::format("metal sets eta and k, but model '{}' has no conductor", to_text(m.spec)));
    forget(settings, "metal");
    Setting eta{"eta", {}}, k{"k", {}};
    for (const auto& index : metal->rgb())
      eta.values.push_back(index.n), k.values.push_back(index.k);
    settings.insert(settings.end(), {eta, k});
  }
}

}  // namespace

const ModelParameter* Model::find(std::string_view name) const {
  const auto it = std::ranges::find(parameters, name, &ModelParameter::name);
  return it == parameters.end() ? nullptr : &*it;
}

Model compose(const ModelSpec& spec, std::size_t channels, std::span<const std::string> grey) {
  Model m;
  m.spec = spec;
  m.channels = channels;
  if (spec.coat)
    throw wrong_usage(
        fmt::format("model '{}': a coat is for scenes and choices only", to_text(spec)));
  const auto term = [&](const std::string& name, Role role) {
    const std::size_t found = find_term(name, role);
    if (auto hold = hold_foreign(found)) m.held.push_back(std::move(hold));
    return use(m, found, m.lobes.size(), grey);
  };
  if (!spec.diffuse.empty()) m.diffuse.push_back(term(spec.diffuse, Role::diffuse));
  for (const auto& l : spec.lobes) {
    TermUse d = term(l.ndf, Role::ndf), v = term(l.masking, Role::masking),
            f = term(l.fresnel, Role::fresnel);
    m.lobes.push_back({std::move(d), std::move(v), std::move(f)});
  }
  if (m.anisotropic) m.parameters.push_back({"tangent", &tangent_parameter, m.value_count++, 1});
  for (const auto& d : m.diffuse)
    if (catalogue()[d.term].coupled && m.lobes.empty())
      throw wrong_usage(fmt::format("model '{}': {} needs a lobe to be coupled to", to_text(spec),
                                    catalogue()[d.term].about->id));
  for (const auto& name : grey)
    if (const auto* p = m.find(name); p && !p->about->per_channel)
      throw wrong_usage(fmt::format("'{}' is no colour: it has one value anyway", name));
  for (const auto& name : grey)
    if (!m.find(name))
      throw wrong_usage(fmt::format("model '{}' has no parameter '{}'", to_text(spec), name));
  return m;
}

BoundModel bind_model(const ModelSpec& spec,
                      std::vector<Setting> settings,
                      std::optional<std::size_t> channels,
                      std::span<const std::string> grey) {
  const ModelSpec resolved = resolve_base_color(resolve_preset(spec, settings), settings);
  const Model grey_model = compose(resolved, 1);
  if (find(settings, "f0") && find(settings, "eta") && !grey_model.find("f0"))
    throw wrong_usage("f0 and eta say the same: give one of them");
  resolve_aliases(grey_model, settings);
  std::size_t longest = 1;
  for (const auto& s : settings) longest = std::max(longest, s.values.size());
  const std::size_t n = channels.value_or(longest > 1 ? longest : 3);

  BoundModel b{compose(resolved, n, grey), {}, {}};
  b.values.resize(b.model.value_count);
  for (const auto& p : b.model.parameters)
    std::fill_n(b.values.begin() + static_cast<std::ptrdiff_t>(p.first), p.count, p.about->start);
  start_colours(b);
  for (const auto& s : settings) {
    const ModelParameter* p = b.model.find(s.name);
    if (!p) {
      std::vector<std::string_view> names;
      for (const auto& q : b.model.parameters) names.push_back(q.name);
      throw wrong_usage(fmt::format("model '{}' has no parameter '{}'; it has: {}",
                                    to_text(resolved), s.name, fmt::join(names, ", ")));
    }
    if (s.values.size() != 1 && s.values.size() != p->count)
      throw wrong_usage(
          fmt::format("{}: {} values where {} fit", s.name, s.values.size(),
                      p->count == 1 ? std::string("one") : fmt::format("one or {}", p->count)));
    if (!s.implied) b.given.push_back(p->name);
    for (std::size_t c = 0; c < p->count; ++c) {
      const double v = s.values[s.values.size() == 1 ? 0 : c];
      check_range(*p->about, s.name, v);
      b.values[p->first + c] = v;
    }
  }
  return b;
}

bool is_mixed_colour(const Model& m, const std::string& name) {
  return !m.find(name) && m.find(name + "_r") && m.find(name + "_g") && m.find(name + "_b");
}

bool takes_parameter(std::string_view spec, const std::string& name) {
  const Preset* preset = find_preset(spec);
  if (preset &&
      std::ranges::find(preset->parameters, name, &Parameter::name) != preset->parameters.end())
    return true;
  const Model m = compose(preset ? preset->spec : spec, 1);
  const auto has = [&](const std::string& p) {
    return m.find(p) || is_mixed_colour(m, p) || !aliased(m, p).empty();
  };
  if (name == "metal" && !m.find(name)) return m.find("eta") && m.find("k");
  return has(name) || ((name == "base_color" || name == "metallic") && has("f0") && m.find("kd"));
}

std::vector<std::pair<std::string, std::vector<double>>> named_values(const BoundModel& b) {
  std::vector<std::pair<std::string, std::vector<double>>> all;
  for (const auto& p : b.model.parameters) {
    const auto first = b.values.begin() + static_cast<std::ptrdiff_t>(p.first);
    all.emplace_back(p.name,
                     std::vector<double>(first, first + static_cast<std::ptrdiff_t>(p.count)));
  }
  return all;
}

}  // namespace gonio
