#include "reports/own/nearest_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/in_number/number.h"
#include "brdf/model/spec.h"
#include "geometry/direction.h"
#include "reports/finding/words.h"
#include "reports/measure/samples.h"
#include "reports/own/cost.h"
#include "reports/own/parameters.h"
#include "reports/own/slip_forms.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using auditing::Row;
using auditing::Values;

/// (1 − c)⁵ of Schlick's form.
double fifth(double c) {
  const double u = 1 - c;
  return u * u * u * u * u;
}

/// What a slip multiplies a highlight with.
struct Disguise {
  double (*factor)(const Row&);
  const char* slip;
};
constexpr std::array<Disguise, 4> disguises{{
    {[](const Row&) { return 1.0; }, ""},
    {[](const Row& r) { return 1 + fifth(r.voh); }, ""},  // said of F
    {[](const Row& r) { return 4 * r.nol * r.nov; },
     "G stands where V belongs: its highlight lacks the division by 4 NoL NoV"},
    {[](const Row& r) { return r.nol; },
     "its highlight has the cosine NoL in it, which its diffuse part has not"},
}};

/// What a shader does with its half vector.
struct HalfVector {
  double scale;  ///< its length over |h · l|; 0: it is of length 1
  const char* slip;
};
constexpr std::array<HalfVector, 3> half_vectors{{
    {0, ""},
    {1, "its half vector is not normalised: it is (L + V)/2"},
    {2, "its half vector is not normalised: it is L + V"},
}};

/// Light and view mirrored at 30°: D and V are at their peaks, nearly.
const Row& mirrored() {
  static const Row row = auditing::row(30 * degree, 0, 30 * degree, std::numbers::pi);
  return row;
}

/// A Fresnel term that a function has where no parameter is F0, with its parameter.
struct Interface {
  std::string_view id;
  double parameter;
};
std::vector<Interface> interfaces(const PartColours& colours,
                                  std::span<const Parameter> parameters) {
  if (!colours.f0.empty()) return {{}};
  constexpr double of_dielectrics = 0.04;
  if (!colours.eta) return {{"fresnel.schlick", of_dielectrics}};
  const double eta = high_of(parameters[*colours.eta]), root = (eta - 1) / (eta + 1);
  return {{"fresnel.dielectric", eta}, {"fresnel.schlick", root * root}};
}

/// A term's values over rows, by width.
using ByWidth = std::vector<Values>;
struct Form {
  std::size_t term;
  ByWidth values;
};

/// A whole function with the parameters that make its parts, and the search for the model that it is.
class Search {
 public:
  Search(std::size_t term,
         std::size_t width,
         const PartColours& colours,
         const HalfVector& half,
         const Interface& interface)
      : term_(term),
        own_(known_parameters(term)),
        width_(width),
        colours_(colours),
        half_(half),
        interface_(interface) {
    // Away from the horizon: shaders add to a denominator there.
    constexpr double least_cosine = 0.3;
    for (const auto& r : auditing::rows_of(Role::diffuse))
      (std::min(r.nol, r.nov) < least_cosine ? grazing_ : rows_).push_back(r);
    widths_ = values_between(own_[width_], 4);
    // The widest first: there no guard bites.
    const auto powers = powers_of(own_[width_]);
    if (!narrows(powers[0])) std::ranges::reverse(widths_);
    for (const double power : powers)
      scaled_.push_back({power, forms(Role::ndf, power), forms(Role::masking, power)});
  }

  std::optional<NearestModel> found() {
    for (const auto& d : disguises)
      for (const auto others : {Others::low, Others::usual}) {
        others_ = others;
        disguise_ = &d;
        take_white(0);
        if (auto n = of_highlight()) return n;
      }
    // Tutorials add so much to 4 NoL NoV.
    for (const double guard : {1e-3, 1e-2}) {
      others_ = Others::low, disguise_ = disguises.data();
      take_white(guard);
      if (auto n = of_highlight()) return n;
    }
    return {};
  }

 private:
  struct Scaled {
    double power;
    std::vector<Form> shapes, maskings;
  };

  /// The highlight at F0 = 1 by width, with what is added to 4 NoL NoV taken out, and the widths that a guard makes one.
  void take_white(double guard) {
    white_.clear(), is_guarded_.clear();
    for (const double w : widths_) white_.push_back(highlight(1, w, rows_));
    guard_ = guard;
    for (auto& f : white_)
      for (std::size_t i = 0; i < f.size() && guard > 0; ++i)
        f[i] *= 1 + guard / (4 * rows_[i].nol * rows_[i].nov);
    constexpr double same = 1e-9;
    for (std::size_t k = 0; k < white_.size(); ++k) {
      const auto other = highlight(1, widths_[k] * (1 + 1e-3), rows_);
      const auto raw = highlight(1, widths_[k], rows_);
      bool is_one = true;
      for (std::size_t i = 0; i < raw.size(); ++i)
        is_one = is_one && std::abs(raw[i] - other[i]) <= same * std::abs(raw[i]);
      is_guarded_.push_back(is_one);
    }
  }

  Values highlight(double f0, double width, std::span<const Row> rows) const {
    auto p = with_highlight(own_, colours_, f0, others_);
    p[width_] = width;
    auto f = values_in(Number::double_, term_, p, rows);
    if (interface_.id.empty()) return f;
    const auto of = values_in(Number::double_, find_term(interface_.id),
                              std::array{interface_.parameter}, as_taken(rows));
    for (std::size_t i = 0; i < f.size(); ++i) f[i] /= of[i];
    return f;
  }
  Values diffuse(double colour, Others others) const {
    auto p = with_diffuse(own_, colours_, colour, others);
    p[width_] = widths_[0];
    return values_in(Number::double_, term_, p, rows_);
  }
  /// Rows as a distribution and a Fresnel term of the shader's half vector have them.
  std::vector<Row> as_taken(std::span<const Row> rows) const {
    std::vector<Row> all(rows.begin(), rows.end());
    for (auto& r : all) {
      if (half_.scale == 0) break;
      const double length = half_.scale * r.voh;
      r.noh = std::min(r.noh * length, 1.0);
      r.voh = std::min(r.voh * length, 1.0);
      r.sin2_theta_h = 1 - r.noh * r.noh;
    }
    return all;
  }
  Values values_of(std::size_t form, double alpha, std::span<const Row> rows) const {
    const Values p(catalogue()[form].parameters.size(), alpha);
    return catalogue()[form].role() == Role::masking
               ? values_in(Number::double_, form, p, rows)
               : values_in(Number::double_, form, p, as_taken(rows));
  }
  /// Values of each form of a role, from the widest as far as alpha is one of the form's.
  std::vector<Form> forms(Role role, double power) const {
    std::vector<Form> all;
    for (std::size_t form = 0; form < catalogue_size(); ++form) {
      const auto& e = catalogue()[form];
      const bool is_alpha_only =
          !e.anisotropic && !e.coupled &&
          (e.parameters.empty() || (e.parameters.size() == 1 && e.parameters[0].name == "alpha"));
      if (e.role() != role || !is_alpha_only) continue;
      ByWidth of;
      for (const double w : widths_) {
        const double alpha = alpha_of(w, power);
        if (!e.parameters.empty() && !e.parameters[0].legal.holds(alpha)) break;
        of.push_back(values_of(form, alpha, rows_));
      }
      constexpr std::size_t enough = 2;  // narrower ones may be no alpha of the form's
      if (of.size() >= enough) all.push_back({form, std::move(of)});
    }
    return all;
  }

  std::optional<NearestModel> of_highlight() const {
    // One alpha for both is tried first.
    for (const bool is_one : {true, false})
      for (const auto& of_d : scaled_)
        for (const auto& of_v : scaled_) {
          if ((&of_d == &of_v) != is_one) continue;
          for (const auto& d : of_d.shapes)
            for (const auto& v : of_v.maskings)
              if (const double factor = factor_of(d, v); factor > 0)
                return described(d, of_d.power, v, of_v.power, factor);
        }
    return {};
  }
  /// The function's highlight over D V, where it is that: everywhere at the widest, and elsewhere but for rows that a guard holds
  /// down; 0 where it is not.
  double factor_of(const Form& d, const Form& v) const {
    const auto wanted = [&](std::size_t k, std::size_t i) {
      return d.values[k][i] * v.values[k][i] * disguise_->factor(rows_[i]);
    };
    const auto peak =
        static_cast<std::size_t>(std::ranges::max_element(white_[0]) - white_[0].begin());
    const double factor = white_[0][peak] / wanted(0, peak);
    if (!(factor > 0) || !std::isfinite(factor)) return 0;
    const double least = 1e-30 * std::abs(white_[0][peak]);
    std::size_t held_down = 0;
    const std::size_t widths = std::min(d.values.size(), v.values.size());
    constexpr std::size_t enough = 2;
    if (static_cast<std::size_t>(std::ranges::count(
            is_guarded_.begin(), is_guarded_.begin() + static_cast<std::ptrdiff_t>(widths),
            false)) < enough)
      return 0;
    for (std::size_t k = 0; k < widths; ++k)
      for (std::size_t i = 0; i < rows_.size() && !is_guarded_[k]; ++i) {
        const double w = factor * wanted(k, i), off = white_[k][i] - w;
        if (std::abs(off) <= same_within * std::abs(w) + least) continue;
        if (k == 0 || !(off < 0)) return 0;
        ++held_down;
      }
    return 2 * held_down < (widths - 1) * rows_.size() ? factor : 0;
  }

  NearestModel described(
      const Form& d, double d_power, const Form& v, double v_power, double factor) const {
    NearestModel n;
    n.width = width_, n.colours = colours_;
    n.power = d_power, n.masking_power = v_power, n.factor = factor;
    n.disguise = disguise_->slip;
    n.half_vector = half_.slip;
    n.guard = guard_;
    const auto over_form = [&](const Values& f, double width, std::span<const Row> rows) {
      const auto x = values_of(d.term, alpha_of(width, d_power), rows),
                 y = values_of(v.term, alpha_of(width, v_power), rows);
      Values r;
      for (std::size_t i = 0; i < rows.size(); ++i) r.push_back(f[i] / (factor * x[i] * y[i]));
      return r;
    };
    n.bite = bite_of(own_[width_], d_power, [&](double w) {
      const std::span one(&mirrored(), 1);
      return over_form(highlight(1, w, one), w, one)[0] / disguise_->factor(mirrored());
    });
    take_horizon(n, over_form(highlight(1, widths_[0], grazing_), widths_[0], grazing_));
    const auto short_id = [](std::size_t form) {
      const std::string id(catalogue()[form].id());
      return id.substr(id.find('.') + 1);
    };
    auto spec = model_of_lobe(short_id(d.term), short_id(v.term), "schlick");
    if (const auto form = take_fresnel(n, over_form)) spec.lobes[0].fresnel = short_id(*form);
    if (take_diffuse(n)) spec.diffuse = "lambert";
    n.spec = to_text(spec);
    const auto channels = channels_of(*foreign_term(term_)->function);
    n.operations = operations_in(n.spec, channels);
    if (n.lacks_diffuse) n.operations = operations_in("lambert+" + n.spec, channels);
    return n;
  }

  void take_horizon(NearestModel& n, const Values& over) const {
    std::size_t least = 0;
    for (std::size_t i = 0; i < over.size(); ++i)
      if (over[i] / disguise_->factor(grazing_[i]) <
          over[least] / disguise_->factor(grazing_[least]))
        least = i;
    constexpr double much = 0.8;
    const double left = over[least] / disguise_->factor(grazing_[least]);
    if (left < much)
      n.horizon = fmt::format(
          "a guard below holds its highlight down towards the horizon: {:.2g} of it is left at {}",
          left, auditing::text(grazing_[least]));
  }

  /// Sets what is said of F, and returns the form of the catalogue that it is, if there is one.
  std::optional<std::size_t> take_fresnel(NearestModel& n, const auto& over_form) const {
    if (!interface_.id.empty()) return find_term(interface_.id);
    const auto& colour = own_[colours_.f0[0]];
    const double f0 = low_of(colour) + 0.04 * (high_of(colour) - low_of(colour));
    auto f = over_form(highlight(f0, widths_[0], rows_), widths_[0], rows_);
    const bool is_of_f = disguise_ == &disguises[1];
    for (std::size_t i = 0; i < f.size() && !is_of_f; ++i) f[i] /= disguise_->factor(rows_[i]);
    const auto taken = as_taken(rows_);
    const auto is = [&](auto value) {
      for (std::size_t i = 0; i < f.size(); ++i)
        if (!(std::abs(f[i] - value(i)) < 2e-3)) return false;
      return true;
    };
    for (std::size_t form = 0; form < catalogue_size(); ++form) {
      const auto& e = catalogue()[form];
      if (e.role() != Role::fresnel || e.coupled || e.parameters.empty() ||
          e.parameters[0].name != "f0" || is_of_f)
        continue;
      Values p;
      for (const auto& q : e.parameters) p.push_back(q.start);
      p[0] = f0;
      const auto values = values_in(Number::double_, form, p, taken);
      if (is([&](std::size_t i) { return values[i]; })) return form;
    }
    n.fresnel_slip = fresnel_slip(f0, taken, f, true);
    n.other_fresnel = n.fresnel_slip.empty();
    return {};
  }

  /// Sets what is said of the diffuse part; true where it is Lambert's.
  bool take_diffuse(NearestModel& n) const {
    const bool has_colour = !colours_.diffuse.empty();
    Values with, without;
    const auto at = [&](Others others) {
      auto p = with_diffuse(own_, colours_, 0, others);
      p[width_] = widths_[0];
      if (colours_.eta) p[*colours_.eta] = usual_of(own_[*colours_.eta]);  // it is the highlight's
      return values_in(Number::double_, term_, p, rows_);
    };
    if (has_colour) {
      const auto& p = own_[colours_.diffuse[0]];
      with = diffuse(high_of(p), others_), without = diffuse(low_of(p), others_);
    } else {
      with = at(Others::usual), without = at(Others::low);
    }
    double least = 1e300, most = -1e300;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      least = std::min(least, with[i] - without[i]);
      most = std::max(most, with[i] - without[i]);
    }
    const bool is_lambert = least > 0 && most < least * (1 + same_within);
    n.lacks_diffuse = !is_lambert && most > same_within;
    return is_lambert;
  }

  std::size_t term_;
  std::vector<Parameter> own_;
  std::size_t width_;
  PartColours colours_;
  HalfVector half_;
  Interface interface_;
  std::vector<Row> rows_, grazing_;
  std::vector<double> widths_;
  std::vector<Scaled> scaled_;
  Others others_ = Others::low;
  const Disguise* disguise_ = nullptr;
  ByWidth white_;
  std::vector<bool> is_guarded_;  ///< the value there does not depend on the width
  double guard_ = 0;              ///< added to 4 NoL NoV
};

/// "no parameter is F0 by its name …", with the roles that the names of a metallic workflow suggest.
std::string advice_of_colours(std::span<const Parameter> own) {
  std::string colour, metallic;
  for (const auto& p : own) {
    const auto n = plain_name(stem_of(p.name));
    const auto has = [&](const char* word) { return n.find(word) != n.npos; };
    if (metallic.empty() && has("metal")) metallic = p.name;
    if (colour.empty() && (has("base") || has("albedo") || has("diffuse")))
      colour = stem_of(p.name);
  }
  if (!colour.empty() && !metallic.empty())
    return fmt::format(
        "no parameter is F0 by its name; --argument {}=basecolor {}=metallic says where it comes "
        "from",
        colour, metallic);
  return "no parameter is F0 by its name, as f0, specularColor, or albedo beside metallic; "
         "--argument NAME=f0 says which";
}

}  // namespace

std::optional<NearestModel> nearest_model(std::size_t term, std::string& why) {
  if (catalogue()[term].role() != Role::diffuse) return {};
  const auto own = known_parameters(term);
  std::vector<std::size_t> widths;
  const auto named = width_of(own);
  if (named) widths.push_back(*named);
  for (std::size_t k = 0; k < own.size() && !named; ++k)
    if (!is_colour(own[k]) && !is_eta(own[k])) widths.push_back(k);
  auto colours = possible_colours(own);
  const bool has_f0 = part_colours(own).has_value();
  if (!has_f0) {
    PartColours none;
    for (std::size_t k = 0; k < own.size(); ++k)
      if (is_colour(own[k])) none.diffuse.push_back(k);
    colours.push_back(std::move(none));
  }
  // What names say is looked at with all half vectors, and everything else with the right one.
  for (const auto& c : colours)
    for (const auto width : widths)
      for (const auto& half : half_vectors) {
        const bool is_said = named && has_f0 && &c == colours.data();
        if (!is_said && &half != half_vectors.data()) continue;
        for (const auto& i : interfaces(c, own))
          if (auto n = Search(term, width, c, half, i).found()) {
            if (!is_said && !c.f0.empty() && !is_f0(own[c.f0[0]]))
              n->f0 = stem_of(own[c.f0[0]].name);
            if (const auto said = part_colours(own);
                !is_said && said && said->metallic && n->disguise.empty() && !c.f0.empty() &&
                std::ranges::find(said->diffuse, c.f0[0]) != said->diffuse.end()) {
              const auto& metallic = own[*said->metallic];
              n->disguise =
                  fmt::format("{0} is F0 where {1} is {2:.4g}: expected where it is {3:.4g}", n->f0,
                              metallic.name, low_of(metallic), high_of(metallic));
            }
            return n;
          }
      }
  if (!has_highlight(term)) return {};
  why = has_f0 ? "" : advice_of_colours(own);
  if (!named)
    why += fmt::format(
        "{}no parameter is a width by its name, as alpha or roughness; --argument NAME=roughness "
        "says which",
        why.empty() ? "" : "; ");
  if (why.empty())
    why = fmt::format("no D and V of ours make its highlight at any power of {}", own[*named].name);
  return {};
}

}  // namespace gonio
