// A rasterized fragment as a Surface.
#include "technique/mesh_vertex.glsl"
#include "shading/output.glsl"

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

// Triangles that are fetched by number know their own; others are counted by the draw.
int triangle_number() {
#ifdef PULLED
  return int(vertex.part.y);
#else
  return int(vertex.part.y) + gl_PrimitiveID;
#endif
}

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
  surface.triangle = triangle_number();
  surface.object = int(instance.numbers.w);
  surface.material = int(instance.numbers.z);
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
