#include <array>

#include "brdf/catalogue/masking_shape.h"
#include "brdf/catalogue/registry.h"
#include "brdf/in_number/number.h"
#include "brdf/model/evaluate.h"
#include "geometry/half_difference.h"
#include "integrate/albedo/normalisation.h"
#include "optics/refractive_index.h"
#include "reports/audit/entry.h"
#include "reports/measure/light_unit.h"
#include "reports/measure/samples.h"

namespace gonio::auditing {
namespace {

class TermAudit {
 public:
  explicit TermAudit(std::size_t term)
      : term_(term),
        about_(*catalogue()[term].about),
        parameters_(catalogue()[term].parameters),
        role_(role_of(about_.id)) {}

  EntryAudit operator()() const {
    EntryAudit e;
    e.about = &about_;
    e.kind = name_of(role_);
    e.light_unit = light_unit(about_.id);
    e.operations = operations_of(term_).sample;
    ranges(e);
    grazing(e);
    if (role_ == Role::ndf) normalisation_of(e);
    if (role_ != Role::fresnel) energy(e);
    if (!about_.reference().empty())
      e.distance = distance(find_term(about_.reference()), Number::double_);
    picture(e);
    judge(e);
    return e;
  }

  std::optional<Distance> distance(std::size_t reference, Number number) const {
    const bool same = reference == term_ && number == Number::double_;
    std::vector<Row> at;
    for (std::size_t i = 0; i < rows().size(); i += same ? 16 : 1) at.push_back(rows()[i]);
    Differences all;
    for (const auto& q : reference_parameters(reference)) {
      const auto p = standing_for(reference, q);
      bool legal = true;
      for (std::size_t k = 0; k < p.size(); ++k) legal = legal && parameters_[k].legal.holds(p[k]);
      if (!legal) continue;
      const auto v = values(term_, p, at, number),
                 w = values(reference, q, at, same ? Number::wide : Number::double_);
      const double peak = role_ == Role::ndf ? *std::ranges::max_element(w) : 1;
      for (std::size_t i = 0; i < v.size(); ++i)
        all.add((v[i] - w[i]) / peak,
                [&] { return joined(text(catalogue()[reference].parameters, q), text(at[i])); });
    }
    static constexpr std::string_view measures[] = {"D ÷ the reference's peak", "G2", "F", "f"};
    return all.distance(catalogue()[reference].about->id,
                        measures[static_cast<std::size_t>(role_)]);
  }

 private:
  /// Values; of a masking term G2.
  static Values values(std::size_t term,
                       const Values& p,
                       std::span<const Row> rows,
                       Number number = Number::double_) {
    auto v = shown_in(number, term, p, rows);
    if (const double unit = light_unit(catalogue()[term].about->id); unit != 1)
      for (double& x : v) x /= unit;
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
      for (std::size_t i = 0; i < v.size(); ++i) look(e, v[i], where(rows()[i]));
      if (role_ != Role::masking && role_ != Role::diffuse) continue;
      std::vector<Row> other;
      for (const auto& r : rows()) other.push_back(exchanged(r));
      const auto w = values(term_, p, other);
      for (std::size_t i = 0; i < v.size(); ++i) look_exchanged(e, v[i], w[i], where(rows()[i]));
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
      auto one = normalisation(term_, p);
      one.value /= light_unit(about_.id);
      one.error /= light_unit(about_.id);
      const double off = std::abs(one.value - 1);
      if (!e.normalisation || !(off <= std::abs(e.normalisation->value - 1)))
        e.normalisation = Worst{one.value, one.error, text(parameters_, p)};
      if (!std::isfinite(one.value)) break;
    }
  }

  /// The lobe that this term is looked at in: with the masking of its own distribution, of Berry's that of GTR at γ = 1, or
  /// the distribution of its own masking.
  ModelSpec lobe() const {
    const std::string own(short_id(about_.id)), shape(shape_of_term(own)),
        kind = catalogue()[term_].anisotropic ? "_aniso" : "";
    return role_ == Role::ndf
               ? model_of_lobe(own, "smith_" + shape + kind + ".correlated", "constant")
               : model_of_lobe(shape + kind, own, "constant");
  }

  void energy(EntryAudit& e) const {
    if (role_ != Role::diffuse) {
      e.energy_of = to_text(lobe());
      e.energy_is_shared = about_.id == "ndf.blinn_phong" || about_.id == "ndf.shape_invariant";
      albedo_in(lobe(), 1, e.energy);
      return;
    }
    const std::string own(short_id(about_.id));
    auto under = model_of_lobe("ggx", "smith_ggx.correlated", "schlick");
    under.diffuse = own;
    if (!catalogue()[term_].coupled) {
      e.energy_of = own;
      albedo_in({own, {}}, 1, e.energy);
    }
    albedo_in(under, 0.04, e.energy_under_lobe);
  }
  /// White, at all values of the parameters of this term and of the width of the lobe.
  void albedo_in(const ModelSpec& spec, double f0, std::optional<Worst>& most) const {
    const Model m = compose(spec, 1);
    BoundModel b{m, Values(m.value_count), {}};
    std::vector<Parameter> varied;
    for (const auto& p : m.parameters) {
      const bool own =
          std::ranges::find(parameters_, p.name, &Parameter::name) != parameters_.end();
      b.values[p.first] = p.name == "kd"              ? 1
                          : p.name == "f0"            ? f0
                          : p.name == "gamma" && !own ? 1
                                                      : p.about->start;
      if ((own && p.name != "kd") || p.name == "alpha") varied.push_back(*p.about);
    }
    for (const auto& values : combinations(varied)) {
      for (std::size_t k = 0; k < varied.size(); ++k)
        b.values[m.find(varied[k].name)->first] = values[k];
      largest_albedo(most, b, text(varied, values), light_unit(about_.id));
    }
  }

  /// Parameters with which this term stands for the reference at parameters q: those that both have are the same; an f0 is what the
  /// reference reflects at normal incidence.
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

}  // namespace

EntryAudit audit_term(std::size_t term) {
  return TermAudit(term)();
}

std::optional<Distance> distance_between(std::size_t term, std::size_t reference, Number number) {
  return TermAudit(term).distance(reference, number);
}

}  // namespace gonio::auditing
