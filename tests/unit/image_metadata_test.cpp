// What 360 degree pictures say of themselves, read from the bytes of the files.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <map>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/image/read.h"
#include "omma/image/write.h"

namespace omma {
namespace {

using namespace std::string_view_literals;

constexpr PanoramaPlace half = {{128, 64}, 32, 0};

class Metadata : public testing::Test {
 protected:
  ~Metadata() override {
    for (const auto& [extension, path] : paths_) std::filesystem::remove(path);
  }

  // The bytes of a picture of 64 x 64 written with this extension.
  std::string written(const std::string& extension, const std::optional<PanoramaPlace>& place,
                      Channel channel = Channel::color, ImageSize size = {64, 64}) {
    const auto path = std::filesystem::temp_directory_path() / fmt::format("omma_panorama_{}{}", ::getpid(), extension);
    paths_[extension] = path;
    FloatImage image(size, channel_info(channel).components, 0.25F);
    write_image(path, image, channel, place);
    std::string bytes = read_file(path);
    const Image back = read_image(path);  // whatever else is in it, it is that picture
    EXPECT_NEAR(std::get<FloatImage>(back).values.front(), 0.25, 0.01);
    return bytes;
  }

  std::map<std::string, std::filesystem::path> paths_;
};

uint32_t number_at(std::string_view bytes, size_t at, int count) {
  uint32_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | static_cast<uint8_t>(bytes[at + static_cast<size_t>(i)]);
  return value;
}

uint32_t crc_of(std::string_view bytes) {
  uint32_t crc = ~0U;
  for (const char byte : bytes) {
    uint32_t low = (crc ^ static_cast<uint8_t>(byte)) & 0xFF;
    for (int bit = 0; bit < 8; ++bit) low = (low & 1) != 0 ? 0xEDB88320U ^ (low >> 1) : low >> 1;
    crc = low ^ (crc >> 8);
  }
  return ~crc;
}

void expect_gpano(std::string_view xmp) {
  for (const std::string_view field :
       {"xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\""sv, "GPano:ProjectionType=\"equirectangular\""sv,
        "GPano:UsePanoramaViewer=\"True\""sv, "GPano:FullPanoWidthPixels=\"128\""sv,
        "GPano:FullPanoHeightPixels=\"64\""sv, "GPano:CroppedAreaImageWidthPixels=\"64\""sv,
        "GPano:CroppedAreaImageHeightPixels=\"64\""sv, "GPano:CroppedAreaLeftPixels=\"32\""sv,
        "GPano:CroppedAreaTopPixels=\"0\""sv, "GPano:PoseHeadingDegrees=\"0\""sv}) {
    EXPECT_NE(xmp.find(field), std::string_view::npos) << field << " is not in\n" << xmp;
  }
}

TEST_F(Metadata, LiesInASegmentOfAJpegAfterJfif) {
  const std::string bytes = written(".jpg", half);
  ASSERT_EQ(bytes.substr(0, 4), "\xff\xd8\xff\xe0"sv);
  const size_t at = 4 + number_at(bytes, 4, 2);
  ASSERT_EQ(bytes.substr(at, 2), "\xff\xe1"sv);
  const size_t length = number_at(bytes, at + 2, 2);
  const std::string_view segment = std::string_view(bytes).substr(at + 4, length - 2);
  ASSERT_TRUE(segment.starts_with("http://ns.adobe.com/xap/1.0/\0<?xpacket"sv));
  ASSERT_TRUE(segment.ends_with("<?xpacket end=\"r\"?>"));
  expect_gpano(segment);
  // Without it the file is as it always was.
  std::string plain = bytes;
  plain.erase(at, 2 + length);
  EXPECT_EQ(plain, written(".jpg", std::nullopt));
}

TEST_F(Metadata, LiesInAChunkOfAPng) {
  const std::string bytes = written(".png", half);
  std::string plain = bytes;
  size_t packets = 0, chunks = 0;
  for (size_t at = 8; at < bytes.size(); ++chunks) {
    const size_t length = number_at(bytes, at, 4);
    const std::string_view chunk = std::string_view(bytes).substr(at + 4, length + 4);
    EXPECT_EQ(number_at(bytes, at + 8 + length, 4), crc_of(chunk)) << chunk.substr(0, 4);
    if (chunk.starts_with("iTXtXML:com.adobe.xmp\0\0\0\0\0<?xpacket"sv)) {
      ++packets;
      expect_gpano(chunk);
      plain.erase(at, length + 12);
    }
    at += length + 12;
  }
  EXPECT_EQ(packets, 1U);
  EXPECT_GE(chunks, 4U);
  EXPECT_EQ(plain, written(".png", std::nullopt));
}

TEST_F(Metadata, IsAnAttributeOfAnExrOfTheWholeSphere) {
  const std::string attribute("envmap\0envmap\0\1\0\0\0\0"sv);  // name, type, one byte: 0 = LATLONG
  const ImageSize whole{128, 64};
  EXPECT_NE(written(".exr", PanoramaPlace{whole}, Channel::color, whole).find(attribute), std::string::npos);
  EXPECT_EQ(written(".exr", half).find("envmap"), std::string::npos);
  EXPECT_EQ(written(".exr", std::nullopt, Channel::color, whole).find("envmap"), std::string::npos);
  EXPECT_EQ(written(".exr", PanoramaPlace{whole}, Channel::distance, whole).find("envmap"), std::string::npos);
}

}  // namespace
}  // namespace omma
