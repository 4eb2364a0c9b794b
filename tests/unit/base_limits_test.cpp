// Limits have names that messages and the command line share; a file beyond them, or beyond its folder, is told from
// others.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/base/limits.h"

namespace omma {
namespace {

namespace fs = std::filesystem;

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return "";
}

TEST(Limits, EachHasAName) {
  EXPECT_EQ(limit_infos().size() * sizeof(size_t), sizeof(Limits));
  for (const LimitInfo& info : limit_infos()) {
    Limits limits;
    EXPECT_LE(limits.*info.value, info.most) << info.name;
    set_limit(limits, fmt::format("{}=7", info.name));
    EXPECT_EQ(limits.*info.value, 7u) << info.name;
    EXPECT_EQ(limit_text(limits, info.value),
              fmt::format("the limit '{0}' is 7; --limit {0}=N, or omma::Limits, raises it", info.name));
  }
}

TEST(Limits, WhatIsNoneIsRefused) {
  Limits limits;
  for (const char* text : {"", "poses", "poses=", "poses=0", "poses=-1", "poses=x", "scene_triangles=4000000000"}) {
    EXPECT_THROW(set_limit(limits, text), CommandError) << text;
  }
  EXPECT_NE(message_of([&] { set_limit(limits, "pose=3"); }).find("did you mean 'poses'"), std::string::npos);
  EXPECT_NE(limit_text(limits, &Limits::scene_triangles).find("the most there can be"), std::string::npos);
}

class LimitedFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("omma_limits_{}", ::getpid());
    fs::create_directories(folder_ / "inner");
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(LimitedFile, IsReadUpToTheLimit) {
  const fs::path path = folder_ / "a.txt";
  write_text(path, "12345");
  EXPECT_EQ(read_file(path, {.file_bytes = 5}), "12345");
  const std::string message = message_of([&] { read_file(path, {.file_bytes = 4}); });
  for (const std::string& part : {path.string(), std::string("4 bytes"), std::string("--limit file_bytes=N")}) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
  EXPECT_THROW(read_file(path, {.document_bytes = 4}, &Limits::document_bytes), InputError);
}

TEST_F(LimitedFile, OfNoKnownSizeIsReadUpToTheLimit) {
  const fs::path path = "/proc/self/stat";  // its size is said to be 0
  if (!fs::exists(path)) GTEST_SKIP() << path;
  EXPECT_FALSE(read_file(path).empty());
  EXPECT_THROW(read_file(path, {.file_bytes = 4}), InputError);
}

TEST_F(LimitedFile, LinksAndDotsAreFollowed) {
  const fs::path inner = folder_ / "inner";
  write_text(folder_ / "outside.txt", "");
  write_text(inner / "inside.txt", "");
  fs::create_symlink(folder_ / "outside.txt", inner / "link.txt");
  fs::create_symlink(folder_, inner / "up");
  fs::create_symlink(inner, folder_ / "other_name");
  for (const fs::path& path : {inner / "inside.txt", inner / "missing.txt", inner / "." / "x" / ".." / "inside.txt",
                               folder_ / "other_name" / "inside.txt", inner / ".." / "inner" / "inside.txt"}) {
    EXPECT_TRUE(lies_within(path, inner)) << path;
    EXPECT_TRUE(lies_within(path, "/")) << path;
  }
  for (const fs::path& path : {inner / ".." / "outside.txt", inner / "link.txt", inner / "up" / "outside.txt",
                               inner / "up" / "missing.txt", fs::path("/etc/passwd"), folder_ / "inner2"}) {
    EXPECT_FALSE(lies_within(path, inner)) << path;
  }
  EXPECT_TRUE(lies_within("here.txt", ""));
  EXPECT_FALSE(lies_within("../there.txt", ""));
}

}  // namespace
}  // namespace omma
