#include "foreign/arithmetic.h"

#include <cmath>
#include <string>

#include "foreign/spirv_words.h"

namespace gonio::foreign {

Kind kind(const SpirvModule& m, Id type) {
  const auto op = m.leaf(type).op;
  return op == spv::OpTypeBool ? Kind::truth : op == spv::OpTypeInt ? Kind::integer : Kind::number;
}

Kind kind_of(const Program& p, Ref r) {
  return r < 0 ? Kind::number : p[r].kind;
}

int whole(const Program& p, Ref r) {
  if (r < 0 || !p[r].known) p.refuse("an integer or an index that depends on the sample");
  if (!(std::abs(p[r].value) < 0x1p31)) p.refuse("an integer beyond 32 bits");
  return static_cast<int>(p[r].value);
}

Value step(const Program& p, const SpirvModule& m, Value q, int k) {
  const SpirvType& t = m.type(q.type);
  const auto count = static_cast<int>(t.op == spv::OpTypeStruct ? t.members.size() : t.count);
  if (k < 0 || k >= count) p.refuse("an index out of bounds");
  if (t.op == spv::OpTypeStruct) {
    for (int j = 0; j < k; ++j) q.offset += m.size(t.members[static_cast<std::size_t>(j)]);
    q.type = t.members[static_cast<std::size_t>(k)];
  } else {
    q.offset += static_cast<std::size_t>(k) * m.size(t.element);
    q.type = t.element;
  }
  return q;
}

Ref choose(Program& p, Ref mask, Ref a, Ref b, Kind k) {
  if (a == b || b == nothing || p.is(mask, 1)) return a;
  if (a == nothing || p.is(mask, 0)) return b;
  if (k == Kind::integer) p.refuse("an integer that depends on the sample");
  if (k == Kind::truth)
    return p(Op::either, p(Op::both, mask, a), p(Op::both, p(Op::inverse, mask), b));
  return p(Op::select, mask, a, b);
}

namespace {

Value extended(Program& p, const SpirvModule& m, const Instruction& i, const Known& known) {
  if (!m.is_glsl450(i.in[0])) p.refuse("functions of another set than GLSL.std.450");
  std::vector<Parts> arguments;
  for (std::size_t k = 2; k < i.in.size(); ++k) arguments.push_back(known(i.in[k]).parts);
  return {i.type, glsl_function(p, i.in[1], arguments)};
}

}  // namespace

Value compute(Program& p, const SpirvModule& m, const Instruction& i, const Known& known) {
  const auto in = i.in;
  Value r{i.type};
  const auto at = [&](std::size_t k) -> const Parts& { return known(in[k]).parts; };
  const auto each = [&](auto f) {
    const Parts a = at(0);
    for (const Ref x : a) r.parts.push_back(f(x));
    return r;
  };
  const auto pairs = [&](auto f) {
    const Parts a = at(0), b = at(1);
    for (std::size_t k = 0; k < a.size(); ++k) r.parts.push_back(f(a[k], b.at(k)));
    return r;
  };
  const auto by = [&](Op op) { return pairs([&](Ref a, Ref b) { return p(op, a, b); }); };
  const auto turned = [&](Op op) { return pairs([&](Ref a, Ref b) { return p(op, b, a); }); };
  const auto integers = [&](auto f) {
    return pairs([&](Ref a, Ref b) {
      const auto v =
          f(static_cast<std::int64_t>(whole(p, a)), static_cast<std::int64_t>(whole(p, b)));
      return p.constant(static_cast<double>(static_cast<std::int32_t>(v)), kind(m, i.type));
    });
  };
  switch (i.op) {
    case spv::OpFAdd:
      return by(Op::add);
    case spv::OpFSub:
      return by(Op::sub);
    case spv::OpFMul:
      return by(Op::mul);
    case spv::OpFDiv:
      return by(Op::div);
    case spv::OpFMod:
      return pairs([&](Ref a, Ref b) {
        return p(Op::sub, a, p(Op::mul, b, p(Op::floor, p(Op::div, a, b))));
      });
    case spv::OpFNegate:
      return each([&](Ref a) { return p(Op::neg, a); });
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar: {
      const Ref s = at(1).at(0);
      return each([&](Ref a) { return p(Op::mul, a, s); });
    }
    case spv::OpDot:
      r.parts = {dot(p, Parts(at(0)), Parts(at(1)))};
      return r;
    case spv::OpMatrixTimesVector: {
      const Parts a = at(0), v = at(1);
      const std::size_t rows = m.size(i.type);
      for (std::size_t k = 0; k < rows; ++k) r.parts.push_back(dot(p, a, v, k, 0, v.size(), rows));
      return r;
    }
    case spv::OpVectorTimesMatrix: {
      const Parts v = at(0), a = at(1);
      for (std::size_t k = 0; k < m.size(i.type); ++k)
        r.parts.push_back(dot(p, v, a, 0, k * v.size(), v.size()));
      return r;
    }
    case spv::OpMatrixTimesMatrix: {
      const Parts a = at(0), b = at(1);
      const std::size_t rows = m.size(m.type(i.type).element), inner = a.size() / rows;
      for (std::size_t c = 0; c < m.type(i.type).count; ++c)
        for (std::size_t k = 0; k < rows; ++k)
          r.parts.push_back(dot(p, a, b, k, c * inner, inner, rows));
      return r;
    }
    case spv::OpTranspose: {
      const Parts a = at(0);
      const std::size_t columns = m.size(m.type(i.type).element), rows = a.size() / columns;
      for (std::size_t c = 0; c < rows; ++c)
        for (std::size_t k = 0; k < columns; ++k) r.parts.push_back(a.at(k * rows + c));
      return r;
    }
    case spv::OpFOrdLessThan:
    case spv::OpFUnordLessThan:
      return by(Op::less);
    case spv::OpFOrdGreaterThan:
    case spv::OpFUnordGreaterThan:
      return turned(Op::less);
    case spv::OpFOrdLessThanEqual:
    case spv::OpFUnordLessThanEqual:
      return by(Op::less_equal);
    case spv::OpFOrdGreaterThanEqual:
    case spv::OpFUnordGreaterThanEqual:
      return turned(Op::less_equal);
    case spv::OpFOrdEqual:
    case spv::OpFUnordEqual:
      return by(Op::equal);
    case spv::OpFOrdNotEqual:
    case spv::OpFUnordNotEqual:
      return pairs([&](Ref a, Ref b) { return p(Op::inverse, p(Op::equal, a, b)); });
    case spv::OpIsNan:
      return each([&](Ref a) { return p(Op::inverse, p(Op::equal, a, a)); });
    case spv::OpIsInf:
      return each([&](Ref a) {
        return p(Op::either, p(Op::equal, a, p.constant(INFINITY)),
                 p(Op::equal, a, p.constant(-INFINITY)));
      });
    case spv::OpLogicalAnd:
      return by(Op::both);
    case spv::OpLogicalOr:
      return by(Op::either);
    case spv::OpLogicalNot:
      return each([&](Ref a) { return p(Op::inverse, a); });
    case spv::OpLogicalEqual:
      return pairs([&](Ref a, Ref b) { return choose(p, a, b, p(Op::inverse, b), Kind::truth); });
    case spv::OpLogicalNotEqual:
      return pairs([&](Ref a, Ref b) { return choose(p, a, p(Op::inverse, b), b, Kind::truth); });
    case spv::OpAny:
    case spv::OpAll: {
      const Parts a = at(0);
      Ref s = a.at(0);
      for (const Ref x : a) s = p(i.op == spv::OpAny ? Op::either : Op::both, s, x);
      r.parts = {s};
      return r;
    }
    case spv::OpSelect: {
      const Parts c = at(0), a = at(1), b = at(2);
      for (std::size_t k = 0; k < a.size(); ++k)
        r.parts.push_back(choose(p, c.at(c.size() == 1 ? 0 : k), a[k], b.at(k), kind(m, i.type)));
      return r;
    }
    case spv::OpCompositeConstruct:
      for (std::size_t k = 0; k < in.size(); ++k)
        r.parts.insert(r.parts.end(), at(k).begin(), at(k).end());
      return r;
    case spv::OpCompositeExtract: {
      Value q{known(in[0]).type};
      for (std::size_t k = 1; k < in.size(); ++k) q = step(p, m, q, static_cast<int>(in[k]));
      for (std::size_t k = 0; k < m.size(i.type); ++k) r.parts.push_back(at(0).at(q.offset + k));
      return r;
    }
    case spv::OpCompositeInsert: {
      Value q{i.type};
      for (std::size_t k = 2; k < in.size(); ++k) q = step(p, m, q, static_cast<int>(in[k]));
      r.parts = at(1);
      for (std::size_t k = 0; k < at(0).size(); ++k) r.parts.at(q.offset + k) = at(0)[k];
      return r;
    }
    case spv::OpVectorShuffle:
      for (std::size_t k = 2; k < in.size(); ++k)
        r.parts.push_back(in[k] < at(0).size() ? at(0)[in[k]] : at(1).at(in[k] - at(0).size()));
      return r;
    case spv::OpVectorExtractDynamic: {
      const int k = whole(p, at(1).at(0));
      if (k < 0 || k >= static_cast<int>(at(0).size())) p.refuse("an index out of bounds");
      r.parts = {at(0)[static_cast<std::size_t>(k)]};
      return r;
    }
    case spv::OpCopyObject:
    case spv::OpFConvert:
    case spv::OpUConvert:
    case spv::OpSConvert:
      r.parts = at(0);
      return r;
    case spv::OpConvertSToF:
    case spv::OpConvertUToF:
      return each([&](Ref a) { return p.constant(whole(p, a)); });
    case spv::OpConvertFToS:
    case spv::OpConvertFToU:
    case spv::OpBitcast:
      return each([&](Ref a) { return p.constant(whole(p, a), kind(m, i.type)); });
    case spv::OpIAdd:
      return integers([](auto a, auto b) { return a + b; });
    case spv::OpISub:
      return integers([](auto a, auto b) { return a - b; });
    case spv::OpIMul:
      return integers([](auto a, auto b) { return a * b; });
    case spv::OpSDiv:
    case spv::OpUDiv:
      return integers([](auto a, auto b) { return b ? a / b : 0; });
    case spv::OpSMod:
    case spv::OpUMod:
    case spv::OpSRem:
      return integers([](auto a, auto b) { return b ? a % b : 0; });
    case spv::OpSNegate:
      return each(
          [&](Ref a) { return p.constant(-static_cast<double>(whole(p, a)), Kind::integer); });
    case spv::OpSLessThan:
    case spv::OpULessThan:
      return integers([](auto a, auto b) { return a < b; });
    case spv::OpSLessThanEqual:
    case spv::OpULessThanEqual:
      return integers([](auto a, auto b) { return a <= b; });
    case spv::OpSGreaterThan:
    case spv::OpUGreaterThan:
      return integers([](auto a, auto b) { return a > b; });
    case spv::OpSGreaterThanEqual:
    case spv::OpUGreaterThanEqual:
      return integers([](auto a, auto b) { return a >= b; });
    case spv::OpIEqual:
      return integers([](auto a, auto b) { return a == b; });
    case spv::OpINotEqual:
      return integers([](auto a, auto b) { return a != b; });
    case spv::OpUndef:
      r.parts.assign(m.size(i.type), nothing);
      return r;
    case spv::OpExtInst:
      return extended(p, m, i, known);
    case spv::OpDPdx:
    case spv::OpDPdy:
    case spv::OpFwidth:
      p.refuse("a derivative by pixels (dFdx, dFdy or fwidth)");
    default:
      if (i.op >= spv::OpSampledImage && i.op <= spv::OpImageQuerySamples)
        p.refuse("a texture is read");
      p.refuse("instruction " + std::to_string(i.op) + ", which no function of numbers needs");
  }
}

}  // namespace gonio::foreign
