#include "cli/manual.h"

#include <algorithm>
#include <functional>
#include <sstream>
#include <vector>

#include "burnish/core/error.h"
#include "burnish/core/wording.h"
#include "cli/tool.h"

namespace burnish::cli {
namespace {

// Options of one heading.
struct Section {
  std::string title;
  std::vector<const CLI::Option*> options;
};

bool is_verb(const CLI::App* app) { return !app->get_name().empty(); }

std::vector<const CLI::App*> below(const CLI::App& app, bool verbs) {
  return app.get_subcommands([&](const CLI::App* sub) { return is_verb(sub) == verbs; });
}

// As --help has them: its headings, then groups of options that stand by themselves.
std::vector<Section> sections(const CLI::App& app) {
  std::vector<Section> all;
  for (const CLI::Option* option : app.get_options()) {
    const std::string title = option->get_positional() ? "Arguments" : option->get_group();
    if (title.empty()) continue;  // hidden
    auto at = std::ranges::find(all, title, &Section::title);
    if (at == all.end()) at = all.insert(all.end(), Section{title, {}});
    at->options.push_back(option);
  }
  for (const CLI::App* group : below(app, false))
    for (Section& section : sections(*group)) {
      if (section.title == "Options") section.title = group->get_group();
      all.push_back(section);
    }
  std::ranges::stable_sort(all, {}, [](const Section& s) {
    return s.title == "Arguments" ? 0 : s.title == "Options" ? 1 : 2;
  });
  return all;
}

// "-o", "--output"
std::vector<std::string> flags(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

// The words that an option takes; none where it takes anything.
std::vector<std::string> words(const CLI::Option& option) {
  std::vector<std::string> all;
  const std::string type = option.get_type_name();
  if (type.find('|') == type.npos) return all;
  std::istringstream in(type);
  for (std::string word; std::getline(in, word, '|');) all.push_back(word);
  return all;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size()) text.replace(at, what.size(), by);
  return text;
}

// Text that is no macro and no escape, with hyphens that can be searched for.
std::string roff(const std::string& text) {
  std::string out = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  if (out.starts_with('.') || out.starts_with('\'')) out.insert(0, "\\&");
  return replaced(replaced(out, "\n.", "\n\\&."), "\n'", "\n\\&'");
}

void write_options(std::ostream& out, const CLI::App& app, const char* heading) {
  for (const Section& section : sections(app)) {
    out << heading << " \"" << (section.title == "Options" ? "Options" : section.title) << "\"\n";
    for (const CLI::Option* o : section.options) {
      const std::string name = o->get_positional() ? o->get_name() : joined(flags(*o));
      const std::string type = o->get_positional() || !takes_value(*o) ? "" : " " + o->get_type_name();
      out << ".TP\n\\fB" << roff(name) << "\\fR" << roff(type) << '\n' << roff(o->get_description()) << '\n';
    }
  }
}

// "NORMAL..." of an app's positionals, those first that are required.
std::string positionals(const CLI::App& app) {
  std::string all;
  for (const CLI::Option* o : app.get_options())
    if (o->get_positional())
      all += " " + (o->get_required() ? o->get_name() : "[" + o->get_name() + "]") +
             (o->get_items_expected_max() > 1 ? "..." : "");
  return all;
}

std::vector<const CLI::Option*> all_options(const CLI::App& app) {
  std::vector<const CLI::Option*> all;
  for (const Section& section : sections(app))
    for (const CLI::Option* option : section.options)
      if (!option->get_positional()) all.push_back(option);
  return all;
}

// What a shell completes behind a tool, or one of its verbs: its options, and the words of those that take some.
struct Completions {
  std::vector<const CLI::Option*> options;
  explicit Completions(const CLI::App& app, const CLI::App* verb) : options(all_options(app)) {
    if (verb)
      for (const CLI::Option* option : all_options(*verb)) options.push_back(option);
  }
};

std::string bash_cases(const Completions& c, const std::string& indent) {
  std::string all, cases;
  for (const CLI::Option* o : c.options) {
    for (const std::string& flag : flags(*o)) all += (all.empty() ? "" : " ") + flag;
    if (!takes_value(*o)) continue;
    cases += indent + "  " + joined(flags(*o), "|") + ") ";
    cases += words(*o).empty() ? "COMPREPLY=($(compgen -f -- \"$word\"))"
                               : "COMPREPLY=($(compgen -W '" + joined(words(*o), " ") + "' -- \"$word\"))";
    cases += "; return ;;\n";
  }
  return indent + "case $before in\n" + cases + indent + "esac\n" + indent +
         "if [[ $word == -* ]]; then COMPREPLY=($(compgen -W '" + all + "' -- \"$word\")); return; fi\n";
}

std::string bash(const CLI::App& app) {
  const std::string function = "_" + replaced(app.get_name(), "-", "_");
  const std::vector<const CLI::App*> verbs = below(app, true);
  std::string out = "# bash completion of " + app.get_name() + "\n" + function +
                    "() {\n  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}\n";
  if (verbs.empty()) {
    out += bash_cases(Completions(app, nullptr), "  ");
  } else {
    std::vector<std::string> names;
    out += "  case ${COMP_WORDS[1]} in\n";
    for (const CLI::App* verb : verbs) {
      names.push_back(verb->get_name());
      out += "    " + verb->get_name() + ")\n" + bash_cases(Completions(app, verb), "      ") + "      ;;\n";
    }
    out += "  esac\n  if ((COMP_CWORD == 1)); then COMPREPLY=($(compgen -W '" + joined(names, " ") +
           " --help --version' -- \"$word\")); return; fi\n";
  }
  return out + "  COMPREPLY=($(compgen -f -- \"$word\"))\n}\ncomplete -o filenames -F " + function + " " +
         app.get_name() + "\n";
}

// In single quotes, within the brackets of a description.
std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '\''                                         ? std::string("'\\''")
           : (c == '[' || c == ']' || c == ':' || c == '\\') ? "\\" + std::string(1, c)
                                                             : std::string(1, c);
  return out;
}

std::string zsh_arguments(const Completions& c, const std::string& indent) {
  std::string out = indent + "_arguments";
  for (const CLI::Option* o : c.options) {
    const std::vector<std::string> names = flags(*o);
    const std::string name = names.size() == 1 ? "'" + names[0] : "{" + joined(names, ",") + "}'";
    out += " \\\n" + indent + "  " + name + "[" + zsh_text(o->get_description()) + "]";
    if (takes_value(*o))
      out += ":" +
             (words(*o).empty() ? zsh_text(o->get_type_name()) + ":_files" : "word:(" + joined(words(*o), " ") + ")");
    out += "'";
  }
  return out + " \\\n" + indent + "  '*:file:_files'\n";
}

std::string zsh(const CLI::App& app) {
  const std::vector<const CLI::App*> verbs = below(app, true);
  std::string out = "#compdef " + app.get_name() + "\n";
  if (verbs.empty()) return out + zsh_arguments(Completions(app, nullptr), "");
  out += "if ((CURRENT == 2)); then\n  local -a verbs=(";
  for (const CLI::App* verb : verbs) out += "'" + verb->get_name() + ":" + zsh_text(verb->get_description()) + "' ";
  out += ")\n  _describe verb verbs\n  return\nfi\ncase $words[2] in\n";
  for (const CLI::App* verb : verbs)
    out += "  " + verb->get_name() + ")\n" + zsh_arguments(Completions(app, verb), "    ") + "    ;;\n";
  return out + "esac\n";
}

}  // namespace

std::string man_page(const CLI::App& app, const ToolText& text, const std::string& version) {
  std::ostringstream out;
  std::string name = app.get_name(), capitals = name;
  std::ranges::transform(capitals, capitals.begin(), [](unsigned char c) { return char(std::toupper(c)); });
  const std::string summary = text.summary.substr(0, text.summary.find_last_not_of('.') + 1);
  const std::vector<const CLI::App*> verbs = below(app, true);
  out << ".TH " << roff(capitals) << " 1 \"\" \"burnish " << version << "\" \"User Commands\"\n"
      << ".SH NAME\n"
      << roff(name) << " \\- " << roff(summary) << "\n.SH SYNOPSIS\n";
  if (verbs.empty()) out << "\\fB" << roff(name) << "\\fR [OPTIONS]" << roff(positionals(app)) << '\n';
  for (const CLI::App* verb : verbs)
    out << "\\fB" << roff(name + " " + verb->get_name()) << "\\fR [OPTIONS]" << roff(positionals(*verb)) << "\n.br\n";
  for (const CLI::App* verb : verbs) {
    out << ".SH " << roff(verb->get_name()) << '\n' << roff(verb->get_description()) << ".\n";
    write_options(out, *verb, ".SS");
  }
  write_options(out, app, ".SH");
  const std::string footer = app.get_footer();
  for (const CLI::App* verb : verbs)
    if (!verb->get_footer().empty())
      out << ".SH \"" << roff(verb->get_name()) << ": example\"\n.nf\n" << roff(verb->get_footer()) << "\n.fi\n";
  out << ".SH EXAMPLES AND EXIT CODES\n.nf\n" << roff(footer) << "\n.fi\n";
  return out.str();
}

std::string completion(const CLI::App& app, const std::string& shell) {
  if (shell == "bash") return bash(app);
  if (shell == "zsh") return zsh(app);
  throw Error(ErrorKind::kUsage, "--completion: expected bash|zsh, got '" + shell + "'");
}

}  // namespace burnish::cli
