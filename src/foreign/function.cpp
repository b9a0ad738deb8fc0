#include "foreign/function.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <mutex>
#include <numbers>
#include <set>

#include "base/error.h"
#include "base/nearest_names.h"
#include "base/numbers.h"
#include "base/text.h"
#include "foreign/compile.h"
#include "foreign/interpret.h"
#include "foreign/spirv_module.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::foreign {
namespace {

constexpr std::size_t most_read = 16;  ///< parameters of a function
/// OpTypeStruct, OpTypePointer, OpVariable
constexpr std::uint32_t spirv_struct = 30, spirv_pointer = 32, spirv_variable = 59;

// ---- names of arguments
// ---------------------------------------------------------------------------

/// The name in lower case without underscores: "n_dot_l" and "NdotL" become "ndotl".
std::string plain(std::string_view name) {
  std::string s;
  for (const char c : name)
    if (c != '_') s += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return s;
}

/// What a vector of that name stands for; empty where it is none of the usual ones.  lightDirectionWS is as light.
std::string vector_of(std::string s) {
  static const std::map<std::string, std::string_view> all{
      {"n", "N"},       {"normal", "N"},  {"nrm", "N"},  {"l", "L"},       {"light", "L"},
      {"wi", "L"},      {"v", "V"},       {"view", "V"}, {"eye", "V"},     {"camera", "V"},
      {"wo", "V"},      {"h", "H"},       {"half", "H"}, {"halfway", "H"}, {"x", "X"},
      {"t", "X"},       {"tangent", "X"}, {"y", "Y"},    {"b", "Y"},       {"bitangent", "Y"},
      {"binormal", "Y"}};
  for (const std::string_view space : {"ws", "vs", "ts", "os"})
    if (s.size() > 2 && s.ends_with(space)) s.resize(s.size() - space.size());
  for (const std::string_view kind : {"direction", "vector", "dir", "vec"})
    if (s.size() > kind.size() && s.ends_with(kind)) s.resize(s.size() - kind.size());
  for (const std::string_view before : {"world", "surface", "to"})
    if (s.size() > before.size() && s.starts_with(before)) s.erase(0, before.size());
  const auto known = all.find(s);
  return known == all.end() ? "" : std::string(known->second);
}

/// What --argument says of a parameter that no name says: how it enters a model.
constexpr std::array<std::string_view, 8> roles{"f0",        "alpha",     "roughness", "smoothness",
                                                "shininess", "basecolor", "metallic",  "eta"};

/// The usual name of a cosine between two of n l v h t b, however it is written; empty where it is none.
std::string cosine_of(const std::string& s) {
  if (s == "costheta" || s == "cosine" || s == "costhetad") return "voh";
  if (s == "costhetai" || s == "costhetal") return "nol";
  if (s == "costhetao" || s == "costhetav") return "nov";
  if (s == "costhetah" || s == "costhetam" || s == "cosh") return "noh";
  if (s == "sin2thetah" || s == "sinthetah2") return "sin2_theta_h";
  std::string pair = s;
  for (const char* between : {"dot", "o"})
    if (const auto at = s.find(between);
        at == 1 && s.size() == std::string_view(between).size() + 2)
      pair = {s.front(), s.back()};
  if (s.size() == 5 && s.starts_with("dot")) pair = s.substr(3);
  if (pair.size() != 2 ||
      (s.size() == 2 && s != "nl" && s != "nv" && s != "nh" && s != "vh" && s != "lh" && s != "lv"))
    return "";
  for (char& c : pair) c = c == 't' ? 'x' : c == 'b' ? 'y' : c;
  static const std::map<std::string, std::string> known{
      {"nl", "nol"}, {"nv", "nov"}, {"nh", "noh"}, {"vh", "voh"}, {"lh", "voh"}, {"lv", "lov"},
      {"xh", "xoh"}, {"yh", "yoh"}, {"xl", "xol"}, {"yl", "yol"}, {"xv", "xov"}, {"yv", "yov"}};
  for (const auto& p : {pair, std::string(pair.rbegin(), pair.rend())})
    if (const auto k = known.find(p); k != known.end()) return k->second;
  return "";
}

/// What an argument of that name and size stands for: N L V H X Y or a cosine; empty for a parameter.
std::string direction_of(const std::string& name, std::size_t size, const Reading& reading) {
  const auto given = reading.arguments.find(name);
  const std::string s = plain(given == reading.arguments.end() ? name : given->second);
  std::string found;
  if (size == 3)
    found = vector_of(s);
  else if (size == 1)
    found = cosine_of(s);
  const bool is_role = s == "parameter" || std::ranges::find(roles, s) != roles.end();
  if (given != reading.arguments.end() && found.empty() && !is_role)
    throw wrong_usage(fmt::format(
        "argument {}={}: expected {}; or of a parameter its role: {}", name, given->second,
        size == 3 ? "N, L, V, H, X or Y" : "nol, nov, noh, voh, lov, sin2_theta_h, xoh …",
        fmt::join(roles, ", ")));
  return found;
}

std::size_t angle(std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(angle_names, name) - angle_names.begin());
}

/// Scalars of a direction, in the frame N = z.
std::vector<Ref> coordinates(Program& p, char direction) {
  const auto in = [&](std::string_view n) { return p.input(true, angle(n)); };
  switch (direction) {
    case 'N':
      return {p.frame_zero(), p.frame_zero(), p.constant(1)};
    case 'X':
      return {p.constant(1), p.frame_zero(), p.frame_zero()};
    case 'Y':
      return {p.frame_zero(), p.constant(1), p.frame_zero()};
    case 'L':
      return {in("xol"), in("yol"), in("nol")};
    case 'V':
      return {in("xov"), in("yov"), in("nov")};
    default:
      return {in("xoh"), in("yoh"), in("noh")};
  }
}

Ref cosine(Program& p, const std::string& name) {
  if (name != "lov") return p.input(true, angle(name));
  const auto l = coordinates(p, 'L'), v = coordinates(p, 'V');
  Ref s = p(Op::mul, l[0], v[0]);
  for (std::size_t k = 1; k < 3; ++k) s = p(Op::add, s, p(Op::mul, l[k], v[k]));
  return s;
}

// ---- files
// ------------------------------------------------------------------------------------------

struct Compiled {
  Source source;
  std::unique_ptr<const SpirvModule> module;
  std::map<std::string, Id> functions;  ///< that give a number or a colour, by name
};

std::mutex files_mutex;
std::map<std::string, std::shared_ptr<const Compiled>>& files() {
  static std::map<std::string, std::shared_ptr<const Compiled>> all;
  return all;
}

[[noreturn]] void refuse(const std::string& file, const Refused& r) {
  throw bad_input(file, r.line > 0 ? fmt::format("line {}", r.line) : "the whole file", r.what(),
                  "a function of numbers that ends");
}

/// Functions that give a number or a colour; the last of those that share a name.
std::map<std::string, Id> functions_of(const SpirvModule& m) {
  std::map<std::string, Id> all;
  for (const auto& [id, f] : m.functions()) {
    const auto name = m.short_name(id);
    if (name.starts_with("gonio_") || name.empty() || name == "main") continue;
    const bool is_value = m.is_of_numbers(f.result) && m.type(f.result).op != spirv_struct;
    const auto op_size = is_value ? m.size(f.result) : 0;
    if (op_size == 1 || op_size == 3 || op_size == 4) all[name] = id;
  }
  return all;
}

/// Line of the first array of a text with more elements than are taken, which a module names without its line; 0: none.
int line_of_array(std::string_view text) {
  constexpr double most = 4096;
  int line = 1;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '\n') ++line;
    if (text[k] != '[') continue;
    const auto close = std::min(text.find(']', k), text.size());
    if (number_from<double>(text.substr(k + 1, close - k - 1)).value_or(0) > most) return line;
  }
  return 0;
}

std::shared_ptr<const Compiled> compiled(Source source) {
  auto c = std::make_shared<Compiled>(Compiled{std::move(source), nullptr, {}});
  try {
    c->module = std::make_unique<SpirvModule>(compile(c->source));
    c->functions = functions_of(*c->module);
  } catch (const Refused& r) {
    refuse(c->source.path, r.line > 0 ? r : Refused(r.what(), line_of_array(c->source.text)));
  } catch (const std::out_of_range&) {
    throw bad_input(c->source.path, "the whole file", "SPIR-V that refers to what it has not",
                    "a module of functions");
  }
  return c;
}

/// The file, compiled once in a run.
std::shared_ptr<const Compiled> file_of(const std::string& path) {
  const std::lock_guard lock(files_mutex);
  auto& known = files()[path];
  if (!known) known = compiled(read_source(path));
  return known;
}

[[noreturn]] void refuse_nameless(const Compiled& c, const std::string& path) {
  throw bad_input(
      path, "the whole file", "no function that gives a number or a colour",
      c.source.language == Language::spirv
          ? "one with its name: some compilers leave names out, as glslang does with -g0"
          : "one");
}

/// The function that a file means: one called BRDF, or else the last that takes two directions.
std::string main_function(const Compiled& c, const std::string& path) {
  const SpirvModule& m = *c.module;
  const auto& all = c.functions;
  std::vector<std::string> names;
  std::optional<std::string> last;
  int line = -1;
  for (const auto& [name, id] : all) {
    names.push_back(name);
    if (plain(name) == "brdf") return name;
    const auto& f = m.functions().at(id);
    std::set<std::string> taken;
    for (const auto& [argument, type] : f.parameters) {
      const Id held = m.type(type).op == spirv_pointer ? m.type(type).element : type;
      if (m.is_of_numbers(held)) taken.insert(direction_of(m.name(argument), m.size(held), {}));
    }
    const bool of_two = (taken.contains("L") && taken.contains("V")) ||
                        (taken.contains("nol") && taken.contains("nov") && taken.contains("noh"));
    if ((of_two && f.line > line) || all.size() == 1) last = name, line = f.line;
  }
  if (last) return *last;
  if (names.empty()) refuse_nameless(c, path);
  throw wrong_usage(fmt::format("{}: which function? it has: {}", path, fmt::join(names, ", ")));
}

// ---- from a function of a file to a term
// -----------------------------------------------------------

/// A parameter as the text declares it: a name for several numbers.
struct Raw {
  std::string name;
  std::size_t size, first;  ///< its numbers among all
};

class Builder {
 public:
  Builder(const Name& name, const Compiled& c, std::optional<Stands> as) : c_(c), m_(*c.module) {
    f_.name = name;
    if (f_.name.function.empty()) f_.name.function = main_function(c, name.file);
    f_.sha256 = c.source.sha256;
    f_.float_constants = c.source.language != Language::glsl;
    as_ = as;
  }

  Function built() {
    const auto& all = c_.functions;
    const auto id = all.find(f_.name.function);
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
      refuse(f_.name.file, r);
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
    if (as_.value_or(Stands::fresnel) == Stands::fresnel && gives_fresnel()) take_as_voh();
    f_.stands = as_.value_or(stands());
    finish();
    return std::move(f_);
  }

 private:
  std::vector<Ref> bind(Program& p, const std::string& name, std::size_t size, Kind kind) {
    const Reading& reading = f_.name.reading;
    const Declared* const declared = c_.source.find(name);
    const auto fixed = reading.values.find(name);
    const bool is_fixed = fixed != reading.values.end() && fixed->second.size() == 1;
    if (kind != Kind::number || is_fixed) {
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
    if (!stands_for.empty())
      return size == 3 ? coordinates(p, stands_for[0]) : std::vector{cosine(p, stands_for)};
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
  static bool is_same(const Program& a, const Program& b) {
    const auto same_node = [](const Node& x, const Node& y) {
      return x.op == y.op && x.kind == y.kind && x.a == y.a && x.b == y.b && x.c == y.c &&
             (x.op != Op::constant || x.value == y.value);
    };
    const auto same_input = [](const Input& x, const Input& y) {
      return x.of_sample == y.of_sample && x.index == y.index && x.node == y.node;
    };
    return a.outputs == b.outputs && std::ranges::equal(a.nodes, b.nodes, same_node) &&
           std::ranges::equal(a.inputs, b.inputs, same_input);
  }

  bool reads_angle(std::string_view name) const {
    return std::ranges::any_of(f_.programs,
                               [&](const Program& p) { return reads(p, true, angle(name)); });
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
          return std::ranges::any_of(cosines, [&](const char* c) { return reads_angle(c); });
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
  /// Decides by the arguments what the function stands for; where it takes both cosines, by its name.
  Stands stands() const {
    const bool l = reads_angle("nol"), v = reads_angle("nov"), facing = reads_angle("voh");
    bool frame = false;
    for (std::size_t k = angle("xol"); k < angle_names.size(); ++k)
      frame |= reads_angle(angle_names[k]);
    const bool half = reads_angle("noh") || reads_angle("sin2_theta_h") || reads_angle("xoh") ||
                      reads_angle("yoh");
    if (half && !l && !v && !facing && !frame) return Stands::distribution;
    if (facing && !l && !v && !half && !frame) return Stands::fresnel;
    const std::string n = plain(f_.name.function);
    const bool named = n.starts_with("v") || n.starts_with("g") || n.find("smith") != n.npos ||
                       n.find("visib") != n.npos || n.find("geom") != n.npos ||
                       n.find("mask") != n.npos || n.find("shadow") != n.npos;
    // Of two widths it takes the cosines with the tangent, too; what takes vectors may be a whole
    // model.
    const bool of_cosines = std::ranges::none_of(f_.arguments, [](const Argument& a) {
      return a.stands_for == "L" || a.stands_for == "V" || a.stands_for == "H";
    });
    const bool may_be = (l || v) && (!frame || (of_cosines && !half && !facing)) &&
                        f_.programs.size() == 1 && n.find("diffuse") == n.npos;
    return may_be && (named || (l && v && of_cosines && !half && !facing && gives_v()))
               ? Stands::masking
               : Stands::lobe;
  }
  /// True of a value that is 1/4 along the normal, or 1 where the 4 stands elsewhere, and only grows towards the horizon: V.
  bool gives_v() const {
    const auto p = starts();
    double last = 0;
    for (const double theta : {0.0, 0.5, 1.0, 1.3, 1.5}) {
      const double v = value_of(f_, p, between(theta, 0, theta, 0))[0];
      if (theta == 0 && differ(v, 0.25) && differ(v, 1)) return false;
      if (!(v > last)) return false;
      last = v;
    }
    return true;
  }

  /// True of a value of one cosine that is 1 at grazing angles and less along the normal, where its name or the cosine's does not say
  /// that it is of the surface: a Fresnel term.  An albedo of NoV may have such values, too.
  bool gives_fresnel() const {
    const bool l = reads_angle("nol"), v = reads_angle("nov");
    if (l == v) return false;
    for (std::size_t k = 0; k < angle_names.size(); ++k)
      if (angle_names[k] != (l ? "nol" : "nov") && reads_angle(angle_names[k])) return false;
    const auto& said = f_.name.reading.arguments;
    if (std::ranges::any_of(f_.arguments, [&](const Argument& a) {
          return a.stands_for != "parameter" && (a.stands_for.size() == 1 || said.contains(a.name));
        }))
      return false;
    const std::string n = plain(f_.name.function);
    const bool is_fresnel = n.find("fresnel") != n.npos || n.find("schlick") != n.npos;
    if (!is_fresnel && std::ranges::none_of(f_.arguments, [](const Argument& a) {
          return a.stands_for != "parameter" && plain(a.name).starts_with("cos");
        }))
      return false;
    const auto at = [&](double c) {
      const double theta = std::acos(c);
      return value_of(f_, starts(), between(theta, 0, theta, 0))[0];
    };
    constexpr double grazing = 1e-6, same = 1e-3, middle = 0.5;
    return std::abs(at(grazing) - 1) < same && at(1) < 1 - same && at(1) >= 0 &&
           at(middle) < 1 + same;
  }
  /// Makes its one cosine VoH.
  void take_as_voh() {
    for (auto& program : f_.programs)
      for (auto& i : program.inputs)
        if (i.of_sample) i.index = angle("voh");
    for (auto& a : f_.arguments)
      if (a.stands_for == "nol" || a.stands_for == "nov") a.stands_for = "voh";
  }

  // ---- what a value includes
  // ------------------------------------------------------------------------

  std::vector<double> starts() const {
    std::vector<double> v;
    for (const auto& p : f_.parameters) v.push_back(p.start);
    return v;
  }
  static std::array<double, 11> between(double theta_l, double phi, double theta_v, double turn) {
    const std::array l{std::sin(theta_l) * std::cos(phi + turn),
                       std::sin(theta_l) * std::sin(phi + turn), std::cos(theta_l)};
    const std::array v{std::sin(theta_v) * std::cos(turn), std::sin(theta_v) * std::sin(turn),
                       std::cos(theta_v)};
    std::array<double, 3> h{l[0] + v[0], l[1] + v[1], l[2] + v[2]};
    const double size = std::hypot(h[0], h[1], h[2]);
    for (double& x : h) x /= size;
    return {l[2], v[2], h[2], size / 2, h[0] * h[0] + h[1] * h[1], h[0], h[1],
            l[0], l[1], v[0], v[1]};
  }
  static bool differ(double a, double b) {
    return std::abs(a - b) > 1e-6 * std::max(std::abs(a), std::abs(b));
  }
  /// Values of parameters that stand for all: the defaults first, then many drawn within the bounds, and of each its ends with the
  /// others drawn.  What is decided at the defaults is wrong of two widths that have the same.
  std::vector<std::vector<double>> many_settings() const {
    std::vector<std::vector<double>> all{starts()};
    const auto drawn = [&] {
      constexpr double golden = 0.618033988749895;
      const auto j = static_cast<double>(all.size());
      std::vector<double> v;
      for (const auto& p : f_.parameters) {
        const double k = static_cast<double>(v.size() + 1), part = std::fmod(j * k * golden, 1);
        // Without bounds it may be an angle in degrees, or a mode.
        const double wide = p.bounded || all.size() % 4 ? 1 : 50;
        v.push_back(p.range.low + wide * part * (p.range.high - p.range.low));
      }
      return v;
    };
    constexpr std::size_t many = 12;
    while (all.size() <= many) all.push_back(drawn());
    for (std::size_t k = 0; k < f_.parameters.size(); ++k)
      for (const double end : {f_.parameters[k].range.low, f_.parameters[k].range.high}) {
        auto v = drawn();
        v[k] = end;
        all.push_back(std::move(v));
      }
    return all;
  }
  /// True where turning the surface changes a value, whatever the parameters are.
  bool is_anisotropic(const std::vector<std::vector<double>>& settings) const {
    if (std::ranges::any_of(f_.arguments, [&](const Argument& a) {
          const std::size_t k = angle(a.stands_for);
          return k >= first_of_frame && k < angle_names.size() && reads_angle(a.stands_for);
        }))
      return true;
    constexpr std::size_t places = 12;
    std::vector<std::array<double, 11>> at;
    for (std::size_t i = 0; i < places; ++i) {
      const double k = static_cast<double>(i);
      const double t = 0.11 + 0.11 * k, u = 1.4 - 0.1 * k, phi = 0.3 + 0.5 * k;
      at.push_back(between(t, phi, u, 0));
      at.push_back(between(t, phi, u, 0.7 + 0.3 * k));
    }
    return std::ranges::any_of(f_.programs, [&](const Program& p) {
      Interpreter<double> run(p, at.size());
      return std::ranges::any_of(settings, [&](const std::vector<double>& values) {
        std::vector<double> v(at.size());
        run.set(values);
        run.run(
            at.size(), [&](std::size_t k, std::size_t j) { return at[j][k]; },
            [&](std::size_t, std::size_t j, double x) { v[j] = x; });
        double most = 0;
        for (const double x : v) most = std::fmax(most, std::abs(x));
        for (std::size_t i = 0; i < v.size(); i += 2)
          if (differ(v[i], v[i + 1]) && std::abs(v[i] - v[i + 1]) > 1e-12 * most) return true;
        return false;
      });
    });
  }
  /// True of a masking function that gives G: 1 along the normal and never more; a V without its 4 is 1 there, too, and more elsewhere.
  bool gives_g(const std::vector<double>& p) const {
    const auto at = [&](double theta_l, double theta_v) {
      return value_of(f_, p, between(theta_l, 1, theta_v, 0))[0];
    };
    constexpr double steep = 1.3, same = 1e-3;
    return at(0, 0) > 0.6 && !(std::fmax(at(steep, steep), at(0, steep)) > at(0, 0) * (1 + same));
  }
  void finish() {
    for (std::size_t k = first_of_frame; k < angle_names.size(); ++k)
      f_.reads_frame = f_.reads_frame || reads_angle(angle_names[k]);
    const auto settings = many_settings();
    f_.anisotropic = f_.reads_frame && is_anisotropic(settings);
    if (f_.stands == Stands::masking) {
      const auto& said = f_.name.reading.includes;
      f_.is_g = said ? *said == "g" : gives_g(settings[0]);
      f_.includes = f_.is_g ? "g" : "v";
      f_.guessed = !said;
    }
    if (f_.stands == Stands::lobe) includes_of_lobe(settings);
    for (auto& program : f_.programs) scale(program);
  }
  void includes_of_lobe(const std::vector<std::vector<double>>& settings) {
    if (const auto& said = f_.name.reading.includes) {
      static constexpr std::string_view known[] = {"nothing", "cosine", "pi", "cosine,pi"};
      if (std::ranges::find(known, *said) == std::end(known))
        refuse_name(*said, known, "thing that a value includes");
      f_.includes = *said;
      return;
    }
    f_.guessed = true;
    if (!takes_direction(f_)) return;  // a helper
    bool cosine = false;
    std::vector<double> brightest;  // there F is 1 whatever cosine it takes
    for (const auto& p : f_.parameters) brightest.push_back(p.range.high);
    auto all = settings;
    all.push_back(std::move(brightest));
    for (const auto& p : all)
      if (const Cosine has = has_cosine(p); has != Cosine::unknown) {
        cosine = has == Cosine::there;
        break;
      }
    const bool pi = has_pi(settings[0], cosine);
    f_.includes = cosine && pi ? "cosine,pi" : cosine ? "cosine" : pi ? "pi" : "nothing";
  }
  enum class Cosine { unknown, missing, there };
  /// Guesses whether a value is f NoL by reciprocity: f(l, v) = f(v, l) with the cosine taken out, not with it in; unknown where the value
  /// is 0, as with a default of 0, or reciprocal neither way.  Shaders add 1e-5 to a cosine so that it is never 0: that is no cosine of
  /// their own.
  Cosine has_cosine(const std::vector<double>& p) const {
    int plain_differs = 0, without_differs = 0, seen = 0;
    double plain_off = 0, without_off = 0;
    const auto off = [](double a, double b) {
      return std::abs(a - b) / std::max(std::abs(a), std::abs(b));
    };
    for (int k = 0; k < 24; ++k) {
      const double t = 0.15 + 0.05 * k, u = 1.3 - 0.045 * k, phi = 0.4 * k;
      const auto x = between(t, phi, u, 0), y = between(u, -phi, t, 0);
      const double a = value_of(f_, p, x)[0], b = value_of(f_, p, y)[0];
      if (!std::isfinite(a) || !std::isfinite(b) || (a == 0 && b == 0)) continue;
      ++seen;
      plain_differs += differ(a, b);
      without_differs += differ(a / x[0], b / y[0]);
      plain_off = std::fmax(plain_off, off(a, b));
      without_off = std::fmax(without_off, off(a / x[0], b / y[0]));
    }
    if (seen == 0) return Cosine::unknown;
    if (plain_differs <= 3) return Cosine::missing;
    if (without_differs == 0 || without_off < 1e-3 * plain_off) return Cosine::there;
    constexpr double much = 1e-2;  // as of a slip, not of a guard
    return plain_off > much && without_off > much ? Cosine::unknown : Cosine::missing;
  }
  /// Rough albedo of the first channel where θ_v = 0.5, over rings about the mirror direction that are narrow near it: a lobe of
  /// any width is seen.
  double rough_albedo(const std::vector<double>& p, bool cosine) const {
    constexpr int rings = 64, columns = 16;
    constexpr double theta_v = 0.5, most = std::numbers::pi / 2 + theta_v;
    Interpreter<double> run(f_.programs[0]);
    run.set(p);
    double sum = 0;
    for (int i = 0; i < rings; ++i)
      for (int j = 0; j < columns; ++j) {
        const double t = (i + 0.5) / rings, rho = most * t * t * t;
        const double phi = 2 * std::numbers::pi * (j + 0.5) / columns;
        const double along = std::sin(rho) * std::cos(phi), across = std::sin(rho) * std::sin(phi);
        const double x = along * std::cos(theta_v) - std::cos(rho) * std::sin(theta_v);
        const double z = along * std::sin(theta_v) + std::cos(rho) * std::cos(theta_v);
        if (z <= 0) continue;
        const auto angles = between(std::acos(std::min(z, 1.0)), std::atan2(across, x), theta_v, 0);
        double f = 0;
        run.run(
            1, [&](std::size_t k, std::size_t) { return angles[k]; },
            [&](std::size_t, std::size_t, double v) { f = v; });
        const double width = most * 3 * t * t / rings * 2 * std::numbers::pi / columns;
        sum += f * (cosine ? 1 : z) * std::sin(rho) * width;
      }
    return sum;
  }
  /// Guesses whether a value is π times f.  A colour at 1, with the others dark, gives an albedo near 1, or else near π, where it
  /// gives most: a rough highlight loses light.
  bool has_pi(const std::vector<double>& starts, bool cosine) {
    const auto is_near = [](double a, double b) { return std::abs(a / b - 1) < 0.1; };
    double most = 0;
    bool near_one = false, near_pi = false;
    const auto take = [&](double albedo) {
      most = std::fmax(most, albedo);
      near_one = near_one || is_near(albedo, 1);
      near_pi = near_pi || is_near(albedo, std::numbers::pi);
    };
    // Parameters in which the value is linear; of a colour whose channels mix the three together.
    using Group = std::vector<std::size_t>;
    std::vector<Group> colours;
    const auto with = [](std::vector<double> p, const Group& g, const std::vector<double>& by) {
      for (const auto k : g) p[k] = by[k];
      return p;
    };
    std::vector<double> low, high, middle;
    for (const auto& q : f_.parameters) {
      low.push_back(q.range.low);
      high.push_back(q.range.high);
      middle.push_back((q.range.low + q.range.high) / 2);
    }
    Group others;
    for (std::size_t k = 0; k < f_.parameters.size(); ++k) {
      Group g{k};
      const auto stem = [&](std::size_t i) {
        const auto& n = f_.parameters[i].name;
        return n.ends_with("_r") || n.ends_with("_g") || n.ends_with("_b")
                   ? n.substr(0, n.size() - 2)
                   : n;
      };
      while (k + 1 < f_.parameters.size() && stem(k + 1) == stem(g[0])) g.push_back(++k);
      const double a = rough_albedo(with(starts, g, low), cosine),
                   b = rough_albedo(with(starts, g, middle), cosine),
                   c = rough_albedo(with(starts, g, high), cosine);
      if (c > a && std::abs((b - a) / (c - a) - 0.5) < 0.02)
        colours.push_back(g);
      else
        others.insert(others.end(), g.begin(), g.end());
    }
    auto dark = starts;
    for (const auto& g : colours) dark = with(dark, g, low);
    // One colour may be that of a diffuse part, and of a metal's highlight.
    const auto metal = std::ranges::find_if(
        others, [&](std::size_t k) { return plain(f_.parameters[k].name).starts_with("metal"); });
    std::vector<std::vector<double>> kinds{dark};
    if (metal != others.end()) kinds = {with(dark, {*metal}, low), with(dark, {*metal}, high)};
    for (const auto& kind : kinds) {
      std::vector<std::vector<double>> places{kind};
      for (const auto k : others)
        for (const auto* end : {&low, &high})
          if (metal == others.end() || k != *metal) places.push_back(with(kind, {k}, *end));
      for (const auto& g : colours) {
        double largest = 0;
        for (const auto& p : places)
          largest = std::fmax(largest, (rough_albedo(with(p, g, high), cosine) -
                                        rough_albedo(with(p, g, low), cosine)) /
                                           (high[g[0]] - low[g[0]]));
        take(largest);
      }
    }
    constexpr double little = 0.2;  // as a roughness that a diffuse part is nearly linear in
    if (most < little) take(rough_albedo(starts, cosine));
    f_.unclear = !near_one && !near_pi && most > 1.2;
    return near_pi && !near_one;
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
  std::optional<Stands> as_;
  std::vector<Raw> raw_;
  std::size_t numbers_ = 0;
  std::map<std::size_t, std::size_t> place_;  ///< number of a parameter as written → parameter
};

}  // namespace

std::string sha256_of(const std::string& file) {
  return file_of(file)->source.sha256;
}

void provide(const std::string& file, const std::string& content) {
  auto made = compiled(source_of(file, content));
  const std::lock_guard lock(files_mutex);
  files()[file] = std::move(made);
}

Function read_function(const Name& name, std::optional<Stands> as) {
  const auto c = file_of(name.file);
  return Builder(name, *c, as).built();
}

std::vector<Entry> list_functions(const std::string& file) {
  const auto c = file_of(file);
  std::vector<Entry> all;
  for (const auto& [name, id] : c->functions) {
    Entry e{name, c->module->functions().at(id).line};
    for (const auto& [argument, type] : c->module->functions().at(id).parameters)
      e.arguments.emplace_back(c->module->name(argument));
    try {
      read_function({file, name});
    } catch (const Error& error) {
      e.refused = error.what();
    }
    all.push_back(std::move(e));
  }
  std::ranges::sort(all, {}, [](const Entry& e) { return std::pair(e.line, e.function); });
  if (all.empty()) refuse_nameless(*c, file);
  return all;
}

}  // namespace gonio::foreign
