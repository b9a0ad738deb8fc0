#pragma once
/// \file
/// A function of a person's file as gonio takes it: which of its arguments are directions, cosines and parameters, what its value
/// includes, and its straight-line code, one for each channel or one for all.
///
///   FILE[:FUNCTION][{NAME=VALUE;…}]     argument.x=noh; includes=cosine|pi|nothing; alpha=0.001,1 (bounds); n=5 (fixed)

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/names.h"
#include "foreign/program.h"
#include "foreign/source.h"
#include "foreign/translate.h"
#include "number/parameter.h"

namespace gonio::foreign {

/// How a function is to be read, where it cannot be known or is guessed wrongly.
struct Reading {
  std::map<std::string, std::string> arguments;  ///< x → noh
  std::optional<std::string> includes;           ///< nothing, cosine, pi
  std::map<std::string, std::vector<double>>
      values;  ///< one: fixed; two: bounds; three: bounds and default

  bool operator==(const Reading&) const = default;
};

/// A file's function as it is named.
struct Name {
  std::string file, function;
  Reading reading{};
};
/// \throws Error  wrong usage of what is no name of a file's function
Name parse_name(std::string_view token);
std::string text_of(const Name&);
/// True of FILE[:FUNCTION][{…}] alone, not of a spec that has one.
bool is_name(std::string_view text);
/// True where there is the file that it names.
bool is_there(std::string_view name);

/// What a function stands for in a model.
enum class Stands { distribution, masking, fresnel, lobe };

struct FunctionParameter {
  std::string name;
  Range range{0, 1};
  double start = 0.5;
  std::optional<std::array<double, 3>>
      colour{};  ///< the default of each channel, where they differ
  bool per_channel = false;
  bool bounded = false;  ///< by the file, or by its reader
};

struct Argument {
  std::string name, stands_for;  ///< "NoL", "NoL"; "alpha", "parameter"
};

struct Function {
  Name name;
  std::string sha256;  ///< of the file
  std::vector<Argument> arguments;
  std::vector<FunctionParameter> parameters;  ///< those that are read
  std::vector<Program> programs;              ///< one, or one a channel; each has one output
  std::vector<Note> notes;
  Stands stands = Stands::lobe;
  bool anisotropic = false;
  bool reads_frame = false;  ///< directions, not only cosines
  bool is_g = false;         ///< a masking function that gives G: V = G/(4 NoL NoV)
  std::string includes = "nothing";
  bool guessed = false;  ///< `includes`
  bool unclear = false;  ///< the guess: albedos are near neither 1 nor π
  bool float_constants = false;
  int line = 0;
};

/// True of a function whose arguments name the light's direction, or one that follows from it: without it there is no BRDF.
bool takes_light(const Function&);
/// True of one whose arguments name any direction but those of the frame.
bool takes_direction(const Function&);

/// A function that a file has.
struct Entry {
  std::string function;
  int line = 0;
  std::string refused{};                 ///< why it cannot be run, where that is known
  std::vector<std::string> arguments{};  ///< their names
  bool is_shadowed = false;              ///< its name means another function
};

/// Files are compiled once in a run.  \throws Error  bad input with the line; wrong usage of a parameter without bounds
Function read_function(const Name&, std::optional<Stands> as = {});
/// Every function of a file that gives a number or a colour, unread.
std::vector<Entry> list_functions(const std::string& file);
/// SHA-256 of a file's bytes as they were compiled.
std::string sha256_of(const std::string& file);
/// Steps that reading a file's functions took so far in this run.
std::size_t steps_of(const std::string& file);
/// Gives a text as the content of a file of that name, for programs that have no file.
void provide(const std::string& file, const std::string& content);

/// f at directions over the horizon by N, X, Y = z, x, y, in double: [channel of programs]
std::vector<double> value_of(const Function&,
                             const std::vector<double>& parameters,
                             const std::array<double, 11>& angles);

}  // namespace gonio::foreign

namespace gonio {
template <>
inline constexpr std::array<std::string_view, 4> names_of<foreign::Stands>{
    "distribution", "masking", "fresnel", "lobe"};
}  // namespace gonio
