// Which files may be read because a scene file names them.
#pragma once

#include <filesystem>
#include <string>

namespace omma::file {

/// What lies within the scene file's folder, or within a folder that the user names.
class Reach {
 public:
  Reach(const std::filesystem::path& scene, std::filesystem::path root);

  bool holds(const std::filesystem::path& path) const;
  /// "lies outside of the folder 'models'; --root DIR, or ReadOptions::root, lets what lies within DIR be read"
  std::string why_not() const;
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_, root_;
};

}  // namespace omma::file
