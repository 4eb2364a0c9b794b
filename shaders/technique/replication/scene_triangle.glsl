// The scene's triangles by number, for stages that are not given vertices.
#include "technique/corners.glsl"

layout(binding = 6) uniform usamplerBuffer attributes;
layout(binding = 7) uniform samplerBuffer colors;

// A part of an instance, as technique/gpu_scene.h has them, of 1024 triangles at most.
struct PartRecord {
  uint instance;
  uint first_triangle;  // id
  uint count;
  float cull_sign;  // 1: faces that turn away are left out; -1: in a mirrored instance; 0: none is
};

layout(binding = 19) uniform usamplerBuffer part_texels;

PartRecord part_of(uint number) {
  uvec4 texel = texelFetch(part_texels, int(number));
  return PartRecord(texel.x, texel.y, texel.z, uintBitsToFloat(texel.w));
}

// An item is a triangle of a part: both numbers in one.
const uint ITEM_BITS = 10u;
uint item_of(uint part, uint triangle) { return part << ITEM_BITS | triangle; }
uint item_part(uint item) { return item >> ITEM_BITS; }
uint item_triangle(uint item) { return item & ((1u << ITEM_BITS) - 1u); }

// The vertices' numbers.
uvec3 item_corners(uint item, PartRecord part, InstanceRecord instance) {
  return corners_of(instance, part.first_triangle + item_triangle(item));
}
