#include "reports/own/nearest_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/in_number/number.h"
#include "brdf/model/spec.h"
#include "geometry/direction.h"
#include "reports/finding/words.h"
#include "reports/measure/samples.h"
#include "reports/own/cost.h"
#include "reports/own/disguises.h"
#include "reports/own/parameters.h"
#include "reports/own/slip_forms.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using auditing::Row;
using auditing::Values;

/// Light and view mirrored at 30°: D and V are at their peaks, nearly.
const Row& mirrored() {
  static const Row row = auditing::row(30 * degree, 0, 30 * degree, std::numbers::pi);
  return row;
}

/// A term's values over rows, by width.
using ByWidth = std::vector<Values>;
/// Places of the least and of the largest.
std::array<std::size_t, 2> ends_of(const Values& v) {
  const auto [least, most] = std::ranges::minmax_element(v);
  return {static_cast<std::size_t>(least - v.begin()), static_cast<std::size_t>(most - v.begin())};
}

double middle_of(const Parameter& p) {
  return (low_of(p) + high_of(p)) / 2;
}

/// A form of the catalogue, or one that shaders have by a slip.
struct Form {
  std::size_t term;
  const SlipForm* slip;
  ByWidth values{};
  std::array<std::size_t, 2> ends{};  ///< rows of the least and of the largest at the widest

  std::string id() const {
    if (slip) return slip->like;
    const std::string whole(catalogue()[term].id());
    return whole.substr(whole.find('.') + 1);
  }
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
        second_(two_widths(own_)),
        colours_(colours),
        half_(half),
        interface_(interface) {
    // Away from the horizon: shaders add to a denominator there.
    constexpr double least_cosine = 0.3;
    for (const auto& r : auditing::rows_of(Role::diffuse))
      (std::min(r.nol, r.nov) < least_cosine ? grazing_ : rows_).push_back(r);
    Values over_cosines;
    for (const auto& r : rows_) over_cosines.push_back(1 / (r.nol * r.nov));
    cosine_ends_ = ends_of(over_cosines);
    widths_ = values_between(own_[width_], 4);
    // The widest first: there no guard bites.
    const auto powers = powers_of(own_[width_]);
    if (!narrows(powers[0])) std::ranges::reverse(widths_);
    for (const double power : powers)
      scaled_.push_back({power, forms(Role::ndf, power), forms(Role::masking, power), {}, {}});
  }

  std::optional<NearestModel> found() {
    for (const auto& d : disguises())
      for (const auto others : {Others::low, Others::usual}) {
        if (half_.cosines && &d != disguises().data()) continue;  // one slip at a time
        take_white(d, others);
        if (d.is_weight && !scales_with_f0()) continue;
        if (auto n = of_highlight(Sought::right)) return n;
      }
    if (half_.cosines) return {};
    if (std::ranges::any_of(own_, is_metallic) && !colours_.f0.empty()) {
      lambert_ = std::numbers::inv_pi;
      take_white(disguises()[0], Others::low);
      if (auto n = of_highlight(Sought::right)) return n;
      lambert_ = 0;
    }
    for (const auto sought : {Sought::guarded, Sought::slips})
      for (const auto others : {Others::low, Others::usual}) {
        take_white(disguises()[0], others);
        if (auto n = of_highlight(sought)) return n;
      }
    return {};
  }

 private:
  struct Scaled {
    double power;
    std::vector<Form> shapes, maskings, shape_slips, masking_slips;
  };
  enum class Sought { right, guarded, slips };

  /// The highlight at F0 = 1 by width, and the widths that a guard makes one.
  void take_white(const Disguise& disguise, Others others) {
    disguise_ = &disguise, others_ = others;
    white_.clear(), is_guarded_.clear();
    constexpr double same = 1e-9;
    for (const double w : widths_) {
      white_.push_back(highlight(1, w, rows_));
      const auto other = highlight(1, w * (1 + 1e-3), rows_);
      bool is_one = true;
      for (std::size_t i = 0; i < other.size(); ++i)
        is_one = is_one && std::abs(white_.back()[i] - other[i]) <= same * std::abs(other[i]);
      is_guarded_.push_back(is_one);
    }
    take_cap();
    peak_ = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (white_[0][i] > white_[0][peak_] && !is_capped(white_[0][i])) peak_ = i;
  }
  /// The value that many have and none exceeds: a clamp's.
  void take_cap() {
    double most = 0;
    for (const auto& v : white_) most = std::max(most, *std::ranges::max_element(v));
    constexpr double same = 1e-12;
    constexpr std::ptrdiff_t many = 4;
    cap_ = most * (1 - same);
    std::ptrdiff_t count = 0;
    for (const auto& v : white_)
      count += std::ranges::count_if(v, [&](double x) { return is_capped(x); });
    if (count < many) cap_ = std::numeric_limits<double>::infinity();
  }
  bool is_capped(double value) const { return value >= cap_; }

  bool scales_with_f0() const {
    const auto half = highlight(0.5, widths_[0], rows_);
    for (std::size_t i = 0; i < half.size(); ++i)
      if (!(std::abs(2 * half[i] / white_[0][i] - 1) < same_within)) return false;
    return true;
  }
  void set_width(Values& p, double width) const {
    p[width_] = width;
    if (second_ && (*second_)[0] == width_) p[(*second_)[1]] = width;
  }
  Values highlight(double f0, double width, std::span<const Row> rows) const {
    auto p = with_highlight(own_, colours_, f0, others_);
    set_width(p, width);
    auto f = values_in(Number::double_, term_, p, rows);
    for (double& x : f) x -= f0 * lambert_;
    if (interface_.id.empty()) return f;
    const auto of = interface_.values(as_taken(rows));
    for (std::size_t i = 0; i < f.size(); ++i) f[i] /= of[i];
    return f;
  }
  /// With a middling F0, which a highlight has, too.
  Values diffuse(double colour, Others others) const {
    auto p = with_diffuse(own_, colours_, colour, others);
    set_width(p, widths_[0]);
    for (const auto k : colours_.f0)
      if (!colours_.metallic) p[k] = middle_of(own_[k]);
    return values_in(Number::double_, term_, p, rows_);
  }
  /// Rows as a distribution and a Fresnel term of the shader's half vector have them.
  std::vector<Row> as_taken(std::span<const Row> rows) const {
    std::vector<Row> all(rows.begin(), rows.end());
    for (auto& r : all) {
      if (!half_.cosines) break;
      const auto [noh, voh] = half_.cosines(r);
      r.noh = half_.is_clamped ? std::min(noh, 1.0) : noh;
      r.voh = half_.is_clamped ? std::min(voh, 1.0) : voh;
      r.sin2_theta_h = 1 - r.noh * r.noh;
    }
    return all;
  }
  Values values_of(const Form& form, Role role, double alpha, std::span<const Row> rows) const {
    const auto at = role == Role::masking ? std::vector(rows.begin(), rows.end()) : as_taken(rows);
    if (!form.slip)
      return values_in(Number::double_, form.term,
                       Values(catalogue()[form.term].parameters.size(), alpha), at);
    Values v;
    for (const auto& r : at) v.push_back(form.slip->value(alpha, r));
    return v;
  }
  /// With its values from the widest as far as alpha is one of the form's; none of too few.
  void add(std::vector<Form>& all, Form form, Role role, double power, const Range& legal) const {
    for (const double w : widths_) {
      const double alpha = alpha_of(w, power);
      if (!legal.holds(alpha)) break;
      form.values.push_back(values_of(form, role, alpha, rows_));
    }
    constexpr std::size_t enough = 2;  // narrower ones may be no alpha of the form's
    if (form.values.size() < enough) return;
    form.ends = ends_of(form.values[0]);
    all.push_back(std::move(form));
  }
  /// Each form of a role.
  std::vector<Form> forms(Role role, double power) const {
    std::vector<Form> all;
    for (std::size_t form = 0; form < catalogue_size(); ++form) {
      const auto& e = catalogue()[form];
      const bool is_alpha_only =
          !e.anisotropic && !e.coupled &&
          (e.parameters.empty() || (e.parameters.size() == 1 && e.parameters[0].name == "alpha"));
      if (e.role() != role || !is_alpha_only) continue;
      add(all, {form, nullptr}, role, power,
          e.parameters.empty() ? Range{-1e300, 1e300} : e.parameters[0].legal);
    }
    return all;
  }
  void take_slips() {
    if (!scaled_[0].shape_slips.empty()) return;
    for (auto& s : scaled_)
      for (const auto& [role, into] :
           {std::pair{Role::ndf, &s.shape_slips}, {Role::masking, &s.masking_slips}})
        for (const auto& slip : slip_forms(role)) add(*into, {0, &slip}, role, s.power, {1e-4, 1});
  }

  std::optional<NearestModel> of_highlight(Sought sought) {
    if (sought == Sought::slips) take_slips();
    // One alpha for both is tried first.
    for (const bool is_one : {true, false})
      for (const auto& of_d : scaled_)
        for (const auto& of_v : scaled_) {
          if ((&of_d == &of_v) != is_one) continue;
          const auto found_in =
              [&](const std::vector<Form>& shapes,
                  const std::vector<Form>& maskings) -> std::optional<NearestModel> {
            for (const auto& d : shapes)
              for (const auto& v : maskings) {
                guard_.reset();
                // What a guard takes of the widest is little, and all else is exact.
                is_loose_ = sought == Sought::guarded && !take_guard(d, v);
                if (const double factor = factor_of(d, v); factor > 0)
                  return described(d, of_d.power, v, of_v.power, factor);
              }
            return {};
          };
          if (sought != Sought::slips) {
            if (auto n = found_in(of_d.shapes, of_v.maskings)) return n;
            continue;
          }
          if (auto n = found_in(of_d.shape_slips, of_v.maskings)) return n;
          if (auto n = found_in(of_d.shapes, of_v.masking_slips)) return n;
        }
    return {};
  }
  /// Takes the sum below that the highlight at the widest has beside D V: two places say how much, all others whether it is so.
  bool take_guard(const Form& d, const Form& v) {
    for (const auto kind : {HorizonGuard::Kind::sum, HorizonGuard::Kind::sum_of_v}) {
      const bool of_v = kind == HorizonGuard::Kind::sum_of_v;
      const auto x = [&](std::size_t i) {
        return of_v ? v.values[0][i] : 1 / (4 * rows_[i].nol * rows_[i].nov);
      };
      const auto y = [&](std::size_t i) { return d.values[0][i] * v.values[0][i] / white_[0][i]; };
      const auto [low, high] = of_v ? v.ends : cosine_ends_;
      const double slope = (y(high) - y(low)) / (x(high) - x(low)), at_0 = y(low) - slope * x(low);
      const double amount = slope / at_0;
      constexpr double most = 1;
      if (!(at_0 > 0) || !(amount > 1e-4) || !(amount < most)) continue;
      bool is = true;
      for (std::size_t i = 0; is && i < rows_.size(); ++i)
        is = std::abs((at_0 + slope * x(i)) / y(i) - 1) < same_within;
      if (is) guard_ = {kind, amount};
      if (is) return true;
    }
    return false;
  }
  /// The function's highlight over D V, where it is that: everywhere at the widest, and elsewhere but for rows that a guard holds
  /// down; 0 where it is not.
  double factor_of(const Form& d, const Form& v) const {
    const auto wanted = [&](std::size_t k, std::size_t i) {
      return d.values[k][i] * v.values[k][i] * disguise_->factor(rows_[i]) *
             (guard_ ? guard_->left(rows_[i], v.values[k][i]) : 1);
    };
    const double factor = white_[0][peak_] / wanted(0, peak_);
    if (!(factor > 0) || !std::isfinite(factor)) return 0;
    // Rounding where next to nothing is left, as of a sheen along the normal.
    constexpr double of_peak = 1e-13;
    std::size_t held_down = 0;
    const std::size_t widths = std::min(d.values.size(), v.values.size());
    constexpr std::size_t enough = 2;
    if (static_cast<std::size_t>(std::ranges::count(
            is_guarded_.begin(), is_guarded_.begin() + static_cast<std::ptrdiff_t>(widths),
            false)) < enough)
      return 0;
    for (std::size_t k = 0; k < widths; ++k) {
      const double least = of_peak * std::abs(*std::ranges::max_element(white_[k]));
      for (std::size_t i = 0; i < rows_.size() && !is_guarded_[k]; ++i) {
        const double w = factor * wanted(k, i), off = white_[k][i] - w;
        if (is_capped(white_[k][i]) && is_capped(w)) continue;
        constexpr double loose = 5e-3;
        if (std::abs(off) <= (is_loose_ ? loose : same_within) * std::abs(w) + least) continue;
        if (k == 0 || !(off < 0)) return 0;
        ++held_down;
      }
    }
    return 2 * held_down < (widths - 1) * rows_.size() ? factor : 0;
  }

  NearestModel described(
      const Form& d, double d_power, const Form& v, double v_power, double factor) {
    NearestModel n;
    n.width = width_, n.colours = colours_;
    n.power = d_power, n.masking_power = v_power, n.factor = factor;
    n.disguise = disguise_->slip;
    n.is_weight = disguise_->is_weight;
    n.half_vector = half_.slip;
    n.interface_slip = interface_.slip();
    for (const auto* form : {&d, &v})
      if (form->slip) n.form_slip = form->slip->slip;
    const auto over_form = [&](const Values& f, double width, std::span<const Row> rows) {
      const auto x = values_of(d, Role::ndf, alpha_of(width, d_power), rows),
                 y = values_of(v, Role::masking, alpha_of(width, v_power), rows);
      Values r;
      for (std::size_t i = 0; i < rows.size(); ++i) r.push_back(f[i] / (factor * x[i] * y[i]));
      return r;
    };
    const auto left_at = [&](double width, const Row& at) {
      const std::span one(&at, 1);
      return over_form(highlight(1, width, one), width, one)[0] / disguise_->factor(at);
    };
    n.bite = bite_of(own_[width_], d_power, [&](double w) { return left_at(w, mirrored()); });
    if (!guard_) {
      std::vector<Values> own(1),
          form{values_of(v, Role::masking, alpha_of(widths_[0], v_power), grazing_)};
      for (std::size_t i = 0; i < grazing_.size(); ++i)
        own[0].push_back(left_at(widths_[0], grazing_[i]) * form[0][i]);
      guard_ = guard_of(grazing_, own, form);
    }
    if (!std::isfinite(cap_))
      n.drop = drop_of([&](const Row& r) { return left_at(widths_[0], r); }, guard_);
    n.shape = d.id(), n.masking = v.id();
    auto spec = model_of_lobe(n.shape, n.masking, "schlick");
    const auto fresnel = take_fresnel(n, over_form, v.values[0]);
    if (const auto form = fresnel) {
      const std::string id(catalogue()[*form].id());
      spec.lobes[0].fresnel = id.substr(id.find('.') + 1);
    }
    n.keeps_lambert = lambert_ > 0;
    if (n.keeps_lambert)
      spec.diffuse = "lambert";
    else
      spec.diffuse = diffuse_of(n, fresnel);
    n.spec = to_text(spec);
    const auto channels = channels_of(*foreign_term(term_)->function);
    n.operations = operations_in(n.spec, channels);
    if (n.lacks_diffuse) n.operations = operations_in("lambert+" + n.spec, channels);
    return n;
  }

  /// Sets what is said of F, and returns the form of the catalogue that it is, if there is one.
  std::optional<std::size_t> take_fresnel(NearestModel& n,
                                          const auto& over_form,
                                          const Values& v_of_widest) const {
    if (!interface_.id.empty()) return find_term(interface_.id);
    const auto& colour = own_[colours_.f0[0]];
    const double f0 = low_of(colour) + 0.04 * (high_of(colour) - low_of(colour));
    const auto all = over_form(highlight(f0, widths_[0], rows_), widths_[0], rows_);
    const bool is_of_f = disguise_->is_of_f;
    const double least =
        1e-9 * std::abs(white_[0][peak_]);  // where D leaves nothing, F is not seen
    Values f;
    std::vector<Row> rows;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!(std::abs(white_[0][i]) > least)) continue;
      rows.push_back(rows_[i]);
      f.push_back(all[i] / (is_of_f ? 1 : disguise_->factor(rows_[i])) /
                  (guard_ ? guard_->left(rows_[i], v_of_widest[i]) : 1));
    }
    const auto taken = as_taken(rows);
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
      if (!is([&](std::size_t i) { return values[i]; })) continue;
      if (e.id() == "fresnel.constant" && !disguise_->is_weight &&
          varies_of_a_dielectric(over_form))
        n.fresnel_slip =
            "its metals have no Fresnel term: F0 is mixed in after it; expected F0 = "
            "mix(0.04, albedo, metallic) in its place";
      return form;
    }
    if (is([](std::size_t) { return 1.0; })) {
      n.fresnel_slip = "its highlight does not depend on F0: its Fresnel term is missing";
      return {};
    }
    n.fresnel_slip = fresnel_slip(f0, taken, f, true);
    if (n.fresnel_slip.empty()) n.fresnel_slip = fresnel_slip(f0, rows, f, true);
    n.other_fresnel = n.fresnel_slip.empty();
    return {};
  }

  /// Of a metallic workflow, whether F of what is no metal depends on the angle.
  bool varies_of_a_dielectric(const auto& over_form) const {
    if (!colours_.metallic) return false;
    auto p = with_diffuse(own_, colours_, low_of(own_[colours_.f0[0]]), others_);
    set_width(p, widths_[0]);
    const auto f = over_form(values_in(Number::double_, term_, p, rows_), widths_[0], rows_);
    const auto [least, most] = std::ranges::minmax(f);
    constexpr double much = 1.5;
    return least > 0 && most > much * least;
  }

  /// Sets what is said of the diffuse part, and returns that of ours which it is: Lambert's, maybe under the highlight's F, or none.
  std::string diffuse_of(NearestModel& n, const std::optional<std::size_t>& fresnel) const {
    const bool has_colour = !colours_.diffuse.empty();
    Values with, without;
    const auto at = [&](Others others) {
      auto p = with_diffuse(own_, colours_, 0, others);
      set_width(p, widths_[0]);
      if (colours_.eta) p[*colours_.eta] = usual_of(own_[*colours_.eta]);  // it is the highlight's
      return values_in(Number::double_, term_, p, rows_);
    };
    if (has_colour) {
      const auto& p = own_[colours_.diffuse[0]];
      with = diffuse(high_of(p), others_), without = diffuse(low_of(p), others_);
    } else {
      with = at(Others::usual), without = at(Others::low);
    }
    double largest = 0;
    const auto is_even = [&](const auto& share) {
      double least = 1e300, most = -1e300;
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        const double part = with[i] - without[i];
        largest = std::max(largest, part);
        least = std::min(least, part / share(i));
        most = std::max(most, part / share(i));
      }
      return least > 0 && most < least * (1 + same_within);
    };
    if (is_even([](std::size_t) { return 1.0; })) return "lambert";
    n.lacks_diffuse = largest > same_within;
    if (!n.lacks_diffuse || !fresnel || colours_.f0.empty() || colours_.metallic) return "";
    Values p;
    for (const auto& q : catalogue()[*fresnel].parameters) p.push_back(q.start);
    p[0] = middle_of(own_[colours_.f0[0]]);
    const auto f = values_in(Number::double_, *fresnel, p, as_taken(rows_));
    const bool is_of_f = is_even([&](std::size_t i) { return f[i]; });
    if (is_of_f)
      n.diffuse_slip =
          "its diffuse part is multiplied by F: expected 1 − F, what the highlight leaves";
    if (!is_of_f && !is_even([&](std::size_t i) { return 1 - f[i]; })) return "";
    n.lacks_diffuse = false;
    return "lambert.coupled";
  }

  std::size_t term_;
  std::vector<Parameter> own_;
  std::size_t width_;
  std::optional<std::array<std::size_t, 2>> second_;  ///< along tangent and bitangent: one here
  double lambert_ = 0;  ///< what a diffuse part of F0's colour has beside the highlight
  PartColours colours_;
  HalfVector half_;
  Interface interface_;
  std::vector<Row> rows_, grazing_;
  std::vector<double> widths_;
  std::vector<Scaled> scaled_;
  Others others_ = Others::low;
  const Disguise* disguise_ = nullptr;
  ByWidth white_;
  bool is_loose_ = false;
  std::size_t peak_ = 0;  ///< row of the largest at the widest that no clamp holds
  double cap_ = 0;        ///< the largest value that a clamp leaves
  std::array<std::size_t, 2> cosine_ends_{};  ///< rows of the largest and of the least NoL NoV
  std::vector<bool> is_guarded_;              ///< the value there does not depend on the width
  std::optional<HorizonGuard> guard_;         ///< that the forms looked at have
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
  const auto named = width_of(own);
  const auto widths = possible_widths(own);
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
      for (const auto& half : half_vectors()) {
        const bool is_said = named && has_f0 && &c == colours.data();
        if (!is_said && half.cosines) continue;
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
