// Up to 64 triangles of a part, tested as one before each for itself.
struct ClusterRecord {
  vec4 sphere;  // centre and radius, object frame
  uint part, first, count;
};
layout(binding = 20) uniform usamplerBuffer cluster_texels;
uniform uint cluster_count;

ClusterRecord cluster_of(uint number) {
  uvec4 triangles = texelFetch(cluster_texels, 2 * int(number) + 1);
  return ClusterRecord(uintBitsToFloat(texelFetch(cluster_texels, 2 * int(number))), triangles.x, triangles.y, triangles.z);
}
