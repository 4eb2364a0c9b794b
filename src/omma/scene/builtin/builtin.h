// The built-in scenes, one file each.
#pragma once

#include "omma/scene/scene.h"

namespace omma::builtin {

/// One value per parameter, in the order of the table in builtin.cpp.
Scene make_city(const std::vector<double>& values);
Scene make_temple(const std::vector<double>& values);
Scene make_facade(const std::vector<double>& values);
Scene make_room(const std::vector<double>& values);
Scene make_terrain(const std::vector<double>& values);

}  // namespace omma::builtin
