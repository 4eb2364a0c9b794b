// A rasterized fragment as a Surface.
#include "technique/mesh_vertex.glsl"
#include "shading/output.glsl"

in MESH_VERTEX vertex;

void main() {
  InstanceRecord instance = instances[vertex.part.x];
  Surface surface;
  surface.position = vertex.position;
  surface.normal = normalize(gl_FrontFacing ? vertex.normal : -vertex.normal);
  surface.tangent = vertex.tangent;
  surface.uv = vertex.uv;
  surface.uv_dx = dFdx(vertex.uv);
  surface.uv_dy = dFdy(vertex.uv);
  surface.color = vertex.color;
  surface.triangle = int(vertex.part.y) + gl_PrimitiveID;
  surface.object = int(instance.numbers.w);
  surface.material = int(instance.numbers.z);
  if (surface_is_hole(surface)) discard;
  write_outputs(surface);
}
