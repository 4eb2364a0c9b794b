// The tree of a camera's rays: nodes with sixteen children, leaves of 4 x 4 rays. Levels lie one after another, the
// leaves first; the children of a level's n-th node are 16 n to 16 n + 15 of the level below.
layout(binding = 16) uniform usamplerBuffer cone_texels;      // axis, sine of the half angle
layout(binding = 17) uniform usamplerBuffer farthest_texels;  // what each node's rays see: least inverse distance

// All directions d with d . axis >= cosine. An axis of zero is every direction, the sine then one.
struct Node {
  vec3 axis;
  float sine, cosine;
  float farthest;  // 1/metres; 0 where a ray sees nothing
  bool has_rays;
};

const uint NO_RAYS = 0x7f800000u;  // in the place of an inverse distance
// What bounds are widened by, relatively: more than single precision takes off a few products.
const float SLACK = 1e-5;
const float SMALLEST_SQUARE = 1e-36;

Node node_of(uint number) {
  vec4 cone = uintBitsToFloat(texelFetch(cone_texels, int(number)));
  uint farthest = texelFetch(farthest_texels, int(number)).x;
  bool has_rays = farthest != NO_RAYS;
  float cosine = sqrt(max(0.0, 1.0 - cone.w * cone.w));
  return Node(cone.xyz, cone.w, cosine, has_rays ? uintBitsToFloat(farthest) : 0.0, has_rays);
}
