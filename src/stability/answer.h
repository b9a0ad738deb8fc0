#pragma once
/// \file
/// Answers to one question: does a formula keep what is required of it, over a domain, in a number?

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "stability/evidence.h"
#include "stability/subject.h"

namespace gonio::stability {

/// "finite", "nonnegative", "relative=0.02" or "absolute=0.002"; wrong usage for all else.
Requirement parse_requirement(std::string_view text);

struct Question {
  Subject subject;
  Arithmetic arithmetic;
  Requirement requirement;
  std::uint64_t seed = 1;
  /// Boxes of a proof, after which what is unproved is open; none: 20 000, and of what is dear as many as take seconds.
  std::optional<std::uint64_t> boxes{};
  bool safe_from = true;        ///< whether the least value from which it holds is looked for, too
  bool proves = true;           ///< false: what a search does not find stays open
  bool exhausts = true;         ///< false: a search, also where every half could be looked at
  bool measures_errors = true;  ///< false: a search only looks for inputs without a value
};

/// An input for which a requirement does not hold.
struct NamedInput {
  std::vector<std::pair<std::string, double>> inputs;
  std::vector<std::pair<std::string, std::string>> inputs_hex;  ///< the same as the number's bits
  double value, exact;
};

/// Least value of the parameter that decides from which on a requirement holds; none: of no value of the domain.
struct Least {
  std::string requirement;
  bool flush;
  std::optional<double> value;
  /// exhaustive and proved: it holds from there on for every input; searched: a search finds no input above that breaks it.
  Evidence evidence;
};

struct Answer {
  std::string id, form;
  Arithmetic arithmetic;
  std::vector<std::pair<std::string, std::vector<double>>> domain;
  std::string requirement;
  Evidence evidence = Evidence::open;  ///< of `holds`
  bool holds = false;
  std::optional<NamedInput> counterexample;
  Looked looked;
  std::string worst_at, worst_hex;   ///< where looked.relative is
  std::optional<double> proved_rel;  ///< bound of the relative error
  std::string unproved_because;      ///< why what is required is open; empty: it is not, or nobody
                                     ///< could have proved it
  std::optional<Range> range;        ///< that the value is proved to lie in
  std::uint64_t boxes = 0;           ///< of the proof
  double open_share = 0;             ///< part of the domain that is neither proved nor refuted
  std::optional<Least> safe_from{};  ///< of what is required; none: no parameter decides
  std::vector<Least> least{};        ///< of all requirements, where that was asked
};

/// Answer by whatever evidence is the strongest: of one or two halves every input, else a proof; a search refutes, and
/// tells the worst, but never establishes.
///
/// On any GPU proofs alone establish.  What is looked at is IEEE arithmetic, which is one of those that the rule allows: a
/// counterexample of it is one, and the worst that it shows is a lower bound of the worst.
///
/// \throws Error (wrong usage) of any GPU in mixed numbers, for which nothing is proved
Answer answer(const Question&);
/// Everything that looking finds: every input where they are halves and few, else a search.
Looked look(const Subject&,
            const Arithmetic&,
            const Tolerance&,
            std::uint64_t seed,
            bool measures_errors = true,
            bool exhausts = true);

/// Least values of `subject.decides` from which each requirement holds: finite, nonnegative, and an error, relative and absolute,
/// the question's own limit or the usual one; in half subnormal results kept, and flushed.  Where there is a proof, they are found
/// to 3.5 % by halving.
std::vector<Least> least_values(const Question&);
/// Absolute error that is usual to ask of values up to 1: half a step of eight bits.
inline constexpr double usual_absolute = 0.002;

/// "half, flushed", "float, on any GPU"
std::string text_of(const Arithmetic&);
/// "alpha 0.01, noh 1"
std::string text_of(const Subject&, std::span<const double> inputs);
/// "alpha 0x211f, noh 0x3c00"
std::string hex_of(const Subject&, Number, std::span<const double> inputs);

/// Document of an answer (gonio.stability/1).
std::string to_json(const Answer&);
std::string answer_schema();

}  // namespace gonio::stability
