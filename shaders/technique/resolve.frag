// A visible triangle's number and a ray as a Surface. With a, b, c the vertices relative to the camera and d the ray:
// n0 = b x c and so on are the edge planes, ni.d / sum nj.d the barycentric coordinates, det(a,b,c) / sum nj.d the
// distance, and the quotient rule gives their derivatives (docs/architecture.md, "One idea").
#include "technique/visible.glsl"
#include "common/camera.glsl"
#include "shading/output.glsl"
#include "technique/corners.glsl"

layout(binding = 6) uniform usamplerBuffer attributes;
layout(binding = 7) uniform samplerBuffer colors;

void main() {
  uvec2 hit = texelFetch(visible, ivec2(gl_FragCoord.xy), 0).xy;
  InstanceRecord instance = instance_of(hit.y);
  uvec3 corner = corners_of(instance, hit.x);
  vec3 a = corner_position(instance, corner.x);
  vec3 b = corner_position(instance, corner.y);
  vec3 c = corner_position(instance, corner.z);
  // With n1 and n2 written by differences of vertices, and the sum as the triangle's normal, rounding grows with the
  // triangle's distance over its size; with b x c it grows with the square of that, and small triangles fall apart.
  vec3 ab = b - a, ac = c - a;
  mat3 planes = mat3(cross(ab, ac), cross(ac, a), cross(a, ab));  // the sum, n1, n2

  PixelRay ray = camera_ray(gl_FragCoord.xy + pixel_offset);
  vec3 inside = ray.direction * planes, inside_dx = ray.dx * planes, inside_dy = ray.dy * planes;
  float sum = inside.x;
  vec2 bc = inside.yz / sum;
  vec2 bc_dx = (inside_dx.yz - bc * inside_dx.x) / sum, bc_dy = (inside_dy.yz - bc * inside_dy.x) / sum;
  vec3 weight = vec3(1.0 - bc.x - bc.y, bc);
  vec3 weight_dx = vec3(-bc_dx.x - bc_dx.y, bc_dx), weight_dy = vec3(-bc_dy.x - bc_dy.y, bc_dy);
  float volume = dot(a, planes[0]);

  uvec4 a_attributes = texelFetch(attributes, int(corner.x));
  uvec4 b_attributes = texelFetch(attributes, int(corner.y));
  uvec4 c_attributes = texelFetch(attributes, int(corner.z));
  mat3x2 uvs = mat3x2(vertex_uv(a_attributes), vertex_uv(b_attributes), vertex_uv(c_attributes));
  vec3 normal = mat3(vertex_normal(a_attributes), vertex_normal(b_attributes), vertex_normal(c_attributes)) * weight;

  Surface surface;
  surface.position = ray.direction * (volume / sum);
  bool front = (volume < 0.0) != is_mirrored(instance);
  surface.normal = normalize(normal_to_camera(instance, front ? normal : -normal));
#ifdef NORMAL_TEXTURE
  vec4 tangent = vertex_tangent(a_attributes) * weight.x + vertex_tangent(b_attributes) * weight.y +
                 vertex_tangent(c_attributes) * weight.z;
  surface.tangent = vec4(direction_to_camera(instance, tangent.xyz), tangent.w < 0.0 ? -1.0 : 1.0);
#else
  surface.tangent = vec4(0.0);
#endif
  surface.uv = uvs * weight;
  surface.uv_dx = uvs * weight_dx;
  surface.uv_dy = uvs * weight_dy;
  surface.color = texelFetch(colors, int(corner.x)) * weight.x + texelFetch(colors, int(corner.y)) * weight.y +
                  texelFetch(colors, int(corner.z)) * weight.z;
  surface.triangle = int(hit.x);
  surface.object = int(instance.numbers.w);
  surface.material = int(instance.numbers.z);
#ifdef EFFECTS
  surface.position_dx = ab * bc_dx.x + ac * bc_dx.y;
  surface.position_dy = ab * bc_dy.x + ac * bc_dy.y;
  surface.barycentric = weight;
  surface.barycentric_dx = weight_dx;
  surface.barycentric_dy = weight_dy;
#endif
  write_outputs(surface);
}
