#include "foreign/glsl_functions.h"

#include <cmath>
#include <numbers>
#include <string>

#include "foreign/spirv_words.h"

namespace gonio::foreign {

Ref power(Program& p, Ref x, Ref y) {
  if (y >= 0 && p[y].op == Op::constant)
    if (const double n = p[y].value; n >= 1 && n <= 16 && n == std::floor(n)) {
      Ref r = nothing, q = x;
      for (int k = static_cast<int>(n); k; k >>= 1) {
        if (k & 1) r = r < 0 ? q : p(Op::mul, r, q);
        if (k > 1) q = p(Op::mul, q, q);
      }
      return r;
    }
  return p(Op::pow, x, y);
}
Ref clamp(Program& p, Ref x, Ref low, Ref high) {
  return p(Op::min, p(Op::max, x, low), high);
}
Ref dot(Program& p,
        const Parts& a,
        const Parts& b,
        std::size_t from_a,
        std::size_t from_b,
        std::size_t n,
        std::size_t step_a) {
  Ref s = p(Op::mul, a.at(from_a), b.at(from_b));
  for (std::size_t k = 1; k < n; ++k)
    s = p(Op::add, s, p(Op::mul, a.at(from_a + k * step_a), b.at(from_b + k)));
  return s;
}
Ref dot(Program& p, const Parts& a, const Parts& b) {
  return dot(p, a, b, 0, 0, a.size());
}
Ref length(Program& p, const Parts& a) {
  return p(Op::sqrt, dot(p, a, a));
}

Parts glsl_function(Program& p, Id function, const std::vector<Parts>& arguments) {
  const auto at = [&](std::size_t n, std::size_t k) { return arguments.at(n).at(k); };
  Parts r;
  const auto each = [&](auto f) {
    for (std::size_t k = 0; k < arguments.at(0).size(); ++k) r.push_back(f(k));
    return r;
  };
  const auto one = [&](Op op) { return each([&](std::size_t k) { return p(op, at(0, k)); }); };
  const auto two = [&](Op op) {
    return each([&](std::size_t k) { return p(op, at(0, k), at(1, k)); });
  };
  const auto scaled = [&](double s) {
    return each([&](std::size_t k) { return p(Op::mul, at(0, k), p.constant(s)); });
  };
  switch (function) {
    case GLSLstd450FAbs:
      return each([&](std::size_t k) { return p(Op::max, at(0, k), p(Op::neg, at(0, k))); });
    case GLSLstd450FSign:
      return each([&](std::size_t k) {
        const Ref x = at(0, k), zero = p.constant(0);
        return p(Op::select, p(Op::less, zero, x), p.constant(1),
                 p(Op::select, p(Op::less, x, zero), p.constant(-1), zero));
      });
    case GLSLstd450Floor:
      return one(Op::floor);
    case GLSLstd450Ceil:
      return each([&](std::size_t k) { return p(Op::neg, p(Op::floor, p(Op::neg, at(0, k)))); });
    case GLSLstd450Fract:
      return each([&](std::size_t k) { return p(Op::sub, at(0, k), p(Op::floor, at(0, k))); });
    case GLSLstd450Round:
    case GLSLstd450RoundEven:  // x + 0.5 may have been rounded up
      return each([&](std::size_t k) {
        const Ref x = at(0, k), up = p(Op::floor, p(Op::add, x, p.constant(0.5)));
        const Ref far = p(Op::sub, up, x), half = p(Op::mul, up, p.constant(0.5));
        const Ref is_even = p(Op::equal, p(Op::floor, half), half);
        const Ref is_down =
            p(Op::either, p(Op::less, p.constant(0.5), far),
              p(Op::both, p(Op::inverse, is_even), p(Op::equal, far, p.constant(0.5))));
        return p(Op::select, is_down, p(Op::sub, up, p.constant(1)), up);
      });
    case GLSLstd450Radians:
      return scaled(std::numbers::pi / 180);
    case GLSLstd450Degrees:
      return scaled(180 / std::numbers::pi);
    case GLSLstd450Sin:
      return one(Op::sin);
    case GLSLstd450Cos:
      return one(Op::cos);
    case GLSLstd450Tan:
      return each(
          [&](std::size_t k) { return p(Op::div, p(Op::sin, at(0, k)), p(Op::cos, at(0, k))); });
    case GLSLstd450Asin:
      return one(Op::asin);
    case GLSLstd450Acos:
      return one(Op::acos);
    case GLSLstd450Atan:
      return one(Op::atan);
    case GLSLstd450Atan2:
      return two(Op::atan2);
    case GLSLstd450Pow:
      return each([&](std::size_t k) { return power(p, at(0, k), at(1, k)); });
    case GLSLstd450Exp:
      return one(Op::exp);
    case GLSLstd450Log:
      return one(Op::log);
    case GLSLstd450Exp2:
      return one(Op::exp2);
    case GLSLstd450Log2:
      return one(Op::log2);
    case GLSLstd450Sqrt:
      return one(Op::sqrt);
    case GLSLstd450InverseSqrt:
      return each([&](std::size_t k) { return p(Op::div, p.constant(1), p(Op::sqrt, at(0, k))); });
    case GLSLstd450FMin:
    case GLSLstd450NMin:
      return two(Op::min);
    case GLSLstd450FMax:
    case GLSLstd450NMax:
      return two(Op::max);
    case GLSLstd450FClamp:
    case GLSLstd450NClamp:
      return each([&](std::size_t k) { return clamp(p, at(0, k), at(1, k), at(2, k)); });
    case GLSLstd450FMix:  // x (1 − a) + y a
      return each([&](std::size_t k) {
        return p(Op::add, p(Op::mul, at(0, k), p(Op::sub, p.constant(1), at(2, k))),
                 p(Op::mul, at(1, k), at(2, k)));
      });
    case GLSLstd450Step:
      return each([&](std::size_t k) {
        return p(Op::select, p(Op::less, at(1, k), at(0, k)), p.constant(0), p.constant(1));
      });
    case GLSLstd450SmoothStep:
      return each([&](std::size_t k) {
        const Ref a = at(0, k);
        const Ref t = clamp(p, p(Op::div, p(Op::sub, at(2, k), a), p(Op::sub, at(1, k), a)),
                            p.constant(0), p.constant(1));
        return p(Op::mul, p(Op::mul, t, t),
                 p(Op::sub, p.constant(3), p(Op::mul, p.constant(2), t)));
      });
    case GLSLstd450Fma:
      return each(
          [&](std::size_t k) { return p(Op::add, p(Op::mul, at(0, k), at(1, k)), at(2, k)); });
    case GLSLstd450Length:
      r = {length(p, arguments.at(0))};
      return r;
    case GLSLstd450Distance: {
      Parts d;
      for (std::size_t k = 0; k < arguments.at(0).size(); ++k)
        d.push_back(p(Op::sub, at(0, k), at(1, k)));
      r = {length(p, d)};
      return r;
    }
    case GLSLstd450Normalize: {
      const Ref l = length(p, arguments.at(0));
      return each([&](std::size_t k) { return p(Op::div, at(0, k), l); });
    }
    case GLSLstd450Cross:
      return each([&](std::size_t k) {
        const std::size_t j = (k + 1) % 3, l = (k + 2) % 3;
        return p(Op::sub, p(Op::mul, at(0, j), at(1, l)), p(Op::mul, at(1, j), at(0, l)));
      });
    case GLSLstd450Reflect: {
      const Ref d = p(Op::mul, p.constant(2), dot(p, arguments.at(1), arguments.at(0)));
      return each([&](std::size_t k) { return p(Op::sub, at(0, k), p(Op::mul, d, at(1, k))); });
    }
    default:
      p.refuse("function " + std::to_string(function) + " of GLSL.std.450");
  }
}

}  // namespace gonio::foreign
