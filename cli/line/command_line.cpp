#include "cli/line/command_line.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/nearest.h"
#include "base/text.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace gonio::cli {

Option& Option::required() {
  option_->required();
  return *this;
}

template <class T>
Option& Option::in(T low, T high) {
  option_->check(CLI::Range(low, high));
  return *this;
}
template Option& Option::in(int, int);
template Option& Option::in(std::size_t, std::size_t);
template Option& Option::in(double, double);

Option& Option::one_of(const std::vector<std::string>& names) {
  option_->check(CLI::IsMember(names));
  return *this;
}

Option& Option::not_negative() {
  option_->check([](const std::string& word) -> std::string {
    return word.starts_with('-') ? "'" + word + "' is below 0" : "";
  });
  return *this;
}

Option& Option::at_most(int words) {
  option_->expected(1, words);
  return *this;
}

Option& Option::one_each() {
  option_->allow_extra_args(false);
  return *this;
}

Option& Option::delimiter(char c) {
  option_->delimiter(c);
  return *this;
}

Option& Option::show_default() {
  option_->capture_default_str();
  return *this;
}

std::vector<std::string> Option::given() const {
  if (option_->count() == 0) return {};
  std::vector<std::string> words{option_->get_name()};
  if (option_->get_items_expected_max() > 0)
    words.insert(words.end(), option_->results().begin(), option_->results().end());
  return words;
}

template <class T>
Option Command::option(const std::string& names, T& value, const std::string& help) {
  return Option(app_->add_option(names, value, help));
}
template Option Command::option(const std::string&, std::string&, const std::string&);
template Option Command::option(const std::string&, int&, const std::string&);
template Option Command::option(const std::string&, unsigned long&, const std::string&);
template Option Command::option(const std::string&, unsigned long long&, const std::string&);
template Option Command::option(const std::string&, double&, const std::string&);
template Option Command::option(const std::string&,
                                std::optional<std::string>&,
                                const std::string&);
template Option Command::option(const std::string&, std::optional<int>&, const std::string&);
template Option Command::option(const std::string&,
                                std::optional<unsigned long>&,
                                const std::string&);
template Option Command::option(const std::string&,
                                std::optional<unsigned long long>&,
                                const std::string&);
template Option Command::option(const std::string&, std::optional<double>&, const std::string&);
template Option Command::option(const std::string&, std::vector<std::string>&, const std::string&);
template Option Command::option(const std::string&, std::vector<double>&, const std::string&);

Option Command::flag(const std::string& names, bool& value, const std::string& help) {
  return Option(app_->add_flag(names, value, help));
}

CommandLine::CommandLine(const std::string& description,
                         const std::string& version,
                         const std::string& footer)
    : app_(std::make_unique<CLI::App>(description)) {
  app_->require_subcommand(1);
  app_->set_version_flag("--version", version);
  app_->footer(footer);
}
CommandLine::~CommandLine() = default;

Command CommandLine::command(const std::string& name,
                             const std::string& description,
                             const std::string& example,
                             Action action) {
  auto* c = app_->add_subcommand(name, description);
  c->footer("Example:\n  " + example);
  c->callback([this, action = std::move(action)] { action_ = action; });
  return Command(c);
}

namespace {

[[noreturn]] void refuse_subcommand(const CLI::App& app, const std::string& name) {
  std::vector<std::string> names;
  for (const auto* c : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(c->get_name());
  const std::vector<std::string_view> known(names.begin(), names.end());
  throw wrong_usage(fmt::format("no subcommand '{}'; nearest: {}; see gonio --help", name,
                                fmt::join(nearest(name, known), ", ")));
}

OptionText text_of(const CLI::Option& option) {
  OptionText out;
  out.help = option.get_description();
  out.by_position = option.get_positional();
  for (const auto& name : option.get_snames()) out.names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) out.names.push_back("--" + name);
  if (out.by_position) out.names = {option.get_name(true)};
  out.required = option.get_required();
  out.several = option.get_expected_max() > 1;
  if (option.get_items_expected_max() == 0) return out;
  // CLI11 keeps what is taken nowhere but in the type that its help shows: "TEXT:{fast,exact}".
  const std::string type = option.get_type_name();
  out.value = type;
  const auto open = type.find(":{"), close = type.rfind('}');
  if (open != type.npos && close != type.npos) {
    out.value = type.substr(0, open);
    for (const auto& choice : split(std::string_view(type).substr(open + 2, close - open - 2), ','))
      out.choices.emplace_back(choice);
  }
  return out;
}

CommandText text_of(const CLI::App& app) {
  CommandText out{app.get_name(), app.get_description(), app.get_footer(), {}};
  for (const auto* option : app.get_options()) out.options.push_back(text_of(*option));
  std::ranges::stable_partition(out.options, &OptionText::by_position);
  return out;
}

}  // namespace

std::vector<CommandText> CommandLine::texts() const {
  std::vector<CommandText> out{text_of(*app_)};
  for (const auto* command : app_->get_subcommands([](const CLI::App*) { return true; }))
    out.push_back(text_of(*command));
  return out;
}

Action CommandLine::parse(int argc, const char* const* argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::Success& e) {  // --help, --version
    app_->exit(e);
    return {};
  } catch (const CLI::ParseError& e) {
    const auto called = app_->get_subcommands();
    if (called.empty() && argc > 1) refuse_subcommand(*app_, argv[1]);
    if (called.empty()) throw wrong_usage("no subcommand; see gonio --help");
    std::string what = e.what();
    constexpr std::string_view missing = ": 1 required TEXT missing";  // as CLI11 puts it
    if (what.ends_with(missing))
      what = what.substr(0, what.size() - missing.size()) + " has no value";
    throw wrong_usage(fmt::format("{}; see gonio {} --help", what, called.front()->get_name()));
  }
  return action_;
}

}  // namespace gonio::cli
