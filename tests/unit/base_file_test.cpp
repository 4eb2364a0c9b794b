#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <ostream>

#include "omma/base/error.h"
#include "omma/base/file.h"

namespace omma {
namespace {

namespace fs = std::filesystem;

class File : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("omma_file_{}", ::getpid());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  size_t files() const { return size_t(std::distance(fs::directory_iterator(folder_), {})); }

  fs::path folder_;
};

TEST_F(File, WhatIsWrittenIsRead) {
  const std::string text("a\0b\n\xff", 5);
  write_text(folder_ / "a.txt", text);
  EXPECT_EQ(read_file(folder_ / "a.txt"), text);
  EXPECT_EQ(files(), 1u);
}

TEST_F(File, FailureLeavesTheOldFileAndNoOther) {
  const fs::path path = folder_ / "a.txt";
  write_text(path, "old");
  EXPECT_THROW(write_whole(path,
                           [](const fs::path& temporary) {
                             write_text(temporary, "half");
                             throw InputError("stop");
                           }),
               InputError);
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(File, TemporaryFileKeepsTheExtension) {
  write_whole(folder_ / "a.exr", [](const fs::path& temporary) {
    EXPECT_EQ(temporary.extension(), ".exr");
    write_text(temporary, "x");
  });
  EXPECT_TRUE(fs::exists(folder_ / "a.exr"));
}

TEST_F(File, FailedStreamIsAMachineError) {
  EXPECT_THROW(write_stream(folder_ / "a", [](std::ostream& stream) { stream.setstate(std::ios::failbit); }),
               MachineError);
  EXPECT_EQ(files(), 0u);
}

TEST_F(File, OnlyWhatADeadProcessLeftIsRemoved) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);  // a number that no process has any more
  write_text(folder_ / fmt::format(".a_0001.{}.part.png", child), "half");
  write_text(folder_ / fmt::format(".b.{}.part", child), "half");
  write_text(folder_ / fmt::format(".a_0002.{}.part.png", ::getpid()), "being written");
  write_text(folder_ / fmt::format("mine.{}.part.png", child), "no dot");
  remove_abandoned(folder_);
  EXPECT_EQ(files(), 2u);
  EXPECT_TRUE(fs::exists(folder_ / fmt::format(".a_0002.{}.part.png", ::getpid())));
  remove_abandoned(folder_ / "missing");
}

TEST_F(File, OfUnknownOrLargeSizeAreReadToTheirEnd) {
  EXPECT_FALSE(read_file("/proc/self/status").empty());  // its size is said to be 0
  const std::string large(300'000, 'x');
  write_text(folder_ / "large", large);
  EXPECT_EQ(read_file(folder_ / "large"), large);
  write_text(folder_ / "empty", "");
  EXPECT_EQ(read_file(folder_ / "empty"), "");
}

TEST_F(File, UnusablePathsAreRefusedBeforehand) {
  EXPECT_THROW(require_writable(folder_ / "missing" / "a.txt"), CommandError);
  EXPECT_THROW(require_writable(folder_), CommandError);
  write_text(folder_ / "a", "");
  EXPECT_THROW(require_writable(folder_ / "a" / "b"), CommandError);
  EXPECT_NO_THROW(require_writable(folder_ / "a"));
  EXPECT_THROW(read_file(folder_), InputError);
  EXPECT_THROW(read_file(folder_ / "missing"), InputError);
  // Nobody writes to the pipe: waiting for its end would last for ever.
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(read_file(folder_ / "pipe"), InputError);
  EXPECT_THROW(read_file("/dev/zero"), InputError);
}

}  // namespace
}  // namespace omma
