// How deeply a glTF file's JSON is nested: assimp's parser calls itself for each level and would run out of stack.
#pragma once

#include <filesystem>

#include "omma/base/limits.h"

namespace omma::file {

/// Throws InputError when maps and lists of a .gltf, or of a .glb's first chunk, lie deeper than limits.document_depth.
void require_shallow_json(const std::filesystem::path& path, const Limits& limits);

}  // namespace omma::file
