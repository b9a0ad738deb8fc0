#pragma once
/// \file
/// A stranger's function as straight-line code over scalars: no branch, loop, vector or memory is left.
///
/// Equal nodes are one, and nodes stand in an order in which they can be computed.  Nothing is regrouped: every number rounds as the
/// text says.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace gonio::foreign {

/// Thrown for text that cannot be run, with its line; 0 where no line is to blame.
struct Refused : std::runtime_error {
  Refused(const std::string& what, int at) : std::runtime_error(what), line(at) {}
  int line;
};

enum class Op : std::uint8_t {
  constant,
  input,
  add,
  sub,
  mul,
  div,
  min,
  max,
  pow,
  atan2,
  neg,
  sqrt,
  exp,
  log,
  exp2,
  log2,
  sin,
  cos,
  asin,
  acos,
  atan,
  floor,
  less,
  less_equal,
  equal,
  both,
  either,
  inverse,
  select,
};
inline constexpr std::array<std::string_view, 29> op_names{
    "constant", "input", "add",    "sub",     "mul",   "div",   "min",  "max",
    "pow",      "atan2", "neg",    "sqrt",    "exp",   "log",   "exp2", "log2",
    "sin",      "cos",   "asin",   "acos",    "atan",  "floor", "less", "less_equal",
    "equal",    "both",  "either", "inverse", "select"};

/// A node by its number; `nothing`: no value was stored.
using Ref = std::int32_t;
inline constexpr Ref nothing = -1;

enum class Kind : std::uint8_t { number, truth, integer };

struct Node {
  Op op;
  Kind kind = Kind::number;
  Ref a = nothing, b = nothing, c = nothing;
  double value = 0;     ///< of a constant; of others where `known`
  bool known = false;   ///< the same whatever the inputs are: it decides loops and branches
  bool uniform = true;  ///< does not depend on the sample: computed once for all of them
};

/// Where an input comes from: a number of the sample (an index into `angle_names`), or a parameter.
struct Input {
  bool of_sample;
  std::size_t index;
  Ref node;
};

/// Numbers of a sample, in the order of FrameAngles.
inline constexpr std::array<std::string_view, 11> angle_names{
    "nol", "nov", "noh", "voh", "sin2_theta_h", "xoh", "yoh", "xol", "yol", "xov", "yov"};
/// From this one on they belong to the frame.
inline constexpr std::size_t first_of_frame = 5;

class Program {
 public:
  std::vector<Node> nodes;
  std::vector<Input> inputs;
  std::vector<Ref> outputs;
  std::size_t most_nodes = 200'000;
  int line = 0;  ///< of the person's text, for what is refused

  Ref constant(double v, Kind kind = Kind::number);
  /// The zero of a frame's own vectors, N = (0, 0, 1): a shader's normal has none, so 0 · x is 0 and 0 + x is x whatever x is.
  Ref frame_zero();
  Ref truth(bool v) { return constant(v ? 1 : 0, Kind::truth); }
  Ref input(bool of_sample, std::size_t index);
  /// A node for an operation, or what it folds to without another rounding.
  Ref make(Op op, Ref a, Ref b = nothing, Ref c = nothing);
  Ref operator()(Op op, Ref a, Ref b = nothing, Ref c = nothing) { return make(op, a, b, c); }
  /// True of a number or truth known to be v.
  bool is(Ref r, double v) const;
  const Node& operator[](Ref r) const { return nodes[static_cast<std::size_t>(r)]; }

  [[noreturn]] void refuse(const std::string& what) const { throw Refused(what, line); }

 private:
  using Key = std::tuple<Op, Kind, Ref, Ref, Ref, std::uint64_t>;
  std::map<Key, Ref> same_;
  Ref frame_zero_ = nothing;
  Ref node(const Node&);
  Ref fold_truths(Op op, Ref a, Ref b);
};

/// The program without nodes that no output needs.
Program trimmed(const Program&);
/// True where an output depends on this parameter, or on this number of the sample.
bool reads(const Program&, bool of_sample, std::size_t index);
/// Each output followed by its derivatives by parameters 0 … count − 1, and by the frame's turn [1/°] where `turn`; one that is 0 is
/// the constant.
Program with_derivatives(const Program&, std::size_t count, bool turn = false);
/// One program with the outputs of all, which computes once what they share.
/// \param index  (number of a program, its parameter) → parameter of the whole
Program merged(const std::vector<const Program*>&,
               const std::function<std::size_t(std::size_t, std::size_t)>& index);

}  // namespace gonio::foreign
