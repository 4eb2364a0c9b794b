#include "omma/image/metadata.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

namespace omma {
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

}  // namespace omma
