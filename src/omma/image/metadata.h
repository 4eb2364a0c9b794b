// What a 360 degree picture says of itself, so that players show it as a panorama.
#pragma once

#include <optional>
#include <string>

#include "omma/image/formats.h"
#include "omma/math/heading.h"
#include "omma/math/ray.h"

namespace omma {

/// Where a picture lies within the equirectangular panorama of the whole sphere, in that panorama's pixels. Its middle
/// is what the lens looks along; a VR180 picture is the middle half.
struct PanoramaPlace {
  ImageSize full;
  int left = 0, top = 0;  ///< of the picture's top left corner
  Heading pose = {};      ///< in the world, of what the panorama's middle looks along; its -Z is north
};

/// Google's Photo Sphere XMP (GPano, https://developers.google.com/streetview/spherical-metadata) for a picture of
/// `size`.
std::string gpano_xmp(const PanoramaPlace& place, const ImageSize& size);

/// An encoded .jpg or .png with an XMP packet: in an APP1 segment or an iTXt chunk. Other formats come back as they
/// are.
std::string with_xmp(std::string encoded, ImageFormat format, const std::string& xmp);

}  // namespace omma
