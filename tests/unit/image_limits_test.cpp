// A picture beyond the limits is refused by its header, and what a header claims takes no memory.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/image/codec/decode.h"
#include "omma/image/npy.h"
#include "omma/image/read.h"
#include "omma/image/write.h"

namespace omma {
namespace {

namespace fs = std::filesystem;

size_t resident_pages(const void* memory, size_t bytes) {
  const auto page = static_cast<size_t>(::sysconf(_SC_PAGESIZE));
  const auto begin = (reinterpret_cast<uintptr_t>(memory) + page - 1) / page * page;
  const size_t count = (bytes - page) / page;
  std::vector<unsigned char> resident(count);
  EXPECT_EQ(::mincore(reinterpret_cast<void*>(begin), count * page, resident.data()), 0);
  size_t sum = 0;
  for (const unsigned char flags : resident) sum += flags & 1U;
  return sum;
}

TEST(PictureLimit, ZerosTakeNoMemoryUntilTheyAreWritten) {
  constexpr size_t bytes = size_t{64} << 20;
  SampleVector<uint8_t> samples(bytes);
  EXPECT_LT(resident_pages(samples.data(), bytes), 64u);
  EXPECT_EQ(samples.front(), 0);
  EXPECT_EQ(samples.back(), 0);
  samples[bytes / 2] = 7;
  samples.resize(2 * bytes);
  EXPECT_EQ(samples[bytes / 2], 7);
  EXPECT_EQ(samples.back(), 0);
}

TEST(PictureLimit, CountsPixelsInEveryFormat) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("omma_picture_limit_{}", ::getpid());
  fs::create_directories(folder);
  const Image image = FloatImage({40, 30}, 3, 0.5f);
  for (const char* name : {"a.png", "a.jpg", "a.exr", "a.pfm", "a.npy"}) {
    const fs::path path = folder / name;
    write_image(path, image, Channel::color);
    EXPECT_NO_THROW(read_image(path, {.picture_pixels = 1200})) << name;
    EXPECT_THROW(read_image(path, {.file_bytes = 100}), InputError) << name;
    try {
      read_image(path, {.picture_pixels = 1199});
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      const std::string message = error.what();
      for (const std::string& part :
           {path.string(), std::string("40 x 30 pixels"), std::string("--limit picture_pixels=N")}) {
        EXPECT_NE(message.find(part), std::string::npos) << message;
      }
    }
  }
  EXPECT_THROW(read_npy<double>(folder / "a.npy", {.picture_pixels = 800}), InputError);
  fs::remove_all(folder);
}

TEST(PictureLimit, PipesAreRefusedByEveryReader) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("omma_picture_pipe_{}", ::getpid());
  fs::create_directories(folder);
  for (const char* name : {"a.png", "a.jpg", "a.exr", "a.pfm", "a.npy"}) {
    ASSERT_EQ(::mkfifo((folder / name).c_str(), 0600), 0);
    EXPECT_THROW(read_image(folder / name), InputError) << name;
  }
  fs::remove_all(folder);
}

/// A GIF's header alone, for a picture of 60000 x 60000: the decoder would clear three such buffers first.
TEST(PictureLimit, HeadersWithoutAPictureAreTruncatedFiles) {
  std::string gif = "GIF89a";
  gif += std::string("\x60\xea\x60\xea\x80\x00\x00", 7) + std::string(6, '\0');
  gif += std::string(",\0\0\0\0\x60\xea\x60\xea\0\x02\x01\x04\0;", 15);
  try {
    decode_picture(gif, ".gif", [](const PictureInfo&) {});
    ADD_FAILURE() << "was decoded";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("truncated"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace omma
