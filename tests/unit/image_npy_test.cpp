#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/image/npy.h"

namespace omma {
namespace {

namespace fs = std::filesystem;

class Npy : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("omma_npy_{}", ::getpid());
    fs::create_directories(folder_);
    path_ = folder_ / "array.npy";
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// A version 1 file, its header as NumPy would write it, followed by `data`.
  void write(const std::string& dtype, const std::string& order, const std::string& shape, const std::string& data) {
    write_header("{'descr': '" + dtype + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }", data);
  }
  void write_header(std::string header, const std::string& data) {
    header += '\n';
    std::string bytes = "\x93NUMPY";
    bytes += '\x01';
    bytes += '\0';
    bytes += char(header.size() & 0xff);
    bytes += char(header.size() >> 8);
    write_text(path_, bytes + header + data);
  }

  std::string read_error() {
    try {
      read_npy<float>(path_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  fs::path folder_, path_;
};

TEST_F(Npy, WhatIsWrittenIsReadBack) {
  const std::vector<float> values{1.5f, -2.0f, std::numeric_limits<float>::infinity(), 4, 5, 6};
  const std::vector<size_t> shape{1, 3, 2};
  write_npy<float>(path_, shape, values);
  const NpyArray<float> read = read_npy<float>(path_);
  EXPECT_EQ(read.shape, shape);
  EXPECT_EQ(read.values, values);
  EXPECT_FALSE(read.integer);
}

TEST_F(Npy, DataStartsAtAMultipleOf64) {
  write_npy<int32_t>(path_, std::vector<size_t>{2}, std::vector<int32_t>{-1, 7});
  EXPECT_EQ((fs::file_size(path_) - 8) % 64, 0u);
  const NpyArray<int32_t> read = read_npy<int32_t>(path_);
  EXPECT_EQ(read.values, (std::vector<int32_t>{-1, 7}));
  EXPECT_EQ(read.shape, std::vector<size_t>{2});
  EXPECT_TRUE(read.integer);
}

TEST_F(Npy, ReadsBothByteOrdersAndEveryType) {
  write("<i2", "False", "(2,)", std::string("\x01\x02\xff\xff", 4));
  EXPECT_EQ(read_npy<int32_t>(path_).values, (std::vector<int32_t>{0x0201, -1}));
  write(">i2", "False", "(2,)", std::string("\x01\x02\xff\xff", 4));
  EXPECT_EQ(read_npy<int32_t>(path_).values, (std::vector<int32_t>{0x0102, -1}));
  write("|u1", "False", "(2,)", "\x01\xff");
  EXPECT_EQ(read_npy<int32_t>(path_).values, (std::vector<int32_t>{1, 255}));
  write("|b1", "False", "(2,)", std::string("\x01\x00", 2));
  EXPECT_EQ(read_npy<float>(path_).values, (std::vector<float>{1, 0}));
  write(">f8", "False", "(1,)", std::string("\x3f\xf8\0\0\0\0\0\0", 8));
  EXPECT_EQ(read_npy<float>(path_).values, std::vector<float>{1.5f});
  write("<f2", "False", "(2,)", std::string("\x00\x3c\x00\xc0", 4));
  EXPECT_EQ(read_npy<double>(path_).values, (std::vector<double>{1.0, -2.0}));
  write("<i8", "False", "()", std::string("\xfe\xff\xff\xff\xff\xff\xff\xff", 8));
  EXPECT_EQ(read_npy<int32_t>(path_).values, std::vector<int32_t>{-2});
}

TEST_F(Npy, ReadsFortranOrder) {
  // The 2 x 3 array [[1, 2, 3], [4, 5, 6]] column by column.
  write("|u1", "True", "(2, 3)", "\x01\x04\x02\x05\x03\x06");
  EXPECT_EQ(read_npy<int32_t>(path_).values, (std::vector<int32_t>{1, 2, 3, 4, 5, 6}));
}

TEST_F(Npy, EmptyArrayIsNoError) {
  write("<f4", "False", "(0, 3)", "");
  EXPECT_TRUE(read_npy<float>(path_).values.empty());
}

TEST_F(Npy, RefusesWholeNumbersThatDoNotFit) {
  write("<f8", "False", "(1,)", std::string("\0\0\0\0\0\0\xf8\x3f", 8));
  EXPECT_THROW(read_npy<int32_t>(path_), InputError);
  write("<i8", "False", "(1,)", std::string("\0\0\0\0\x01\0\0\0", 8));
  EXPECT_THROW(read_npy<int32_t>(path_), InputError);
}

TEST_F(Npy, RefusesHostileFiles) {
  EXPECT_NE(read_error().find("no such file"), std::string::npos);
  write_text(path_, "");
  EXPECT_NE(read_error().find("empty"), std::string::npos);
  write_text(path_, "PNG, not an array at all");
  EXPECT_NE(read_error().find("not a .npy"), std::string::npos);
  write_text(path_, std::string("\x93NUMPY\x01\0\xff\xff", 10));
  EXPECT_NE(read_error().find("truncated"), std::string::npos);
  write("<f4", "False", "(2,)", "1234567");
  EXPECT_NE(read_error().find("truncated"), std::string::npos);
  write("<f4", "False", "(2,)", "123456789");
  EXPECT_NE(read_error().find("1 bytes follow"), std::string::npos);
  write("<f4", "False", "(4294967296, 4294967296, 4294967296)", "1234");
  EXPECT_NE(read_error().find("truncated"), std::string::npos);
  write("<f4", "False", "(99999999999999999999999999,)", "1234");
  EXPECT_NE(read_error().find("too large"), std::string::npos);
  write("<f4", "False", "(-1,)", "1234");
  EXPECT_NE(read_error().find("whole number"), std::string::npos);
  for (const char* dtype : {"|O", "<c8", "<f3", "<f16", "|S4", "", "f4", "<b4"}) {
    write(dtype, "False", "(1,)", "1234");
    EXPECT_NE(read_error().find("is not supported"), std::string::npos) << dtype;
  }
  write_header("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (1,)}", "1234");
  EXPECT_NE(read_error().find("records"), std::string::npos);
  for (const char* header : {"", "{", "{'descr", "{'descr': '<f4'}", "{'descr': '<f4', 'x': 1}",
                             "{'fortran_order': Maybe}", "{'shape': (1", "{'shape': (1 2)}"}) {
    write_header(header, "1234");
    EXPECT_NE(read_error().find("broken .npy header"), std::string::npos) << header;
  }
}

TEST_F(Npy, EveryTruncationIsAnError) {
  write_npy<double>(path_, std::vector<size_t>{2, 2}, std::vector<double>{1, 2, 3, 4});
  const std::string whole = read_file(path_);
  for (size_t length = 0; length < whole.size(); ++length) {
    write_text(path_, whole.substr(0, length));
    EXPECT_THROW(read_npy<float>(path_), InputError) << length;
  }
}

}  // namespace
}  // namespace omma
