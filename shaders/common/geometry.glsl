// Instances and packed vertices. Matches technique/gpu_scene.cpp.

struct InstanceRecord {
  vec4 cameraFromObject[3];  // rows
  uvec4 numbers;             // first triangle's id, first triangle's texel, material, object
};

// Tables are read as texels: software rasterizers read those of eight invocations at once, storage blocks one by one.
layout(binding = 14) uniform usamplerBuffer instance_texels;

InstanceRecord instance_of(uint number) {
  int at = 4 * int(number);
  return InstanceRecord(vec4[3](uintBitsToFloat(texelFetch(instance_texels, at)),
                                uintBitsToFloat(texelFetch(instance_texels, at + 1)),
                                uintBitsToFloat(texelFetch(instance_texels, at + 2))),
                        texelFetch(instance_texels, at + 3));
}

vec3 to_camera(InstanceRecord instance, vec3 point) {
  vec4 p = vec4(point, 1.0);
  precise vec3 seen = vec3(dot(instance.cameraFromObject[0], p), dot(instance.cameraFromObject[1], p),
                           dot(instance.cameraFromObject[2], p));
  return seen;
}

vec3 direction_to_camera(InstanceRecord instance, vec3 direction) {
  return vec3(dot(instance.cameraFromObject[0].xyz, direction), dot(instance.cameraFromObject[1].xyz, direction),
              dot(instance.cameraFromObject[2].xyz, direction));
}

bool is_mirrored(InstanceRecord instance) {
  return dot(instance.cameraFromObject[0].xyz,
             cross(instance.cameraFromObject[1].xyz, instance.cameraFromObject[2].xyz)) < 0.0;
}

// Normals go by the cofactor matrix; a mirrored instance turns them with its winding.
vec3 normal_to_camera(InstanceRecord instance, vec3 normal) {
  vec3 r0 = instance.cameraFromObject[0].xyz, r1 = instance.cameraFromObject[1].xyz, r2 = instance.cameraFromObject[2].xyz;
  vec3 c0 = cross(r1, r2);
  vec3 turned = vec3(dot(c0, normal), dot(cross(r2, r0), normal), dot(cross(r0, r1), normal));
  return is_mirrored(instance) ? -turned : turned;
}

// Unit vectors as two signed 16-bit numbers: the octahedral map (Cigolle et al. 2014).
vec3 unpack_direction(uint bits) {
  vec2 e = unpackSnorm2x16(bits);
  vec3 v = vec3(e, 1.0 - abs(e.x) - abs(e.y));
  if (v.z < 0.0) v.xy = (1.0 - abs(v.yx)) * vec2(v.x < 0.0 ? -1.0 : 1.0, v.y < 0.0 ? -1.0 : 1.0);
  return normalize(v);
}

// attributes: normal, tangent (its lowest bit is the bitangent's sign), u, v
vec3 vertex_normal(uvec4 attributes) {
  return unpack_direction(attributes.x);
}
vec4 vertex_tangent(uvec4 attributes) {
  return vec4(unpack_direction(attributes.y), (attributes.y & 1u) == 0u ? 1.0 : -1.0);
}
vec2 vertex_uv(uvec4 attributes) {
  return uintBitsToFloat(attributes.zw);
}
