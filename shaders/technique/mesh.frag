// A rasterized fragment as a Surface.
#include "technique/mesh_vertex.glsl"
#include "shading/output.glsl"
#ifdef EFFECTS
#include "technique/corners.glsl"
#endif

in MESH_VERTEX vertex;

#ifdef PIECES
#include "technique/piecewise/owner.glsl"
flat in uint vertex_piece;
#endif

// Whether the side that is seen is the front, which windings tell; a mirror image turns them round.
bool is_front() {
#ifdef MIXED_PIECES
  return gl_FrontFacing != ((piece_flags(vertex_piece) & PIECE_MIRRORED) != 0);
#else
  return gl_FrontFacing;
#endif
}

#ifdef SORTED
layout(binding = 24) uniform usamplerBuffer sorted_triangles;  // ids in the order in which they are drawn
uniform int first_sorted;
#endif

// Triangles that are fetched by number know their own, sorted ones have a list; others are counted by the draw.
int triangle_number() {
#if defined PULLED
  return int(vertex.part.y);
#elif defined SORTED
  return int(texelFetch(sorted_triangles, first_sorted + gl_PrimitiveID).x);
#else
  return int(vertex.part.y) + gl_PrimitiveID;
#endif
}

#ifdef EFFECTS
// Where the surface lies in its triangle. A point of its plane is linear in the coordinates, so they change as it does.
void set_barycentric(inout Surface surface, InstanceRecord instance) {
  uvec3 corner = corners_of(instance, uint(surface.triangle));
  vec3 a = corner_position(instance, corner.x);
  vec3 ab = corner_position(instance, corner.y) - a, ac = corner_position(instance, corner.z) - a;
  vec3 normal = cross(ab, ac);
  mat2x3 bcFromPlane = mat2x3(cross(ac, normal), cross(normal, ab)) / dot(normal, normal);
  vec2 bc = (surface.position - a) * bcFromPlane;
  vec2 bc_dx = surface.position_dx * bcFromPlane, bc_dy = surface.position_dy * bcFromPlane;
  surface.barycentric = vec3(1.0 - bc.x - bc.y, bc);
  surface.barycentric_dx = vec3(-bc_dx.x - bc_dx.y, bc_dx);
  surface.barycentric_dy = vec3(-bc_dy.x - bc_dy.y, bc_dy);
}
#endif

void main() {
  InstanceRecord instance = instance_of(vertex.part.x);
  Surface surface;
  surface.position = vertex.position;
  surface.normal = normalize(is_front() ? vertex.normal : -vertex.normal);
  surface.tangent = vertex.tangent;
  surface.uv = vertex.uv;
  surface.uv_dx = dFdx(vertex.uv);
  surface.uv_dy = dFdy(vertex.uv);
  surface.color = vertex.color;
#ifdef SHADOWS
  surface.plane = cross(dFdx(vertex.position), dFdy(vertex.position));
#endif
  surface.triangle = triangle_number();
  surface.object = int(instance.numbers.w);
  surface.material = int(instance.numbers.z);
#ifdef EFFECTS
  surface.position_dx = dFdx(vertex.position);
  surface.position_dy = dFdy(vertex.position);
  set_barycentric(surface, instance);
#endif
#ifdef PIECES
  int samples = samples_of(vertex_piece, ivec2(gl_FragCoord.xy));
  if (samples == 0 || surface_is_hole(surface)) discard;
#if SAMPLES > 1
  gl_SampleMask[0] = samples;
#endif
#else
  if (surface_is_hole(surface)) discard;
#endif
  write_outputs(surface);
}
