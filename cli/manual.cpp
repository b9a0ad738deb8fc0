// Man pages and the completion of shells, from the words that the program itself reads.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/file.h"
#include "cli/line/command.h"
#include "fitting/choice/choice.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

struct Options {
  const CommandLine* line = nullptr;
  std::string folder;
};

std::string replaced(std::string_view text, std::string_view what, std::string_view by) {
  std::string out;
  for (const char c : text) {
    if (what.find(c) == what.npos)
      out += c;
    else
      out += fmt::format(fmt::runtime(by), c);
  }
  return out;
}

/// Text as roff takes it: a line that begins with a point would be a command, and letters beyond ASCII
/// have names, \[u03B1].
std::string roff(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto c = static_cast<unsigned char>(text[i++]);
    const bool begins = out.empty() || out.back() == '\n';
    if (begins && (c == '.' || c == '\'')) out += "\\&";
    if (c >= 0x80) {
      const int more = c >= 0xF0 ? 3 : c >= 0xE0 ? 2 : 1;  // bytes that follow, of six bits each
      unsigned letter = c & (0x3FU >> more);
      for (int k = 0; k < more && i < text.size(); ++k)
        letter = letter << 6 | (static_cast<unsigned char>(text[i++]) & 0x3FU);
      out += fmt::format("\\[u{:04X}]", letter);
    } else if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += static_cast<char>(c);
    }
  }
  return out;
}

/// A man page of a command, or of the whole program, which is the first of them.
std::string man_page(const std::vector<CommandText>& all, const CommandText& c) {
  const bool whole = &c == &all.front();
  const std::string name = whole ? "gonio" : "gonio-" + c.name;
  std::string out =
      fmt::format(".TH {0} 1 \"\" \"gonio {1}\"\n.SH NAME\n{2} \\- {3}\n.SH SYNOPSIS\n", roff(name),
                  GONIO_VERSION, roff(name), roff(c.description));
  out += fmt::format(".B gonio{}\n", whole ? " COMMAND" : " " + roff(c.name));
  for (const auto& o : c.options)
    if (o.by_position) {
      const std::string word = roff(o.names[0]) + (o.several ? "..." : "");
      out += fmt::format(".I {}\n", o.required ? word : "[" + word + "]");
    }
  out += "[options]\n.SH OPTIONS\n";
  for (const auto& o : c.options) {
    std::vector<std::string> names;
    for (const auto& n : o.names) names.push_back(roff(n));
    out += fmt::format(".TP\n\\fB{}\\fR", fmt::join(names, "\\fR, \\fB"));
    if (!o.value.empty() && !o.by_position) out += fmt::format(" \\fI{}\\fR", roff(o.value));
    out += "\n" + roff(o.help) + "\n";
    if (!o.choices.empty())
      out += roff(fmt::format("\n.br\nOne of: {}.", fmt::join(o.choices, ", "))).substr(1) + "\n";
  }
  if (whole) {
    out += ".SH COMMANDS\n";
    for (std::size_t i = 1; i < all.size(); ++i)
      out += fmt::format(".TP\n\\fBgonio\\-{}\\fR(1)\n{}\n", roff(all[i].name),
                         roff(all[i].description));
    out += ".SH EXIT STATUS\n" + roff(c.footer) + "\n";
  } else {
    const auto line = c.footer.find('\n');
    out += fmt::format(
        ".SH EXAMPLE\n.nf\n{}\n.fi\n.SH EXIT STATUS\n{}\n.SH SEE ALSO\n.BR gonio (1)\n",
        roff(c.footer.substr(line == c.footer.npos ? 0 : line + 1)), roff(all.front().footer));
  }
  return out;
}

/// Shells offer the usual models, though others are taken, too.
void offer_models(std::vector<CommandText>& all) {
  for (auto& c : all)
    for (auto& o : c.options) {
      const bool several = o.names.back() == "--models";
      if (!several && o.names.back() != "--model") continue;
      for (const auto model : usual_models()) o.choices.emplace_back(model);
      if (several) o.choices.emplace_back("all");
    }
}

/// Words that are taken, by the option before them: nothing where any word is.
std::string bash(const std::vector<CommandText>& all) {
  std::vector<std::string> names;
  for (std::size_t i = 1; i < all.size(); ++i) names.push_back(all[i].name);
  std::string out = fmt::format(
      "# gonio's words for bash; an option without words takes files.\n"
      "_gonio() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words=\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    COMPREPLY=($(compgen -W '{} --help --version' -- \"$word\"))\n"
      "    return\n"
      "  fi\n"
      "  case ${{COMP_WORDS[1]}} in\n",
      fmt::join(names, " "));
  for (std::size_t i = 1; i < all.size(); ++i) {
    out += fmt::format("    {})\n      case $before in\n", all[i].name);
    std::vector<std::string> options, places;
    for (const auto& o : all[i].options) {
      if (o.by_position)
        places.insert(places.end(), o.choices.begin(), o.choices.end());
      else
        options.insert(options.end(), o.names.begin(), o.names.end());
      if (!o.by_position && !o.value.empty())
        out += fmt::format("        {}) words='{}' ;;\n", fmt::join(o.names, "|"),
                           fmt::join(o.choices, " "));
    }
    out += fmt::format("        *) words='{}'; [[ $word != -* ]] || words='{}' ;;\n      esac ;;\n",
                       fmt::join(places, " "), fmt::join(options, " "));
  }
  return out +
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
         "}\n"
         "complete -o bashdefault -o default -F _gonio gonio\n";
}

std::string zsh(const std::vector<CommandText>& all) {
  const auto help = [](std::string_view text) {
    return replaced(replaced(replaced(text, "\\[]:", "\\{}"), "'", "'\\{}'"), "\n", " ");
  };
  std::string out = "#compdef gonio\n_gonio() {\n  local -a commands=(\n";
  for (std::size_t i = 1; i < all.size(); ++i)
    out += fmt::format("    '{}:{}'\n", all[i].name, help(all[i].description));
  out +=
      "  )\n"
      "  if (( CURRENT == 2 )); then _describe command commands; return; fi\n"
      "  shift words; (( CURRENT-- ))\n"
      "  case $words[1] in\n";
  for (std::size_t i = 1; i < all.size(); ++i) {
    out += fmt::format("    {}) _arguments", all[i].name);
    for (const auto& o : all[i].options) {
      const std::string taken =
          o.value.empty()     ? ""
          : o.choices.empty() ? fmt::format(":{}:_files", help(o.value))
                              : fmt::format(":{}:({})", help(o.value), fmt::join(o.choices, " "));
      if (o.by_position) {
        out += fmt::format(" \\\n      '*{}'", taken);
        continue;
      }
      for (const auto& name : o.names)
        out += fmt::format(" \\\n      '*{}[{}]{}'", name, help(o.help), taken);
    }
    out += " ;;\n";
  }
  return out + "  esac\n}\n_gonio \"$@\"\n";
}

std::string fish(const std::vector<CommandText>& all) {
  const auto quoted = [](std::string_view text) {
    return "'" + replaced(text, "'\\", "\\{}") + "'";
  };
  std::string out;
  for (std::size_t i = 1; i < all.size(); ++i)
    out += fmt::format("complete -c gonio -f -n __fish_use_subcommand -a {} -d {}\n", all[i].name,
                       quoted(all[i].description));
  for (std::size_t i = 1; i < all.size(); ++i)
    for (const auto& o : all[i].options) {
      const std::string of =
          fmt::format("complete -c gonio -n '__fish_seen_subcommand_from {}'", all[i].name);
      const std::string choices =
          o.choices.empty() ? "" : fmt::format(" -a '{}'", fmt::join(o.choices, " "));
      if (o.by_position) {
        if (!choices.empty()) out += of + choices + "\n";
        continue;
      }
      out += of;
      for (const auto& name : o.names)
        out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!o.value.empty()) out += o.choices.empty() ? " -r" : " -x" + choices;
      out += " -d " + quoted(o.help) + "\n";
    }
  return out;
}

void write(const std::filesystem::path& path, std::string_view text) {
  std::filesystem::create_directories(path.parent_path());
  OutputFile out(path.string(), NamedBy::gonio);
  out.write(text);
  out.commit();
}

Exit run(const Options& o) {
  auto all = o.line->texts();
  const std::filesystem::path share = o.folder;
  for (const auto& c : all)
    write(share / "man/man1" / (&c == &all.front() ? "gonio.1" : "gonio-" + c.name + ".1"),
          man_page(all, c));
  offer_models(all);
  write(share / "bash-completion/completions/gonio", bash(all));
  write(share / "zsh/site-functions/_gonio", zsh(all));
  write(share / "fish/vendor_completions.d/gonio.fish", fish(all));
  return Exit::done;
}

}  // namespace

void add_manual(CommandLine& line) {
  auto [c, o] = line.command("manual", "Man pages, and the completion of bash, zsh and fish",
                             "gonio manual ~/.local/share", run);
  o->line = &line;
  c.option("DIR", o->folder, "They go into man/man1, bash-completion and their like below it")
      .required();
}

}  // namespace gonio::cli
