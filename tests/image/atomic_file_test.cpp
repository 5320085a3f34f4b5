#include "image/atomic_file.h"

#include <csignal>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <list>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "temporary_folder.h"

namespace lkao::image {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

mode_t permissions_of(const std::string& path) {
  struct stat status {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0);
  return status.st_mode & 0777;
}

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "out.json");
  put(file.temporary_path(), "text");
  EXPECT_FALSE(std::filesystem::exists(folder / "out.json"));
  file.commit();
  EXPECT_EQ(bytes_of(folder / "out.json"), "text");
  EXPECT_THAT(folder.names(), ElementsAre("out.json"));
}

TEST(AtomicFile, TemporaryNameIsHiddenAndKeepsTheEnding) {
  const TemporaryFolder folder;
  const AtomicFile file(folder / "out.part.exr");
  EXPECT_EQ(file.temporary_path(), folder / (".out.part.partial-" + std::to_string(::getpid()) + ".exr"));
}

TEST(AtomicFile, LeavesNothingWithoutCommit) {
  const TemporaryFolder folder;
  put(folder / "out.ply", "before");
  {
    const AtomicFile file(folder / "out.ply");
    put(file.temporary_path(), "half of");
  }
  EXPECT_THAT(folder.names(), ElementsAre("out.ply"));
  EXPECT_EQ(bytes_of(folder / "out.ply"), "before");
}

TEST(AtomicFile, CommitsOnceOnly) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "out.csv");
  file.commit();
  put(folder / "out.csv", "later");
  EXPECT_NO_THROW(file.commit());
  EXPECT_EQ(bytes_of(folder / "out.csv"), "later");
}

TEST(AtomicFile, NewFilesFollowTheUmask) {
  const TemporaryFolder folder;
  const mode_t before = ::umask(027);
  write_file(folder / "new.txt", "text");
  ::umask(before);
  EXPECT_EQ(permissions_of(folder / "new.txt"), 0640u);
}

TEST(AtomicFile, KeepsThePermissionsOfAnExistingFile) {
  const TemporaryFolder folder;
  put(folder / "old.txt", "before");
  ::chmod((folder / "old.txt").c_str(), 0604);
  write_file(folder / "old.txt", "after");
  EXPECT_EQ(permissions_of(folder / "old.txt"), 0604u);
  EXPECT_EQ(bytes_of(folder / "old.txt"), "after");
}

TEST(AtomicFile, DoesNotReplaceAWriteProtectedFile) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write everywhere";
  const TemporaryFolder folder;
  put(folder / "old.txt", "before");
  ::chmod((folder / "old.txt").c_str(), 0444);
  EXPECT_THROW(write_file(folder / "old.txt", "after"), std::runtime_error);
  EXPECT_EQ(bytes_of(folder / "old.txt"), "before");
}

TEST(AtomicFile, FollowsSymbolicLinks) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "sub");
  put(folder / "sub/real.txt", "before");
  std::filesystem::create_symlink("sub/real.txt", folder / "link.txt");
  write_file(folder / "link.txt", "after");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
  EXPECT_EQ(bytes_of(folder / "sub/real.txt"), "after");
}

TEST(AtomicFile, WritesDevicesInPlace) {
  AtomicFile file("/dev/null");
  EXPECT_EQ(file.temporary_path(), "/dev/null");
  remove_unfinished_files();
  file.commit();
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, TwoForOnePathDoNotMix) {
  const TemporaryFolder folder;
  AtomicFile first(folder / "out.txt");
  AtomicFile second(folder / "out.txt");
  EXPECT_NE(first.temporary_path(), second.temporary_path());
  put(first.temporary_path(), "first");
  put(second.temporary_path(), "second");
  second.commit();
  first.commit();
  EXPECT_EQ(bytes_of(folder / "out.txt"), "first");
  EXPECT_THAT(folder.names(), ElementsAre("out.txt"));
}

TEST(AtomicFile, TakesRelativeAndLongNames) {
  const TemporaryFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder / "");
  AtomicFile file("relative.txt");
  std::filesystem::current_path(before);  // a change of folder in between does no harm
  file.commit();
  const std::string longest = std::string(251, 'x') + ".txt";
  write_file(folder / longest, "text");
  EXPECT_THAT(folder.names(), ElementsAre("relative.txt", longest));
}

TEST(AtomicFile, RefusesWhatCannotBeWritten) {
  const TemporaryFolder folder;
  put(folder / "file", "");
  const auto error_of = [](const std::string& path) -> std::string {
    try {
      const AtomicFile file(path);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  EXPECT_EQ(error_of(""), "cannot write: the file name is empty");
  EXPECT_EQ(error_of(folder / ""), "cannot write '" + (folder / "") + "': is a directory");
  EXPECT_EQ(error_of(folder / "none/"), "cannot write '" + (folder / "none/") + "': has no file name");
  EXPECT_EQ(error_of(folder / "none/a"),
            "cannot write '" + (folder / "none/a") + "': there is no folder '" + (folder / "none") + "'");
  EXPECT_EQ(error_of(folder / "file/a"),
            "cannot write '" + (folder / "file/a") + "': '" + (folder / "file") + "' is not a folder");
  EXPECT_THAT(folder.names(), ElementsAre("file"));
}

TEST(WriteFile, ReportsAFullDisk) {
  // Of a size that stays in the buffer until the file is closed, and of one that does not.
  for (const std::size_t size : {10u, 100000u}) {
    try {
      write_file("/dev/full", std::string(size, 'x'));
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "cannot write '/dev/full': No space left on device");
    }
  }
}

TEST(RemoveUnfinishedFiles, RemovesThoseAliveAndNoOthers) {
  const TemporaryFolder folder;
  put(folder / "old.exr", "before");
  write_file(folder / "done.txt", "done");
  AtomicFile first(folder / "old.exr");
  AtomicFile second(folder / "new.ply");
  ASSERT_THAT(folder.names(), SizeIs(4));
  remove_unfinished_files();
  EXPECT_THAT(folder.names(), ElementsAre("done.txt", "old.exr"));
  EXPECT_EQ(bytes_of(folder / "old.exr"), "before");
  // The interrupted program cannot finish its file any more.
  EXPECT_THROW(first.commit(), std::runtime_error);
  EXPECT_EQ(bytes_of(folder / "old.exr"), "before");
}

TEST(RemoveUnfinishedFiles, WorksInASignalHandler) {
  const TemporaryFolder folder;
  const auto interrupted = [&] {
    std::signal(SIGINT, [](int) {
      remove_unfinished_files();
      ::_exit(130);
    });
    const AtomicFile file(folder / "out.exr");
    put(file.temporary_path(), "half of");
    std::raise(SIGINT);
  };
  const pid_t child = ::fork();
  if (child == 0) {
    interrupted();
    ::_exit(1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 130) << status;
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(AtomicFile, ManyInARowReuseTheTable) {
  const TemporaryFolder folder;
  for (int i = 0; i < 200; ++i) write_file(folder / "out.txt", std::to_string(i));
  EXPECT_EQ(bytes_of(folder / "out.txt"), "199");
}

TEST(AtomicFile, RefusesMoreThanTheTableHolds) {
  const TemporaryFolder folder;
  std::list<AtomicFile> files;
  EXPECT_THROW(
      {
        for (int i = 0; i < 65; ++i) files.emplace_back(folder / std::to_string(i));
      },
      std::runtime_error);
  const std::size_t alive = files.size();
  EXPECT_THAT(folder.names(), SizeIs(alive));
  files.clear();
  EXPECT_THAT(folder.names(), IsEmpty());
}

}  // namespace
}  // namespace lkao::image
