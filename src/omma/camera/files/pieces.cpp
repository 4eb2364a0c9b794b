// Omma's own file of a camera in the pieces form, in JSON.
#include <nlohmann/json.hpp>

#include "omma/camera/files/calibration.h"
#include "omma/camera/files/format.h"

namespace omma {
namespace {

using Json = nlohmann::ordered_json;

bool recognises(const Document& document) { return document.syntax == Syntax::json && root_of(document).has("pieces"); }

Piece read_piece(const DocumentNode& node) {
  const DocumentNode corner_list = node.at("corners"), rows = node.at("imageFromRay");
  const std::vector<DocumentNode> corners = corner_list.items(), matrix = rows.items();
  Piece piece;
  if (corners.size() != 3 && corners.size() != 4) {
    corner_list.fail("has {} corners; 3 or 4 are accepted", corners.size());
  }
  piece.corner_count = static_cast<int>(corners.size());
  for (size_t i = 0; i < corners.size(); ++i) {
    const std::vector<double> xy = corners[i].numbers(2);
    piece.corners[i] = {xy[0], xy[1]};
  }
  if (matrix.size() != 3) rows.fail("has {} rows; 3 are expected", matrix.size());
  for (int row = 0; row < 3; ++row) {
    const std::vector<double> values = matrix[static_cast<size_t>(row)].numbers(3);
    for (int column = 0; column < 3; ++column) piece.imageFromRay[column][row] = values[static_cast<size_t>(column)];
  }
  return piece;
}

Camera read_camera(const DocumentNode& root) {
  const ImageSize size = image_size(root.at("size"));
  const DocumentNode list = root.at("pieces");
  std::vector<Piece> pieces;
  for (const DocumentNode& node : list.items()) pieces.push_back(read_piece(node));
  try {
    Camera camera(PieceSet(size, std::move(pieces), root.document().file));
    if (camera.pixels_per_radian() == 0.0) list.fail("leave the image empty: the camera sees nothing");
    return camera;
  } catch (const CommandError& error) {
    throw InputError("{}", error.what());
  }
}

std::vector<CameraFile::Entry> read(const std::shared_ptr<const Document>& document) {
  return {{"camera", [root = DocumentNode(document)] { return read_camera(root); }}};
}

std::string write(std::span<const NamedCamera> cameras) {
  const NamedCamera& camera = only_one(cameras, pieces_format.name);
  const PieceSet* set = camera.camera.pieces();
  if (!set) {
    throw CommandError("{}: is no camera of pieces but of {}; write it with --pieces", camera.name,
                       camera.camera.kind());
  }
  Json list = Json::array();
  for (const Piece& piece : set->pieces()) {
    Json corners = Json::array(), rows = Json::array();
    for (int i = 0; i < piece.corner_count; ++i) {
      const glm::dvec2& corner = piece.corners[static_cast<size_t>(i)];
      corners.push_back({corner.x, corner.y});
    }
    const glm::dmat3& matrix = piece.imageFromRay;
    for (int row = 0; row < 3; ++row) rows.push_back({matrix[0][row], matrix[1][row], matrix[2][row]});
    list.push_back({{"corners", std::move(corners)}, {"imageFromRay", std::move(rows)}});
  }
  // A line for each piece.
  std::string text = fmt::format("{{\"size\":[{},{}],\"pieces\":[", set->size().width, set->size().height);
  for (size_t i = 0; i < list.size(); ++i) text += (i == 0 ? "\n" : ",\n") + list[i].dump();
  return text + "\n]}\n";
}

}  // namespace

const CameraFormat pieces_format = {
    .name = "pieces",
    .what = "Omma's cameras of perspective pieces (JSON)",
    .recognised = "`pieces`",
    .models = "convex polygons of 3 or 4 corners, each with a matrix of 3 rows, `imageFromRay`",
    .convention = "Omma's: image's corner at (0, 0), corners clockwise in multiples of 1/256 pixel, camera frame",
    .recognises = recognises,
    .read = read,
    .extension = ".json",
    .write = write,
};

}  // namespace omma
