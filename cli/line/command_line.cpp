#include "cli/line/command_line.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/nearest.h"
#include "base/numbers.h"
#include "base/options.h"
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
  if constexpr (std::is_floating_point_v<T>)  // CLI's own takes nan, and writes six digits
    option_->check(CLI::Validator(
        [low, high](const std::string& word) {
          const auto x = number_from<double>(word);
          if (x && low <= *x && *x <= high) return std::string();
          return fmt::format("Value {} not in range {:g} to {:g}", word, low, high);
        },
        fmt::format("{} in [{:g} - {:g}]", option_->get_type_name(), low, high)));
  else
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

Option Command::option(const std::string& names,
                       const ValueType& t,
                       void* value,
                       const std::string& help,
                       const Rules& rules) {
  auto* const o = app_->add_option(
      names,
      [&t, value, rules](const CLI::results_t& words) {
        return set_from_words(t, rules, value, words);
      },
      help, false, [&t, value, rules] { return word_of(t, rules, value); });
  const bool list = t.kind == ValueKind::list;
  const ValueType& of = list || t.kind == ValueKind::optional ? *t.of : t;
  const bool number = of.kind == ValueKind::number, whole = of.kind == ValueKind::whole;
  o->type_name(number ? "FLOAT" : !whole ? "TEXT" : of.is_signed ? "INT" : "UINT");
  if (list) o->expected(CLI::detail::expected_max_vector_size);
  if (const auto all = choices_of(of, rules); !all.empty())
    o->check(CLI::IsMember(std::vector<std::string>(all.begin(), all.end())));
  if (whole && !of.is_signed)
    o->check([](const std::string& word) {
      return word.starts_with('-') ? "'" + word + "' is below 0" : std::string();
    });
  if (rules.has_numbers) {
    const auto end = [&](double x) {
      return fmt::format(fmt::runtime(whole ? "{:.0f}" : "{:g}"), x);
    };
    const auto [low, high] = std::pair(end(rules.numbers.low), end(rules.numbers.high));
    o->check(CLI::Validator(
        [numbers = rules.numbers, low = low, high = high](const std::string& word) {
          const auto x = number_from<double>(word);
          if (x && numbers.holds(*x)) return std::string();
          return fmt::format("Value {} not in range {} to {}", word, low, high);
        },
        fmt::format("{} in [{} - {}]", o->get_type_name(), low, high)));
  }
  return Option(o);
}

Option Command::flag(const std::string& names, bool& value, const std::string& help) {
  return Option(app_->add_flag(names, value, help));
}

std::vector<Option> Command::options(const RecordType& record, void* at) {
  std::vector<Option> all;
  for_each_option(record, at, [&](const RecordField& f, void* value) {
    std::string name = "--" + std::string(f.name), help = help_of(f);
    std::ranges::replace(name, '_', '-');
    // As a sentence; "auto: …" begins with a value's name.
    if (help.find(':') > help.find(' ') && help[0] >= 'a')
      help[0] = static_cast<char>(help[0] - 'a' + 'A');
    if (is_flag(f)) {
      all.push_back(flag(name, *static_cast<bool*>(value), help));
      return;
    }
    Option o = option(name, *f.type, value, help, f.rules).show_default();
    if (f.type->kind == ValueKind::list && f.rules.entries.most != Entries{}.most)
      o.at_most(static_cast<int>(f.rules.entries.most));
    else if (f.type->kind == ValueKind::list)
      o.delimiter(',');
    all.push_back(o);
  });
  return all;
}

CommandLine::CommandLine(const std::string& description,
                         const std::function<std::string()>& version,
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

/// An option that the command has not, where one is among the words that it left over.
void refuse_option(const CLI::App& command) {
  const auto left = command.remaining();
  const auto unknown =
      std::ranges::find_if(left, [](const std::string& word) { return word.starts_with("--"); });
  if (unknown == left.end()) return;
  std::vector<std::string> names;
  for (const auto* o : command.get_options())
    for (const auto& name : o->get_lnames()) names.push_back("--" + name);
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string name = unknown->substr(0, unknown->find('='));
  throw wrong_usage(fmt::format("no option '{}'; nearest: {}; see gonio {} --help",
                                printable(name, 80), fmt::join(nearest(name, known), ", "),
                                command.get_name()));
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
    refuse_option(*called.front());
    std::string what = e.what();
    constexpr std::string_view missing = ": 1 required TEXT missing";  // as CLI11 puts it
    if (what.ends_with(missing))
      what = what.substr(0, what.size() - missing.size()) + " has no value";
    throw wrong_usage(fmt::format("{}; see gonio {} --help", what, called.front()->get_name()));
  }
  return action_;
}

}  // namespace gonio::cli
