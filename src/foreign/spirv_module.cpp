#include "foreign/spirv_module.h"

#include <algorithm>
#include <bit>
#include <functional>

#include "foreign/program.h"
#include "foreign/spirv_words.h"

namespace gonio::foreign {
namespace {

constexpr std::size_t most_members = 1000, most_elements = 4096, most_scalars = 1 << 16;
constexpr int deepest_blocks = 5000;

std::string text_of_words(std::span<const std::uint32_t> words) {
  std::string s;
  for (const auto w : words)
    for (int k = 0; k < 4; ++k) {
      const char c = static_cast<char>(w >> 8 * k & 0xff);
      if (!c) return s;
      s += c;
    }
  return s;
}

}  // namespace

SpirvModule::SpirvModule(std::vector<std::uint32_t> words) : words_(std::move(words)) {
  if (words_.size() < 5 || words_[0] != spv::MagicNumber) throw Refused("no SPIR-V", 0);
  SpirvFunction* f = nullptr;
  int line = 0;
  for (std::size_t at = 5; at < words_.size();) {
    const std::uint32_t length = words_[at] >> 16, op = words_[at] & 0xffff;
    if (length == 0 || at + length > words_.size())
      throw Refused("SPIR-V that ends within an instruction", 0);
    bool has_id = false, has_type = false;
    spv::HasResultAndType(static_cast<spv::Op>(op), &has_id, &has_type);
    if (1U + has_id + has_type > length) throw Refused("SPIR-V with an instruction too short", 0);
    Instruction i{static_cast<std::uint16_t>(op)};
    std::size_t skip = 1;
    if (has_type) i.type = words_[at + skip++];
    if (has_id) i.id = words_[at + skip++];
    i.in = std::span(words_).subspan(at + skip, length - skip);
    at += length;
    if (op == spv::OpLine) line = static_cast<int>(i.in[1]);
    if (op == spv::OpNoLine) line = 0;
    i.line = line;
    declare(i, f);
  }
  for (auto& [id, g] : functions_) {
    put_in_order(g);
    if (g.parameters.empty() && short_name(id) == "main") mains_.push_back(id);
  }
}

std::vector<std::size_t> SpirvModule::globals_of(std::vector<Id> functions) const {
  std::set<Id> seen(functions.begin(), functions.end());
  std::set<std::size_t> globals;
  std::vector<std::size_t> next;
  const auto refer = [&](Id id) {
    if (const auto g = global_at_.find(id); g != global_at_.end()) {
      if (globals.insert(g->second).second) next.push_back(g->second);
    } else if (functions_.contains(id) && seen.insert(id).second) {
      functions.push_back(id);
    }
  };
  // A number among the operands may look like an id: then more is there than is needed.
  for (std::size_t k = 0; k < functions.size(); ++k)
    for (const auto& block : functions_.at(functions[k]).blocks)
      for (const auto& i : block.code) std::ranges::for_each(i.in, refer);
  while (!next.empty()) {
    const auto& g = globals_[next.back()];
    next.pop_back();
    for (const Id id : g.in)
      if (global_at_.contains(id)) refer(id);
  }
  return {globals.begin(), globals.end()};
}

bool SpirvModule::calls(Id caller, Id called) const {
  std::vector<Id> all{caller};
  std::set<Id> seen{caller};
  for (std::size_t k = 0; k < all.size(); ++k)
    for (const auto& block : functions_.at(all[k]).blocks)
      for (const auto& i : block.code) {
        if (i.op != spv::OpFunctionCall) continue;
        if (i.in[0] == called) return true;
        if (functions_.contains(i.in[0]) && seen.insert(i.in[0]).second) all.push_back(i.in[0]);
      }
  return false;
}

void SpirvModule::declare(const Instruction& i, SpirvFunction*& f) {
  switch (i.op) {
    case spv::OpName:
      names_[i.in[0]] = text_of_words(i.in.subspan(1));
      return;
    case spv::OpMemberName: {
      auto& m = member_names_[i.in[0]];
      if (i.in[1] > most_members) throw Refused("a struct of too many members", i.line);
      if (m.size() <= i.in[1]) m.resize(i.in[1] + 1);
      m[i.in[1]] = text_of_words(i.in.subspan(2));
      return;
    }
    case spv::OpExtInstImport:
      if (text_of_words(i.in) == "GLSL.std.450") glsl450_.insert(i.id);
      return;
    case spv::OpTypeInt:
    case spv::OpTypeFloat:
      types_[i.id] = {i.op, i.in[0]};
      return;
    case spv::OpTypeVector:
    case spv::OpTypeMatrix:
      types_[i.id] = {i.op, 0, i.in[0], i.in[1]};
      return;
    case spv::OpTypeArray: {
      std::uint32_t n = 0;
      if (const auto at = global_at_.find(i.in[1]);
          at != global_at_.end() && globals_[at->second].op == spv::OpConstant)
        n = globals_[at->second].in[0];
      if (n == 0 || n > most_elements)
        throw Refused("an array of unknown length, or of more than 4096 elements", i.line);
      types_[i.id] = {i.op, 0, i.in[0], n};
      return;
    }
    case spv::OpTypeStruct: {
      SpirvType t{i.op, 0, 0, 0, 0, {i.in.begin(), i.in.end()}};
      // Empty ones, each of two of the one before, hold no number, and 60 of them 2⁶⁰ structs.
      for (const Id m : t.members)
        if ((t.parts += leaf(m).parts) > most_scalars)
          throw Refused("a struct of more than 65536 parts", i.line);
      types_[i.id] = std::move(t);
      return;
    }
    case spv::OpTypePointer:
      types_[i.id] = {i.op, 0, i.in[1], 0, i.in[0]};
      return;
    case spv::OpTypeFunction:
      types_[i.id] = {i.op, 0, i.in[0], 0, 0, {i.in.begin() + 1, i.in.end()}};
      return;
    case spv::OpTypeVoid:
    case spv::OpTypeBool:
    case spv::OpTypeImage:
    case spv::OpTypeSampler:
    case spv::OpTypeSampledImage:
    case spv::OpTypeRuntimeArray:
      types_[i.id] = {i.op};
      return;
    case spv::OpFunction:
      f = &(functions_[i.id] = {i.id, i.in[1], i.type, {}, {}, {}, {}, i.line});
      return;
    case spv::OpFunctionParameter:
      f->parameters.emplace_back(i.id, i.type);
      return;
    case spv::OpFunctionEnd:
      f = nullptr;
      return;
    case spv::OpLabel:
      f->blocks.push_back({i.id, {}});
      return;
    case spv::OpLine:
    case spv::OpNoLine:
    case spv::OpString:
      return;
    default:
      break;
  }
  if (f && f->blocks.empty()) throw Refused("SPIR-V with code outside a block", i.line);
  if (f && f->line == 0) f->line = i.line;
  if (f)
    f->blocks.back().code.push_back(i);
  else if (i.id && global_at_.try_emplace(i.id, globals_.size()).second)
    globals_.push_back(i);
}

/// Reverse post-order; what follows a construct is visited first, so it stands last.
void SpirvModule::put_in_order(SpirvFunction& g) {
  std::map<Id, std::size_t> at;
  for (std::size_t b = 0; b < g.blocks.size(); ++b) at[g.blocks[b].id] = b;
  std::vector<bool> seen(g.blocks.size());
  std::vector<std::size_t> post;
  const std::function<void(std::size_t, int)> visit = [&](std::size_t b, int depth) {
    if (seen[b]) return;
    if (depth > deepest_blocks) throw Refused("branches nested too deep", g.line);
    seen[b] = true;
    std::vector<Id> next;
    for (const auto& i : g.blocks[b].code) {
      if (i.op == spv::OpLoopMerge) next.insert(next.end(), {i.in[0], i.in[1]});
      if (i.op == spv::OpSelectionMerge || i.op == spv::OpBranch) next.push_back(i.in[0]);
      if (i.op == spv::OpBranchConditional) next.insert(next.end(), {i.in[2], i.in[1]});
      if (i.op == spv::OpSwitch) {
        next.push_back(i.in[1]);
        for (std::size_t k = 3; k < i.in.size(); k += 2) next.push_back(i.in[k]);
      }
    }
    for (const auto n : next) visit(at.at(n), depth + 1);
    post.push_back(b);
  };
  if (!g.blocks.empty()) visit(0, 0);
  g.order.assign(post.rbegin(), post.rend());
  for (std::size_t k = 0; k < g.order.size(); ++k) g.rank[g.blocks[g.order[k]].id] = k;
}

std::string SpirvModule::name(Id id) const {
  const auto i = names_.find(id);
  return i == names_.end() ? "" : i->second;
}

std::string SpirvModule::short_name(Id id) const {
  const auto n = name(id);
  return n.substr(0, n.find('('));
}

std::string SpirvModule::member_name(Id type, std::size_t k) const {
  const auto m = member_names_.find(type);
  return m == member_names_.end() || k >= m->second.size() || m->second[k].empty()
             ? "member_" + std::to_string(k)
             : m->second[k];
}

std::size_t SpirvModule::size(Id id) const {
  const SpirvType& t = types_.at(id);
  std::size_t n = 0;
  switch (t.op) {
    case spv::OpTypeVoid:
      return 0;
    case spv::OpTypeBool:
    case spv::OpTypeInt:
    case spv::OpTypeFloat:
      return 1;
    case spv::OpTypeVector:
    case spv::OpTypeMatrix:
    case spv::OpTypeArray:
      n = t.count * size(t.element);
      break;
    case spv::OpTypeStruct:
      for (const auto m : t.members) n += size(m);
      break;
    default:
      throw Refused("a texture, a buffer or a pointer, which holds no number here", 0);
  }
  if (n > most_scalars) throw Refused("a value of more than 65536 numbers", 0);
  return n;
}

bool SpirvModule::is_of_numbers(Id id) const {
  const SpirvType& t = types_.at(id);
  if (t.op == spv::OpTypeVector || t.op == spv::OpTypeMatrix || t.op == spv::OpTypeArray)
    return is_of_numbers(t.element);
  if (t.op == spv::OpTypeStruct)
    return std::ranges::all_of(t.members, [&](Id m) { return is_of_numbers(m); });
  return t.op == spv::OpTypeBool || t.op == spv::OpTypeInt || t.op == spv::OpTypeFloat;
}

const SpirvType& SpirvModule::leaf(Id id) const {
  static const SpirvType not_yet;  // a pointer's, which may be declared behind its struct
  if (!types_.contains(id)) return not_yet;
  const SpirvType* t = &types_.at(id);
  while (t->op == spv::OpTypeVector || t->op == spv::OpTypeMatrix || t->op == spv::OpTypeArray)
    t = &types_.at(t->element);
  return *t;
}

std::optional<double> number_of(const SpirvModule& m, const Instruction& i) {
  const SpirvType& t = m.type(i.type);
  if (t.width != 32 && (t.width != 64 || t.op == spv::OpTypeInt)) return {};
  if (t.op == spv::OpTypeInt) return static_cast<std::int32_t>(i.in[0]);
  return t.width == 64 ? std::bit_cast<double>(i.in[0] | static_cast<std::uint64_t>(i.in[1]) << 32)
                       : static_cast<double>(std::bit_cast<float>(i.in[0]));
}

}  // namespace gonio::foreign
