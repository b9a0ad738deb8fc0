#include "reports/own/parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "brdf/in_number/number.h"
#include "geometry/direction.h"
#include "reports/measure/samples.h"
#include "reports/own/parameters.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using auditing::Row;
using auditing::Values;

constexpr double rounded = 0.02;  ///< by which the albedo of a smooth highlight is off

/// A whole function whose width and colours are known.
class Parts {
 public:
  Parts(std::size_t term,
        const OwnAlbedo& albedo,
        const std::optional<NearestModel>& model,
        bool is_sheen,
        bool guessed_pi,
        PartsAudit& into)
      : term_(term),
        albedo_(albedo),
        own_(known_parameters(term)),
        model_(model),
        is_sheen_(is_sheen),
        guessed_pi_(guessed_pi),
        a_(into) {
    width_ = width_of(own_);
    colours_ = part_colours(own_);
    if (!model) return;
    width_ = model->width, colours_ = model->colours;
    kept_ = model->keeps_lambert ? 1 : 0;
  }

  void take() {
    take_coat();
    if (!colours_) return;
    take_cosine();
    const bool is_whole = take_highlight();
    if (narrowest_ > 0) take_metal();
    if (!is_whole) return;
    take_anisotropy();
    take_diffuse();
  }

 private:
  /// The highlight's F0 where it is as bright as it can be.
  double brightest() const {
    if (!colours_->f0.empty()) return 1;
    const double eta = colours_->eta ? high_of(own_[*colours_->eta]) : 1.5;
    const double root = (eta - 1) / (eta + 1);
    return root * root;
  }
  Values with_white(Others others) const {
    const double f0 = colours_->f0.empty() ? 1 : high_of(own_[colours_->f0[0]]);
    return with_highlight(own_, *colours_, f0, others);
  }

  /// Along the normal masking takes nothing from a smooth highlight, and all light returns.  Says what is lost or gained.
  /// \return  whether it returns what it should
  bool take_highlight() {
    if (!width_ || is_sheen_ || std::isnan(own_[*width_].start)) return false;
    const auto& w = own_[*width_];
    power_ = model_ ? model_->power : conventions_of(w)[0];
    const double narrow = narrows(power_) ? w.legal.high : w.legal.low;
    constexpr double smooth = 0.1;  // of alpha: GGX still returns 0.98 there
    if (!(alpha_of(narrow, power_) <= smooth)) return false;
    const auto at = [&](double v, Others others) {
      auto p = with_white(others);
      p[*width_] = v;
      if (const auto two = two_widths(own_)) p[(*two)[0]] = p[(*two)[1]] = v;
      return (albedo_.along_normal(p) - kept_) / brightest();
    };
    // With all else at its lower end there may be no light at all.
    others_ = at(w.start, Others::low) > 0 ? Others::low : Others::usual;
    const double least = 1e-3 * (w.legal.high - w.legal.low);
    narrowest_ = narrows(power_) ? narrow : std::max(narrow, least);
    a_.highlight = FoundAt{at(narrowest_, others_), fmt::format("{} {:.4g}", w.name, narrowest_)};
    const bool is_whole = std::abs(a_.highlight->value - 1) < rounded;
    if (model_ && (model_->bite || model_->factor != 1)) return is_whole;  // named by its form
    for (const double factor : {std::numbers::pi, 4.0, 4 * std::numbers::pi, std::numbers::inv_pi})
      if (std::abs(a_.highlight->value / factor - 1) < rounded && (factor > 1 || guessed_pi_))
        a_.slips.push_back(highlight_text(factor, guessed_pi_));
    if (is_inverted(w, [&](double v) { return at(v, others_); })) {
      a_.slips.push_back(fmt::format(
          "{0} is used as a {1}: the highlight widens towards {0} {2:.4g}; expected 1 − {0} in its "
          "place",
          w.name, narrows(power_) ? "roughness" : "smoothness", narrowest_));
      a_.highlight.reset();
      return false;
    }
    if (const auto bite = bite_of(w, power_, [&](double v) { return at(v, others_); })) {
      const auto text = fmt::format(
          "its smooth highlight loses light: {:.2g} of it returns along the normal at "
          "{}, and 0.9 only {} {:.3g}; a guard or a clamp cuts its peak{}",
          a_.highlight->value, a_.highlight->at, narrows(power_) ? "to" : "from", bite->from,
          bite->is_little ? "; right where no material is so smooth" : "");
      (bite->is_little ? a_.to_check : a_.slips).push_back(text);
    }
    return is_whole;
  }

  /// True where the highlight narrows towards the end that its name promises to be wide.  A guard cuts only the narrowest peaks.
  bool is_inverted(const Parameter& w, const auto& at) const {
    if (power_ == of_exponent) return false;
    const double wide = narrows(power_) ? w.legal.low : w.legal.high;
    const auto from_wide = [&](double part) { return at(wide + part * (narrowest_ - wide)); };
    constexpr double near = 0.25, far = 0.6, narrow = 0.93, much = 0.05, wider = 0.75;
    if (!(at(narrowest_) < wider)) return false;
    const double near_wide = from_wide(near);
    return near_wide > narrow && near_wide < 1 + much && from_wide(far) < near_wide - much;
  }

  /// A highlight that is whole at the default of an anisotropy is so at its ends, where D has the right norm.
  void take_anisotropy() {
    constexpr double loss = 0.2, gain = 0.05;
    for (std::size_t k = 0; k < own_.size(); ++k) {
      if (!is_anisotropy(own_[k])) continue;
      for (const double end : {low_of(own_[k]), high_of(own_[k])}) {
        auto p = with_white(Others::usual);
        p[*width_] = narrowest_, p[k] = end;
        const double v = albedo_.along_normal(p) / brightest();
        if (!std::isfinite(v) || (v > 1 - loss && v < 1 + gain)) continue;
        a_.slips.push_back(fmt::format(
            "the norm of its D is wrong where {} is {:.4g}: its highlight returns {:.3g} of the "
            "light along the normal, expected 1, as with 1/(π αx αy)",
            own_[k].name, end, v));
        break;
      }
    }
  }

  /// Away from a narrow peak a metal reflects next to nothing: what is left there is a diffuse part.
  void take_metal() {
    if (!colours_->metallic || colours_->f0.empty()) return;
    const auto& metallic = own_[*colours_->metallic];
    const auto& colour = own_[colours_->f0[0]];
    const double grey = (low_of(colour) + high_of(colour)) / 2;  // of white F leaves nothing
    auto p = with_highlight(own_, *colours_, grey, others_);
    p[*width_] = narrowest_;
    const auto at = [&](double v, const Row& row) {
      p[*colours_->metallic] = v;
      return values_in(Number::double_, term_, p, std::span(&row, 1))[0];
    };
    const auto peak = auditing::row(0, 0, 0, 0);
    const double low = at(low_of(metallic), peak), high = at(high_of(metallic), peak);
    const double middle = at((low_of(metallic) + high_of(metallic)) / 2, peak);
    constexpr double mixed_twice = 0.25, same = 0.01;
    if (std::abs((middle - low) / (high - low) - mixed_twice) < same)
      a_.slips.push_back(
          fmt::format("its F0 is mixed twice: halfway over {} it is a quarter of the way from a "
                      "dielectric's to the colour, expected half",
                      metallic.name));
    const auto off_peak = auditing::row(45 * degree, 0, 45 * degree, 60 * degree);
    constexpr double least = 0.3;  // of a dielectric's
    const double of_metal = at(high_of(metallic), off_peak), other = at(low_of(metallic), off_peak);
    if (other > 0 && of_metal > least * other)
      a_.slips.push_back(
          fmt::format("its diffuse part is left where {0} is {1:.4g}: expected (1 − {0}) times the "
                      "diffuse part",
                      metallic.name, high_of(metallic)));
  }

  /// What a diffuse part returns along the normal, its colour being 1, is not far from 1, whichever form it has.
  void take_diffuse() {
    if (colours_->diffuse.empty()) return;
    const auto& colour = own_[colours_->diffuse[0]];
    PartColours one = *colours_;
    std::erase_if(one.diffuse,
                  [&](std::size_t k) { return stem_of(own_[k].name) != stem_of(colour.name); });
    const auto at = [&](double v) {
      return albedo_.along_normal(with_diffuse(own_, one, v, Others::usual));
    };
    const double v =
        (at(high_of(colour)) - at(low_of(colour))) / (high_of(colour) - low_of(colour));
    constexpr double least = 0.75, most = 1.2;
    if (v > least * std::numbers::pi && v < most * std::numbers::pi)
      a_.slips.push_back("its diffuse part is " + factor_text(std::numbers::pi));
  }

  /// Where one part is reciprocal only with the cosine taken out or put in, and the other as it is.
  void take_cosine() {
    enum class Cosine { unknown, none, too_many, too_few };
    const auto& rows = auditing::rows_of(Role::diffuse);
    std::vector<Row> other;
    for (const auto& r : rows) other.push_back(auditing::exchanged(r));
    const auto of = [&](const Values& with, const Values& without) {
      const auto part = [&](const std::vector<Row>& at) {
        auto v = values_in(Number::double_, term_, with, at);
        const auto w = values_in(Number::double_, term_, without, at);
        for (std::size_t i = 0; i < v.size(); ++i) v[i] -= w[i];
        return v;
      };
      const auto v = part(rows), w = part(other);
      const auto is = [&](double (*scale)(const Row&)) {
        double most = 0, off = 0;
        for (std::size_t i = 0; i < v.size(); ++i) {
          if (!std::isfinite(v[i]) || !std::isfinite(w[i])) continue;
          const double x = v[i] * scale(rows[i]), y = w[i] * scale(other[i]);
          const double size = std::max(std::abs(x), std::abs(y));
          most = std::max(most, size);
          if (size > 0) off = std::max(off, std::abs(x - y) / size);
        }
        return most > 0 && off < same_within;
      };
      return is([](const Row&) { return 1.0; })               ? Cosine::none
             : is([](const Row& r) { return 1 / r.nol; })     ? Cosine::too_many
             : is([](const Row& r) { return double{r.nol}; }) ? Cosine::too_few
                                                              : Cosine::unknown;
    };
    if (colours_->diffuse.empty() || colours_->f0.empty()) return;
    const auto d = with_diffuse(own_, *colours_, high_of(own_[colours_->diffuse[0]]),
                                Others::usual),
               none =
                   with_diffuse(own_, *colours_, low_of(own_[colours_->diffuse[0]]), Others::usual);
    const auto dark = with_highlight(own_, *colours_, low_of(own_[colours_->f0[0]]), Others::usual);
    const auto diffuse = of(d, none), highlight = of(with_white(Others::usual), dark);
    const auto say = [&](Cosine part, Cosine beside, const char* name, const char* other_name) {
      if (beside == Cosine::none && part == Cosine::too_many)
        a_.slips.push_back(
            fmt::format("its {} has the cosine NoL in it, which its {} has not", name, other_name));
      if (beside == Cosine::none && part == Cosine::too_few)
        a_.slips.push_back(
            fmt::format("its {} lacks the cosine NoL, which its {} has", name, other_name));
    };
    say(diffuse, highlight, "diffuse part", "highlight");
    say(highlight, diffuse, "highlight", "diffuse part");
  }

  /// A coat that is added whatever lies below takes nothing from it.
  void take_coat() {
    const auto coat = std::ranges::find_if(own_, [](const Parameter& p) {
      const auto n = plain_name(p.meaning);
      return !is_colour(p) && (n == "coat" || n == "clearcoat" || n.ends_with("coatweight") ||
                               n.ends_with("coatstrength") || n.ends_with("coatintensity") ||
                               n.ends_with("coatamount"));
    });
    if (coat == own_.end()) return;
    const auto k = static_cast<std::size_t>(coat - own_.begin());
    const auto values = [&](double strength, bool bright) {
      Values p;
      for (const auto& q : own_)
        p.push_back(!is_colour(q) ? usual_of(q) : bright ? high_of(q) : low_of(q));
      p[k] = strength;
      return p;
    };
    const auto of = [&](double strength, bool bright) {
      return values_in(Number::double_, term_, values(strength, bright),
                       auditing::rows_of(Role::diffuse));
    };
    const double none = low_of(*coat), full = high_of(*coat);
    const auto bare = of(none, false), bare_bright = of(none, true), over = of(full, false),
               over_bright = of(full, true);
    double base = 0, taken = 0;
    for (std::size_t i = 0; i < bare.size(); ++i) {
      base = std::max(base, std::abs(bare_bright[i] - bare[i]));
      taken = std::max(taken, std::abs((over_bright[i] - bare_bright[i]) - (over[i] - bare[i])));
    }
    if (!(base > 0) || !(taken < 1e-6 * base)) return;
    const double adds =
        albedo_.along_normal(values(full, false)) - albedo_.along_normal(values(none, false));
    constexpr double weak = 0.02;  // Disney's returns 0.01, a varnish 0.04
    if (adds > weak)
      a_.slips.push_back(fmt::format(
          "its {} is added and takes nothing from what lies below: expected the base times 1 − F "
          "of the coat",
          coat->name));
    else if (adds > 0)
      a_.to_check.push_back(fmt::format(
          "its {} takes nothing from what lies below: right where it is as weak as Disney's",
          coat->name));
  }

  std::size_t term_;
  const OwnAlbedo& albedo_;
  std::vector<Parameter> own_;
  const std::optional<NearestModel>& model_;
  bool is_sheen_, guessed_pi_;
  PartsAudit& a_;
  std::optional<std::size_t> width_;
  std::optional<PartColours> colours_;
  double power_ = 1, narrowest_ = 0;
  double kept_ = 0;  ///< albedo of a diffuse part that a highlight of F0 = 1 leaves
  Others others_ = Others::low;
};

}  // namespace

PartsAudit audit_parts(std::size_t term,
                       const OwnAlbedo& albedo,
                       const std::optional<NearestModel>& model,
                       bool is_sheen,
                       bool guessed_pi) {
  PartsAudit a;
  Parts(term, albedo, model, is_sheen, guessed_pi, a).take();
  return a;
}

}  // namespace gonio
