#include "foreign/function.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "base/error.h"
#include "base/nearest_names.h"
#include "foreign/compiled_file.h"
#include "foreign/directions.h"
#include "foreign/guesses.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::foreign {
namespace {

constexpr std::size_t most_read = 16;  ///< parameters of a function
/// OpVariable
constexpr std::uint32_t spirv_variable = 59;

/// True of a function that takes two directions, as a whole model does.
bool takes_two(const SpirvModule& m, const SpirvFunction& f) {
  std::set<std::string> taken;
  for (const auto& [argument, type] : f.parameters) {
    const Id held = m.type(type).op == spirv_pointer ? m.type(type).element : type;
    if (m.is_of_numbers(held)) taken.insert(direction_of(m.name(argument), m.size(held), {}));
  }
  return (taken.contains("L") && taken.contains("V")) ||
         (taken.contains("nol") && taken.contains("nov") && taken.contains("noh"));
}

/// The function that a file means: one called BRDF, the only one, or the only whole model: a function of two directions that no other
/// such calls, and that by its value is no masking or Fresnel term.
std::string main_function(const Compiled& c, const std::string& path) {
  const SpirvModule& m = *c.module;
  const auto& all = c.functions;
  std::vector<std::string> names, models;
  for (const auto& [name, id] : all) {
    names.push_back(name);
    if (plain(name) == "brdf") return name;
    if (takes_two(m, m.functions().at(id)) || all.size() == 1) models.push_back(name);
  }
  const auto calls = [&](const std::string& caller, const std::string& called) {
    return caller != called && m.calls(all.at(caller), all.at(called));
  };
  const auto candidates = models;
  std::erase_if(models, [&](const std::string& called) {
    return std::ranges::any_of(candidates, [&](const std::string& n) { return calls(n, called); });
  });
  if (models.size() > 1)
    std::erase_if(models, [&](const std::string& name) {
      try {
        return read_function({path, name}).stands != Stands::lobe;
      } catch (const Error&) {
        return true;  // what cannot be run is none
      }
    });
  if (models.size() == 1) return models[0];
  if (names.empty()) refuse_nameless(c, path);
  if (models.empty())
    throw wrong_usage(fmt::format("{}: which function? it has: {}", path, fmt::join(names, ", ")));
  throw wrong_usage(
      fmt::format("{0}: which function? its whole models are {1}; name one, as {0}:{2}", path,
                  fmt::join(models, ", "), models[0]));
}

/// A parameter as the text declares it: a name for several numbers.
struct Raw {
  std::string name;
  std::size_t size, first;  ///< its numbers among all
};

class Builder {
 public:
  /// \param by_half  its directions are seen from the half vector: all that is left of them is VoH
  Builder(const Name& name, const Compiled& c, std::optional<Stands> as, bool by_half)
      : c_(c), m_(*c.module), by_half_(by_half) {
    f_.name = name;
    if (f_.name.function.empty()) f_.name.function = main_function(c, name.file);
    f_.sha256 = c.source.sha256;
    f_.float_constants = c.source.language != Language::glsl;
    as_ = as;
  }

  Function built() {
    const auto& all = c_.functions;
    const auto id = all.find(f_.name.function);
    if (const auto without = c_.void_functions.find(f_.name.function);
        id == all.end() && without != c_.void_functions.end())
      refuse(f_.name.file, why_none(without->second));
    if (id == all.end()) {
      std::vector<std::string_view> names;
      for (const auto& [n, i] : all) names.push_back(n);
      refuse_name(f_.name.function, names, fmt::format("function of {}", f_.name.file));
    }
    f_.line = m_.functions().at(id->second).line;
    Translation t;
    try {
      t = translate(m_, id->second,
                    [&](Program& p, const std::string& n, std::size_t size, Kind k) {
                      return bind(p, n, size, k);
                    });
    } catch (const Refused& r) {
      refuse(f_.name.file, r.line > 0 ? r : Refused(r.what(), f_.line));
    } catch (const std::out_of_range&) {
      throw bad_input(f_.name.file, fmt::format("line {}", f_.line),
                      "SPIR-V that refers to what it has not", "a function of numbers");
    }
    f_.notes = std::move(t.notes);
    if (t.program.outputs.size() == 4) t.program.outputs.pop_back();
    if (c_.source.explorer)
      std::ranges::stable_sort(raw_, {}, [&](const Raw& r) {
        const auto* d = c_.source.find(r.name);
        return d ? d - c_.source.declared.data() : std::ssize(c_.source.declared);
      });
    divide_into_channels(t.program);
    expect_known_names();
    std::erase_if(f_.arguments, [&](const Argument& a) {  // a global that has a value of its own
      return a.stands_for == "parameter" &&
             std::ranges::none_of(f_.parameters, [&](const FunctionParameter& p) {
               return p.name.starts_with(a.name);
             });
    });
    forget_unread_globals(m_.functions().at(id->second));
    if (as_.value_or(Stands::fresnel) == Stands::fresnel && gives_fresnel(f_)) take_as_voh();
    f_.stands = as_.value_or(stands_for(f_));
    guess_includes(f_);
    for (auto& program : f_.programs) scale(program);
    return std::move(f_);
  }

 private:
  std::vector<Ref> bind(Program& p, const std::string& name, std::size_t size, Kind kind) {
    const Reading& reading = f_.name.reading;
    const Declared* const declared = c_.source.find(name);
    const auto fixed = reading.values.find(name);
    const bool is_fixed = fixed != reading.values.end() && fixed->second.size() == 1;
    const bool is_fixed_here =
        fixed == reading.values.end() && declared && declared->is_fixed() && !c_.source.explorer;
    if (kind != Kind::number || is_fixed || is_fixed_here) {
      if (!is_fixed && !(declared && !declared->start.empty()))
        throw wrong_usage(
            fmt::format("{}: {} is no number that varies: give its value, as in --bounds {}=1",
                        f_.name.file, name, name));
      const double v = is_fixed ? fixed->second[0] : declared->start[0];
      note(name, fmt::format("{:g}", v));
      return std::vector<Ref>(size, p.constant(kind == Kind::truth ? (v != 0) : v, kind));
    }
    const std::string stands_for =
        c_.source.explorer && declared ? std::string() : direction_of(name, size, reading);
    note(name, stands_for.empty() ? "parameter" : stands_for);
    if (!stands_for.empty() && size == 3)
      return by_half_ ? from_half(p, stands_for[0]) : coordinates(p, stands_for[0]);
    if (!stands_for.empty()) return {cosine(p, stands_for)};
    auto known = std::ranges::find(raw_, name, &Raw::name);
    if (known == raw_.end()) {
      known = raw_.insert(known, {name, size, numbers_});
      numbers_ += size;
    }
    const Raw& raw = *known;
    std::vector<Ref> r;
    for (std::size_t k = 0; k < size; ++k) r.push_back(p.input(false, raw.first + k));
    return r;
  }
  void note(const std::string& name, const std::string& stands_for) {
    if (std::ranges::find(f_.arguments, name, &Argument::name) == f_.arguments.end())
      f_.arguments.push_back({name, stands_for});
  }

  /// Why a function that gives nothing cannot be run: what it does that no function of numbers does, or that it gives nothing.
  Refused why_none(Id function) const {
    const int line = m_.functions().at(function).line;
    try {
      std::size_t count = 0;
      translate(m_, function, [&](Program& p, const std::string&, std::size_t size, Kind kind) {
        std::vector<Ref> all;
        for (std::size_t k = 0; k < size; ++k)
          all.push_back(kind == Kind::number ? p.input(false, count++) : p.constant(1, kind));
        return all;
      });
    } catch (const Refused& r) {
      return {r.what(), r.line > 0 ? r.line : line};
    } catch (const std::out_of_range&) {
      // It gives nothing all the same.
    }
    return {"no value that it returns", line};
  }
  /// True of a variable of the file, or a member of one, whether or not the function reads it.
  bool is_global(const std::string& name) const {
    return std::ranges::any_of(m_.globals(), [&](const Instruction& g) {
      if (g.op != spirv_variable) return false;
      const auto& held = m_.type(m_.type(g.type).element);
      for (std::size_t k = 0; k < held.members.size(); ++k)
        if (m_.member_name(m_.type(g.type).element, k) == name) return true;
      return m_.name(g.id) == name;
    });
  }
  void expect_known_names() const {
    const auto known = [&](const std::string& n) {
      return std::ranges::find(f_.arguments, n, &Argument::name) != f_.arguments.end() ||
             std::ranges::find(f_.parameters, n, &FunctionParameter::name) != f_.parameters.end() ||
             is_global(n);
    };
    for (const auto& [n, v] : f_.name.reading.arguments)
      if (!known(n)) throw wrong_usage(fmt::format("{} has no argument '{}'", text_of(f_.name), n));
    for (const auto& [n, v] : f_.name.reading.values)
      if (!known(n))
        throw wrong_usage(fmt::format("{} has no parameter '{}'", text_of(f_.name), n));
  }

  /// One program a channel, each of the parameters that it reads; colours are one a channel where each channel reads its own.
  void divide_into_channels(const Program& whole) {
    std::vector<Program> one;
    for (const Ref o : whole.outputs) {
      Program p = whole;
      p.outputs = {o};
      one.push_back(trimmed(p));
    }
    bool own = one.size() == 3;
    for (std::size_t c = 0; c < one.size(); ++c)
      for (const auto& r : raw_)
        if (r.size == 3)
          for (std::size_t k = 0; k < 3; ++k)
            own = own && (k == c || !reads(one[c], false, r.first + k));
    for (const auto& r : raw_)
      for (std::size_t k = 0; k < r.size; ++k) {
        const std::size_t at = r.first + k;
        const bool is_read =
            std::ranges::any_of(one, [&](const Program& p) { return reads(p, false, at); });
        const bool colour = own && r.size == 3;
        if (colour && k > 0) {
          place_[at] = place_[r.first];
          continue;
        }
        const bool any = colour ? std::ranges::any_of(one,
                                                      [&](const Program& p) {
                                                        return reads(p, false, r.first) ||
                                                               reads(p, false, r.first + 1) ||
                                                               reads(p, false, r.first + 2);
                                                      })
                                : is_read;
        if (!any) continue;
        place_[at] = f_.parameters.size();
        add_parameter(r, k, colour);
      }
    if (f_.parameters.size() > most_read)
      throw bad_input(f_.name.file, fmt::format("line {}", f_.line),
                      fmt::format("{} parameters", f_.parameters.size()),
                      fmt::format("at most {}: fix some, as in --bounds NAME=0.5", most_read));
    for (auto& p : one) renumber(p);
    if (std::ranges::all_of(one, [&](const Program& p) { return is_same(p, one[0]); }))
      one.resize(1);
    f_.programs = std::move(one);
  }
  void add_parameter(const Raw& r, std::size_t k, bool colour) {
    const Declared* const d = c_.source.find(r.name);
    FunctionParameter p{r.name};
    if (r.size > 1 && !colour) {
      p.name += '_';
      p.name += std::string_view(r.size == 3 ? "rgb" : "xyzw").substr(k, 1);
    }
    p.per_channel = colour;
    const auto given = f_.name.reading.values.find(r.name);
    const bool is_given = given != f_.name.reading.values.end();
    p.bounded = d || is_given;
    if (d) p.range = d->range;
    if (is_given) p.range = {given->second[0], given->second[1]};
    if (d && !d->start.empty())
      p.start = d->start[d->start.size() == 3 ? k : 0];
    else
      p.start = p.range.low > 0 && p.range.high > 100 * p.range.low
                    ? std::sqrt(p.range.low * p.range.high)
                    : (p.range.low + p.range.high) / 2;
    if (is_given && given->second.size() > 2) p.start = given->second[2];
    if (colour && d && d->start.size() == 3 && !(is_given && given->second.size() > 2)) {
      p.start = (d->start[0] + d->start[1] + d->start[2]) / 3;
      p.colour = {d->start[0], d->start[1], d->start[2]};
      for (double& x : *p.colour) x = std::clamp(x, p.range.low, p.range.high);
    }
    p.start = std::clamp(p.start, p.range.low, p.range.high);
    f_.parameters.push_back(std::move(p));
  }
  void renumber(Program& p) {
    for (auto& i : p.inputs)
      if (!i.of_sample) i.index = place_.at(i.index);
  }
  /// True of programs that compute the same in the same way, in whichever order their nodes stand.
  static bool is_same(const Program& a, const Program& b) {
    if (a.outputs.size() != b.outputs.size()) return false;
    std::vector<Ref> in_b(a.nodes.size(), nothing);
    const auto pair_up = [&](Ref x, Ref y) {
      if ((x < 0) != (y < 0)) return false;
      if (x < 0) return true;
      auto& known = in_b[static_cast<std::size_t>(x)];
      if (known < 0) known = y;
      return known == y;
    };
    const auto input_at = [](const Program& p, Ref node) {
      return *std::ranges::find(p.inputs, node, &Input::node);
    };
    for (std::size_t k = 0; k < a.outputs.size(); ++k)
      if (!pair_up(a.outputs[k], b.outputs[k])) return false;
    // What a node is made of stands before it.
    for (std::size_t k = a.nodes.size(); k-- > 0;) {
      if (in_b[k] < 0) continue;
      const Node &x = a.nodes[k], &y = b.nodes[static_cast<std::size_t>(in_b[k])];
      if (x.op != y.op || x.kind != y.kind || (x.op == Op::constant && x.value != y.value) ||
          !pair_up(x.a, y.a) || !pair_up(x.b, y.b) || !pair_up(x.c, y.c))
        return false;
      if (x.op != Op::input) continue;
      const Input i = input_at(a, static_cast<Ref>(k)), j = input_at(b, in_b[k]);
      if (i.of_sample != j.of_sample || i.index != j.index) return false;
    }
    return true;
  }

  /// Directions of the file's variables count as arguments where the function reads them.
  void forget_unread_globals(const SpirvFunction& function) {
    const auto is_own = [&](const Argument& a) {
      return std::ranges::any_of(function.parameters,
                                 [&](const auto& p) { return m_.name(p.first) == a.name; });
    };
    const auto is_read = [&](const std::string& direction) {
      for (const auto& [d, cosines] : {std::pair{"L", std::array{"nol", "xol", "yol"}},
                                       {"V", {"nov", "xov", "yov"}},
                                       {"H", {"noh", "xoh", "yoh"}}})
        if (direction == d)
          return std::ranges::any_of(cosines, [&](const char* c) { return reads_angle(f_, c); });
      return true;
    };
    const auto own = f_.arguments;
    std::erase_if(f_.arguments, [&](const Argument& a) {
      const bool is_twice = std::ranges::any_of(own, [&](const Argument& b) {
        return is_own(b) && b.name != a.name && b.stands_for == a.stands_for;
      });
      return a.stands_for != "parameter" && !is_own(a) && (is_twice || !is_read(a.stands_for));
    });
  }
  /// Makes its one cosine VoH.
  void take_as_voh() {
    for (auto& program : f_.programs)
      for (auto& i : program.inputs)
        if (i.of_sample) i.index = angle("voh");
    for (auto& a : f_.arguments)
      if (a.stands_for == "nol" || a.stands_for == "nov") a.stands_for = "voh";
  }
  /// Divides the value by what it includes, so that it is f in 1/sr, or V.
  void scale(Program& p) {
    Ref r = p.outputs[0];
    const auto has = [&](std::string_view what) {
      return f_.includes.find(what) != std::string::npos;
    };
    if (f_.is_g)
      r = p(Op::div, r, p(Op::mul, p.constant(4), p(Op::mul, cosine(p, "nol"), cosine(p, "nov"))));
    if (f_.stands == Stands::lobe && has("cosine")) r = p(Op::div, r, cosine(p, "nol"));
    if (f_.stands == Stands::lobe && has("pi")) r = p(Op::div, r, p.constant(std::numbers::pi));
    p.outputs[0] = r;
  }

  const Compiled& c_;
  const SpirvModule& m_;
  Function f_;
  bool by_half_;
  std::optional<Stands> as_;
  std::vector<Raw> raw_;
  std::size_t numbers_ = 0;
  std::map<std::size_t, std::size_t> place_;  ///< number of a parameter as written → parameter
};

}  // namespace

Function read_function(const Name& name, std::optional<Stands> as) {
  const auto c = file_of(name.file);
  auto f = Builder(name, *c, as, false).built();
  if (as.value_or(Stands::fresnel) != Stands::fresnel || !depends_on_voh_only(f)) return f;
  return Builder(name, *c, as, true).built();
}

std::vector<Entry> list_functions(const std::string& file) {
  const auto c = file_of(file);
  std::vector<Entry> all;
  auto named = c->functions;
  named.insert(c->void_functions.begin(), c->void_functions.end());
  for (const auto& [name, id] : named) {
    Entry e{name, c->module->functions().at(id).line};
    for (const auto& [argument, type] : c->module->functions().at(id).parameters)
      e.arguments.emplace_back(c->module->name(argument));
    all.push_back(std::move(e));
  }
  for (const auto& [name, id] : c->shadowed) {
    Entry e{name, c->module->functions().at(id).line};
    e.is_shadowed = true;
    e.refused = bad_input(file, fmt::format("line {}", e.line), "a function whose name another has",
                          fmt::format("a name of its own: {} means the one in line {}", name,
                                      c->module->functions().at(named.at(name)).line))
                    .what();
    all.push_back(std::move(e));
  }
  std::ranges::sort(all, {}, [](const Entry& e) { return std::pair(e.line, e.function); });
  if (all.empty()) refuse_nameless(*c, file);
  return all;
}

}  // namespace gonio::foreign
