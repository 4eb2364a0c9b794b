// Coordinates on a surface and their change per pixel to the right and down.
struct Mapping {
  vec2 at, dx, dy;
};

// How far each coordinate changes over a pixel.
vec2 footprint_of(Mapping mapping) {
  return sqrt(mapping.dx * mapping.dx + mapping.dy * mapping.dy);
}

// World metres along the two axes that the surface faces least: the second is up wherever it is no floor. Where it
// faces two alike, rounding must not choose.
Mapping world_mapping(Surface surface) {
  mat3 world = mat3(frame.worldFromCamera);
  vec3 at = (frame.worldFromCamera * vec4(surface.position, 1.0)).xyz;
  vec3 dx = world * surface.position_dx, dy = world * surface.position_dy;
  vec3 facing = abs(world * surface.normal) * vec3(1.002, 1.001, 1.0);
  if (facing.y > max(facing.x, facing.z)) return Mapping(at.xz, dx.xz, dy.xz);
  if (facing.x > facing.z) return Mapping(at.zy, dx.zy, dy.zy);
  return Mapping(at.xy, dx.xy, dy.xy);
}

Mapping uv_mapping(Surface surface) {
  return Mapping(surface.uv, surface.uv_dx, surface.uv_dy);
}
