#include "burnish/core/output_set.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "expect_error.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::bytes_of;
using testing::ScratchDir;
using testing::write_bytes;

TEST(OutputSet, CommitPutsAllIntoPlaceAndLeavesNothingElse) {
  const ScratchDir dir;
  write_bytes(dir / "a.png", "old");
  OutputSet set;
  const FileRef a = set.add(dir / "a.png"), b = set.add(dir / "b.png");
  EXPECT_EQ(a.name, dir / "a.png");
  EXPECT_NE(a.path, a.name);
  write_bytes(a.path, "new a");
  write_bytes(b.path, "new b");
  EXPECT_EQ(bytes_of(dir / "a.png"), "old") << "nothing changes before the commit";
  set.commit();
  EXPECT_TRUE(set.empty());
  EXPECT_EQ(bytes_of(dir / "a.png"), "new a");
  EXPECT_EQ(bytes_of(dir / "b.png"), "new b");
  EXPECT_EQ(dir.entries(), 2u);
}

TEST(OutputSet, WithoutCommitEveryOldFileIsAsItWas) {
  const ScratchDir dir;
  write_bytes(dir / "a.png", "old");
  {
    OutputSet set;
    write_bytes(set.add(dir / "a.png").path, "new a");
    write_bytes(set.add(dir / "b.png").path, "new b");
    EXPECT_EQ(dir.entries(), 3u);
  }
  EXPECT_EQ(bytes_of(dir / "a.png"), "old");
  EXPECT_EQ(dir.entries(), 1u);
}

TEST(OutputSet, DirectoriesAreMadeWithThoseAboveThemAndStayAfterCommit) {
  const ScratchDir dir;
  OutputSet set;
  set.make_directory(dir / "a/b/c/");
  write_bytes(set.add(dir / "a/b/c/x.png").path, "new");
  set.make_directory(dir / "a/b");
  set.commit();
  EXPECT_EQ(bytes_of(dir / "a/b/c/x.png"), "new");
}

TEST(OutputSet, WithoutCommitOnlyTheDirectoriesThatWereThereStay) {
  const ScratchDir dir;
  std::filesystem::create_directory(dir / "old");
  {
    OutputSet set;
    set.make_directory(dir / "old/a/b");
    set.make_directory(dir / "new/../new/c");
    write_bytes(set.add(dir / "old/a/b/x.png").path, "new");
    EXPECT_TRUE(std::filesystem::is_directory(dir / "new/c"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(dir / "old"));
  EXPECT_EQ(dir.entries(), 1u);
}

TEST(OutputSet, ADirectoryThatSomebodyElsePutAFileIntoStays) {
  const ScratchDir dir;
  {
    OutputSet set;
    set.make_directory(dir / "a/b");
    write_bytes(dir / "a/theirs", "theirs");
  }
  EXPECT_FALSE(std::filesystem::exists(dir / "a/b"));
  EXPECT_EQ(bytes_of(dir / "a/theirs"), "theirs");
}

TEST(OutputSet, AFileInTheWayOfADirectoryIsNamedAndNothingStays) {
  const ScratchDir dir;
  write_bytes(dir / "file", "");
  {
    OutputSet set;
    EXPECT_ERROR(set.make_directory(dir / "file"), ErrorKind::kIo, "/file' is a file");
    set.make_directory(dir / "a");
    EXPECT_ERROR(set.make_directory(dir / "a/../file/b"), ErrorKind::kIo,
                 "/a/../file/b': cannot be made a directory: '");
  }
  EXPECT_EQ(dir.entries(), 1u);
}

TEST(OutputSet, ASignalTakesDirectoriesAway) {
  const ScratchDir dir;
  OutputSet set;
  set.make_directory(dir / "a/b");
  write_bytes(set.add(dir / "a/b/x.png").path, "new");
  OutputSet::remove_all_temporaries();
  EXPECT_EQ(dir.entries(), 0u);
}

TEST(OutputSet, TemporariesLieBesideTheTargetAndMatchNoGlob) {
  const ScratchDir dir;
  OutputSet set;
  const std::filesystem::path p = set.add(dir / "a.png").path;
  EXPECT_EQ(p.parent_path(), dir.path());
  EXPECT_NE(p.extension(), ".png");
  EXPECT_EQ(p.filename().string()[0], '.') << "hidden from *";
}

TEST(OutputSet, RefusesAnInputByAnyOfItsNames) {
  const ScratchDir dir;
  write_bytes(dir / "in.png", "input");
  std::filesystem::create_symlink(dir / "in.png", dir / "link.png");
  std::filesystem::create_hard_link(dir / "in.png", dir / "hard.png");
  OutputSet set;
  set.protect(dir / "in.png");
  EXPECT_ERROR(set.add(dir / "in.png"), ErrorKind::kUsage, "in.png");
  EXPECT_ERROR(set.add(dir / "link.png"), ErrorKind::kUsage, "link.png");
  EXPECT_ERROR(set.add(dir / "hard.png"), ErrorKind::kUsage, "hard.png");
  EXPECT_ERROR(set.add(dir.path() + "/./in.png"), ErrorKind::kUsage, "in.png");
  EXPECT_EQ(dir.entries(), 3u);
  EXPECT_EQ(bytes_of(dir / "in.png"), "input");
}

TEST(OutputSet, RefusesAnInputNamedAfterTheOutput) {
  const ScratchDir dir;
  write_bytes(dir / "in.png", "input");
  OutputSet set;
  set.add(dir / "in.png");
  EXPECT_ERROR(set.protect(dir.path() + "/./in.png"), ErrorKind::kUsage, "in.png");
}

// A depfile must not be newer than what it speaks of, nor there without it.
TEST(OutputSet, RanksDecideWhatIsPutIntoPlaceFirst) {
  const ScratchDir dir;
  {
    OutputSet set;
    set.add(dir / "last", 2);
    set.add(dir / "middle", 1);
    set.add(dir / "first");
    set.add(dir / "blocked", 1);
    std::filesystem::create_directory(dir / "blocked");
    EXPECT_ERROR(set.commit(), ErrorKind::kIo, "blocked");
  }
  EXPECT_TRUE(std::filesystem::exists(dir / "first"));
  EXPECT_TRUE(std::filesystem::exists(dir / "middle"));
  EXPECT_FALSE(std::filesystem::exists(dir / "last"));
  EXPECT_EQ(dir.entries(), 3u);
}

TEST(OutputSet, RefusesOneNameTwice) {
  const ScratchDir dir;
  std::filesystem::create_directory(dir / "sub");
  OutputSet set;
  set.add(dir / "a.png");
  EXPECT_ERROR(set.add(dir / "a.png"), ErrorKind::kUsage, "twice");
  EXPECT_ERROR(set.add(dir.path() + "/./a.png"), ErrorKind::kUsage, "twice");
  EXPECT_ERROR(set.add(dir / "sub/../a.png"), ErrorKind::kUsage, "twice");
  set.add("-");
  EXPECT_ERROR(set.add("-"), ErrorKind::kUsage, "twice");
}

TEST(OutputSet, RefusesOneFileTwiceThroughALinkedFolder) {
  const ScratchDir dir;
  std::filesystem::create_directory(dir / "real");
  std::filesystem::create_directory_symlink(dir / "real", dir / "linked");
  OutputSet set;
  set.add(dir / "real/a.png");
  EXPECT_ERROR(set.add(dir / "linked/a.png"), ErrorKind::kUsage, "twice");
}

TEST(OutputSet, RefusesFoldersMissingFoldersAndFilesInPlaceOfFolders) {
  const ScratchDir dir;
  std::filesystem::create_directory(dir / "folder.png");
  write_bytes(dir / "file", "");
  OutputSet set;
  EXPECT_ERROR(set.add(dir / "folder.png"), ErrorKind::kIo, "directory");
  EXPECT_ERROR(set.add(dir / "missing/a.png"), ErrorKind::kIo, "missing/a.png");
  EXPECT_ERROR(set.add(dir / "file/a.png"), ErrorKind::kIo, "file/a.png");
  EXPECT_ERROR(set.add(dir.path() + "/"), ErrorKind::kIo, "directory");
  EXPECT_EQ(dir.entries(), 2u);
}

TEST(OutputSet, RefusesWhatItMayNotWrite) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const ScratchDir dir;
  write_bytes(dir / "read-only.png", "old");
  ::chmod((dir / "read-only.png").c_str(), 0444);
  OutputSet set;
  EXPECT_ERROR(set.add(dir / "read-only.png"), ErrorKind::kIo, "cannot be written");
}

TEST(OutputSet, ASignalLeavesNothingBehind) {
  const ScratchDir dir;
  write_bytes(dir / "a.png", "old");
  OutputSet set;
  write_bytes(set.add(dir / "a.png").path, "half");
  const ScratchFile scratch;
  OutputSet::remove_all_temporaries();
  EXPECT_EQ(dir.entries(), 1u);
  EXPECT_EQ(bytes_of(dir / "a.png"), "old");
  EXPECT_FALSE(std::filesystem::exists(scratch.path()));
}

TEST(OutputSet, CommitFindsALostTemporaryBeforeItReplacesAnything) {
  const ScratchDir dir;
  write_bytes(dir / "a.png", "old");
  {
    OutputSet set;
    write_bytes(set.add(dir / "a.png").path, "new");
    ::unlink(set.add(dir / "b.png").path.c_str());
    EXPECT_ERROR(set.commit(), ErrorKind::kIo, "b.png");
  }
  EXPECT_EQ(bytes_of(dir / "a.png"), "old");
  EXPECT_EQ(dir.entries(), 1u);
}

TEST(OutputSet, LongNamesStillHaveRoomForATemporary) {
  const ScratchDir dir;
  const std::string longest = std::string(251, 'x') + ".png";  // 255 bytes: as long as a name may be
  OutputSet set;
  write_bytes(set.add(dir / longest).path, "new");
  set.commit();
  EXPECT_EQ(bytes_of(dir / longest), "new");
  EXPECT_EQ(dir.entries(), 1u);
}

TEST(ScratchFile, IsRemoved) {
  std::string path;
  {
    const ScratchFile scratch;
    path = scratch.path();
    EXPECT_TRUE(std::filesystem::exists(path));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace burnish
