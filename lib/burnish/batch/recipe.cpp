#include "burnish/batch/recipe.h"

#include <algorithm>
#include <sstream>

#include "burnish/core/whole_file.h"
#include "burnish/core/wording.h"

namespace burnish {
namespace {

const std::vector<std::string> kOwnNames{"stem", "dir", "source", "input", "output"};

bool is_own(const std::string& name) { return std::ranges::find(kOwnNames, name) != kOwnNames.end(); }

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

RecipeStep read_step(const TomlTable& t) {
  RecipeStep s{t.text("name"),
               words_of(t.text("tool")),
               t.texts("files"),
               t.texts("exclude"),
               t.text("from", ""),
               t.boolean("together", false),
               t.texts("output"),
               t.texts("arguments"),
               {},
               t};
  for (const TomlTable& w : t.tables("when")) {
    s.when.push_back({w.texts("files"), w.texts("arguments"), w});
    if (s.when.back().files.empty()) w.fail("files", "expected globs, got none");
    w.refuse_unknown();
  }
  t.refuse_unknown();
  const bool plain = !s.name.empty() && s.name.find_first_not_of(
                                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                            "0123456789_-") == std::string::npos;
  if (!plain) t.fail("name", "expected letters, digits, '_' and '-', got '" + s.name + "'");
  if (is_own(s.name)) t.fail("name", "'" + s.name + "' means something else in braces");
  if (s.tool.empty()) t.fail("tool", "expected a tool such as \"normals\" or \"ptm fit\", got ''");
  if (s.from.empty() == s.files.empty()) t.fail("files", "expected either files or from");
  if (!s.from.empty() && !s.exclude.empty()) t.fail("exclude", "goes with files");
  if (s.outputs.empty()) t.fail("output", "expected a name, got none");
  return s;
}

// The steps whose results a step uses.
std::vector<std::string> needs(const RecipeStep& s) {
  std::vector<std::string> names;
  if (!s.from.empty()) names.push_back(s.from);
  const auto scan = [&](const std::vector<std::string>& texts) {
    for (const std::string& text : texts)
      filled_in(text, [&](const std::string& name) {
        if (!is_own(name)) names.push_back(name);
        return name;
      });
  };
  scan(s.arguments);
  for (const RecipeStep::When& w : s.when) scan(w.arguments);
  return names;
}

// Depth first; `path` is how a step came to be asked for.
class Ordering {
 public:
  explicit Ordering(const std::vector<RecipeStep>& steps) : steps_(steps), placed_(steps.size()) {}

  std::vector<RecipeStep> ordered() {
    for (std::size_t i = 0; i < steps_.size(); i++) place(i);
    return std::move(out_);
  }

 private:
  void place(std::size_t i) {
    const RecipeStep& s = steps_[i];
    if (placed_[i]) return;
    if (const auto at = std::ranges::find(path_, s.name); at != path_.end()) {
      std::vector<std::string> cycle(at, path_.end());
      cycle.push_back(s.name);
      s.at.fail(s.from.empty() ? "arguments" : "from",
                "expected steps that do not wait for each other, got " + joined(cycle, " from "));
    }
    path_.push_back(s.name);
    for (const std::string& name : needs(s)) {
      const auto other = std::ranges::find(steps_, name, &RecipeStep::name);
      if (other == steps_.end()) s.at.fail(name == s.from ? "from" : "arguments", "there is no step '" + name + "'");
      place(std::size_t(other - steps_.begin()));
    }
    path_.pop_back();
    placed_[i] = true;
    out_.push_back(s);
  }

  const std::vector<RecipeStep>& steps_;
  std::vector<char> placed_;
  std::vector<std::string> path_;
  std::vector<RecipeStep> out_;
};

}  // namespace

std::string filled_in(const std::string& text, const std::function<std::string(const std::string&)>& value) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = text[i] == '{' ? text.find('}', i) : std::string::npos;
    if (end == std::string::npos) {
      out += text[i++];
    } else {
      out += value(text.substr(i + 1, end - i - 1));
      i = end + 1;
    }
  }
  return out;
}

std::vector<RecipeStep> read_recipe(const FileRef& file) {
  const TomlTable root = TomlTable::parse(read_file(file), file.name);
  std::vector<RecipeStep> steps;
  for (const TomlTable& t : root.tables("step")) {
    steps.push_back(read_step(t));
    if (std::ranges::count(steps, steps.back().name, &RecipeStep::name) > 1)
      t.fail("name", "a step is called '" + steps.back().name + "' already");
  }
  root.refuse_unknown();
  if (steps.empty()) root.fail("step", "expected at least one [[step]]");
  return Ordering(steps).ordered();
}

}  // namespace burnish
