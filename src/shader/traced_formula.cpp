#include "shader/traced_formula.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "brdf/formula/scattering.h"
#include "brdf/function/any_function.h"
#include "brdf/function/map_functions.h"
#include "number/dual.h"
#include "scene/kernel/multiple.h"
#include "stability/value_over.h"

#include <fmt/format.h>

namespace gonio::shader {
namespace {

constexpr std::array<std::string_view, 11> angle_names{
    "NoL", "NoV", "NoH", "VoH", "sin2_theta_h", "XoH", "YoH", "XoL", "YoL", "XoV", "YoV"};

/// What the variables of a role's part are called.
std::string_view letter(Role role) {
  switch (role) {
    case Role::ndf:
      return "D";
    case Role::masking:
      return "V";
    case Role::fresnel:
      return "F";
    case Role::diffuse:
      break;
  }
  return "diffuse";
}

/// Formula of numbers that constants are folded in.
template <class F>
class Tracer {
 public:
  using T = Traced<F>;

  explicit Tracer(TracedFormula& formula) : formula_(formula), recording_(formula.trace) {
    std::array<T, angle_names.size()> a;
    for (std::size_t k = 0; k < a.size(); ++k) {
      a[k] = T::input(std::string(angle_names[k]));
      formula.angles.push_back({std::string(angle_names[k]), a[k].node()});
    }
    angles_ = {{a[0], a[1], a[2], a[3], a[4]}, a[5], a[6], a[7], a[8], a[9], a[10]};
  }

  T argument(const std::string& name, const Parameter& about, bool colour) {
    const T x = T::input(name);
    formula_.parameters.push_back({name, x.node(), colour, &about});
    return x;
  }
  T known(const std::string& name, std::span<const double> values) {
    std::vector<double> kept;
    for (const double v : values) kept.push_back(static_cast<double>(static_cast<F>(v)));
    for (const double v : kept)
      if (!std::isfinite(v))
        throw wrong_usage(
            fmt::format("{} is more than {} holds", name, name_of(formula_.precision)));
    formula_.known.emplace_back(name, kept);
    if (std::ranges::adjacent_find(kept, std::not_equal_to<>()) == kept.end())
      return T(static_cast<F>(kept.front()));
    const T x = T::input(name);
    formula_.colours.push_back({name, x.node(), {kept[0], kept[1], kept[2]}});
    return x;
  }
  /// A term's fraction, its numerator and denominator named after its role, those of a second lobe with a 2.
  Quotient<T> term(std::size_t index, std::span<const T> parameters) {
    const auto& entry = catalogue()[index];
    auto name = std::string(letter(entry.role()));
    const auto earlier = std::ranges::count_if(formula_.terms, [&](const UsedTerm& t) {
      return catalogue()[t.term].role() == entry.role();
    });
    if (earlier > 0) name += std::to_string(earlier + 1);
    UsedTerm used{index, name, {}};
    for (const auto& p : parameters)
      used.known.push_back(p.is_known() ? std::optional(static_cast<double>(p.known()))
                                        : std::nullopt);
    formula_.terms.push_back(std::move(used));
    formula_.trace.begin(name);
    if (const auto* own = foreign_term(index); own && own->function->programs.size() > 1)
      throw wrong_usage(fmt::format(
          "{}: its channels are formulas of their own, and gonio shader writes one for all",
          foreign::text_of(own->function->name)));
    auto q = any_function<T>(index)(parameters, angles_);
    call(q.num, q.whole ? name : name + "_num");
    if (!q.whole) call(q.den, name + "_den");
    formula_.trace.begin("f");
    return q;
  }
  /// The light that single scattering of a lobe loses, given back: what is added to f.
  ///
  /// \param f0  the lobe's Fresnel term at normal incidence; schlicks: it is Schlick's
  T compensation(const Compensating& c, const T& lobe, const T& f0, const T& alpha, bool schlicks) {
    formula_.trace.begin("bounces");
    const auto argument_of = [&](const char* name, const Parameter& about) {
      return argument(name, about, formula_.colour && about.per_channel);
    };
    const auto f_average = [&] {
      return schlicks ? schlick_average<T>(f0)
                      : argument_of("F_average", KullaContyLobe<T>::parameters[3]);
    };
    if (c.by == Compensation::kulla_conty) {
      using Lobe = KullaContyLobe<T>;
      formula_.maps.push_back(&Lobe::about);
      const T light = argument_of("E_light", Lobe::parameters[0]),
              view = argument_of("E_view", Lobe::parameters[1]),
              average = argument_of("E_average", Lobe::parameters[2]);
      return Lobe::apply(std::array{light, view, average, f_average()})[0];
    }
    T e;
    if (c.albedo == AlbedoFrom::fit) {
      formula_.maps.push_back(&AlbedoFit<T>::about);
      e = AlbedoFit<T>::apply(std::array{alpha, angles_.nov})[0];
    } else {
      e = argument_of("E_view", e_parameter);
    }
    if (c.by == Compensation::turquin) {
      formula_.maps.push_back(&Turquin<T>::about);
      return scene::added_by_turquin<T>(lobe, e, f0);
    }
    formula_.maps.push_back(&FdezAguera<T>::about);
    return scene::added_by_fdez_aguera<T>(lobe, e, f_average());
  }
  /// A Fresnel term's F0.
  T at_normal_incidence(std::size_t fresnel, std::span<const T> parameters) const {
    auto facing = angles_;
    facing.voh = T(1);
    return any_function<T>(fresnel)(parameters, facing).value();
  }
  void finish(const T& value, std::span<const std::string> derivatives) {
    formula_.results.push_back({"value", value.node()});
    call(value, "f");
    add(derivatives);
  }
  /// The same of a map's outputs.
  void finish(std::span<const std::string_view> names,
              const std::vector<T>& values,
              std::span<const std::string> derivatives) {
    if (values.size() > 1 && !derivatives.empty())
      throw wrong_usage(fmt::format("{} has {} outputs: --derivatives goes with one", formula_.id,
                                    values.size()));
    for (std::size_t k = 0; k < values.size(); ++k)
      formula_.results.push_back({std::string(names[k]), values[k].node()});
    add(derivatives);
  }

 private:
  void add(std::span<const std::string> derivatives) {
    const Trace of_value = formula_.trace;  // without what derivatives add
    for (const auto& name : derivatives) {
      const auto by = "by_" + name;
      if (std::ranges::find(formula_.results, by, &Result::name) == formula_.results.end())
        derive(of_value, name);
    }
    leave_what_is_read();
  }
  void call(const T& x, const std::string& name) {
    if (!x.is_known()) formula_.trace.call(x.node(), name);
  }
  void derive(const Trace& before, const std::string& name) {
    using D = Dual<T, 1>;
    const auto parameter = std::ranges::find(formula_.parameters, name, &Argument::name);
    if (parameter == formula_.parameters.end()) {
      if (std::ranges::find(formula_.known, name,
                            &std::pair<std::string, std::vector<double>>::first) !=
          formula_.known.end())
        throw wrong_usage(fmt::format(
            "no derivative by '{0}': it is a constant; --inputs {0} keeps it as an argument",
            name));
      std::vector<std::string_view> names;
      for (const auto& p : formula_.parameters) names.push_back(p.name);
      refuse_name(name, names, "parameter to derive by");
    }
    formula_.trace.begin("by_" + name);
    std::vector<D> inputs;
    for (std::size_t k = 0; k < before.nodes().size(); ++k)
      if (before.nodes()[k].kind == Trace::Kind::input) {
        const auto x = T::at(static_cast<int>(k));
        inputs.push_back(static_cast<int>(k) == parameter->node ? D::variable(x, 0) : D(x));
      }
    // Values are there already: what is new are the slopes.
    const auto all = replay<D>(before, inputs, [&](int node, D& x) {
      if (!x.v.is_known()) x.v = T::at(node);
    });
    const T slope = all[static_cast<std::size_t>(formula_.results[0].node)].d[0];
    formula_.results.push_back({"by_" + name, slope.node()});
    ++formula_.derivatives;
    call(slope, "by_" + name);
  }
  void leave_what_is_read() {
    const auto live = formula_.live();
    for (std::size_t k = 0; k < live.size(); ++k) {
      const auto& node = formula_.trace.nodes()[k];
      if (live[k] && node.kind == Trace::Kind::constant && !std::isfinite(node.value))
        throw wrong_usage(fmt::format("{} has constants that {} does not hold", formula_.id,
                                      name_of(formula_.precision)));
    }
    const auto idle = [&](const auto& a) { return !live[static_cast<std::size_t>(a.node)]; };
    std::erase_if(formula_.parameters, idle);
    std::erase_if(formula_.angles, idle);
    std::erase_if(formula_.colours, idle);
  }

  TracedFormula& formula_;
  Trace::Recording recording_;
  FrameAngles<T> angles_;
};

template <class F>
void trace(const BoundModel& bound,
           std::span<const std::string> arguments,
           std::span<const std::string> derivatives,
           const std::optional<Compensating>& compensating,
           TracedFormula& formula) {
  const Model& m = bound.model;
  Tracer<F> tracer(formula);
  using T = Traced<F>;
  std::vector<T> parameters;
  for (const auto& p : m.parameters) {
    const auto values = std::span(bound.values).subspan(p.first, p.count);
    const bool stays = std::ranges::find(arguments, p.name) != arguments.end();
    const bool given = std::ranges::find(bound.given, p.name) != bound.given.end();
    if (&p == m.tangent()) {
      if (stays) throw wrong_usage("--inputs tangent: whoever calls the function gives the frame");
      formula.tangent = values.front();
      if (given) formula.known.emplace_back(p.name, std::vector(values.begin(), values.end()));
      parameters.push_back(T(0));
    } else if (given && !stays) {
      parameters.push_back(tracer.known(p.name, values));
    } else {
      parameters.push_back(tracer.argument(p.name, *p.about, p.count > 1));
    }
  }
  const auto own = [&](const TermUse& use) {
    std::vector<T> values;
    for (const auto k : use.parameters) values.push_back(parameters[k]);
    return values;
  };
  std::vector<Quotient<T>> terms;
  T value = stability::value_of_terms<T>(
      m, [&](const TermUse& use) { return terms.emplace_back(tracer.term(use.term, own(use))); });
  if (compensating) {
    const auto& first = m.lobes.front();
    const auto of_lobe = std::span(terms).subspan(m.diffuse.size(), 3);
    const T lobe = (of_lobe[0] * of_lobe[1] * of_lobe[2]).value();
    value = value +
            tracer.compensation(*compensating, lobe,
                                tracer.at_normal_incidence(first.fresnel.term, own(first.fresnel)),
                                own(first.ndf)[0],
                                catalogue()[first.fresnel.term].id() == "fresnel.schlick");
  }
  tracer.finish(value, derivatives);
}

template <class F>
void trace(std::size_t term, std::span<const std::string> derivatives, TracedFormula& formula) {
  const auto& entry = catalogue()[term];
  Tracer<F> tracer(formula);
  std::vector<Traced<F>> parameters;
  for (const auto& p : entry.parameters)
    parameters.push_back(tracer.argument(std::string(p.name), p, false));
  tracer.finish(tracer.term(term, parameters).value(), derivatives);
}

template <class F>
void trace_of_map(std::size_t map,
                  std::span<const std::string> derivatives,
                  TracedFormula& formula) {
  const auto& entry = maps()[map];
  Tracer<F> tracer(formula);
  formula.maps.push_back(entry.about);
  formula.trace.begin("map");
  std::vector<Traced<F>> parameters;
  for (const auto& p : entry.parameters)
    parameters.push_back(tracer.argument(std::string(p.name), p, false));
  tracer.finish(entry.outputs, map_functions<Traced<F>>()[map](parameters), derivatives);
}

}  // namespace

std::vector<bool> TracedFormula::live() const {
  std::vector<bool> is(trace.nodes().size());
  for (const auto& r : results) is[static_cast<std::size_t>(r.node)] = true;
  for (std::size_t k = is.size(); k-- > 0;)
    if (is[k])
      for (const int of : trace.nodes()[k].of)
        if (of >= 0) is[static_cast<std::size_t>(of)] = true;
  return is;
}

std::vector<bool> TracedFormula::coloured() const {
  std::vector<bool> is(trace.nodes().size());
  for (const auto& p : parameters)
    if (p.colour) is[static_cast<std::size_t>(p.node)] = true;
  for (const auto& c : colours) is[static_cast<std::size_t>(c.node)] = true;
  for (std::size_t k = 0; k < is.size(); ++k)
    for (const int of : trace.nodes()[k].of)
      if (of >= 0 && is[static_cast<std::size_t>(of)]) is[k] = true;
  return is;
}

Operations TracedFormula::operations() const {
  using Kind = Trace::Kind;
  Operations sum;
  const auto alive = live(), wide = coloured();
  for (std::size_t k = 0; k < alive.size(); ++k) {
    if (!alive[k]) continue;
    const std::size_t n = wide[k] ? 3 : 1;
    switch (trace.nodes()[k].kind) {
      case Kind::add:
      case Kind::subtract:
        sum[Operation::add] += n;
        break;
      case Kind::multiply:
        sum[Operation::mul] += n;
        break;
      case Kind::divide:
        sum[Operation::div] += n;
        break;
      case Kind::sqrt:
        sum[Operation::sqrt] += n;
        break;
      case Kind::exp:
        sum[Operation::exp] += n;
        break;
      case Kind::log:
        sum[Operation::log] += n;
        break;
      case Kind::less:
        sum[Operation::compare] += n;
        break;
      case Kind::select:
        sum[Operation::select] += n;
        break;
      case Kind::max:
      case Kind::min:
        sum[Operation::compare] += n;
        sum[Operation::select] += n;
        break;
      case Kind::constant:
      case Kind::input:
      case Kind::negate:
      case Kind::both:
      case Kind::either:
      case Kind::no:
        break;
    }
  }
  return sum;
}

TracedFormula trace_model(const BoundModel& bound,
                          Precision precision,
                          std::span<const std::string> arguments,
                          std::span<const std::string> derivatives,
                          const std::optional<Compensating>& compensating) {
  const Model& m = bound.model;
  if (m.channels != 1 && m.channels != 3)
    throw wrong_usage(fmt::format("{} channels: a shader's function has one or three", m.channels));
  for (const auto& name : arguments)
    if (!m.find(name)) {
      std::vector<std::string_view> names;
      for (const auto& p : m.parameters) names.push_back(p.name);
      refuse_name(name, names, "parameter");
    }
  if (compensating) {
    if (m.lobes.empty())
      throw wrong_usage(fmt::format("model '{}' has no lobe to compensate", to_text(m.spec)));
    const auto& lobe = m.lobes.front();
    const bool fitted = catalogue()[lobe.ndf.term].id() == "ndf.ggx" &&
                        catalogue()[lobe.masking.term].id() == "masking.smith_ggx.correlated" &&
                        compensating->by != Compensation::kulla_conty;
    if (compensating->albedo == AlbedoFrom::fit && !fitted)
      throw wrong_usage(
          "the fitted albedo is of ndf.ggx under masking.smith_ggx.correlated, and of one "
          "direction: not for kulla_conty");
  }
  TracedFormula formula;
  formula.id = to_text(m.spec);
  formula.precision = precision;
  formula.is_model = true;
  formula.colour = m.channels == 3;
  formula.anisotropic = m.anisotropic;
  if (precision == Precision::half)
    trace<Half>(bound, arguments, derivatives, compensating, formula);
  else
    trace<float>(bound, arguments, derivatives, compensating, formula);
  // A function of a file may read directions although the surface may be turned: whoever calls it
  // gives any frame.
  formula.anisotropic |= std::ranges::any_of(formula.angles, [](const Argument& a) {
    return a.name.starts_with('X') || a.name.starts_with('Y');
  });
  return formula;
}

TracedFormula trace_term(std::size_t term,
                         Precision precision,
                         std::span<const std::string> derivatives) {
  const auto& entry = catalogue()[term];
  TracedFormula formula;
  formula.id = entry.id();
  formula.precision = precision;
  formula.anisotropic = entry.anisotropic;
  if (precision == Precision::half)
    trace<Half>(term, derivatives, formula);
  else
    trace<float>(term, derivatives, formula);
  return formula;
}

TracedFormula trace_map(std::size_t map,
                        Precision precision,
                        std::span<const std::string> derivatives) {
  TracedFormula formula;
  formula.id = maps()[map].about->id;
  formula.precision = precision;
  if (precision == Precision::half)
    trace_of_map<Half>(map, derivatives, formula);
  else
    trace_of_map<float>(map, derivatives, formula);
  return formula;
}

}  // namespace gonio::shader
