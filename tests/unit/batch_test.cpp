#include "burnish/batch/batch.h"

#include <gtest/gtest.h>

#include <fstream>

#include "burnish/batch/glob.h"
#include "burnish/batch/ninja_file.h"
#include "burnish/core/shell_quoted.h"
#include "expect_error.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::ScratchDir;

TEST(Glob, Patterns) {
  for (const auto& [path, pattern] : std::vector<std::pair<std::string, std::string>>{{"a.png", "*.png"},
                                                                                      {"a.png", "?.p[m-o]g"},
                                                                                      {"d/a.png", "d/*"},
                                                                                      {"d/a.png", "**/*.png"},
                                                                                      {"a.png", "**/*.png"},
                                                                                      {"d/e/f/a.png", "d/**/a.png"},
                                                                                      {"d/a.png", "d/**"},
                                                                                      {".hidden", ".h*"}})
    EXPECT_TRUE(fits_glob(path, pattern)) << path << " " << pattern;
  for (const auto& [path, pattern] : std::vector<std::pair<std::string, std::string>>{{"d/a.png", "*.png"},
                                                                                      {"a.png", "*.PNG"},
                                                                                      {"a.png", ""},
                                                                                      {"a.png", "a.png/b"},
                                                                                      {"d/a.png", "d"},
                                                                                      {".hidden", "*"},
                                                                                      {"d/.git/a", "**/a"},
                                                                                      {"d/a.png", "e/**/a.png"}})
    EXPECT_FALSE(fits_glob(path, pattern)) << path << " " << pattern;
}

// A recipe, and files of a directory.
class Batch : public ::testing::Test {
 protected:
  void add_files(const std::vector<std::string>& files) {
    for (const std::string& file : files) {
      std::filesystem::create_directories(std::filesystem::path(dir_ / ("in/" + file)).parent_path());
      std::ofstream(dir_ / ("in/" + file)) << "x";
    }
  }
  std::vector<RecipeStep> steps(const std::string& text) {
    std::ofstream(dir_ / "r.toml") << text;
    return read_recipe({dir_ / "r.toml", "r.toml"});
  }
  std::vector<Job> jobs(const std::string& text, Shard shard = {}) {
    return plan_jobs(steps(text), {dir_ / "in", dir_ / "out"}, shard);
  }

  const ScratchDir dir_;
};

const std::string kNormals = "[[step]]\nname='n'\ntool='normals'\nfiles='**/*.png'\noutput='{dir}{stem}_n.png'\n";

TEST_F(Batch, ErrorsAreOfOneLineWhateverIsQuoted) {
  const std::string rest = kNormals.substr(kNormals.find("tool"));
  EXPECT_ERROR(steps("[[step]]\nname = \"a\\nb\"\n" + rest), ErrorKind::kMalformed, "got 'a?b'");
  EXPECT_ERROR(steps("\"a\\nb\" = 1\n" + kNormals), ErrorKind::kMalformed, "'a?b': unknown key");
  EXPECT_ERROR(steps("a = t\n"), ErrorKind::kMalformed, "line 1: ");
}

TEST_F(Batch, ACommandForEachFile) {
  add_files({"b.png", "sub/a.png", "c.txt"});
  const std::vector<Job> made = jobs(kNormals + "arguments=['--wrap','repeat']\n");
  ASSERT_EQ(made.size(), 2u);
  EXPECT_EQ(shell_command(made[1].command),
            "burnish-normals ../in/sub/a.png --wrap repeat -o sub/a_n.png -j 1 --quiet --depfile sub/a_n.png.d");
  EXPECT_EQ(made[1].inputs, std::vector<std::string>{"../in/sub/a.png"});
  EXPECT_EQ(made[1].outputs, std::vector<std::string>{"sub/a_n.png"});
  EXPECT_EQ(made[1].source, "sub/a.png");
}

TEST_F(Batch, ArgumentsOfSome) {
  add_files({"a.png", "b.png"});
  const std::vector<Job> made =
      jobs(kNormals + "arguments=['-j','2']\n[[step.when]]\nfiles=['b*']\narguments=['--height','2']\n");
  EXPECT_EQ(shell_command(made[0].command), "burnish-normals ../in/a.png -j 2 -o a_n.png --quiet --depfile a_n.png.d");
  EXPECT_EQ(shell_command(made[1].command),
            "burnish-normals ../in/b.png -j 2 --height 2 -o b_n.png --quiet --depfile b_n.png.d");
}

TEST_F(Batch, StepsUseWhatOthersMake) {
  add_files({"a.png", "b.png"});
  const std::vector<Job> made = jobs(
      "[[step]]\nname='mips'\ntool='mipmap'\nfrom='quantized'\noutput='{stem}.ktx2'\narguments=['--source','{n}']\n"
      "[[step]]\nname='quantized'\ntool='quantize'\nfrom='n'\noutput='{stem}_q.exr'\narguments=['--palette={all}']\n"
      "[[step]]\nname='all'\ntool='quantize'\nfrom='n'\ntogether=true\noutput=['{stem}.exr','x.exr']\n"
      "arguments=['{input}','-n','9','--output-dir','d']\n" +
      kNormals);
  ASSERT_EQ(made.size(), 7u);  // in the order that they need each other
  EXPECT_EQ(made[2].step, "all");
  EXPECT_EQ(shell_command(made[2].command),
            "burnish-quantize a_n.png b_n.png -n 9 --output-dir d -j 1 --quiet --depfile all.exr.d");
  EXPECT_EQ(shell_command(made[3].command),
            "burnish-quantize a_n.png --palette=all.exr -o a_q.exr -j 1 --quiet --depfile a_q.exr.d");
  EXPECT_EQ(made[3].inputs, (std::vector<std::string>{"a_n.png", "all.exr", "x.exr"}));
  EXPECT_EQ(made[6].inputs, (std::vector<std::string>{"b_q.exr", "b_n.png"}));
}

TEST_F(Batch, ShardsShareTheFilesAndEachHasWhatIsForAll) {
  add_files({"a.png", "b.png", "c.png"});
  const std::string each = kNormals + "[[step]]\nname='q'\ntool='quantize'\nfrom='n'\noutput='{stem}.exr'\n";
  const auto sources = [&](const std::string& text, Shard shard) {
    std::string all;
    for (const Job& job : jobs(text, shard)) all += job.step + ":" + job.source + " ";
    return all;
  };
  EXPECT_EQ(sources(each, {0, 2}), "n:a.png n:c.png q:a.png q:c.png ");
  EXPECT_EQ(sources(each, {1, 2}), "n:b.png q:b.png ");
  const std::string all = each +
                          "arguments=['--palette','{p}']\n[[step]]\nname='p'\ntool='quantize'\nfrom='n'\n"
                          "together=true\noutput='p.exr'\narguments=['{input}','-o','{output}']\n";
  EXPECT_EQ(sources(all, {1, 2}), "n:a.png n:b.png n:c.png p: q:b.png ");
}

TEST_F(Batch, WhatARecipeMayNotSay) {
  add_files({"a.png", "a.tif", "b.png"});
  const auto refused = [&](const std::string& text, const std::string& part) {
    EXPECT_ERROR(jobs(text), ErrorKind::kMalformed, "'r.toml': line " + part);
  };
  const std::string head = "[[step]]\nname='n'\ntool='normals'\n";
  refused("", "1: 'step': expected at least one [[step]]");
  refused("steps=1\n[[step]]\n", "2: 'step[0].name': expected a string, got nothing");
  refused(kNormals + "outptu='x'\n", "6: 'step[0].outptu': unknown key");
  refused(kNormals + kNormals, "7: 'step[1].name': a step is called 'n' already");
  refused("[[step]]\nname='stem'\ntool='x'\nfiles='*'\noutput='o'\n", "2: 'step[0].name': 'stem' means something else");
  refused("[[step]]\nname='a b'\ntool='x'\nfiles='*'\noutput='o'\n", "2: 'step[0].name': expected letters");
  refused(head + "files='*.jpg'\noutput='{stem}'\n", "4: 'step[0].files': no file of '");
  refused(head + "files='*.png'\nfrom='n'\noutput='{stem}'\n", "4: 'step[0].files': expected either files or from");
  refused(head + "from='n'\noutput='{stem}'\n", "4: 'step[0].from': expected steps that do not wait");
  refused(head + "output='{stem}'\n", "1: 'step[0].files': expected either files or from");
  refused(head + "files='*.png'\noutput=[]\n", "5: 'step[0].output': expected a name");
  refused(head + "files='*.png'\noutput='same'\n",
          "5: 'step[0].output': 'same' is written by step 'n' for 'a.png' and by step 'n' for 'b.png'");
  refused(head + "files=['*.png','*.tif']\noutput='{stem}'\n", "5: 'step[0].output': 'a' is written by");
  refused(head + "files='*.png'\noutput='../{stem}'\n", "5: 'step[0].output': expected a file in the build directory");
  refused(head + "files='*.png'\noutput='/{stem}'\n", "5: 'step[0].output': expected a file in the build directory");
  refused(head + "files='*.png'\noutput='../in/{stem}.png'\n", "5: 'step[0].output': expected a file in the build");
  refused(head + "files='*.png'\noutput='{source}'\n", "5: 'step[0].output': expected {stem} or {dir}, got {source}");
  refused(head + "files='*.png'\noutput=['{stem}','{stem}2']\n", "5: 'step[0].output': several outputs need arguments");
  refused(kNormals + "arguments=['--mask','{m}']\n", "6: 'step[0].arguments': there is no step 'm'");
  refused(kNormals + "arguments=['--depfile','d']\n", "6: 'step[0].arguments': --depfile is added");
  refused(kNormals + "exclude='**'\n", "6: 'step[0].exclude': no file is left");
  refused(kNormals + "[[step.when]]\nfiles='z*'\n", "7: 'step[0].when[0].files': fits none of the files");
  refused(kNormals + "together=1\n", "6: 'step[0].together': expected true or false");
  refused(kNormals + "arguments=[1]\n", "6: 'step[0].arguments': expected strings");
  refused(kNormals + "together=true\narguments=['--x={input}']\n", "7: 'step[0].arguments': {input} is not one file");
  refused(
      kNormals +
          "[[step]]\nname='a'\ntool='x'\nfrom='b'\noutput='1'\n[[step]]\nname='b'\ntool='x'\nfrom='a'\noutput='2'\n",
      "9: 'step[1].from': expected steps that do not wait for each other, got a from b from a");
  refused(kNormals + "[[step]]\nname='a'\ntool='x'\nfiles='*.tif'\noutput='1'\narguments=['{n}']\n",
          "11: 'step[1].arguments': step 'n' makes nothing of 'a.tif'");
  EXPECT_ERROR(plan_jobs(steps(kNormals), {dir_ / "none", dir_ / "out"}), ErrorKind::kIo, "is not a directory");
  EXPECT_ERROR(read_recipe(dir_ / "none.toml"), ErrorKind::kIo, "none.toml");
}

TEST(ShellWords, ComeBackFromTheirQuotes) {
  const std::vector<std::string> words{"plain", "it's $5", "", "a\nb", "\"", "\\", "-o", "\t x "};
  std::string text = "\n ";
  for (const std::string& word : words) text += shell_quoted(word) + (word.empty() ? "\n" : "  ");
  EXPECT_EQ(shell_words(text), words);
  EXPECT_EQ(shell_words("a\\ b \"c \\\" 'd'\"e"), (std::vector<std::string>{"a b", "c \" 'd'e"}));
  EXPECT_EQ(shell_words(" "), std::vector<std::string>{});
  EXPECT_EQ(shell_words("a 'b"), std::nullopt);
}

TEST(NinjaFile, NamesThatNinjaAndShellsRead) {
  Job job{"s", "", {"burnish-x", "it's $5", "-o", "a b"}, {"in: 1"}, {"a b"}, "a b.d"};
  const std::string text = ninja_text({job}, "/opt/b", "nice -n 19", ".");
  EXPECT_NE(text.find("\nbuild a$ b: run | in$:$ 1 /opt/b/burnish-x\n"
                      "  run = nice -n 19 /opt/b/burnish-x 'it'\\''s $$5' -o 'a b'\n  deps = gcc\n  depfile = a b.d\n"),
            std::string::npos)
      << text;
  job.command.insert(job.command.end(), 20000, "a 'b");  // more than an argument holds
  const std::string by_file = ninja_text({job}, "/opt/b", "nice -n 19", ".");
  EXPECT_NE(by_file.find("\n  run = nice -n 19 /opt/b/burnish-x --arguments-from 'a b.arguments'\n"
                         "  rspfile = a b.arguments\n  rspfile_content = 'it'\\''s $$5' -o 'a b' 'a '\\''b' "),
            std::string::npos)
      << by_file.substr(0, 500);
  job.outputs[0] = "a\nb";
  EXPECT_ERROR(ninja_text({job}, "/opt/b", "", "."), ErrorKind::kUnsupported, "newline");
}

}  // namespace
}  // namespace burnish
