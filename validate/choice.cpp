#include "validate/choice.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "base/json/describe.h"
#include "base/letters.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/fitted_model.h"
#include "brdf/model/own_files.h"
#include "brdf/model/presets.h"
#include "brdf/model/settings_form.h"
#include "brdf/model/takes_parameter.h"
#include "optics/refractive_index.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

constexpr Numbers shares{0, 1}, amounts{0, Numbers::any};
constexpr Entries few{1, 64}, parameters{0, 100};
/// A usual name of shaders for what an artist sets.
constexpr std::string_view shader_roughness = "perceptualRoughness";

}  // namespace

template <>
inline constexpr auto description<Budgets::ColourDifference> =
    FieldList{Field{"limit", &Budgets::ColourDifference::limit,
                    "CIEDE2000 under a uniform white sky", amounts},
              Field{"quantile", &Budgets::ColourDifference::quantile,
                    "of the domain that keeps it; 1: all", shares, or_default}};
template <>
inline constexpr auto description<Budgets::Time> =
    FieldList{Field{"limit", &Budgets::Time::limit, "times the baseline's time", amounts},
              Field{"baseline", &Budgets::Time::baseline,
                    "spec of a model, measured in the same run", not_empty}};
template <>
inline constexpr auto description<Budgets> = FieldList{
    Field{"albedo_error", if_there(&Budgets::albedo_error),
          "directional albedo, from the reference's", amounts},
    Field{"fresnel_error", if_there(&Budgets::fresnel_error),
          "F, from the exact one of the domain's substances", amounts},
    Field{"delta_e_2000", if_there(&Budgets::delta_e_2000), "colour, from the reference's"},
    Field{"energy_gain", if_there(&Budgets::energy_gain), "directional albedo above 1", amounts},
    Field{"energy_loss", if_there(&Budgets::energy_loss),
          "of lobes at F = 1, directional albedo below 1", shares},
    Field{"reciprocity", if_there(&Budgets::reciprocity),
          "relative change of f where light and view change places", amounts},
    Field{"nonfinite", if_there(&Budgets::nonfinite), "inputs without a value in the number",
          amounts},
    Field{"operations", if_there(&Budgets::operations), "of one sample in all channels", amounts},
    Field{"ns", if_there(&Budgets::ns), "time of a sample"},
    Field{"table_bytes", if_there(&Budgets::table_bytes), "tables that a shader reads", amounts}};

template <>
struct Description<Choice::Domain> {
  static constexpr auto fields() {
    using D = Choice::Domain;
    constexpr Numbers any{};
    return FieldList{
        field("roughness", if_there(per_channel(&D::roughness)), "as an artist sets it", any),
        field("mu", if_there(per_channel(&D::mu)),
              "cosine of directions and the normal; else 0.05 to 1", any),
        field("eta", if_there(per_channel(&D::eta)), "index of refraction of dielectrics", any),
        field("f0", if_there(per_channel(&D::f0)), "reflectance at normal incidence", any),
        field("metal", if_there(per_channel(&D::metals)), "metals by their symbols", few,
              not_empty),
        field("fits", if_there(per_channel(&D::fits)),
              "documents of fits: their models and parameters", few, not_empty)};
  }
  static void check(Choice::Domain& d, Demand expect) {
    const auto within = [&](const char* key, const std::optional<Choice::Ends>& r, double low,
                            double high) {
      if (r && !((*r)[0] >= low && (*r)[0] <= (*r)[1] && (*r)[1] <= high))
        expect(false, key,
               fmt::format("[low, high] within {:g} to {:g}, not [{:g}, {:g}]", low, high, (*r)[0],
                           (*r)[1]));
    };
    within("roughness", d.roughness, 1e-3, 1);
    within("mu", d.mu, 1e-4, 1);
    within("eta", d.eta, 1.0001, 10);
    within("f0", d.f0, 0, 1);
    const bool fits = !d.fits.empty();
    const int kinds = d.eta.has_value() + d.f0.has_value() + !d.metals.empty() + fits;
    expect(kinds <= 1, kinds > 1 && fits ? "fits" : "metal", "only one of eta, f0, metal and fits");
  }
};

template <>
struct Description<Choice> {
  template <class Member>
  static constexpr auto shipped(Member member) {
    return at(&Choice::shipped, member);
  }
  template <class Member>
  static constexpr auto reference(Member member) {
    return at(&Choice::reference, member);
  }
  static constexpr auto fields() {
    using S = Shipped;
    return FieldList{
        constant_text("schema", "gonio.choice/1"),
        field("model", shipped(&S::model), "spec of a model, or a preset", not_empty),
        field("parameters", shipped(&S::parameters),
              "a number or one per channel each; of the model, and of the reference where that "
              "takes the name and reference_parameters and the domain do not set it",
              parameters, or_default),
        field("scattering", shipped(&S::scattering), "what follows light after its first bounce",
              or_default),
        field("alpha", shipped(&S::alpha), "width from roughness", or_default),
        field("coating", if_there(shipped(&S::coating)),
              "what a coat leaves for all below it: by its albedo in the view's direction, or in "
              "the light's too"),
        field("number", &Choice::number, "in which a shader computes it", or_default),
        field("reference", if_there(reference(&S::model)), "spec that the model stands for",
              not_empty),
        field("reference_parameters", reference(&S::parameters),
              "of the reference only, a number or one per channel each", parameters, or_default),
        field("reference_scattering", reference(&S::scattering), "", or_default),
        field("reference_coating", if_there(reference(&S::coating)),
              "of the reference, as coating"),
        field("domain", &Choice::domain, "where the budgets must be kept", or_default),
        field("budgets", &Choice::budgets, "limits")};
  }
  static void check(Choice& c, Demand expect) {
    const auto& b = c.budgets;
    c.has_reference = !c.reference.model.empty();
    expect(b.albedo_error || b.fresnel_error || b.delta_e_2000 || b.energy_gain || b.energy_loss ||
               b.reciprocity || b.nonfinite || b.operations || b.ns || b.table_bytes,
           "budgets", "at least one budget");
    expect(c.has_reference || !(b.albedo_error || b.delta_e_2000), "reference",
           "a reference, which the budgets albedo_error and delta_e_2000 compare with");
    expect(c.has_reference || c.reference.parameters.empty(), "reference_parameters",
           "a reference beside them");
    expect(!b.fresnel_error || c.domain.eta || !c.domain.metals.empty(), "domain",
           "eta or metal, whose exact F the budget fresnel_error compares with");
    expect(c.number != Number::wide, "number", "half, mixed, float or double");
  }
};

ModelSpec Shipped::spec() const {
  return coat_as_lobe(parse_model(model));
}

Model Shipped::composed() const {
  std::vector<Setting> unset;
  return compose(resolve_preset(spec(), unset), 3);
}

bool has_range(const Choice& c) {
  return c.domain.eta || c.domain.f0;
}

namespace {

Substance of_surface(std::string name, FresnelSurface surface) {
  auto forms = forms_for(surface);  // least squares, so once
  return {std::move(name), std::move(surface), std::move(forms)};
}

}  // namespace

Substance substance_at(const Choice& c, double part) {
  const auto at = [&](const Choice::Ends& e) { return e[0] + part * (e[1] - e[0]); };
  if (c.domain.eta) {
    const double ior = at(*c.domain.eta);
    return of_surface(fmt::format("IOR {:.4g}", ior),
                      dielectric(ior, fmt::format("IOR {:.4g}", ior)));
  }
  const double f0 = at(*c.domain.f0);
  return {fmt::format("F0 {:.4g}", f0), {}, {}, {{"f0", {f0}}}};
}

namespace {

std::vector<Substance> substances_of(const Choice& c) {
  std::vector<Substance> all;
  if (has_range(c)) {
    const auto& e = c.domain.eta ? *c.domain.eta : *c.domain.f0;
    const int steps = e[0] == e[1] ? 0 : 4;
    for (int i = 0; i <= steps; ++i)
      all.push_back(substance_at(c, steps ? i / static_cast<double>(steps) : 0));
  }
  for (const auto& name : c.domain.metals) {
    const Material& m = *find_metal(name);
    all.push_back(of_surface(std::string(m.name), metal(m)));
  }
  for (const auto& file : c.domain.fits) {
    const auto path = path_beside(c.path, file);
    const auto fitted = read_fitted_model(path);
    bind_fitted(path, fitted, {});  // refuses what is not known
    Substance s{file};
    for (const auto& [name, values] : fitted.parameters) s.settings.push_back({name, values});
    all.push_back(std::move(s));
  }
  if (all.empty()) all.push_back({});
  return all;
}

}  // namespace

namespace {

/// A coat is the only lobe, on diffuse terms that it does not couple with; what it leaves for them is said.
void check_coat(const JsonReader& root,
                const Shipped& s,
                const char* model,
                const char* coating,
                const char* scattering) {
  if (parse_model(s.model).coat.has_value() != s.coating.has_value()) {
    if (s.coating)
      root.at(coating).fail(fmt::format("a {} with a coat, \"coat:\" before its last lobe", model));
    root.at(model).fail(fmt::format("{}, view or both, beside a coat", coating));
  }
  if (!s.coating) return;
  const Model m = s.composed();
  const bool coupled =
      std::ranges::any_of(m.diffuse, [](const TermUse& t) { return catalogue()[t.term].coupled; });
  if (m.lobes.size() != 1 || m.diffuse.empty() || coupled)
    root.at(model).fail("DIFFUSE+coat:LOBE, the diffuse terms uncoupled");
  if (s.scattering != Bounces::single) root.at(scattering).fail("single, where there is a coat");
}

}  // namespace

namespace {

bool has(const std::vector<Setting>& all, std::string_view name) {
  return std::ranges::find(all, name, &Setting::name) != all.end();
}

/// True of a width's name, whatever its case: a shader's Roughness is one.
bool is_width(std::string_view name) {
  return std::ranges::any_of(width_names, [&](auto w) { return same_letters(w, name); }) ||
         same_letters(name, shader_roughness);
}

/// Letters of a name without those that only separate words: base_color is a shader's baseColor.
std::string joined(std::string_view name) {
  std::string s;
  for (const char c : name)
    if (c != '_') s += lower_case(c);
  return s;
}
/// The model's parameter of these letters, of a colour that it mixes without the channel; empty where there is none.
std::string of_letters(const Model& m, std::string_view name) {
  for (const auto& p : m.parameters) {
    const auto known = p.name.ends_with("_r") ? p.name.substr(0, p.name.size() - 2) : p.name;
    if (joined(known) == joined(name)) return known;
  }
  return "";
}

/// True where the domain gives each substance, or each roughness, what the name sets.
bool is_of_domain(const Choice::Domain& d, std::string_view name) {
  if (is_width(name)) return d.roughness.has_value();
  const bool of_surface = d.eta || d.f0 || !d.metals.empty();
  return of_surface && (name == "f0" || name == "eta" || name == "k" || name == "metal");
}

/// Parameters reach the model and the reference, whichever takes them.  Names that neither takes, and values that one does not
/// take, are refused.
void share_parameters(const JsonReader& root, Choice& c) {
  const auto try_binding = [](const Shipped& s, const std::vector<Setting>& settings) {
    try {
      bind_model(s.spec(), settings);
      return std::string();
    } catch (const Error& e) {
      return std::string(e.what());
    }
  };
  const auto demand = [&](const char* key, const Shipped& s, const std::vector<Setting>& settings) {
    if (const auto why = try_binding(s, settings); !why.empty())  // the words are the file's
      root.at(key).fail(fmt::format("what the model takes ({})", why));
  };
  const auto settings_at = [&](const char* key, const GivenParameters& given) {
    return given.empty() ? std::vector<Setting>{} : settings_of(given, root.at(key));
  };
  demand("model", c.shipped, {});
  if (c.has_reference) demand("reference", c.reference, {});
  const auto given = settings_at("parameters", c.shipped.parameters);
  auto others = settings_at("reference_parameters", c.reference.parameters);
  const auto refuse_unknown = [&](const char* key, const std::vector<Setting>& settings,
                                  const std::vector<const Shipped*>& sides) {
    for (const auto& s : settings) {
      if (std::ranges::any_of(sides, [&](const Shipped* side) {
            return takes_parameter(to_text(side->spec()), s.name);
          }))
        continue;
      std::vector<std::string> of;
      for (const Shipped* side : sides) {
        const auto model = side->composed();
        std::vector<std::string> names;
        for (const auto& p : model.parameters) names.push_back(p.name);
        of.push_back(fmt::format("{} ({})", side->model, fmt::join(names, ", ")));
      }
      root.at(key).at(s.name).fail(fmt::format("a parameter of {}", fmt::join(of, " or of ")));
    }
  };
  std::vector<const Shipped*> sides{&c.shipped};
  if (c.has_reference) sides.push_back(&c.reference);
  refuse_unknown("parameters", given, sides);
  sides.erase(sides.begin());
  refuse_unknown("reference_parameters", others, sides);
  const auto taken_by = [&](const Shipped& side) {
    std::vector<Setting> own;
    for (const auto& s : given)
      if (takes_parameter(to_text(side.spec()), s.name)) own.push_back(s);
    return own;
  };
  const auto own = taken_by(c.shipped);
  demand("parameters", c.shipped, own);
  const auto all_given = std::exchange(c.shipped.parameters, {});
  for (const auto& p : all_given)
    if (has(own, p.first)) c.shipped.parameters.push_back(p);
  if (!c.has_reference) return;
  demand("reference_parameters", c.reference, others);
  auto shared = taken_by(c.reference);
  std::map<std::string, std::string> said;  // a shader's baseColor is the reference's base_color
  for (const auto& s : own)
    if (const auto known = has(shared, s.name) ? "" : of_letters(c.reference.composed(), s.name);
        !known.empty() && !has(shared, known)) {
      shared.push_back(s);
      shared.back().name = known;
      said[known] = s.name;
    }
  auto demanded = shared;
  if (has(own, "metallic") && !has(shared, "base_color"))  // a shader's own, beside its baseColor
    std::erase_if(demanded, [](const Setting& s) { return s.name == "metallic"; });
  demand("parameters", c.reference, demanded);
  for (const auto& s : shared) {
    const auto renamed = said.find(s.name);
    const bool is_own = has(own, s.name) || renamed != said.end();
    const auto at = root.at("parameters").at(renamed == said.end() ? s.name : renamed->second);
    const auto known = is_own ? "" : of_letters(c.shipped.composed(), s.name);
    if (!known.empty() && !has(own, known))
      at.fail(fmt::format("{}, as {} has it", known, c.shipped.model));
    const bool is_set = has(others, s.name);
    if (is_own && (is_set || is_of_domain(c.domain, s.name))) continue;
    others.push_back(s);
    if (!is_set && try_binding(c.reference, others).empty()) {
      c.reference.parameters.emplace_back(s.name, GivenParameter{s.values, s.text});
      continue;
    }
    others.pop_back();  // the reference sets the same, maybe by another name
    if (!is_own) at.fail("a parameter that reference_parameters does not set otherwise");
  }
}

/// Refuses ends of a domain that change neither side, because their own parameters win.
void check_reach(const JsonReader& root, const Choice& c) {
  const auto reaches = [&](const Substance& a, double roughness_a, const Substance& b,
                           double roughness_b) {
    const auto moves = [&](const Shipped& s) {
      return bound(c, s, a, roughness_a).values != bound(c, s, b, roughness_b).values;
    };
    return moves(c.shipped) || (c.has_reference && moves(c.reference));
  };
  const auto refuse = [&](const char* key, std::string_view name, const std::string& who) {
    root.at("domain").at(key).fail(fmt::format("no {}, because {} sets {}", key, who, name));
  };
  const auto sets = [](const auto& all, std::string_view name) {
    return std::ranges::any_of(all, [&](const auto& p) { return p.first == name; });
  };
  if (c.domain.roughness)
    for (const auto& s : c.substances) {
      if (reaches(s, 0.3, s, 0.6)) continue;
      for (const auto& p : c.shipped.parameters)
        if (is_width(p.first)) refuse("roughness", p.first, "parameters");
      for (const auto name : width_names)
        if (has(s.settings, name)) refuse("roughness", name, s.name);
    }
  const auto &first = c.substances.front(), &last = c.substances.back();
  if (has_range(c) && first.name != last.name && !reaches(first, 0.5, last, 0.5))
    for (const char* name : {"f0", "eta", "metal"})
      if (sets(c.shipped.parameters, name)) refuse(c.domain.eta ? "eta" : "f0", name, "parameters");
}

}  // namespace

Choice parse_choice(const std::string& path, const std::string& bytes) {
  const JsonDocument document(path, bytes, Places::pointer);
  const JsonReader& root = document.root();
  Choice c;
  c.path = path;
  read_record(root, c);
  for (std::size_t i = 0; i < c.domain.metals.size(); ++i)
    if (!find_metal(c.domain.metals[i])) {
      const auto at = root.at("domain").at("metal");
      (at.is_array() ? at.at(i) : at).fail("a metal that is known");
    }
  for (auto* s : {&c.shipped, &c.reference}) try {
      s->model = own_files_beside(path, s->model);
    } catch (const Error& e) {
      if (e.code() != Exit::usage) throw;
      // no model: what follows says so
    }
  share_parameters(root, c);
  check_coat(root, c.shipped, "model", "coating", "scattering");
  if (c.has_reference)
    check_coat(root, c.reference, "reference", "reference_coating", "reference_scattering");
  if (c.shipped.coating) {
    const auto& b = c.budgets;
    for (const auto& [asked, key] :
         {std::pair(b.energy_loss.has_value(), "energy_loss"),
          std::pair(b.nonfinite.has_value(), "nonfinite"),
          std::pair(b.operations.has_value(), "operations"), std::pair(b.ns.has_value(), "ns"),
          std::pair(b.table_bytes.has_value(), "table_bytes")})
      if (asked)
        root.at("budgets").at(key).fail(
            "a model without a coat, which is asked albedo_error, delta_e_2000, energy_gain, "
            "fresnel_error and reciprocity only");
  }
  if (c.shipped.composed().lobes.empty())
    for (const auto& [asked, key] : {std::pair(c.budgets.fresnel_error, "fresnel_error"),
                                     std::pair(c.budgets.energy_loss, "energy_loss")})
      if (asked) root.at("budgets").at(key).fail("a model with a lobe, of which it is asked");
  if (c.budgets.ns) {
    auto& baseline = c.budgets.ns->baseline;
    try {
      baseline = own_files_beside(path, baseline);
    } catch (const Error& e) {
      if (e.code() != Exit::usage) throw;
    }
    try {
      bind_model(baseline, {});
    } catch (const Error& e) {
      root.at("budgets").at("ns").at("baseline").fail(fmt::format("a model ({})", e.what()));
    }
  }
  c.substances = substances_of(c);
  check_reach(root, c);
  return c;
}

Choice read_choice(const std::string& path) {
  return parse_choice(path, InputFile(path).read_rest(most_document_bytes));
}

std::string choice_schema() {
  return schema_text<Choice>("Choice of a material model, and what it must keep");
}

namespace {

/// Settings of a lobe's Fresnel term on a substance's surface.
std::vector<Setting> fresnel_settings(std::string_view id, const Substance& of) {
  for (const auto& f : of.forms)
    if (f.name == id) return f.settings;
  const FresnelSurface& s = *of.surface;
  Setting eta{"eta", {}}, k{"k", {}};
  for (const auto& i : s.index) eta.values.push_back(i.n), k.values.push_back(i.k);
  if (id == "fresnel.conductor") return {eta, k};
  if (id == "fresnel.dielectric" && s.kind == "dielectric") return {eta};
  throw wrong_usage(fmt::format("{} is not for {}", id, s.material));
}

/// The model's parameter of a name, whatever its case: F0 of a shader is f0.
std::string named_as_in(const Model& m, std::string_view name) {
  if (m.find(name)) return std::string(name);
  for (const auto& p : m.parameters)
    if (same_letters(p.name, name)) return p.name;
  return std::string(name);
}

/// Adds the width that the domain's roughness means, where none is set: of a preset whose own parameters are set by these,
/// of others by those of the terms.
void add_width(std::vector<Setting>& settings, const Shipped& s, const Model& m, double roughness) {
  for (const auto name : width_names)
    if (has(settings, name)) return;
  const double alpha = s.alpha == AlphaMap::linear   ? roughness
                       : s.alpha == AlphaMap::square ? roughness * roughness
                                                     : std::pow(roughness, 4);
  const auto sets_own = [&](const Parameter& p) { return has(settings, p.name); };
  const auto set = [&](std::string name, double value) {
    if (!has(settings, name)) settings.push_back({std::move(name), {value}});
  };
  if (const Preset* preset = find_preset(s.model);
      preset && std::ranges::any_of(preset->parameters, sets_own))
    settings.push_back({"roughness", {std::sqrt(alpha)}});
  else if (m.find("alpha"))
    settings.push_back({"alpha", {alpha}});
  else if (m.find("alpha_x"))
    settings.push_back({"alpha_x", {alpha}}), settings.push_back({"alpha_y", {alpha}});
  else if (const auto own = named_as_in(m, "alpha"); m.find(own))
    set(own, alpha);
  else
    for (const auto name : {std::string_view("roughness"), shader_roughness})
      if (const auto mine = named_as_in(m, name); m.find(mine)) return set(mine, roughness);
}

}  // namespace

BoundModel bound(const Choice& c, const Shipped& s, const Substance& of, double roughness) {
  std::vector<Setting> settings;
  for (const auto& [name, given] : s.parameters)
    settings.push_back({name, given.values, given.word});
  try {
    const Model plain = s.composed();
    const auto add = [&](const Setting& setting) {
      if (!has(settings, setting.name)) settings.push_back(setting);
    };
    if (of.surface && !plain.lobes.empty())
      for (const auto& x : fresnel_settings(catalogue()[plain.lobes[0].fresnel.term].about->id, of))
        add(x);
    for (auto x : of.settings) {
      x.name = named_as_in(plain, x.name);
      if (x.name == "f0" || plain.find(x.name)) add(x);
    }
    if (c.domain.roughness) add_width(settings, s, plain, roughness);
    auto model = bind_model(s.spec(), std::move(settings), 3);
    if (!c.domain.fits.empty())  // a default would be another material than the fit's
      for (const auto& p : model.model.parameters)
        if (std::ranges::find(model.given, p.name) == model.given.end())
          throw wrong_usage(fmt::format("nothing for '{}'", p.name));
    return model;
  } catch (const Error& e) {
    throw bad_input(c.path, of.name.empty() ? "/domain" : fmt::format("/domain ({})", of.name),
                    e.what(), "what the model takes");
  }
}

std::vector<UsedParameter> used_parameters(const Choice& c, const Shipped& side) {
  std::vector<Setting> own;
  for (const auto& [name, given] : side.parameters) own.push_back({name, given.values, given.word});
  const auto by_choice = bind_model(side.spec(), std::move(own), 3).given;
  const auto ends = c.domain.roughness.value_or(Choice::Ends{1, 1});
  const BoundModel first = bound(c, side, c.substances.front(), ends[0]);
  auto values = named_values(first);
  for (const auto& s : c.substances)
    for (const double r : ends) {
      const auto here = named_values(bound(c, side, s, r));
      for (std::size_t i = 0; i < values.size(); ++i)
        if (here[i].second != values[i].second) values[i].second.clear();
    }
  std::vector<UsedParameter> all;
  for (auto& [name, v] : values) {
    const auto among = [&, &n = name](const std::vector<std::string>& names) {
      return std::ranges::find(names, n) != names.end();
    };
    using enum UsedParameter::From;
    all.push_back({name, std::move(v),
                   among(by_choice)     ? choice
                   : among(first.given) ? domain
                                        : default_value});
  }
  return all;
}

}  // namespace gonio
