// A triangle on its way to the fragments that decide what of it is seen.
#define EXACT_TRIANGLE ExactTriangle { \
  flat uvec3 number;           /* triangle's id, instance, the edges (as bits) that own what lies on them */ \
  flat vec3 plane[3];          /* through the camera's centre and the edges bc, ca and ab, pointing inwards */ \
  flat vec4 inverse_distance;  /* dot(xyz, d) / w along a ray d of unit length */ \
}
