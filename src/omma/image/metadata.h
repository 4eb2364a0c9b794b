// What a 360 degree picture says of itself, so that players show it as a panorama.
#pragma once

#include <optional>
#include <string>

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

}  // namespace omma
