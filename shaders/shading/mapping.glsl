// Coordinates on a surface and their change per pixel to the right and down.
struct Mapping {
  vec2 at, dx, dy;
};

// How far each coordinate changes over a pixel.
SHADING vec2 footprint_of(Mapping mapping) {
  return vec2(length(vec2(mapping.dx.x, mapping.dy.x)), length(vec2(mapping.dx.y, mapping.dy.y)));
}

// The coordinates of a vector along two of the axes.
SHADING vec2 along_axes(vec3 v, truth level, truth sideways) {
  return choose(level, vec2(v.x, v.z), choose(sideways, vec2(v.z, v.y), vec2(v.x, v.y)));
}

// World metres along the two axes that the surface faces least: the second is up wherever it is no floor. Where it
// faces two alike, rounding must not choose.
SHADING Mapping world_mapping(Surface surface) {
  mat3 world = mat3(frame.worldFromCamera);
  vec3 at = xyz_of(frame.worldFromCamera * vec4(surface.position, 1.0));
  vec3 facing = abs(world * surface.normal) * vec3(1.002, 1.001, 1.0);
  truth level = facing.y > max(facing.x, facing.z), sideways = facing.x > facing.z;
  Mapping mapping;
  mapping.at = along_axes(at, level, sideways);
  mapping.dx = along_axes(world * surface.position_dx, level, sideways);
  mapping.dy = along_axes(world * surface.position_dy, level, sideways);
  return mapping;
}

SHADING Mapping uv_mapping(Surface surface) {
  Mapping mapping;
  mapping.at = surface.uv;
  mapping.dx = surface.uv_dx;
  mapping.dy = surface.uv_dy;
  return mapping;
}
