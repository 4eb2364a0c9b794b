// The surface where a ray meets a triangle; the quotient rule gives the derivatives of what technique/triangle.glsl names.
#include "common/camera.glsl"
#include "shading/surface.glsl"
#include "technique/triangle.glsl"

Surface surface_of(Triangle t, uint number, PixelRay ray) {
  mat3 planes = mat3(t.sum, t.plane_b, t.plane_c);
  vec3 inside = ray.direction * planes, inside_dx = ray.dx * planes, inside_dy = ray.dy * planes;
  float scale = 1.0 / inside.x;
  vec2 bc = inside.yz * scale;
  vec2 bc_dx = (inside_dx.yz - bc * inside_dx.x) * scale, bc_dy = (inside_dy.yz - bc * inside_dy.x) * scale;

  Surface surface;
  surface.position = ray.direction * (t.volume * scale);
  surface.normal = normalize(t.normal + bc.x * t.normal_b + bc.y * t.normal_c);
#ifdef TRIANGLE_TANGENTS
  surface.tangent = vec4(t.tangent.xyz + bc.x * t.tangent_b + bc.y * t.tangent_c, t.tangent.w);
#else
  surface.tangent = vec4(0.0);
#endif
  surface.uv = t.uv + bc.x * t.uv_b + bc.y * t.uv_c;
  surface.uv_dx = bc_dx.x * t.uv_b + bc_dx.y * t.uv_c;
  surface.uv_dy = bc_dy.x * t.uv_b + bc_dy.y * t.uv_c;
#ifdef TRIANGLE_COLORS
  surface.color = t.color + bc.x * t.color_b + bc.y * t.color_c;
#else
  surface.color = vec4(1.0);
#endif
  surface.triangle = int(number);
  surface.object = int(t.object);
  surface.material = int(t.material);
#ifdef SHADOWS
  surface.plane = t.sum;
#endif
#ifdef EFFECTS
  surface.position_dx = t.edge_b * bc_dx.x + t.edge_c * bc_dx.y;
  surface.position_dy = t.edge_b * bc_dy.x + t.edge_c * bc_dy.y;
  surface.barycentric = vec3(1.0 - bc.x - bc.y, bc);
  surface.barycentric_dx = vec3(-bc_dx.x - bc_dx.y, bc_dx);
  surface.barycentric_dy = vec3(-bc_dy.x - bc_dy.y, bc_dy);
#endif
  return surface;
}
