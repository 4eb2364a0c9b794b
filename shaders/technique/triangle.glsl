// A triangle as exact techniques see it. With a, b, c the vertices relative to the camera and d a ray: n0 = b x c and so
// on are the edge planes, ni.d / sum nj.d the barycentric coordinates, det(a,b,c) / sum nj.d the distance.
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
