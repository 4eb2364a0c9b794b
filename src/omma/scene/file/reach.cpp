#include "omma/scene/file/reach.h"

#include <fmt/core.h>

#include "omma/base/file.h"

namespace omma::file {

Reach::Reach(const std::filesystem::path& scene, std::filesystem::path root)
    : folder_(scene.has_parent_path() ? scene.parent_path() : std::filesystem::path(".")), root_(std::move(root)) {}

bool Reach::holds(const std::filesystem::path& path) const {
  return lies_within(path, folder_) || (!root_.empty() && lies_within(path, root_));
}

std::string Reach::why_not() const {
  const std::string also = root_.empty() ? "" : fmt::format(" and of '{}'", root_.string());
  return fmt::format(
      "lies outside of the folder '{}'{}; --root DIR, or ReadOptions::root, lets what lies within DIR be "
      "read",
      folder_.string(), also);
}

}  // namespace omma::file
