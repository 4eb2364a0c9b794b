// A visible triangle and a ray as a Surface.
#include "technique/sight.glsl"
#include "technique/triangle_record.glsl"
#include "technique/triangle_surface.glsl"
#include "shading/output.glsl"

layout(binding = 11) uniform samplerBuffer triangle_records;
uniform int material_number;

void main() {
  uint seen = visible_at(ivec2(gl_FragCoord.xy));
  // Squares reach over pixels of other materials.
  if (seen == NOTHING) discard;
  Triangle t = unpack_triangle(triangle_records, int(seen));
  if (int(t.material) != material_number) discard;
  uint number = texelFetch(visible_triangles, int(seen)).x;
  write_outputs(surface_of(t, number, camera_ray(sight_pixel())));
#ifdef SAMPLES
  out_color *= sight_share();
#endif
}
