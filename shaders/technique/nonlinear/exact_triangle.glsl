// A triangle on its way to the fragments that decide what of it is seen.
#define EXACT_TRIANGLE ExactTriangle { \
  flat uvec3 number;           /* triangle's id, instance, bits of edges: 0-2 own what lies on them, 3-5 reach over */ \
  flat vec3 plane[3];          /* through the camera's centre and the edges bc, ca and ab, pointing inwards */ \
  flat vec4 inverse_distance;  /* dot(xyz, d) / w along a ray d of unit length */ \
}
