// WoodScape's calibration of a surround-view camera: r = k1 θ + k2 θ² + k3 θ³ + k4 θ⁴ in pixels, θ in radians.
//
// cx_offset and cy_offset count from the middle of the image, where the centre of the first pixel is (0, 0) and the
// middle (w − 1) / 2: so in Omma they count from w / 2. aspect_ratio stretches y.
#include "omma/camera/files/calibration.h"
#include "omma/camera/files/format.h"

namespace omma {
namespace {

bool recognises(const Document& document) {
  if (document.syntax != Syntax::json) return false;
  const auto intrinsic = root_of(document).find("intrinsic");
  return intrinsic && intrinsic->has("poly_order");
}

Camera read_camera(const DocumentNode& root) {
  const DocumentNode lens = root.at("intrinsic"), model = lens.at("model"), order = lens.at("poly_order");
  if (model.text() != "radial_poly") fail_unknown(model, "model", model.text(), {"radial_poly"});
  if (order.integer() != 4) order.fail("is {}; 4 is accepted", order.integer());
  const ImageSize size = image_size(lens.at("width"), lens.at("height"));
  const std::vector<double> offset = members(lens, {"cx_offset", "cy_offset"});
  return to_camera(lens.place(), {.model = "polynomial",
                                  .size = size,
                                  .focal = {1.0, lens.at("aspect_ratio").number()},
                                  .centre = {0.5 * size.width + offset[0], 0.5 * size.height + offset[1]},
                                  .parameters = members(lens, {"k1", "k2", "k3", "k4"})});
}

std::vector<CameraFile::Entry> read(const std::shared_ptr<const Document>& document) {
  const DocumentNode root(document);
  const auto name = root.find("name");
  return {{name ? name->text() : "camera", [root] { return read_camera(root); }}};
}

}  // namespace

const CameraFormat woodscape_format = {
    .name = "woodscape",
    .what = "WoodScape calibration (JSON)",
    .recognised = "`intrinsic` with `poly_order`",
    .models = "`radial_poly` of order 4",
    .convention = "offsets from the image's middle; angle in radians to radius in pixels, all powers",
    .recognises = recognises,
    .read = read,
};

}  // namespace omma
