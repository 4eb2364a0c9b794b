// XMP Specification Part 3 (Adobe): where the packet lies in JPEG (1.1.3) and PNG (1.1.5).
#include "omma/image/metadata.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

namespace omma {
namespace {

using namespace std::string_view_literals;

std::string big_endian(uint32_t value, int bytes) {
  std::string text;
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xFF);
  return text;
}

/// PNG's (ISO 3309), bit by bit: a packet is short.
uint32_t crc32(std::string_view bytes) {
  uint32_t crc = 0xFFFFFFFF;
  for (const char byte : bytes) {
    crc ^= static_cast<uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320 : 0);
  }
  return ~crc;
}

}  // namespace

std::string gpano_xmp(const PanoramaPlace& place, const ImageSize& size) {
  std::string fields;
  const auto add = [&](const char* name, const auto& value) {
    fields += fmt::format("\n   GPano:{}=\"{}\"", name, value);
  };
  add("ProjectionType", "equirectangular");
  add("UsePanoramaViewer", "True");
  // To a millionth of a degree; a heading is 0 to 360.
  const auto degrees = [](double radians) { return std::round(radians * 180e6 / std::numbers::pi) / 1e6 + 0.0; };
  const double heading = degrees(place.pose.yaw);
  add("PoseHeadingDegrees", heading < 0.0 ? heading + 360.0 : heading);
  add("PosePitchDegrees", degrees(place.pose.pitch));
  add("PoseRollDegrees", degrees(place.pose.roll));
  add("FullPanoWidthPixels", place.full.width);
  add("FullPanoHeightPixels", place.full.height);
  add("CroppedAreaImageWidthPixels", size.width);
  add("CroppedAreaImageHeightPixels", size.height);
  add("CroppedAreaLeftPixels", place.left);
  add("CroppedAreaTopPixels", place.top);
  return fmt::format(
      "<?xpacket begin=\"\xef\xbb\xbf\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
      "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n"
      " <rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n"
      "  <rdf:Description rdf:about=\"\" xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\"{}/>\n"
      " </rdf:RDF>\n"
      "</x:xmpmeta>\n"
      "<?xpacket end=\"r\"?>",
      fields);
}

std::string with_xmp(std::string encoded, ImageFormat format, const std::string& xmp) {
  if (format == ImageFormat::jpg) {
    const std::string payload = std::string("http://ns.adobe.com/xap/1.0/\0"sv) + xmp;
    // After the start of the image, and after JFIF's segment, which has to be the first.
    size_t at = 2;
    if (std::string_view(encoded).substr(2, 2) == "\xff\xe0"sv) {
      at += 2 + (static_cast<uint8_t>(encoded[4]) << 8 | static_cast<uint8_t>(encoded[5]));
    }
    encoded.insert(at, "\xff\xe1" + big_endian(static_cast<uint32_t>(payload.size() + 2), 2) + payload);
  } else if (format == ImageFormat::png) {
    const std::string chunk = std::string("iTXtXML:com.adobe.xmp\0\0\0\0\0"sv) + xmp;
    constexpr size_t after_header = 8 + 25;  // the signature and IHDR
    encoded.insert(after_header,
                   big_endian(static_cast<uint32_t>(chunk.size() - 4), 4) + chunk + big_endian(crc32(chunk), 4));
  }
  return encoded;
}

}  // namespace omma
