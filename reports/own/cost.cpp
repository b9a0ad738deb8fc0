#include "reports/own/cost.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/cost/model_operations.h"
#include "brdf/in_number/number.h"
#include "brdf/model/model.h"
#include "geometry/direction.h"
#include "reports/measure/samples.h"
#include "reports/own/compare.h"
#include "reports/own/pairing.h"
#include "reports/own/parameters.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using auditing::Row;
using auditing::Values;

/// Light and view at 45° over several azimuths: a diffuse part is even there, a highlight is not.
const std::vector<Row>& turned() {
  static const std::vector<Row> rows = [] {
    std::vector<Row> all;
    for (const double phi : {0.0, 60.0, 120.0, 150.0, 180.0})
      all.push_back(auditing::row(45 * degree, 0, 45 * degree, phi * degree));
    return all;
  }();
  return rows;
}

/// Values of parameters with all colours dark but for one; the width and all others are at their ends or at their defaults.
std::vector<Values> one_colour_each(std::span<const Parameter> parameters) {
  std::vector<std::size_t> bright;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    if (is_colour(parameters[k])) bright.push_back(k);
  if (bright.empty()) bright.push_back(parameters.size());
  const auto width = width_of(parameters);
  std::vector<Values> all;
  for (const auto one : bright)
    for (const auto of_width : {low_of, usual_of, high_of})
      for (const auto of_others : {low_of, usual_of, high_of}) {
        Values v;
        for (std::size_t k = 0; k < parameters.size(); ++k) {
          const auto& p = parameters[k];
          const bool is_bright =
              one < parameters.size() && stem_of(p.name) == stem_of(parameters[one].name);
          v.push_back(k == width      ? of_width(p)
                      : !is_colour(p) ? of_others(p)
                      : is_bright     ? high_of(p)
                                      : low_of(p));
        }
        all.push_back(std::move(v));
      }
  return all;
}

bool has_coat(std::span<const Parameter> parameters) {
  return std::ranges::any_of(parameters, [](const Parameter& p) {
    const auto n = plain_name(p.meaning);
    return !is_colour(p) && n.find("coat") != n.npos && !is_rough(p);
  });
}

/// True where one of the colours makes more at 60° from the plane of the light than a narrow highlight leaves there.
bool has_diffuse(std::size_t term, std::span<const Parameter> parameters) {
  const auto width = width_of(parameters);
  return std::ranges::any_of(one_colour_each(parameters), [&](Values v) {
    for (std::size_t k = 0; k < v.size(); ++k) {
      const auto& p = parameters[k];
      const bool is_narrow_high = narrows(powers_of(p)[0]);
      if (is_metallic(p)) v[k] = low_of(p);
      if (k == width) v[k] = is_narrow_high ? high_of(p) : low_of(p);
    }
    constexpr double least = 0.03;  // white has 1/π
    return values_in(Number::double_, term, v, turned())[1] > least;
  });
}

}  // namespace

std::size_t channels_of(const foreign::Function& f) {
  const bool is_colour =
      f.programs.size() > 1 ||
      std::ranges::any_of(f.parameters, &foreign::FunctionParameter::per_channel);
  return is_colour ? 3 : 1;
}

std::size_t operations_in_one(std::size_t term) {
  if (const auto* own = foreign_term(term)) return operations_of(*own->function, 1).total();
  return operations_of(term).sample.total();
}

std::size_t operations_in(const std::string& spec, std::size_t channels) {
  auto below = parse_model(spec);
  std::size_t of_coat = 0;
  if (const auto coat = std::exchange(below.coat, {})) {  // white: f = F D V + (1 − F) f_below
    ModelSpec alone;
    alone.lobes.push_back(*coat);
    of_coat = operations_of(compose(alone, 1)).total() + 1 + 2 * channels;
  }
  return of_coat + operations_of(compose(below, channels)).total();
}

std::string channels_text(const foreign::Function& f, bool in_one) {
  return channels_of(f) == 1 ? "" : in_one ? " in one channel" : " in 3 channels";
}

bool has_highlight(std::size_t term) {
  constexpr double uneven = 2.5;  // Oren–Nayar's most is 1.5 at 45°
  return std::ranges::any_of(one_colour_each(known_parameters(term)), [&](const Values& p) {
    const auto f = values_in(Number::double_, term, p, turned());
    double least = 1e300, most = 0;
    for (const double x : f)
      if (std::isfinite(x)) least = std::min(least, x), most = std::max(most, x);
    return most > 1e-12 && most > uneven * least;
  });
}

namespace {

/// D and V of ours that a highlight may be like, and the model in which they stand.
struct Kind {
  const char *ndf, *masking, *fresnel;
  bool is_sheen;
};
constexpr std::array kinds{Kind{"ggx", "smith_ggx.correlated", "schlick", false},
                           Kind{"beckmann", "smith_beckmann.correlated", "schlick", false},
                           Kind{"blinn_phong", "implicit", "schlick", false},
                           Kind{"charlie", "smith_charlie.correlated", "constant", true}};

/// How unlike two shapes are whatever their scales: 0 to 1.
double unlikeness(const Values& f, const Values& g) {
  double ff = 0, gg = 0, fg = 0;
  for (std::size_t i = 0; i < f.size(); ++i)
    if (std::isfinite(f[i]) && std::isfinite(g[i])) {
      ff += f[i] * f[i];
      gg += g[i] * g[i];
      fg += f[i] * g[i];
    }
  return ff > 0 && gg > 0 ? 1 - fg * fg / (ff * gg) : 1;
}

/// The kind that a function's highlight is nearest to by its values, over each map of each parameter that may be its width; GGX, where
/// no other is much nearer.
const Kind& kind_of(std::size_t term, std::span<const Parameter> own) {
  const auto colours = possible_colours(own);
  const auto& rows = auditing::rows_of(Role::diffuse);
  std::array<double, kinds.size()> least;
  least.fill(1);
  constexpr std::size_t places = 3;
  for (const auto k : possible_widths(own)) {
    std::vector<Values> white;
    const auto at = values_between(own[k], places);
    for (const double w : at) {
      auto p =
          colours.empty() ? Values(own.size()) : with_highlight(own, colours[0], 1, Others::usual);
      if (colours.empty()) std::ranges::transform(own, p.begin(), usual_of);
      p[k] = w;
      white.push_back(values_in(Number::double_, term, p, rows));
    }
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
      const std::size_t ndf = find_term(kinds[kind].ndf, Role::ndf),
                        masking = find_term(kinds[kind].masking, Role::masking);
      for (const double power : every_power(own[k])) {
        double sum = 0;
        for (std::size_t j = 0; j < places; ++j) {
          const double alpha = alpha_of(at[j], power);
          if (!catalogue()[ndf].parameters[0].legal.holds(alpha)) {
            sum = places;
            break;
          }
          auto g = values_in(Number::double_, ndf, std::array{alpha}, rows);
          const auto v = values_in(Number::double_, masking,
                                   Values(catalogue()[masking].parameters.size(), alpha), rows);
          for (std::size_t i = 0; i < g.size(); ++i) g[i] *= v[i];
          sum += unlikeness(white[j], g);
        }
        least[kind] = std::min(least[kind], sum / places);
      }
    }
  }
  const auto nearest = static_cast<std::size_t>(std::ranges::min_element(least) - least.begin());
  constexpr double much = 0.5;  // of GGX's, which is the usual one
  return kinds[least[nearest] < much * least[0] ? nearest : 0];
}

}  // namespace

OfTheKind model_of_the_kind(std::size_t term) {
  const auto parameters = known_parameters(term);
  const std::size_t channels = channels_of(*foreign_term(term)->function);
  const auto of = [&](const std::string& spec) {
    return OfTheKind{spec, operations_in(spec, channels),
                     operations_of(*foreign_term(term)->function, channels).total()};
  };
  if (has_highlight(term)) {
    const auto& kind = kind_of(term, parameters);
    // A sheen is as even as a diffuse part: its colours tell them apart.
    const auto colours = possible_colours(parameters);
    const bool is_on_base = kind.is_sheen ? !colours.empty() && !colours[0].diffuse.empty()
                                          : has_diffuse(term, parameters);
    auto found = of(fmt::format(
        "{}{}/{}/{}{}", is_on_base ? "lambert+" : "", kind.ndf, kind.masking, kind.fresnel,
        has_coat(parameters) ? "+coat:ggx/smith_ggx.correlated/schlick" : ""));
    found.is_sheen = kind.is_sheen;
    return found;
  }
  Domain domain;
  for (const auto& p : parameters)
    if (std::isnan(p.start)) domain.emplace_back(p.name, Range{low_of(p), high_of(p)});
  const std::size_t lambert = find_term("diffuse.lambert");
  std::size_t nearest = lambert;
  double least = difference_between(term, lambert, domain);
  for (const auto id : {"diffuse.oren_nayar", "diffuse.oren_nayar.fujii", "diffuse.eon",
                        "diffuse.disney", "diffuse.frostbite"}) {
    const std::size_t form = find_term(id);
    constexpr double much = 0.7;  // of Lambert's difference, which is the plainest
    if (const double apart = difference_between(term, form, domain);
        apart < least * (nearest == lambert ? much : 1))
      least = apart, nearest = form;
  }
  return {std::string(catalogue()[nearest].id()), operations_in_one(nearest),
          operations_in_one(term)};
}

}  // namespace gonio
