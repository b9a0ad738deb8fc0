#include "foreign/translate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "foreign/arithmetic.h"
#include "foreign/glsl_functions.h"
#include "foreign/spirv_words.h"

namespace gonio::foreign {
namespace {

constexpr int most_turns = 4096, deepest_calls = 64, deepest_logic = 64;
constexpr std::size_t most_variables = 100'000, most_scalars = 1'000'000, most_steps = 4'000'000,
                      most_looks = 4000;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A variable's scalars: what all lanes hold, and what was stored last, which the lanes of `where` see without a select.
struct Variable {
  Parts parts, latest;
  std::vector<Ref> where, written;  ///< masks; `written`: lanes that ever stored
  int depth;                        ///< of the call that it belongs to
};

struct Edge {
  Id from;
  Ref mask;
  std::map<Id, Parts> phi;
};

/// A call of a function that is being run.
struct Frame {
  const SpirvFunction& f;
  std::map<Id, Value> values;
  Ref outer;  ///< mask of the call
  int depth;
  Ref now = nothing;  ///< mask of the block
  std::map<std::size_t, std::vector<Edge>> pending{};
  std::vector<std::pair<Ref, Parts>> returned{};
};

/// Functions of doubles, which GLSL has not: declared before the person's text, known by name.
const std::map<std::string, Op>& declared_functions() {
  static const std::map<std::string, Op> all{
      {"gonio_exp", Op::exp},   {"gonio_log", Op::log},   {"gonio_exp2", Op::exp2},
      {"gonio_log2", Op::log2}, {"gonio_sin", Op::sin},   {"gonio_cos", Op::cos},
      {"gonio_asin", Op::asin}, {"gonio_acos", Op::acos}, {"gonio_atan", Op::atan}};
  return all;
}

class Translator {
 public:
  Translator(const SpirvModule& module, const Binding& binding) : m(module), bind_(binding) {}
  Translator(const Translator&) = delete;
  Translator& operator=(const Translator&) = delete;
  ~Translator() { m.steps += steps_ + p.nodes.size(); }

  Translation run(Id function) {
    // Those that it needs, in the order of the text: a file may have as many as functions.
    std::vector<Id> run_first = m.mains();
    std::erase(run_first, function);
    std::vector<Id> all = run_first;
    all.push_back(function);
    for (const std::size_t k : m.globals_of(std::move(all))) {
      const auto& g = m.globals()[k];
      p.line = g.line;
      if (g.op == spv::OpVariable && !m.is_of_numbers(m.type(g.type).element)) continue;
      global(g);
    }
    // Globals that are no constants, but have a value, get it where main begins.
    for (const Id id : run_first) call(m.functions().at(id), {}, p.truth(true), 1);
    const auto& f = m.functions().at(function);
    p.line = f.line;
    std::vector<Value> arguments;
    for (const auto& [id, type] : f.parameters) {
      const bool by_pointer = m.type(type).op == spv::OpTypePointer;
      const Id held = by_pointer ? m.type(type).element : type;
      Value v{held, bound(m.name(id), held)};
      if (by_pointer) v = {held, {}, new_variable(held, v.parts, 0)};
      arguments.push_back(std::move(v));
    }
    p.outputs = call(f, arguments, p.truth(true), 1).parts;
    for (const Ref r : p.outputs)
      if (r == nothing) p.refuse("a result that was never written");
    return {trimmed(p), std::move(notes_)};
  }

 private:
  const SpirvModule& m;
  const Binding& bind_;
  Program p;
  std::map<Id, Value> globals_;
  std::vector<Variable> variables_;
  std::vector<Note> notes_;
  std::size_t steps_ = 0, looks_ = 0, scalars_ = 0;

  // ---- values and variables
  // -----------------------------------------------------------------------

  int new_variable(Id type, Parts parts, int depth) {
    if (variables_.size() >= most_variables) p.refuse("more than 100000 variables");
    const Ref stored = parts.empty() ? p.truth(false) : p.truth(true);
    if (parts.empty()) parts.assign(m.size(type), nothing);
    const std::size_t n = parts.size();
    if (n > most_scalars - scalars_) p.refuse("variables of more than 1000000 numbers");
    scalars_ += n;
    variables_.push_back(
        {parts, parts, std::vector<Ref>(n, p.truth(true)), std::vector<Ref>(n, stored), depth});
    return static_cast<int>(variables_.size() - 1);
  }
  Variable& variable(const Value& v) {
    if (v.variable < 0) p.refuse("a pointer to no variable");
    return variables_[static_cast<std::size_t>(v.variable)];
  }
  Parts bound(const std::string& name, Id type) {
    const SpirvType& t = m.type(type);
    if (t.op != spv::OpTypeStruct) return bind_(p, name, m.size(type), kind(m, type));
    Parts all;
    for (std::size_t k = 0; k < t.members.size(); ++k) {
      const Parts part = bound(m.member_name(type, k), t.members[k]);
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }
  void global(const Instruction& i) {
    switch (i.op) {
      case spv::OpConstantTrue:
      case spv::OpConstantFalse:
        globals_[i.id] = {i.type, {p.truth(i.op == spv::OpConstantTrue)}};
        return;
      case spv::OpConstant: {
        const auto v = number_of(m, i);
        if (!v) p.refuse("a constant of neither 32 nor 64 bits");
        globals_[i.id] = {i.type, {p.constant(*v, kind(m, i.type))}};
        return;
      }
      case spv::OpConstantComposite: {
        Value v{i.type};
        for (const Id c : i.in) {
          const Parts& part = globals_.at(c).parts;
          v.parts.insert(v.parts.end(), part.begin(), part.end());
        }
        globals_[i.id] = v;
        return;
      }
      case spv::OpConstantNull:
      case spv::OpUndef:
        globals_[i.id] = {i.type, Parts(m.size(i.type), p.constant(0, kind(m, i.type)))};
        return;
      case spv::OpVariable:
        globals_[i.id] = global_variable(i);
        return;
      default:
        p.refuse("a specialisation constant");
    }
  }
  Value global_variable(const Instruction& i) {
    const Id held = m.type(i.type).element;
    Parts parts;
    const bool is_block =
        i.in[0] == spv::StorageClassUniform || i.in[0] == spv::StorageClassPushConstant;
    if (i.in.size() > 1 && i.in[0] != spv::StorageClassUniformConstant)
      parts = globals_.at(i.in[1]).parts;
    else if (i.in[0] != spv::StorageClassOutput && i.in[0] != spv::StorageClassWorkgroup &&
             !m.name(i.id).starts_with("gl_") &&
             (!is_block || m.type(held).op == spv::OpTypeStruct))
      parts = bound(m.name(i.id), held);
    else
      parts.assign(m.size(held), nothing);
    return {held, {}, new_variable(held, parts, 0)};
  }
  // ---- masks
  // ---------------------------------------------------------------------------------------

  /// True where lanes of a are among those of b, as far as the masks' formulas say.
  bool implies(Ref a, Ref b, int depth = 0) {
    if (a == b || p.is(b, 1) || p.is(a, 0)) return true;
    if (depth == 0) looks_ = 0;
    if (depth > deepest_logic || ++looks_ > most_looks) return false;
    const Node &x = p[a], &y = p[b];
    if (x.op == Op::either) return implies(x.a, b, depth + 1) && implies(x.b, b, depth + 1);
    if (y.op == Op::both) return implies(a, y.a, depth + 1) && implies(a, y.b, depth + 1);
    if (x.op == Op::both && (implies(x.a, b, depth + 1) || implies(x.b, b, depth + 1))) return true;
    return y.op == Op::either && (implies(a, y.a, depth + 1) || implies(a, y.b, depth + 1));
  }
  Ref lanes_here(const Frame& fr, const Variable& v) {
    return v.depth == fr.depth ? fr.now : p(Op::both, fr.outer, fr.now);
  }
  Ref load(const Frame& fr, Variable& v, std::size_t k) {
    const Ref here = lanes_here(fr, v);
    if (v.latest.at(k) >= 0 && implies(here, v.where[k])) return v.latest[k];
    const Ref all = v.parts[k];
    if (all < 0 && v.latest[k] >= 0 && kind_of(p, v.latest[k]) == Kind::integer)
      p.refuse("an integer that depends on the sample");
    if (all < 0 || implies(here, v.written[k]) || kind_of(p, all) != Kind::number) return all;
    const Note note{p.line,
                    "a variable is read that not every branch wrote: no number where none did"};
    if (std::ranges::find(notes_, note.line, &Note::line) == notes_.end()) notes_.push_back(note);
    return p(Op::select, v.written[k], all, p.constant(not_a_number));
  }
  void store(const Frame& fr, const Value& to, const Parts& parts) {
    Variable& v = variable(to);
    const Ref here = lanes_here(fr, v);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const std::size_t at = to.offset + k;
      Ref& held = v.parts.at(at);
      const bool is_integer = parts[k] >= 0 && kind_of(p, parts[k]) == Kind::integer;
      if (is_integer && held != parts[k] && !p.is(here, 1))
        held = nothing;  // in each lane another: none can be read
      else
        held = held < 0 ? parts[k] : choose(p, here, parts[k], held, kind_of(p, parts[k]));
      v.latest[at] = parts[k];
      v.where[at] = here;
      if (parts[k] >= 0) v.written[at] = p(Op::either, v.written[at], here);
    }
  }

  // ---- control flow
  // --------------------------------------------------------------------------------

  Value call(const SpirvFunction& f, const std::vector<Value>& arguments, Ref outer, int depth) {
    if (depth > deepest_calls) p.refuse("calls nested deeper than 64: a recursion?");
    if (f.blocks.empty()) p.refuse("a function without code");
    Frame fr{f, {}, outer, depth};
    for (std::size_t k = 0; k < arguments.size(); ++k)
      fr.values[f.parameters.at(k).first] = arguments[k];
    std::map<std::size_t, int> turns;
    fr.pending[0] = {{0, p.truth(true), {}}};
    while (!fr.pending.empty()) {  // the first in order: loops before what follows them
      const std::size_t rank = fr.pending.begin()->first;
      const auto edges = std::move(fr.pending.begin()->second);
      fr.pending.erase(fr.pending.begin());
      const int turn = ++turns[rank];
      if (turn > most_turns)
        p.refuse("a loop that 4096 turns do not end, or whose end depends on the sample");
      run_block(fr, f.blocks[f.order[rank]], edges, turn > 1);
    }
    Value r{f.result};
    if (m.type(f.result).op == spv::OpTypeVoid) return r;
    if (fr.returned.empty()) p.refuse("a function that returns nothing");
    r.parts = fr.returned.back().second;
    for (std::size_t k = fr.returned.size() - 1; k-- > 0;)
      for (std::size_t j = 0; j < r.parts.size(); ++j)
        r.parts[j] = choose(p, fr.returned[k].first, fr.returned[k].second[j], r.parts[j],
                            kind_of(p, r.parts[j]));
    return r;
  }

  Value& get(Frame& fr, Id id) {
    if (const auto v = fr.values.find(id); v != fr.values.end()) {
      Value& x = v->second;
      if (x.guard >= 0 && !implies(fr.now, x.guard)) {  // past the loop
        for (const Ref r : x.others)
          if (r < 0) p.refuse("an integer that depends on the sample");
        x.parts = x.others;
        x.guard = nothing;
      }
      return x;
    }
    if (const auto g = globals_.find(id); g != globals_.end()) return g->second;
    p.refuse("a texture or a buffer, or a value that was not computed");
  }
  const Parts& parts(Frame& fr, Id id) { return get(fr, id).parts; }

  void set(Frame& fr, Id id, Value v, bool again) {
    if (const auto old = fr.values.find(id);
        again && !p.is(fr.now, 1) && v.variable < 0 && old != fr.values.end()) {
      v.guard = fr.now;  // lanes that left the loop keep what they had
      const Parts& before = old->second.guard >= 0 ? old->second.others : old->second.parts;
      for (std::size_t k = 0; k < v.parts.size(); ++k) {
        const bool differs = kind_of(p, v.parts[k]) == Kind::integer && v.parts[k] != before.at(k);
        v.others.push_back(
            differs ? nothing
                    : choose(p, fr.now, v.parts[k], before.at(k), kind_of(p, v.parts[k])));
      }
    }
    fr.values[id] = std::move(v);
  }

  void go(Frame& fr, Id from, Id to, Ref mask) {
    if (p.is(mask, 0)) return;
    Edge e{from, mask, {}};
    const std::size_t rank = fr.f.rank.at(to);
    for (const auto& i : fr.f.blocks[fr.f.order[rank]].code)
      if (i.op == spv::OpPhi)
        for (std::size_t k = 0; k + 1 < i.in.size(); k += 2)
          if (i.in[k + 1] == from) e.phi[i.id] = parts(fr, i.in[k]);
    fr.pending[rank].push_back(std::move(e));
  }

  void run_block(Frame& fr, const SpirvBlock& b, const std::vector<Edge>& edges, bool again) {
    Ref mask = edges[0].mask;
    for (std::size_t k = 1; k < edges.size(); ++k) mask = p(Op::either, mask, edges[k].mask);
    if (p.is(mask, 0)) return;
    fr.now = mask;
    for (const auto& i : b.code) {
      if (i.line) p.line = i.line;
      if (++steps_ > most_steps) p.refuse("more than four million steps");
      const auto in = i.in;
      switch (i.op) {
        case spv::OpSelectionMerge:
        case spv::OpLoopMerge:
        case spv::OpUnreachable:
          break;
        case spv::OpPhi: {
          Parts r = edges.back().phi.at(i.id);
          for (std::size_t k = edges.size() - 1; k-- > 0;)
            for (std::size_t j = 0; j < r.size(); ++j)
              r[j] = choose(p, edges[k].mask, edges[k].phi.at(i.id).at(j), r[j], kind(m, i.type));
          set(fr, i.id, {i.type, r}, again);
          break;
        }
        case spv::OpBranch:
          go(fr, b.id, in[0], mask);
          break;
        case spv::OpBranchConditional: {
          const Ref c = parts(fr, in[0]).at(0);
          go(fr, b.id, in[1], p(Op::both, mask, c));
          go(fr, b.id, in[2], p(Op::both, mask, p(Op::inverse, c)));
          break;
        }
        case spv::OpSwitch: {
          const int on = whole(p, parts(fr, in[0]).at(0));
          Id to = in[1];
          for (std::size_t k = 2; k + 1 < in.size(); k += 2)
            if (static_cast<int>(in[k]) == on) to = in[k + 1];
          go(fr, b.id, to, mask);
          break;
        }
        case spv::OpReturn:
          fr.returned.push_back({mask, {}});
          break;
        case spv::OpReturnValue:
          fr.returned.push_back({mask, parts(fr, in[0])});
          break;
        case spv::OpKill:
          p.refuse("discard");
        case spv::OpVariable: {
          const Id held = m.type(i.type).element;
          const Parts start = in.size() > 1 ? parts(fr, in[1]) : Parts{};
          fr.values[i.id] = {held, {}, new_variable(held, start, fr.depth)};
          break;
        }
        case spv::OpLoad: {
          const Value q = get(fr, in[0]);
          Parts r;
          for (std::size_t k = 0; k < m.size(i.type); ++k)
            r.push_back(load(fr, variable(q), q.offset + k));
          set(fr, i.id, {i.type, r}, again);
          break;
        }
        case spv::OpStore:
          store(fr, get(fr, in[0]), Parts(parts(fr, in[1])));
          break;
        case spv::OpAccessChain:
        case spv::OpInBoundsAccessChain: {
          Value q = get(fr, in[0]);
          for (std::size_t k = 1; k < in.size(); ++k)
            q = step(p, m, q, whole(p, parts(fr, in[k]).at(0)));
          fr.values[i.id] = q;
          break;
        }
        case spv::OpFunctionCall: {
          if (m.short_name(in[0]).starts_with("gonio_texture")) p.refuse("a texture is read");
          std::vector<Value> arguments;
          for (std::size_t k = 1; k < in.size(); ++k) arguments.push_back(get(fr, in[k]));
          const auto& callee = m.functions().at(in[0]);
          const int line = p.line;
          auto v = declared(fr, callee, arguments, i.type);
          set(fr, i.id, v ? *v : call(callee, arguments, p(Op::both, fr.outer, mask), fr.depth + 1),
              again);
          p.line = line;
          break;
        }
        default:
          set(fr, i.id, compute(p, m, i, [&](Id id) -> const Value& { return get(fr, id); }),
              again);
      }
    }
  }

  // ---- arithmetic
  // ----------------------------------------------------------------------------------

  std::optional<Value> declared(const Frame& fr,
                                const SpirvFunction& f,
                                const std::vector<Value>& arguments,
                                Id type) {
    const std::string n = m.short_name(f.id);
    if (!n.starts_with("gonio_") || m.size(type) != 1) return {};
    const auto argument = [&](std::size_t k) {
      const Value& v = arguments.at(k);
      return v.variable < 0 ? v.parts.at(0) : load(fr, variable(v), v.offset);
    };
    const auto value = [&](Ref r) { return Value{type, {r}}; };
    if (n == "gonio_atan" && arguments.size() == 2)
      return value(p(Op::atan2, argument(0), argument(1)));
    if (const auto o = declared_functions().find(n); o != declared_functions().end())
      return value(p(o->second, argument(0)));
    if (n == "gonio_tan") {
      const Ref x = argument(0);
      return value(p(Op::div, p(Op::sin, x), p(Op::cos, x)));
    }
    if (n == "gonio_pow") return value(power(p, argument(0), argument(1)));
    return {};
  }
};

}  // namespace

Translation translate(const SpirvModule& m, Id function, const Binding& bind) {
  return Translator(m, bind).run(function);
}

}  // namespace gonio::foreign
