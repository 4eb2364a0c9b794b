#include "omma/camera/deformation/deformation.h"

#include <algorithm>

namespace omma {
namespace {

constexpr DeformationInfo table[] = {
    {"expression", "a typed formula: r of theta, theta of r, longitude and latitude or x, y, z of u, v",
     "expression:r=2*sin(theta/2),fov_deg=180", make_expression_camera},
    {"table", "a table of angles and radii", "table:file=lens.txt,f=1", make_table_camera},
    {"camera_texture", "an image of offsets over a base camera",
     "camera_texture:file=offsets.exr,base=perspective,fov_deg=90", make_camera_texture},
    {"warp_mesh", "a mesh that lays a base camera's image out on the screen",
     "warp_mesh:file=standard_16x9.data,base=equidistant,fov_deg=180", make_warp_mesh_camera},
};

}  // namespace

std::span<const DeformationInfo> deformations() { return table; }

const DeformationInfo* find_deformation(std::string_view name) {
  const auto* found = std::ranges::find(table, name, &DeformationInfo::name);
  return found == std::end(table) ? nullptr : found;
}

}  // namespace omma
