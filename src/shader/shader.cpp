#include "shader/shader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <set>

#include "base/error.h"
#include "brdf/catalogue/registry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::shader {
namespace {

/// Characters up to which an expression stands within another.
constexpr std::size_t longest_inline = 44;

/// A formula's statements and results in a language.
class Body {
 public:
  using Kind = Trace::Kind;

  Body(const TracedFormula& formula, const Syntax& syntax)
      : formula_(formula),
        trace_(formula.trace),
        syntax_(syntax),
        live_(formula.live()),
        coloured_(formula.coloured()),
        uses_(count_uses()),
        texts_(trace_.nodes().size()) {
    for (const auto& n : trace_.nodes())
      if (n.kind == Kind::input) taken_.insert(n.name);
    for (std::size_t k = 0; k < texts_.size(); ++k)
      if (live_[k]) write(static_cast<int>(k));
  }

  const std::string& statements() const { return statements_; }
  /// A result as an expression, of a colour where results are colours.
  std::string result(int node) const {
    return formula_.colour ? widened(node) : text(node, Level::sum);
  }

 private:
  enum class Level { sum, product, unary, name };
  struct Text {
    std::string words;
    Level level = Level::name;
  };

  const Trace::Node& node(int k) const { return trace_[k]; }
  bool is_mask(int k) const {
    const auto kind = node(k).kind;
    return kind == Kind::less || kind == Kind::both || kind == Kind::either || kind == Kind::no;
  }
  bool coloured(int k) const { return coloured_[static_cast<std::size_t>(k)]; }

  /// Times that each node is written out; a mask stands wherever it is used, so what it is made of does, too.
  std::vector<std::size_t> count_uses() const {
    std::vector<std::size_t> uses(trace_.nodes().size());
    for (const auto& r : formula_.results) uses[static_cast<std::size_t>(r.node)] += 2;
    for (std::size_t k = uses.size(); k-- > 0;)
      if (live_[k])
        for (const int of : node(static_cast<int>(k)).of)
          if (of >= 0)
            uses[static_cast<std::size_t>(of)] += is_mask(static_cast<int>(k)) ? uses[k] : 1;
    return uses;
  }

  std::string text(int k, Level least) const {
    const auto& t = texts_[static_cast<std::size_t>(k)];
    return t.level < least ? "(" + t.words + ")" : t.words;
  }
  /// A value of three channels, whatever it is of.
  std::string widened(int k) const {
    return coloured(k) ? text(k, Level::sum) : syntax_.colour(text(k, Level::sum));
  }
  std::string as(int k, bool colour) const { return colour ? widened(k) : text(k, Level::sum); }

  void write(int k) {
    Text t = expression(k);
    const auto& n = node(k);
    const bool plain = n.kind == Kind::constant || n.kind == Kind::input || is_mask(k) ||
                       (n.kind == Kind::negate && uses_[static_cast<std::size_t>(k)] == 1);
    const bool named = !n.name.empty();
    if (!plain &&
        (uses_[static_cast<std::size_t>(k)] > 1 || named || t.words.size() > longest_inline)) {
      begin(n.part);
      const std::string name = name_of_node(k);
      statements_ += "  " + syntax_.variable(name, coloured(k), t.words) + "\n";
      t = {name, Level::name};
    }
    texts_[static_cast<std::size_t>(k)] = std::move(t);
  }
  /// A line that says what follows, where that is another term than before.
  void begin(const std::string& part) {
    if (part == part_) return;
    part_ = part;
    for (const auto& t : formula_.terms)
      if (t.part == part)
        statements_ += fmt::format("  // {}: {}\n", part, catalogue()[t.term].about->title);
  }

  Text expression(int k) const {
    const auto& n = node(k);
    const auto sign = [&](const char* s) {
      return fmt::format("{} {} {}", text(n.of[0], Level::sum), s, text(n.of[1], Level::product));
    };
    switch (n.kind) {
      case Kind::input:
        return {n.name, Level::name};
      case Kind::constant:
        return {syntax_.literal(n.value), n.value < 0 ? Level::unary : Level::name};
      case Kind::negate:
        return {"-" + text(n.of[0], Level::name), Level::unary};
      case Kind::sqrt:
        return {fmt::format("sqrt({})", text(n.of[0], Level::sum))};
      case Kind::exp:
        return {fmt::format("exp({})", text(n.of[0], Level::sum))};
      case Kind::log:
        return {fmt::format("log({})", text(n.of[0], Level::sum))};
      case Kind::add: {
        const auto& b = node(n.of[1]);
        if (b.kind == Kind::constant && b.value < 0)
          return {fmt::format("{} - {}", text(n.of[0], Level::sum), syntax_.literal(-b.value)),
                  Level::sum};
        const auto& a = node(n.of[0]);
        if (a.kind == Kind::constant && a.value < 0)
          return {fmt::format("{} - {}", text(n.of[1], Level::sum), syntax_.literal(-a.value)),
                  Level::sum};
        return {sign("+"), Level::sum};
      }
      case Kind::subtract:
        return {sign("-"), Level::sum};
      case Kind::multiply:
        return {fmt::format("{} * {}", text(n.of[0], Level::product), text(n.of[1], Level::unary)),
                Level::product};
      case Kind::divide:
        return {fmt::format("{} / {}", text(n.of[0], Level::product), text(n.of[1], Level::unary)),
                Level::product};
      case Kind::max:
      case Kind::min:
        return {fmt::format("{}({}, {})", n.kind == Kind::max ? "max" : "min",
                            as(n.of[0], coloured(k)), as(n.of[1], coloured(k)))};
      case Kind::select:
        return {syntax_.choice(mask(n.of[0], coloured(k)), as(n.of[1], coloured(k)),
                               as(n.of[2], coloured(k)), coloured(k))};
      case Kind::less:
      case Kind::both:
      case Kind::either:
      case Kind::no:
        break;  // written where it is used: it may be of three channels there
    }
    return {};
  }
  std::string mask(int k, bool colour) const {
    const auto& n = node(k);
    if (colour && !coloured(k)) return syntax_.of_all_channels(mask(k, false));
    if (n.kind == Kind::less) return syntax_.less(as(n.of[0], colour), as(n.of[1], colour), colour);
    if (n.kind == Kind::no) return syntax_.opposite(mask(n.of[0], colour), colour);
    return syntax_.joined(n.kind, mask(n.of[0], colour), mask(n.of[1], colour), colour);
  }

  std::string name_of_node(int k) {
    const auto& n = node(k);
    const auto is_name = [&](int of) {
      const auto& t = texts_[static_cast<std::size_t>(of)];
      return t.level == Level::name && std::isalpha(static_cast<unsigned char>(t.words[0])) &&
             t.words.find('(') == std::string::npos;
    };
    const auto words = [&](int of) { return texts_[static_cast<std::size_t>(of)].words; };
    const auto is_one = [&](int of) {
      return node(of).kind == Kind::constant && node(of).value == 1;
    };
    std::string name = n.name;
    if (name.empty() && n.kind == Kind::multiply && n.of[0] == n.of[1] && is_name(n.of[0])) {
      const auto root = words(n.of[0]);
      name = root + (std::isdigit(static_cast<unsigned char>(root.back())) ? "_squared" : "2");
    }
    if (name.empty() && n.kind == Kind::divide && is_one(n.of[0]) && is_name(n.of[1]))
      name = "per_" + words(n.of[1]);
    if (name.empty() && n.kind == Kind::subtract && is_one(n.of[0]) && is_name(n.of[1]))
      name = "one_minus_" + words(n.of[1]);
    if (name.size() > 24) name.clear();
    if (!name.empty() && taken_.insert(name).second) return name;
    const std::string stem = !name.empty()          ? name
                             : n.kind == Kind::sqrt ? n.part + "_root"
                             : n.kind == Kind::exp  ? n.part + "_exp"
                                                    : n.part + "_";
    for (int number = name.empty() ? 1 : 2;; ++number) {
      const auto numbered = fmt::format("{}{}{}", stem, name.empty() ? "" : "_", number);
      if (taken_.insert(numbered).second) return numbered;
    }
  }

  const TracedFormula& formula_;
  const Trace& trace_;
  const Syntax& syntax_;
  std::vector<bool> live_, coloured_;
  std::vector<std::size_t> uses_;
  std::vector<Text> texts_;
  std::set<std::string> taken_{"n", "l", "v", "h", "t", "b"};
  std::string statements_, part_;
};

/// Words in lines of a comment.
std::string comment(const std::string& words) {
  constexpr std::size_t width = 112;
  std::string lines, line = "//";
  for (std::size_t at = 0; at < words.size();) {
    const auto end = std::min(words.find(' ', at), words.size());
    const auto word = words.substr(at, end - at);
    if (line.size() > 2 && line.size() + 1 + word.size() > width) {
      lines += line + "\n";
      line = "//  ";
    }
    line += " " + word;
    at = end + 1;
  }
  return lines + line + "\n";
}

std::string text_of(const Operations& operations) {
  std::vector<std::string> words;
  for (std::size_t k = 0; k < operation_names.size(); ++k)
    if (operations.by_kind[k] > 0)
      words.push_back(fmt::format("{} {}", operations.by_kind[k], operation_names[k]));
  return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "));
}

std::string header(const TracedFormula& f,
                   const Writing& w,
                   std::string_view what,
                   const Operations& operations) {
  std::string text = comment(fmt::format("{}, {}", f.id, what));
  for (const auto& t : f.terms) {
    const About& about = *catalogue()[t.term].about;
    text += comment(fmt::format("{} {}: {}.  {}", t.part, about.id, about.formula, about.source));
  }
  for (const About* map : f.maps)
    text += comment(fmt::format("{}: {}.  {}", map->id, map->formula, map->source));
  for (const auto& p : f.parameters)
    text += comment(fmt::format("parameter {} in [{:g}, {:g}]{}{}", p.name, p.about->legal.low,
                                p.about->legal.high, p.about->meaning.empty() ? "" : ": ",
                                p.about->meaning));
  for (const auto& [name, values] : f.known)
    text += comment(fmt::format("constant {} = {:.9g}", name, fmt::join(values, ", ")));
  if (w.language == Language::wgsl)
    text += comment(
        "WGSL has no word that keeps a compiler from regrouping sums and products: bits may differ "
        "from machine to machine.");
  text += comment("operations: " + text_of(operations));
  if (f.derivatives > 0)
    text += comment(
        "The known error is that of the value. The error of its derivatives is unknown, and in "
        "half they may overflow where the value does not.");
  for (const auto& remark : w.remarks) text += comment(remark);
  return text;
}

std::string title_case(const std::string& name) {
  std::string type;
  bool up = true;
  for (const char c : name) {
    if (c == '_') {
      up = true;
      continue;
    }
    type += up ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    up = false;
  }
  return type;
}

}  // namespace

void check_function_name(const std::string& name) {
  const auto letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (c >= '0' && c <= '9');
  };
  if (name.empty() || name.size() > 64 || !std::isalpha(static_cast<unsigned char>(name[0])) ||
      !std::ranges::all_of(name, letter) || name.find("__") != std::string::npos ||
      name.ends_with('_'))
    throw wrong_usage(fmt::format(
        "--name {}: expected a letter, then letters, digits and single underscores between them",
        name));
  if (is_kept_word(name))
    throw wrong_usage(fmt::format("--name {}: a word that a shading language keeps", name));
}

std::string function_of_cosines(const TracedFormula& f, const Writing& w) {
  return f.is_model ? w.name + "_of_cosines" : w.name;
}

namespace {

/// Writer of a formula's functions in a language.
class Functions {
 public:
  Functions(const TracedFormula& formula, const Writing& writing)
      : f_(formula),
        w_(writing),
        syntax_(writing.language, formula.precision),
        type_(syntax_.type(formula.colour)),
        structure_(structure_name(formula, writing)) {
    for (const auto& p : f_.parameters)
      parameters_.push_back(syntax_.parameter(syntax_.type(p.colour), p.name));
  }

  std::string preamble() const { return syntax_.preamble(); }
  /// Of the results; "" where there is one alone.
  std::string structure() const {
    if (!has_several()) return "";
    std::string text = fmt::format("struct {} {{\n", structure_);
    for (const auto& r : f_.results) text += "  " + syntax_.member(type_, r.name) + "\n";
    return text + syntax_.structure_end() + "\n\n";
  }
  std::string of_cosines() const {
    const Body body(f_, syntax_);
    auto given = parameters_;
    for (const auto& a : f_.angles) given.push_back(syntax_.parameter(syntax_.type(false), a.name));
    std::string text = head(function_of_cosines(f_, w_), given);
    for (const auto& c : f_.colours) {
      const auto channel = [&](std::size_t k) { return syntax_.literal(c.value[k]); };
      const auto value =
          syntax_.colour(fmt::format("{}, {}, {}", channel(0), channel(1), channel(2)));
      text += "  " + syntax_.variable(c.name, true, value) + "\n";
    }
    text += body.statements();
    std::vector<std::string> results;
    for (const auto& r : f_.results) results.push_back(body.result(r.node));
    return text + returned("  ", "all", results) + "}\n";
  }
  /// The same of unit vectors, of an anisotropic model with the tangent and the bitangent.
  std::string of_directions() const {
    std::string text = fmt::format(
        "\n// n, l, v: unit vectors of the normal, to the light and to the viewer{}; 0 from below "
        "the surface.\n",
        f_.anisotropic ? "; t, b: tangent and bitangent" : "");
    auto given = parameters_;
    const auto vector = syntax_.type(true, Precision::float_);
    for (const char* name : {"n", "l", "v"}) given.push_back(syntax_.parameter(vector, name));
    if (f_.anisotropic)
      for (const char* name : {"t", "b"}) given.push_back(syntax_.parameter(vector, name));
    text += head(w_.name, given);
    text += line("NoL", false, "dot(n, l)") + line("NoV", false, "dot(n, v)");
    const auto zero = syntax_.literal(0);
    const std::vector<std::string> none(f_.results.size(), f_.colour ? syntax_.colour(zero) : zero);
    text += "  if (!(NoL > 0.0 && NoV > 0.0)) {\n" + returned("    ", "none", none) + "  }\n";
    text += half_vector();
    if (f_.anisotropic) text += frame();
    std::vector<std::string> names;
    for (const auto& p : f_.parameters) names.push_back(p.name);
    for (const auto& a : f_.angles) names.push_back(syntax_.from_float(a.name));
    return text + fmt::format("  return {}({});\n}}\n", function_of_cosines(f_, w_),
                              fmt::join(names, ", "));
  }

 private:
  bool has_several() const { return f_.results.size() > 1; }
  bool reads(std::string_view angle) const {
    return std::ranges::find(f_.angles, angle, &Argument::name) != f_.angles.end();
  }
  std::string head(const std::string& name, const std::vector<std::string>& given) const {
    return syntax_.function(has_several() ? structure_ : type_, name,
                            fmt::format("{}", fmt::join(given, ", "))) +
           " {\n";
  }
  /// Statements that return results.  \param name  of the structure where there are several
  std::string returned(const std::string& indent,
                       const std::string& name,
                       const std::vector<std::string>& results) const {
    if (!has_several()) return fmt::format("{}return {};\n", indent, results[0]);
    return fmt::format("{0}{1}\n{0}return {2};\n", indent,
                       syntax_.made(structure_, fmt::format("{}", fmt::join(results, ", ")), name),
                       name);
  }
  /// Statement that sets a float, or a vector of them.
  std::string line(const std::string& name, bool is_vector, const std::string& value) const {
    return "  " + syntax_.angle(name, is_vector, value) + "\n";
  }
  std::string half_vector() const {
    std::string text;
    const bool any = std::ranges::any_of(std::array{"NoH", "VoH", "sin2_theta_h", "XoH", "YoH"},
                                         [&](auto a) { return reads(a); });
    if (any) text += line("h", true, "normalize(l + v)");
    if (reads("NoH")) text += line("NoH", false, "min(dot(n, h), 1.0)");
    if (reads("VoH")) text += line("VoH", false, "min(dot(v, h), 1.0)");
    if (reads("sin2_theta_h"))
      text += line("n_x_h", true, "cross(n, h)") + line("sin2_theta_h", false, "dot(n_x_h, n_x_h)");
    return text;
  }
  /// Cosines with the tangent, which may be turned, and the bitangent.
  std::string frame() const {
    std::string text, x = "t", y = "b";
    if (f_.tangent != 0) {
      const double turn = f_.tangent * std::numbers::pi / 180;
      const Syntax floats(w_.language, Precision::float_);
      const auto c = floats.literal(std::cos(turn)), s = floats.literal(std::sin(turn));
      text += line("x", true, fmt::format("({}) * t + ({}) * b", c, s)) +
              line("y", true, fmt::format("({}) * b - ({}) * t", c, s));
      x = "x", y = "y";
    }
    for (const auto& [of, direction] : {std::pair{"H", "h"}, {"L", "l"}, {"V", "v"}})
      for (const auto& [letter, axis] : {std::pair{"X", x}, {"Y", y}})
        if (const auto name = fmt::format("{}o{}", letter, of); reads(name))
          text += line(name, false, fmt::format("dot({}, {})", axis, direction));
    return text;
  }

  const TracedFormula& f_;
  const Writing& w_;
  Syntax syntax_;
  std::string type_, structure_;
  std::vector<std::string> parameters_;  ///< as both functions are given them
};

}  // namespace

std::string own_shader_source(const TracedFormula& f,
                              const Writing& w,
                              const Operations& operations,
                              const std::string& text) {
  const auto version = text.starts_with("#version") ? text.find('\n') : text.npos;
  const auto below = version == text.npos ? 0 : version + 1;
  return text.substr(0, below) +
         header(f, w, "as its file has it; gonio shader looked at it and wrote these lines.",
                operations) +
         "\n" + text.substr(below);
}

std::string structure_name(const TracedFormula& f, const Writing& w) {
  return title_case(w.name) + (f.derivatives > 0 ? "Derivatives" : "Values");
}

std::string shader_source(const TracedFormula& f, const Writing& w) {
  check_function_name(w.name);
  const Functions functions(f, w);
  return functions.preamble() +
         header(f, w, "written by gonio shader: do not edit, write it again.", f.operations()) +
         "\n" + functions.structure() + functions.of_cosines() +
         (f.is_model ? functions.of_directions() : "");
}

}  // namespace gonio::shader
