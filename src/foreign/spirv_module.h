#pragma once
/// \file
/// A SPIR-V module that the validator has passed, taken apart: types, names, constants, functions and their blocks.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gonio::foreign {

using Id = std::uint32_t;

struct SpirvType {
  std::uint32_t op = 0, width = 0;
  Id element = 0;  ///< of a vector, matrix, array or pointer; of a function what it returns
  std::uint32_t count = 0, storage = 0;
  std::vector<Id> members{};
  std::size_t parts = 1;  ///< of a struct, with those of its members
};

struct Instruction {
  std::uint16_t op;
  Id type = 0, id = 0;                  ///< 0: none
  std::span<const std::uint32_t> in{};  ///< operands after these
  int line = 0;                         ///< of the person's text; 0: not known
};

struct SpirvBlock {
  Id id;
  std::vector<Instruction> code;
};

struct SpirvFunction {
  Id id, type, result;
  std::vector<std::pair<Id, Id>> parameters;  ///< id, type
  std::vector<SpirvBlock> blocks;
  std::vector<std::size_t> order;  ///< of blocks: a construct's stand before what follows it
  std::map<Id, std::size_t> rank;  ///< block → place in that order
  int line = 0;
};

class SpirvModule {
 public:
  /// \throws Refused  of what is no SPIR-V, or is larger than anything a person writes
  explicit SpirvModule(std::vector<std::uint32_t> words);
  SpirvModule(const SpirvModule&) = delete;

  const std::map<Id, SpirvFunction>& functions() const { return functions_; }
  const std::vector<Instruction>& globals() const { return globals_; }
  /// Places among globals() of what some functions refer to, with what they call: ascending.
  std::vector<std::size_t> globals_of(std::vector<Id> functions) const;
  /// Whether one function calls another, maybe by way of others.
  bool calls(Id caller, Id called) const;
  /// Functions of that name without a parameter, which a compiler puts the values of globals into.
  const std::vector<Id>& mains() const { return mains_; }
  const SpirvType& type(Id id) const { return types_.at(id); }
  std::string name(Id id) const;
  /// Without the signature that glslang appends.
  std::string short_name(Id id) const;
  std::string member_name(Id type, std::size_t k) const;
  bool is_glsl450(Id set) const { return glsl450_.contains(set); }
  /// Scalars that a value of this type has; refuses a type that holds what is no number.
  std::size_t size(Id type) const;
  bool is_of_numbers(Id type) const;
  /// The scalar type that vectors, matrices and arrays consist of.
  const SpirvType& leaf(Id type) const;

  mutable std::atomic<std::size_t> steps = 0;  ///< that translating its functions took so far

 private:
  void declare(const Instruction&, SpirvFunction*& f);
  static void put_in_order(SpirvFunction&);

  std::vector<std::uint32_t> words_;
  std::map<Id, std::string> names_;
  std::map<Id, std::vector<std::string>> member_names_;
  std::map<Id, SpirvType> types_;
  std::vector<Instruction> globals_;
  std::unordered_map<Id, std::size_t> global_at_;
  std::vector<Id> mains_;
  std::map<Id, SpirvFunction> functions_;
  std::set<Id> glsl450_;
};

/// The number that an OpConstant is; none of one that has neither 32 nor 64 bits.
std::optional<double> number_of(const SpirvModule&, const Instruction&);

}  // namespace gonio::foreign
