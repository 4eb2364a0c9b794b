// A triangle as exact techniques see it, and the surface where a ray meets it. With a, b, c the vertices relative to the
// camera and d the ray: n0 = b x c and so on are the edge planes, ni.d / sum nj.d the barycentric coordinates,
// det(a,b,c) / sum nj.d the distance, and the quotient rule gives their derivatives.
#include "common/camera.glsl"
#include "shading/surface.glsl"
#include "technique/corners.glsl"

layout(binding = 6) uniform usamplerBuffer attributes;
layout(binding = 7) uniform samplerBuffer colors;

// What is constant over a triangle, in the camera frame. Attributes are those of corner a and how much those of b and c
// differ from it.
struct Triangle {
  vec3 sum, plane_b, plane_c;  // edge planes: n0 + n1 + n2, n1, n2
  float volume;                // det(a,b,c)
  vec2 uv, uv_b, uv_c;
  vec3 normal, normal_b, normal_c;  // on the camera's side
  float material, object;
#ifdef TRIANGLE_TANGENTS
  vec4 tangent;  // w: the bitangent's sign
  vec3 tangent_b, tangent_c;
#endif
#ifdef TRIANGLE_COLORS
  vec4 color, color_b, color_c;
#endif
#ifdef EFFECTS
  vec3 edge_b, edge_c;  // metres
#endif
};

Triangle triangle_of(uint number, InstanceRecord instance) {
  uvec3 corner = corners_of(instance, number);
  vec3 a = corner_position(instance, corner.x);
  vec3 b = corner_position(instance, corner.y);
  vec3 c = corner_position(instance, corner.z);
  // With n1 and n2 written by differences of vertices, and the sum as the triangle's normal, rounding grows with the
  // triangle's distance over its size; with b x c it grows with the square of that, and small triangles fall apart.
  vec3 ab = b - a, ac = c - a;
  Triangle t;
  t.sum = cross(ab, ac);
  t.plane_b = cross(ac, a);
  t.plane_c = cross(a, ab);
  t.volume = dot(a, t.sum);

  uvec4 a_attributes = texelFetch(attributes, int(corner.x));
  uvec4 b_attributes = texelFetch(attributes, int(corner.y));
  uvec4 c_attributes = texelFetch(attributes, int(corner.z));
  t.uv = vertex_uv(a_attributes);
  t.uv_b = vertex_uv(b_attributes) - t.uv;
  t.uv_c = vertex_uv(c_attributes) - t.uv;
  float side = (t.volume < 0.0) != is_mirrored(instance) ? 1.0 : -1.0;
  vec3 normal = vertex_normal(a_attributes);
  t.normal = side * normal_to_camera(instance, normal);
  t.normal_b = side * normal_to_camera(instance, vertex_normal(b_attributes) - normal);
  t.normal_c = side * normal_to_camera(instance, vertex_normal(c_attributes) - normal);
  t.material = float(instance.numbers.z);
  t.object = float(instance.numbers.w);
#ifdef TRIANGLE_TANGENTS
  vec4 tangent = vertex_tangent(a_attributes);
  t.tangent = vec4(direction_to_camera(instance, tangent.xyz), tangent.w);
  t.tangent_b = direction_to_camera(instance, vertex_tangent(b_attributes).xyz - tangent.xyz);
  t.tangent_c = direction_to_camera(instance, vertex_tangent(c_attributes).xyz - tangent.xyz);
#endif
#ifdef TRIANGLE_COLORS
  t.color = texelFetch(colors, int(corner.x));
  t.color_b = texelFetch(colors, int(corner.y)) - t.color;
  t.color_c = texelFetch(colors, int(corner.z)) - t.color;
#endif
#ifdef EFFECTS
  t.edge_b = ab;
  t.edge_c = ac;
#endif
  return t;
}

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
