// The scene as technique/visibility/gpu_bodies.cpp lays it out: groups of sixteen clusters of sixteen triangles.
#include "technique/visibility/tree.glsl"

// Lengths are metres times `scale`, which brings everything that a body holds near 1.
struct Placement {
  vec3 column[3], origin;  // cameraFromObject, scaled
  float scale;
  float pad;  // what rounding may move a point by
  uint first_part;
  bool blended;
};

// In the body's own frame.
struct Box {
  vec3 centre, half_size;
  uint first, count;  // of a group: its clusters; of a cluster: its part, 16
};

layout(binding = 20) uniform usamplerBuffer placement_texels;
layout(binding = 21) uniform usamplerBuffer placed_group_texels;  // placement, group
layout(binding = 22) uniform usamplerBuffer group_texels;
layout(binding = 23) uniform usamplerBuffer cluster_texels;

Placement placement_of(uint number) {
  int at = 4 * int(number);
  vec4 x = uintBitsToFloat(texelFetch(placement_texels, at)), y = uintBitsToFloat(texelFetch(placement_texels, at + 1));
  vec4 z = uintBitsToFloat(texelFetch(placement_texels, at + 2));
  uvec4 more = texelFetch(placement_texels, at + 3);
  return Placement(vec3[3](x.xyz, y.xyz, z.xyz), vec3(x.w, y.w, z.w), uintBitsToFloat(more.x), uintBitsToFloat(more.y),
                   more.z, more.w != 0u);
}

Box box_at(uvec4 first, uvec4 second) {
  return Box(uintBitsToFloat(first.xyz), uintBitsToFloat(second.xyz), first.w, second.w);
}
Box group_of(uint number) {
  return box_at(texelFetch(group_texels, 2 * int(number)), texelFetch(group_texels, 2 * int(number) + 1));
}
Box cluster_of(uint number) {
  return box_at(texelFetch(cluster_texels, 2 * int(number)), texelFetch(cluster_texels, 2 * int(number) + 1));
}

// The same to the bit wherever a vertex is asked for.
vec3 to_camera(Placement placement, vec3 point) {
  precise vec3 seen = placement.column[0] * point.x + placement.column[1] * point.y + placement.column[2] * point.z +
                      placement.origin;
  return seen;
}

// False where no ray of the node meets the box, or all of them see something nearer. The plane that touches the cone on
// the side of the box's centre parts the two if the whole box is beyond it.
bool may_see(Box box, Placement placement, Node node) {
  vec3 c = to_camera(placement, box.centre);
  float along = dot(c, node.axis);
  vec3 across = c - node.axis * along;
  float height = sqrt(max(dot(across, across), SMALLEST_SQUARE));
  vec3 outwards = across * (node.cosine / height) - node.axis * node.sine;
  float beyond = height * node.cosine - along * node.sine;
  float reach = 0.0, depth = 0.0;
  for (int i = 0; i < 3; ++i) {
    reach += box.half_size[i] * abs(dot(placement.column[i], outwards));
    depth += box.half_size[i] * abs(dot(placement.column[i], node.axis));
  }
  float room = 2e-6 * (height + abs(along)) + SLACK * reach + placement.pad;
  float nearest = (along - depth * (1.0 + SLACK) - room) / placement.scale;
  return node.has_rays && beyond <= reach + room && nearest * node.farthest <= 1.0 + SLACK;
}
