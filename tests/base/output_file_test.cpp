#include "grove/base/output_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "grove/base/error.h"
#include "lab/temporary_directory.h"

namespace grove {
namespace {

using testing::read_file;
using testing::TemporaryDirectory;
using testing::write_file;

TEST(OutputFile, AppearsOnlyWhenCommitted) {
  const TemporaryDirectory directory;
  const auto path = directory / "out.txt";
  OutputFile file(path);
  file.write("hello");
  EXPECT_FALSE(std::filesystem::exists(path));
  file.commit();
  EXPECT_EQ(read_file(path), "hello");
  EXPECT_EQ(directory.entry_count(), 1U);
}

TEST(OutputFile, LeavesTheOldFileWhenAbandoned) {
  const TemporaryDirectory directory;
  write_file(directory / "out.txt", "old");
  {
    OutputFile file(directory / "out.txt");
    file.write("new");
  }
  EXPECT_EQ(read_file(directory / "out.txt"), "old");
  EXPECT_EQ(directory.entry_count(), 1U);
}

TEST(OutputFile, SeveralWritersOfOnePathDoNotMeet) {
  const TemporaryDirectory directory;
  OutputFile first(directory / "out.txt");
  OutputFile second(directory / "out.txt");
  first.write("first");
  second.write("second");
  second.commit();
  first.commit();
  EXPECT_EQ(read_file(directory / "out.txt"), "first");
}

TEST(OutputFile, AnotherWriterMayUseTheWorkingPath) {
  const TemporaryDirectory directory;
  OutputFile file(directory / "out.txt");
  write_file(file.working_path(), "written by name");
  file.commit();
  EXPECT_EQ(read_file(directory / "out.txt"), "written by name");
}

TEST(OutputFile, FollowsALink) {
  const TemporaryDirectory directory;
  write_file(directory / "target.txt", "old");
  std::filesystem::create_symlink("target.txt", directory / "link.txt");
  write_text_file(directory / "link.txt", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(directory / "link.txt"));
  EXPECT_EQ(read_file(directory / "target.txt"), "new");
}

TEST(OutputFile, WritesToADeviceInPlace) {
  write_text_file("/dev/null", "gone");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(OutputFile, RefusesWhatCannotBeWritten) {
  const TemporaryDirectory directory;
  EXPECT_THROW(OutputFile(directory / "missing/out.txt"), OutputError);
  EXPECT_THROW(OutputFile(directory.path()), OutputError);
  EXPECT_THROW(OutputFile(""), OutputError);
  EXPECT_EQ(directory.entry_count(), 0U);
}

TEST(OutputFile, ReportsAFullDisk) {
  EXPECT_THROW(write_text_file("/dev/full", "anything"), OutputError);
}

TEST(OutputFile, ErrorNamesTheFileInOneLine) {
  try {
    check_writable("/nowhere/out.txt");
    FAIL() << "nothing was thrown";
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("/nowhere/out.txt"));
    EXPECT_THAT(error.what(), ::testing::Not(::testing::HasSubstr("\n")));
  }
}

TEST(CheckWritable, LeavesNoTrace) {
  const TemporaryDirectory directory;
  write_file(directory / "old.txt", "old");
  check_writable(directory / "old.txt");
  check_writable(directory / "new.txt");
  EXPECT_EQ(read_file(directory / "old.txt"), "old");
  EXPECT_EQ(directory.entry_count(), 1U);
}

}  // namespace
}  // namespace grove
