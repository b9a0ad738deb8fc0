#pragma once
/// \file
/// The words of a call: subcommands and their options.  CLI11 reads them; only command_line.cpp
/// includes it, for each file that does compiles its inline functions again.
///
/// Options of what the program does are declared beside the struct that holds them (base/describe.h): a field's name, meaning, unit,
/// range, choices and default become those of an option.

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/record.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace gonio::cli {

/// The program's work after parsing.
using Action = std::function<Exit()>;

/// An option and the rules for its words.  A call that breaks one is refused before anything runs; the help
/// shows them.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}
  Option& required();
  /// Numbers of both ends and between, of the ends' type.  \tparam T  int, std::size_t, double
  template <class T>
  Option& in(T low, T high);
  Option& one_of(const std::vector<std::string>& names);
  template <class Name, std::size_t N>
  Option& one_of(const std::array<Name, N>& names) {
    return one_of(std::vector<std::string>(names.begin(), names.end()));
  }
  /// From one to so many words each time that it is given.
  Option& at_most(int words);
  /// One word each time that it is given.
  Option& one_each();
  /// Several values in a word.
  Option& delimiter(char);
  /// The help shows the value as it is now.
  Option& show_default();
  /// Words that give it as this call does: its name and values; none where it is not given.
  std::vector<std::string> given() const;

 private:
  CLI::Option* option_;
};

/// A subcommand.  It writes into what it was given by reference, which has to live until the parse.
class Command {
 public:
  explicit Command(CLI::App* app) : app_(app) {}
  /// \param names  "-o,--output", or without dashes a word by its position
  /// \tparam T     text, a number, an enumeration with names; std::optional or std::vector of these; a type with from_words
  template <class T>
  Option option(const std::string& names, T& value, const std::string& help) {
    return option(names, type_of<T>, &value, help, {});
  }
  /// \param names  "--full", or "!--no-plain" that makes it false
  Option flag(const std::string& names, bool& value, const std::string& help);
  /// An option for each field that the description of a struct has, "--refine-normals" for refine_normals; its value as it is now is the
  /// default.  A list takes several words, or where its rules have no Entries one with commas.
  template <Described T>
  std::vector<Option> options(T& value) {
    return options(record_of<T>, &value);
  }

 private:
  Option option(const std::string& names,
                const ValueType&,
                void* value,
                const std::string& help,
                const Rules&);
  std::vector<Option> options(const RecordType&, void* value);

  CLI::App* app_;
};

/// What is known of an option, for its manual and for a shell's completion.
struct OptionText {
  std::vector<std::string> names;  ///< as "-o" and "--output"; of a word by its position that alone
  std::string value;               ///< as "TEXT" or "INT in [1 - 64]"; empty of a flag
  std::string help;
  std::vector<std::string> choices;  ///< where only these are taken
  bool by_position = false;
  bool required = false, several = false;  ///< of a word by its position
};
struct CommandText {
  std::string name, description, footer;
  std::vector<OptionText> options;  ///< words by their position first
};

class CommandLine {
 public:
  CommandLine(const std::string& description,
              const std::function<std::string()>& version,
              const std::string& footer);
  ~CommandLine();
  /// A subcommand with its example under the help, and the options that it keeps for `run`.
  template <class Options>
  std::pair<Command, Options*> command(const std::string& name,
                                       const std::string& description,
                                       const std::string& example,
                                       Exit (*run)(const Options&)) {
    const auto options = std::make_shared<Options>();
    return {command(name, description, example, [options, run] { return run(*options); }),
            options.get()};
  }
  /// \return  what the subcommand does; empty if help or the version was asked for and is printed
  /// \throws  wrong_usage
  Action parse(int argc, const char* const* argv);
  /// The whole program, then its subcommands in the order of the help.
  std::vector<CommandText> texts() const;

 private:
  Command command(const std::string& name,
                  const std::string& description,
                  const std::string& example,
                  Action);

  std::unique_ptr<CLI::App> app_;
  Action action_;  ///< of the subcommand that was called
};

}  // namespace gonio::cli
