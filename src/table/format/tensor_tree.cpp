#include "table/format/tensor_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/error.h"
#include "base/numbers.h"
#include "base/text.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Halvings of an axis that a tree may have: cells of .002°.
constexpr int kDeepest = 16;

struct TreeNode {
  std::size_t first;  ///< of its nodes, or of its values
  int halvings;       ///< of each axis among its values; −1: it has nodes
};

using Cell = std::array<double, 4>;

struct TensorTree {
  std::size_t axes;
  std::vector<TreeNode> nodes;  ///< the root first
  std::vector<float> values;

  double value(Cell at) const {
    std::size_t k = 0;
    while (nodes[k].halvings < 0) {
      std::size_t branch = 0;
      for (std::size_t i = 0; i < axes; ++i) {
        at[i] *= 2;
        if (at[i] >= 1) branch |= std::size_t{1} << i, at[i] -= 1;
      }
      k = nodes[k].first + branch;
    }
    const int cells = 1 << nodes[k].halvings;
    std::size_t index = 0;
    for (std::size_t i = 0; i < axes; ++i)
      index = index * static_cast<std::size_t>(cells) +
              static_cast<std::size_t>(std::clamp(static_cast<int>(at[i] * cells), 0, cells - 1));
    return static_cast<double>(values[nodes[k].first + index]);
  }
  /// \param leaf  takes the cell's lower corner, its size and its value
  template <class F>
  void for_each_leaf(F leaf, std::size_t k = 0, Cell corner = {}, double size = 1) const {
    const TreeNode& node = nodes[k];
    if (node.halvings < 0) {
      for (std::size_t branch = 0; branch < std::size_t{1} << axes; ++branch) {
        Cell c = corner;
        for (std::size_t i = 0; i < axes; ++i)
          if (branch >> i & 1) c[i] += size / 2;
        for_each_leaf(leaf, node.first + branch, c, size / 2);
      }
      return;
    }
    const std::size_t cells = std::size_t{1} << node.halvings;
    const std::size_t count = std::size_t{1} << (static_cast<std::size_t>(node.halvings) * axes);
    for (std::size_t index = 0; index < count; ++index) {
      Cell c = corner;
      for (std::size_t i = axes, rest = index; i-- > 0; rest /= cells)
        c[i] += size / static_cast<double>(cells) * static_cast<double>(rest % cells);
      leaf(c, size / static_cast<double>(cells), static_cast<double>(values[node.first + index]));
    }
  }
};

class TensorTreeParser {
 public:
  TensorTreeParser(const std::string& path, std::string_view text, std::size_t axes)
      : path_(path), rest_(text) {
    tree_.axes = axes;
    tree_.nodes.push_back({});
    node(0, 0);
    if (const char c = next(); c != 0) fail(fmt::format("'{}'", c), "the end of the tree");
  }
  TensorTree tree() { return std::move(tree_); }
  int depth() const { return depth_; }

 private:
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw bad_input(path_, fmt::format("ScatteringData, number {}", tree_.values.size() + 1), found,
                    expected);
  }
  /// Next character that is no blank; 0 at the end.
  char next() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" ,\t\r\n"), rest_.size()));
    return rest_.empty() ? '\0' : rest_.front();
  }
  void take(char c) {
    const char found = next();
    if (found != c) fail(found ? fmt::format("'{}'", found) : "the end", fmt::format("'{}'", c));
    rest_.remove_prefix(1);
  }
  void node(std::size_t k, int depth) {
    if (depth > kDeepest) fail("a tree nested deeper", fmt::format("at most {} levels", kDeepest));
    take('{');
    if (next() == '{') {
      const std::size_t first = tree_.nodes.size(), count = std::size_t{1} << tree_.axes;
      tree_.nodes[k] = {first, -1};
      tree_.nodes.resize(first + count);
      for (std::size_t n = 0; n < count; ++n) node(first + n, depth + 1);
    } else {
      leaf(k, depth);
    }
    take('}');
  }
  void leaf(std::size_t k, int depth) {
    const std::size_t first = tree_.values.size();
    while (next() != '}') {
      const auto word = rest_.substr(0, rest_.find_first_of(" ,\t\r\n{}"));
      const auto v = number_from<float>(word);
      if (!v || !std::isfinite(*v)) fail(word.empty() ? "no '}'" : in_quotes(word), "a number");
      if ((tree_.values.size() + 1) * 5 > most_values) fail("more", "fewer values");
      tree_.values.push_back(*v);
      rest_.remove_prefix(word.size());
    }
    const std::size_t count = tree_.values.size() - first;
    int halvings = 0;
    while (std::size_t{1} << (static_cast<std::size_t>(halvings) * tree_.axes) < count) ++halvings;
    if (count == 0 ||
        std::size_t{1} << (static_cast<std::size_t>(halvings) * tree_.axes) != count ||
        depth + halvings > kDeepest)
      fail(fmt::format("a leaf of {} values", count),
           fmt::format("1, {} or another power of that", 1 << tree_.axes));
    tree_.nodes[k] = {first, halvings};
    depth_ = std::max(depth_, depth + halvings);
  }

  const std::string& path_;
  std::string_view rest_;
  TensorTree tree_;
  int depth_ = 0;
};

/// Coordinates of directions; nothing below the horizon.
std::optional<Cell> cell_of(const DirectionPair& p, std::size_t axes) {
  if (!(p.wi.z > 0 && p.wo.z > 0)) return {};
  if (axes == 4) {
    const auto [a, b] = square_of_disc(-p.wi.x, -p.wi.y);
    const auto [c, d] = square_of_disc(p.wo.x, p.wo.y);
    return Cell{a, b, c, d};
  }
  const double sine = std::hypot(p.wi.x, p.wi.y);
  const double c = sine > 0 ? -p.wi.x / sine : 1, s = sine > 0 ? -p.wi.y / sine : 0;
  const auto [a, b] = square_of_disc(c * p.wo.x + s * p.wo.y, c * p.wo.y - s * p.wo.x);
  return Cell{std::max(0.0, 0.5 - 0.5 * sine - 1e-12), a, b};
}

}  // namespace

SquarePoint square_of_disc(double x, double y) {
  const double r = std::hypot(x, y);
  double phi = std::atan2(y, x);
  if (phi < -std::numbers::pi / 4) phi += 2 * std::numbers::pi;
  const double quarter = 4 / std::numbers::pi;
  double a, b;
  if (phi < std::numbers::pi / 4)
    a = r, b = phi * quarter * r;
  else if (phi < 3 * std::numbers::pi / 4)
    b = r, a = -(phi - std::numbers::pi / 2) * quarter * r;
  else if (phi < 5 * std::numbers::pi / 4)
    a = -r, b = -(phi - std::numbers::pi) * quarter * r;
  else
    b = -r, a = (phi - 3 * std::numbers::pi / 2) * quarter * r;
  return {std::clamp((a + 1) / 2, 0.0, 1.0), std::clamp((b + 1) / 2, 0.0, 1.0)};
}

SquarePoint disc_of_square(double x, double y) {
  const double a = 2 * x - 1, b = 2 * y - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool along = std::abs(a) > std::abs(b);
  const double r = along ? a : b, phi = along
                                            ? std::numbers::pi / 4 * (b / a)
                                            : std::numbers::pi / 2 - std::numbers::pi / 4 * (a / b);
  return {r * std::cos(phi), r * std::sin(phi)};
}

Table tensor_tree_table(const std::string& path,
                        std::string_view braces,
                        std::size_t axes,
                        bool back) {
  TensorTreeParser parser(path, braces, axes);
  const auto tree = std::make_shared<const TensorTree>(parser.tree());
  const double turn = back ? -1 : 1;
  Table t;
  t.format = "tensor_tree";
  t.channels = {"f"};
  DirectionList l;
  Values values;
  const std::size_t leaves = tree->values.size() / (axes == 3 ? 2 : 1) + 1;
  for (auto* of : {&l.theta_i_deg, &l.phi_i_deg, &l.theta_o_deg, &l.phi_o_deg}) of->reserve(leaves);
  values.reserve(leaves);
  const auto add = [](std::vector<double>& theta, std::vector<double>& phi, double x, double y) {
    theta.push_back(std::asin(std::min(1.0, std::hypot(x, y))) / degree);
    const double deg = std::atan2(y, x) / degree;
    phi.push_back(deg < 0 ? deg + 360 : deg);
  };
  tree->for_each_leaf([&](const Cell& corner, double size, double value) {
    Cell at = corner;
    for (double& x : at) x += size / 2;
    if (axes == 3) {
      if (corner[0] >= 0.5) return;  // no sine is below 0
      const double sine = 1 - (corner[0] + std::min(corner[0] + size, 0.5));
      const auto [x, y] = disc_of_square(at[1], at[2]);
      add(l.theta_i_deg, l.phi_i_deg, -sine, 0);
      add(l.theta_o_deg, l.phi_o_deg, x, turn * y);
    } else {
      const auto [a, b] = disc_of_square(at[0], at[1]);
      const auto [x, y] = disc_of_square(at[2], at[3]);
      add(l.theta_i_deg, l.phi_i_deg, -a, -turn * b);
      add(l.theta_o_deg, l.phi_o_deg, x, turn * y);
    }
    values.push_back(value);
  });
  t.where = std::move(l);
  t.values.push_back(std::move(values));
  t.patch_deg = std::sqrt(std::numbers::pi) * std::ldexp(1.0, -parser.depth()) / degree;
  t.between = [tree, turn](const DirectionPair& p, std::size_t) {
    const auto turned = [&](const Direction& d) { return Direction{d.x, turn * d.y, d.z}; };
    const auto at = cell_of({turned(p.wi), turned(p.wo)}, tree->axes);
    return at ? tree->value(*at) : std::nan("");
  };
  return t;
}

}  // namespace gonio
